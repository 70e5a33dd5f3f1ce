# A run that is to go on in another directory than that of its results.
cp "$here/files/turn.prm" input.prm
mkdir input_results
cp input.prm input_results/parameters.prm
debond --resume input_results input.prm --set Output/Directory=elsewhere
# the same one is no mistake, but there is no checkpoint
debond --resume input_results input.prm --set Output/Directory=./input_results/
