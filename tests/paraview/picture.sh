#!/bin/sh
# Runs a scene, makes pictures of it, and looks at them: picture.sh DEBOND PVPYTHON
# picture.sh DEBOND PVPYTHON mistakes: what is refused, and what ParaView's window runs. Each start of ParaView takes seconds.
set -eu
here=$(dirname "$0")
scripts=$here/../../doc/paraview
unset DISPLAY # must do without a screen
"$1" "$here/quarter.prm" --force
"$1" "$here/quarter.prm" --force --set Bone/Material=linear --set Implant/Material=linear --set Output/Directory=results/elastic

if [ "${3-}" != mistakes ]; then
  rm -f quarter.png
  "$2" "$scripts/debonding_front.py" results/quarter --field mu --angles 0.4 4 --width 500 --output quarter.png
  "$2" "$here/check_picture.py" quarter.png

  # all that is opened in ParaView, of elastic bodies, from a state file
  rm -rf opened
  mkdir opened
  "$2" "$scripts/open_results.py" results/elastic --state opened/view.pvsm --pictures opened --width 960 > opened/text
  "$2" "$here/check_opened.py" results/elastic opened opened/text opened/view.pvsm
  exit
fi

# an angle without files is refused, and those with files are named
if "$2" "$scripts/debonding_front.py" results/quarter --angles 2 > messages 2>&1; then exit 1; fi
grep -q "no file at angle 2; there are 0, 0.4, 4" messages

# both bodies, which are rigid
rm -f mesh.png
"$2" "$scripts/bodies.py" mesh results/quarter --width 400 --output mesh.png | grep -qx "mesh.png: 400 x 182 pixels"
if "$2" "$scripts/bodies.py" stress results/quarter --output stress.png > messages 2>&1; then exit 1; fi
grep -q "bodies.py: results/quarter: there is no stress anywhere" messages

# as a script of ParaView's window, which has no name and no arguments there
DEBOND_RESULTS=results/elastic "$2" "$here/as_in_the_window.py"
# mistakes are named
if "$2" "$scripts/open_results.py" results/elastic --angles 2 > messages 2>&1; then exit 1; fi
grep -q "open_results.py: results/elastic: no file at angle 2; there are 0, 0.4, 4" messages
if "$2" "$scripts/open_results.py" results/elastic --fields psi > messages 2>&1; then exit 1; fi
grep -q "open_results.py: --fields psi: there is no such field" messages
