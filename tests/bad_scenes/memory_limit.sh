# A mesh that this machine has memory for, but not within a limit that is set.
cp "$here/files/turn.prm" input.prm
(
  ulimit -v 1500000
  debond input.prm --set "Bone/Cells=100, 100, 10" --set "Implant/Cells=60, 20"
)
# One that leaves less than the threads of OpenBLAS want, which wait for it for ever: the program ends all the same.
# (Below some limit OpenBLAS waits before main() begins. The libraries of Debian 13 take more than those of 12.)
limit=900000
if grep -qs "^VERSION_CODENAME=bookworm" /etc/os-release; then limit=700000; fi
(
  ulimit -v $limit
  debond input.prm --threads 1
)
