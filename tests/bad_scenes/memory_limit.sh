# A mesh that this machine has memory for, but not within a limit that is set.
cp "$here/files/turn.prm" input.prm
(
  ulimit -v 1500000
  debond input.prm --set "Bone/Cells=100, 100, 10" --set "Implant/Cells=60, 20"
)
# One that leaves less than the threads of OpenBLAS want, which wait for it for ever: the program ends all the same.
(
  ulimit -v 700000
  debond input.prm --threads 1
)
