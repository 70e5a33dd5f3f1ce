#!/bin/bash
# first_steps.sh SOURCE BUILD PYTHON PACKAGES   doc/first_steps.sh with the packages in this directory
# first_steps.sh SOURCE BUILD PYTHON            the same with the program and the module of the build tree
# Prints what that script has found right.
set -eu
export PYTHONNOUSERSITE=1 # ./quickstart has told this user's Python where the build is
source=$1 build=$2 python=$3 packages=${4:-}
mkdir work && cd work # ctest writes into a file output
BUILD=$build PYTHON=$python "$source/doc/first_steps.sh" --unpack "$packages" steps > log 2>&1 || { cat log && exit 1; }
grep '^ok: ' log
