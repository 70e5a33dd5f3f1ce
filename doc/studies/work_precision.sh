#!/usr/bin/env bash
# Speed and accuracy in one picture: runs the studies prm/studies/work_precision*.prm one variant at a time, each with two
# threads whatever the number of processors (--jobs 1 alone would give a run as many as there are), so that seconds mean
# something, and draws output/studies/work_precision.png, work_precision_local.png and work_precision_codes.png.
#   doc/studies/work_precision.sh [--force] [--draw] [--publish]
#     --force   run again what is there already (without it an interrupted study goes on where it was)
#     --draw    run nothing, draw what is there
#     --publish copy the pictures to doc/images and the tables into doc/evidence
# Other codes: OTHER_CODES=FILE.csv (default prm/studies/data/other_codes.csv, if it is there) with the columns
# code,label,seconds,error_torque for the scene of prm/studies/work_precision_coulomb.prm, which
# tests/comparison/work_precision.sh --curve FILE.csv writes; its rows of debond are not drawn.
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
other_codes=${OTHER_CODES:-prm/studies/data/other_codes.csv}
results=output/studies
force=() draw_only=false publish=false
for option in "$@"; do
  case $option in
    --force) force=(--force) ;;
    --draw) draw_only=true ;;
    --publish) publish=true ;;
    *) sed -n '2,11s/^# //p' "$0"; exit 1 ;;
  esac
done
command -v gnuplot > /dev/null || { echo "work_precision.sh: gnuplot is needed to draw" >&2; exit 1; }

if [[ $draw_only == false ]]; then
  [[ -x $debond ]] || { echo "work_precision.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }
  echo "Some fifteen minutes if the machine is quiet, which it should be; one run needs 2 GB. Each line below is a variant,
run with two threads."
  for study in closed_forms coulomb coulomb_splines ends splines quadratic ""; do
    echo "== $(date +%H:%M) work_precision${study:+_$study}"
    "$debond" "prm/studies/work_precision${study:+_$study}.prm" --jobs 1 --threads 2 "${force[@]}"
  done
  # what a process of its own would take in addition: the least of five empty ones
  TIMEFORMAT=%R
  for _ in 1 2 3 4 5; do
    { time "$debond" --version > /dev/null; } 2>&1
  done | sort -g | head -n 1 > $results/start
  # Accuracy: the least of three processes, which run a coarser scene, too
  echo "accuracy,seconds,error_torque,estimate,cells" > $results/work_precision_accuracy.csv
  for accuracy in 5 1 0.3 0.1 0.03; do
    echo "== $(date +%H:%M) Accuracy = $accuracy %"
    seconds=$(for _ in 1 2 3; do
      { time "$debond" prm/studies/work_precision_accuracy.prm --force --threads 2 --set "Accuracy=$accuracy %" > /dev/null; } 2>&1
    done | sort -g | head -n 1)
    python3 -c '
import json, re, sys
accuracy, seconds, directory = sys.argv[1:]
summary = json.load(open(directory + "/summary.json"))
cells = re.findall(r"^ *set Cells *= (.*)", open(directory + "/parameters.prm").read(), re.M)
print(accuracy, seconds, summary["difference_max"], summary["error_estimate"], " / ".join(cells).replace(", ", " x "), sep=",")
' $accuracy "$seconds" $results/work_precision_accuracy >> $results/work_precision_accuracy.csv
  done
fi

for file in work_precision{_closed_forms,_coulomb,_coulomb_splines,_ends,_splines,_quadratic,}/study.csv work_precision_accuracy.csv; do
  [[ -f $results/$file ]] ||
    { echo "work_precision.sh: nothing to draw yet: there is no $results/$file; run without --draw first" >&2; exit 1; }
done
start=$(cat $results/start)
awk -v start="$start" -f doc/studies/gather.awk $results/work_precision{_closed_forms,_ends,_splines,_quadratic,}/study.csv > $results/work_precision.csv
awk -v start="$start" -f doc/studies/gather.awk $results/work_precision_coulomb{,_splines}/study.csv > $results/work_precision_coulomb.csv

# Rows for which no other is both faster and closer, and that are closer by at least a tenth than the one before:
# pareto TABLE COLUMN_OF_SECONDS COLUMN_OF_ERROR
pareto() {
  head -n 1 "$1"
  tail -n +2 "$1" | awk -F, -v k="$3" '$k != "nan" && $k > 0' | sort -t, -g -k"$2,$2" |
    awk -F, -v k="$3" 'NR == 1 || $k + 0 < 0.9 * best { print; best = $k + 0 }'
}
pareto $results/work_precision.csv 8 12 > $results/front_torque.csv
pareto $results/work_precision.csv 8 14 > $results/front_pressure.csv
pareto $results/work_precision.csv 8 15 > $results/front_slip.csv
pareto $results/work_precision_coulomb.csv 8 12 > $results/front_coulomb.csv

# the methods in the file of other codes, CODE/METHOD: the first word of a label; the rest of it are the cells
codes="" methods=""
if [[ -f $other_codes ]]; then
  codes=$other_codes
  methods=$(awk -F, 'NR > 1 && $1 != "debond" { split($2, part, " "); m = $1 "/" part[1]; if (!seen[m]++) printf "%s ", m }' "$codes")
else echo "No $other_codes: the picture of codes shows this one alone"
fi
gnuplot -e "codes='$codes'; methods='$methods'; start='$start'" doc/studies/work_precision.gp
echo "On the front of torque curves (seconds, largest error relative to T_max):"
awk -F, 'NR > 1 { printf "%9.3f  %.1e  %s\n", $8, $12, $16 }' $results/front_torque.csv
{
  echo "| Accuracy | cells chosen, bone / implant | seconds | error of the torque curve | estimate |"
  echo "| --- | --- | --- | --- | --- |"
  awk -F, 'NR > 1 { printf "| %s %% | %s | %.2g s | %.1e | %.1e |\n", $1, $5, $2, $3, $4 }' $results/work_precision_accuracy.csv
  echo
  awk -f doc/studies/tables.awk $results/work_precision.csv
  printf '\n| number in the picture | seconds | error of the torque curve | choice |\n| --- | --- | --- | --- |\n'
  awk -F, 'NR > 1 { printf "| %d | %.3g | %.1e | %s |\n", NR - 1, $8, $12, $16 }' $results/front_torque.csv
} > $results/work_precision.md
echo "Tables: $results/work_precision.md
Pictures: $results/work_precision.png, work_precision_local.png, work_precision_codes.png, and the same as SVG; all rows: $results/work_precision.csv"
if [[ $publish == true ]]; then
  for picture in work_precision work_precision_local work_precision_codes; do
    for format in png svg; do cp $results/$picture.$format doc/images/; done
  done
  doc/studies/publish.py doc/evidence/speed_and_accuracy.md work_precision accuracy+ splines+ meshes factors fastest+ front+ < $results/work_precision.md
  echo "Published in doc/images and doc/evidence"
fi
