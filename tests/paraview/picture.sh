#!/bin/sh
# Runs a scene, makes a picture of it, and looks at its pixels: picture.sh DEBOND PVPYTHON
set -eu
here=$(dirname "$0")
"$1" "$here/quarter.prm" --force
rm -f quarter.png
unset DISPLAY # must do without a screen
"$2" "$here/../../doc/paraview/debonding_front.py" results/quarter --field mu --angles 0.4 4 --width 500 --output quarter.png
"$2" "$here/check_picture.py" quarter.png

# an angle without files is refused, and those with files are named
if "$2" "$here/../../doc/paraview/debonding_front.py" results/quarter --angles 2 > messages 2>&1; then exit 1; fi
grep -q "no file at angle 2; there are 0, 0.4, 4" messages

# both bodies, which are rigid
rm -f mesh.png
"$2" "$here/../../doc/paraview/bodies.py" mesh results/quarter --width 400 --output mesh.png | grep -qx "mesh.png: 400 x 182 pixels"
if "$2" "$here/../../doc/paraview/bodies.py" stress results/quarter --output stress.png > messages 2>&1; then exit 1; fi
grep -q "bodies.py: results/quarter: there is no stress anywhere" messages
