#!/usr/bin/env bash
# A run with Accuracy whose cells do not suffice at first: its parameters.prm, run again, gives the same to the last bit, errors
# included; so does a run that is interrupted in the coarser run, in the first one that counts or in the one with more cells,
# and goes on. Another scene is refused, and a checkpoint of the coarser run is not destroyed unasked.
# usage: accuracy_program.sh DEBOND
set -euo pipefail
set -m # else the shell lets its background processes ignore SIGINT
debond=$1
rm -rf results && mkdir results
# The tolerance makes hundreds of steps, in which signals come; one of the cells is more than 0.12 % off.
cat > scene.prm <<SCENE
include $(cd "$(dirname "$0")" && pwd)/coin.prm
set Accuracy = 0.12 %
subsection Interface
  set Normal stiffness              = 622
  set Tangential stiffness          = 305
  set Friction coefficient broken   = 0.40
  set Friction coefficient unbroken = 0.586
  set Characteristic slip distance  = 0.042
  set Transition factor             = 0.74
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Tolerance = 1e-5
end
subsection Output
  set Fields every = none
  set Report       = false
end
SCENE

fail() {
  echo "FAILED: $*"
  exit 1
}

# Waits until a command is true.
wait_until() {
  for _ in $(seq 6000); do
    if "$@" 2> /dev/null; then
      return
    fi
    sleep 0.01
  done
  fail "never: $*"
}
has_lines() {
  [ -f "$1" ] && [ "$(wc -l < "$1")" -ge "$2" ]
}

run() {
  "$debond" scene.prm --threads 1 --set "Output/Directory=$1" "${@:2}" > "$1.log" 2>&1
}
exec_run() { # in the background: the process that $! names is the program
  exec "$debond" "$@" --threads 1
}

# Interrupts the process $process in a directory, which says so with these words. Not to be called in a subshell.
interrupt() {
  local directory=$1 words=$2 code=0
  kill -s INT "$process"
  wait "$process" || code=$?
  [ "$code" = 130 ] || fail "exit code $code after a signal in $directory"
  grep -q "$words; debond --resume '$directory' goes on from there" "$directory.log" || fail "message in $directory.log"
}
start() {
  exec_run scene.prm --set "Output/Directory=$1" > "$1.log" 2>&1 &
  process=$!
}
resume() {
  "$debond" --resume "$@" --threads 1 > "$1.log" 2>&1 || fail "going on with $1"
}
in_coarser="interrupted in the coarser run, which tells the error"
in_run="interrupted by SIGINT after step [0-9]*"

# All errors of a summary.
errors() {
  grep 'error' "$1/summary.json" > "$1.errors"
  [ "$(wc -l < "$1.errors")" -gt 20 ] || fail "there are no errors in $1"
}
same() {
  errors "$1"
  errors "$2"
  cmp "$1.errors" "$2.errors" || fail "$3: other errors"
  for file in torque.csv curve.csv errors.csv coarser/torque.csv; do
    cmp "$1/$file" "$2/$file" || fail "$3: another $file"
  done
}

run results/whole || fail "a run in one go"
[ "$(grep -c "once more with" results/whole.log)" = 1 ] || fail "the run was not repeated once, with more cells"
! grep -q warning results/whole.log || fail "there is a warning"
echo "more cells, once: yes"

"$debond" results/whole/parameters.prm --threads 1 --set Output/Directory=results/again > results/again.log 2>&1 || fail "parameters.prm"
! grep -q "once more with" results/again.log || fail "its own parameters do not suffice"
same results/whole results/again "parameters.prm run again"
echo "its parameters give the same: yes"

start results/coarser
wait_until has_lines results/coarser/coarser/torque.csv 20
interrupt results/coarser "$in_coarser"
[ ! -e results/coarser/torque.csv ] || fail "that was not the coarser run"
if "$debond" scene.prm --set Output/Directory=results/coarser > anew.log 2>&1; then
  fail "a checkpoint is destroyed without --force"
fi
grep -q "holds the checkpoint of a run that was interrupted after step [0-9]*: debond --resume" anew.log || fail "message about a checkpoint"
if "$debond" --resume results/coarser scene.prm --set "Interface/Friction coefficient broken=0.3" > refused.log 2>&1; then
  fail "another scene is not refused"
fi
grep -q "Interface / Friction coefficient broken is 0.3, the checkpoint's 0.40" refused.log || fail "the difference is not named"
resume results/coarser
same results/whole results/coarser "interrupted in the coarser run"
echo "interrupted in the coarser run: yes"

start results/first
wait_until has_lines results/first/torque.csv 20
interrupt results/first "$in_run"
! grep -q "once more with" results/first.log || fail "that was not the first run"
resume results/first
! grep -q "For the error first" results/first.log || fail "the coarser run was made again"
same results/whole results/first "interrupted in the first run"
echo "interrupted in the first run: yes"

start results/finer
wait_until grep -q "once more with" results/finer.log
cells=$(sed -n "s/.*once more with \(.*\) and .*/\1/p" results/finer.log)
wait_until grep -q "set Cells *= $cells$" results/finer/parameters.prm
wait_until has_lines results/finer/torque.csv 20
interrupt results/finer "$in_run"
resume results/finer
same results/whole results/finer "interrupted in the run with more cells"
echo "interrupted in the run with more cells: yes"

# One after the other in the same directory.
start results/twice
wait_until has_lines results/twice/coarser/torque.csv 20
interrupt results/twice "$in_coarser"
exec_run --resume results/twice > results/twice.log 2>&1 &
process=$!
wait_until has_lines results/twice/torque.csv 20
interrupt results/twice "$in_run"
resume results/twice
same results/whole results/twice "interrupted twice"
echo "interrupted twice: yes"

# Cells of the bone that the scene sets stay; the coarser run has fewer of them in any case.
run results/half --set "Bone/Cells=9, 9, 2" --set "Accuracy=0.15 %" || fail "cells of the bone"
grep -q "once more with 9, 9, 2 and " results/half.log || fail "cells of the implant are not more"
"$debond" results/half/parameters.prm --threads 1 --set Output/Directory=results/half_again > results/half_again.log 2>&1 ||
  fail "parameters.prm of a scene that sets cells"
same results/half results/half_again "cells of the bone"
echo "cells of the bone are those of the scene: yes"

"$debond" --resume results/whole | grep -q "is finished. A scene, or --set" || fail "a finished run"
echo "a finished run is no error: yes"

# By the scene, which leaves open what was chosen and names another directory.
start results/by_scene
wait_until has_lines results/by_scene/torque.csv 20
interrupt results/by_scene "$in_run"
resume results/by_scene scene.prm
same results/whole results/by_scene "going on by the scene"
echo "goes on by the scene: yes"

grep -Eq "Largest torque 53\.[0-9]+ \+- 0\.0[1-9][0-9] N mm at 1\.[0-9]+ \+- 0\.0" results/whole.log || fail "the error is not said with two digits"
echo "errors have two digits: yes"

# More cells that fail: thin layers of large cells turn them inside out. The result before them stays, and says so.
cat > cup.prm <<SCENE
set Accuracy = 0.3 %
subsection Bone
  set Shape         = cavity
  set Outer radius  = 6
  set Ends          = slide
  set Young modulus = 4740
  set Material      = linear
end
subsection Implant
  set Shape         = cup
  set Radius        = 3
  set Height        = 3
  set Young modulus = 3600
  set Material      = linear
end
subsection Interface
  set Normal stiffness     = 124000
  set Tangential stiffness = 124000
  set Friction law         = coulomb
  set Friction coefficient = 0.4
  set Interference         = 0.002
end
subsection Load steps
  set Times     = 0, 1
  set Tolerance = 0.002
end
subsection Chuck
  subsection Rotation z
    set Value = 0.02 * t
  end
end
subsection Output
  set Report = false
end
subsection Expert
  subsection Bone
    set Layer grading = 3
  end
end
SCENE
"$debond" cup.prm --threads 1 --set Output/Directory=results/cup > results/cup.log 2>&1 || fail "a scene whose finer cells fail"
grep -q "^warning: more cells, 8, 6, 5 and 8, 3, 5, fail: " results/cup.log || fail "no warning that more cells fail"
grep -q "^ *set Cells *= 8, 4, 3" results/cup/parameters.prm || fail "cells after more of them have failed"
grep -q '"converged": true' results/cup/summary.json || fail "summary after more cells have failed"
echo "more cells that fail leave the result before them: yes"
