# Directories that cannot be written into, with models that are no finite elements.
cp "$here/files/turn.prm" input.prm
debond input.prm --set Model=analytical --set "Closed form/Pressure=2" --set Output/Directory=/dev/null
debond input.prm --set Model=auto --set Output/Directory=/dev/null
