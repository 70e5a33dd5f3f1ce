#!/usr/bin/env bash
# The program under signals: it stops after the step at work with 128 + the signal's number, says how to go on, and
# then leaves the torque curve of a run in one go; what nohup ignores stays ignored; a directory belongs to
# one run at a time; a checkpoint is not destroyed unasked; a study ends with its variants and goes on from their
# checkpoints; a closed pipe ends no run. usage: interrupted_program.sh DEBOND
set -euo pipefail
set -m # else the shell lets its background processes ignore SIGINT
debond=$1
rm -rf results && mkdir results
cat > scene.prm <<SCENE
include $(cd "$(dirname "$0")" && pwd)/coin.prm
subsection Bone
  set Cells    = 6, 6, 2
  set Material = linear
end
subsection Implant
  set Material = linear
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 5 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 600
end
subsection Output
  set Fields every = 300
end
SCENE

fail() {
  echo "FAILED: $*"
  exit 1
}

# Waits until a file has that many lines.
wait_for_lines() {
  for _ in $(seq 6000); do
    if [ -f "$1" ] && [ "$(wc -l < "$1")" -ge "$2" ]; then
      return
    fi
    sleep 0.01
  done
  fail "no $2 lines in $1"
}

run() {
  "$debond" scene.prm --threads 1 --set "Output/Directory=$1"
}
exec_run() { # in the background: the process that $! names is the program
  exec "$debond" scene.prm --threads 1 --set "Output/Directory=$1"
}

# Runs into a directory and sends a signal after some rows; code is the exit code. Not to be called in a subshell,
# where `set -m` has no effect.
interrupt() {
  local directory=$1 signal=$2
  exec_run "$directory" > "$directory.log" 2>&1 &
  local process=$!
  wait_for_lines "$directory/torque.csv" 20
  kill -s "$signal" $process
  code=0
  wait $process || code=$?
}

run results/whole > results/whole.log 2>&1 || fail "a run in one go"
for signal in INT:130 HUP:129 TERM:143; do
  directory=results/${signal%:*}
  interrupt "$directory" "${signal%:*}"
  [ "$code" = "${signal#*:}" ] || fail "exit code $code after $signal"
  grep -q "interrupted by SIG${signal%:*} after step [0-9]*; debond --resume '$directory' goes on" "$directory.log" ||
    fail "message after $signal"
  grep -q '"converged": false' "$directory/summary.json" || fail "summary after $signal"
  "$debond" --resume "$directory" --threads 1 > "$directory.log" 2>&1 || fail "going on after $signal"
  for file in torque.csv bulk-0002.vtu interface-0002.vtu interface.pvd; do
    cmp "$directory/$file" "results/whole/$file" || fail "other results after $signal"
  done
done
echo "stops and goes on: yes"

"$debond" --resume results/INT | grep -q "is finished. A scene, or --set" || fail "a finished run"
echo "a finished run is no error: yes"

interrupt results/refused TERM
if "$debond" --resume results/refused scene.prm --set Interface/Viscosity=1 > refused.log 2>&1; then
  fail "another scene is not refused"
fi
grep -q "Interface / Viscosity is 1, the checkpoint's 0" refused.log || fail "the difference is not named"
echo "another scene is refused: yes"

(
  trap '' HUP # as nohup does
  run results/nohup > results/nohup.log 2>&1
) &
process=$!
wait_for_lines results/nohup/torque.csv 20
kill -s HUP -- -$process
wait $process || fail "an ignored signal ends the run"
cmp results/nohup/torque.csv results/whole/torque.csv || fail "an ignored signal changes the results"
echo "an ignored signal is ignored: yes"

exec_run results/busy > busy.log 2>&1 &
process=$!
wait_for_lines results/busy/torque.csv 20
kill -s STOP $process # it is not to end before the others come
for others in "scene.prm --set Output/Directory=results/busy --force" "--resume results/busy" \
  "scene.prm --set Output/Directory=results/busy --set Interface/Viscosity={{0|1}}"; do
  code=0
  # shellcheck disable=SC2086
  "$debond" $others > others.log 2>&1 || code=$?
  [ $code = 1 ] || fail "exit code $code of another run in the same directory: $others"
  grep -q "another run of debond is at work in results/busy: wait for it" others.log || fail "message of $others"
done
kill -s CONT $process
wait -f $process || fail "a run that others wanted to disturb" # -f: it may still be known as stopped
cmp results/busy/torque.csv results/whole/torque.csv || fail "others change the results"
echo "a directory belongs to one run: yes"

interrupt results/anew TERM
ls -l --full-time results/anew > before.log
if run results/anew > anew.log 2>&1; then
  fail "a checkpoint is destroyed without --force"
fi
grep -q "results/anew holds the checkpoint of a run that was interrupted after step [0-9]*: debond --resume" anew.log ||
  fail "message about a checkpoint"
[ "$(ls results/anew)" = "$(awk 'NF > 2 {print $NF}' before.log)" ] || fail "files are lost"
"$debond" scene.prm --threads 1 --set Output/Directory=results/anew --force > anew.log 2>&1 || fail "--force"
cmp results/anew/torque.csv results/whole/torque.csv || fail "other results with --force"
echo "a checkpoint is kept: yes"

# The variants have the same bodies, which they share.
study() {
  exec "$debond" scene.prm --set Output/Directory=results/study --set "Expert/Output/Checkpoint every=7" --jobs 2 --set "Interface/Normal stiffness={{585|1000|1800}}"
}
study > study.log 2>&1 &
wait_for_lines results/study/variant-001/torque.csv 20
code=0
kill -s TERM $!
wait $! || code=$?
[ $code = 143 ] || fail "exit code $code of a study"
grep -q "interrupted by SIGTERM: [0-2] of 3 variants are done" study.log || fail "message of a study"
n=$(wc -l < results/study/variant-001/torque.csv)
sleep 0.3
[ "$(wc -l < results/study/variant-001/torque.csv)" = "$n" ] || fail "a variant outlives its study"
ls results/study/variant-001/checkpoint-? > /dev/null || fail "a variant leaves no checkpoint"
first_fields() {
  stat -c %y results/study/variant-001/bulk-0000.vtu # written once: by a run from its beginning
}
before=$(first_fields)
(study > study.log 2>&1) || fail "the study does not go on"
[ "$(first_fields)" = "$before" ] || fail "a variant does not go on from its checkpoint"
cmp results/study/variant-001/torque.csv results/whole/torque.csv || fail "another variant"
echo "a study ends with its variants and goes on: yes"

# A reader that goes away, as head does, ends no run: the rest is said to nobody.
run results/piped 2> piped.log | head -n 1 > /dev/null
[ "${PIPESTATUS[0]}" = 0 ] && [ ! -s piped.log ] || fail "a pipe that is closed"
cmp results/piped/torque.csv results/whole/torque.csv || fail "other results with a pipe that is closed"
echo "a closed pipe ends no run: yes"
