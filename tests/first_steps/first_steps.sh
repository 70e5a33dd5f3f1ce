#!/bin/bash
# first_steps.sh SOURCE BUILD PYTHON packages   doc/first_steps.sh with the packages of a build
# first_steps.sh SOURCE BUILD PYTHON build      the same with the program and the module of the build tree
# Prints what that script has found right.
set -eu
source=$1 build=$2 python=$3 with=$4
mkdir work && cd work # ctest writes into a file output
packages=
if [[ $with == packages ]]; then
  packages=$PWD/packages
  cpack --config "$build/CPackConfig.cmake" -B "$packages" > log 2>&1 || { cat log && exit 1; }
  rm -r "$packages/_CPack_Packages"
fi
BUILD=$build PYTHON=$python "$source/doc/first_steps.sh" --unpack "$packages" steps > log 2>&1 || { cat log && exit 1; }
grep '^ok: ' log
