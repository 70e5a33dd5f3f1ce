# Directories that cannot be written into.
cp "$here/files/turn.prm" input.prm
debond input.prm --set Output/Directory=/proc/debond
debond input.prm --set Output/Directory=/dev/null
