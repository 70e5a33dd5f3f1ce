# --set with an entry that does not exist, without a value, without a name, and with what a scene could not hold.
cp "$here/files/turn.prm" input.prm
debond input.prm --set Interface/Penalty=1800
debond input.prm --set "Interface/Penalty stiffness"
debond input.prm --set "=1800"
debond input.prm --set "/=1800"
debond input.prm --set "Interface//Penalty stiffness=1800"
debond input.prm --set "Title=a # b"
debond input.prm --set "Interface/Penalty stiffness=stiff"
