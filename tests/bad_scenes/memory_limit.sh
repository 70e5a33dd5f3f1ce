# A mesh that this machine has memory for, but not within a limit that is set.
cp "$here/files/turn.prm" input.prm
(
  ulimit -v 1500000
  debond input.prm --set "Bone/Cells=100, 100, 10" --set "Implant/Cells=60, 20"
)
