#!/bin/bash
# quickstart.sh RELEASE SOURCE: makes a Debian of this release, and in it the two commands of README.md. Needs root,
# debootstrap and 8 GB. Prints what must be so.
set -eu
if [[ -z ${DEBOND_UNSHARED:-} ]]; then DEBOND_UNSHARED=1 exec unshare --mount "$0" "$@"; fi
. "$(dirname "$(realpath "$0")")/tree.sh"
release=$1 source=$2
mkdir work && cd work # ctest writes into a file output
make_tree "$release"
mount --rbind /dev "$tree/dev" # for MPI
mkdir "$tree/debond"
git -C "$source" ls-files -z | tar -C "$source" --null --files-from=- -c | tar -C "$tree/debond" -x
run() {
  inside "$tree" env HOME=/root LC_ALL=C.UTF-8 sh -c "cd /debond && ./quickstart $*" > "quickstart$*.log" || true
}
run
grep -o "Largest torque [0-9]*" quickstart.log || tail -n 50 quickstart.log
grep -E "(:[0-9]+|ld): warning:" quickstart.log || true # of the compiler and the linker
run test
grep -o "100% tests passed" quickstarttest.log || tail -n 50 quickstarttest.log
