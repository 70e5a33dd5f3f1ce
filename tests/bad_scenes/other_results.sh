# A directory that holds results of another scene.
mkdir input_results
echo "set Title = another" > input_results/parameters.prm
debond "$here/files/turn.prm" --set Output/Directory=input_results
