#!/usr/bin/env bash
# Speed and accuracy in one picture: runs the studies prm/studies/work_precision*.prm one variant at a time, so that seconds
# mean something, and draws output/studies/work_precision.png, work_precision_local.png and work_precision_codes.png.
#   doc/studies/work_precision.sh [--force] [--draw]
#     --force   run again what is there already (without it an interrupted study goes on where it was)
#     --draw    run nothing, draw what is there
# Other codes: OTHER_CODES=FILE.csv (default prm/studies/data/other_codes.csv, if it is there) with the columns
# code,label,seconds,error_torque for the scene of prm/studies/work_precision_coulomb.prm.
set -euo pipefail
export LC_ALL=C
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
other_codes=${OTHER_CODES:-prm/studies/data/other_codes.csv}
results=output/studies
force=() draw_only=false
for option in "$@"; do
  case $option in
    --force) force=(--force) ;;
    --draw) draw_only=true ;;
    *) sed -n '2,8s/^# //p' "$0"; exit 1 ;;
  esac
done
command -v gnuplot > /dev/null || { echo "work_precision.sh: gnuplot is needed to draw" >&2; exit 1; }

if [[ $draw_only == false ]]; then
  [[ -x $debond ]] || { echo "work_precision.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }
  echo "Some 20 minutes if the machine is quiet, which it should be; one run needs 75 s and 4 GB. Each line below is a variant."
  for study in closed_forms coulomb ends ""; do
    echo "== $(date +%H:%M) work_precision${study:+_$study}"
    "$debond" "prm/studies/work_precision${study:+_$study}.prm" --jobs 1 "${force[@]}"
  done
fi

awk -f doc/studies/gather.awk $results/work_precision{_closed_forms,_ends,}/study.csv > $results/work_precision.csv
awk -f doc/studies/gather.awk $results/work_precision_coulomb/study.csv > $results/work_precision_coulomb.csv

# Rows for which no other is both faster and closer: pareto TABLE COLUMN_OF_SECONDS COLUMN_OF_ERROR
pareto() {
  head -n 1 "$1"
  tail -n +2 "$1" | awk -F, -v k="$3" '$k != "nan" && $k > 0' | sort -t, -g -k"$2,$2" |
    awk -F, -v k="$3" 'NR == 1 || $k + 0 < best { print; best = $k + 0 }'
}
pareto $results/work_precision.csv 8 12 > $results/front_torque.csv
pareto $results/work_precision.csv 8 14 > $results/front_pressure.csv
pareto $results/work_precision.csv 8 15 > $results/front_slip.csv
pareto $results/work_precision_coulomb.csv 8 12 > $results/front_coulomb.csv

codes=""
if [[ -f $other_codes ]]; then codes=$other_codes; else echo "No $other_codes: the picture of codes shows this one alone"; fi
gnuplot -e "codes='$codes'" doc/studies/work_precision.gp
echo "On the front of torque curves (seconds, largest error relative to T_max):"
awk -F, 'NR > 1 { printf "%9.3f  %.1e  %s\n", $8, $12, $16 }' $results/front_torque.csv
echo "Pictures: $results/work_precision.png, work_precision_local.png, work_precision_codes.png; table: $results/work_precision.csv"
