#!/usr/bin/env bash
# Ensembles of randomly bonded implants: runs prm/studies/ensemble.prm, ensemble_fraction.prm and ensemble_correlation.prm with
# the homogeneous patterns they are compared with, and draws output/studies/ensemble.png, ensemble_fraction.png and
# ensemble_correlation.png.
#   doc/studies/ensemble.sh [--force] [--draw] [--publish]
#     --force   run again what is there already (without it an interrupted study goes on where it was)
#     --draw    run nothing, draw what is there
#     --publish copy the pictures to doc/images
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
results=output/studies
force=() draw_only=false publish=false
for option in "$@"; do
  case $option in
    --force) force=(--force) ;;
    --draw) draw_only=true ;;
    --publish) publish=true ;;
    *) sed -n '2,8s/^# //p' "$0"; exit 1 ;;
  esac
done
command -v gnuplot > /dev/null || { echo "ensemble.sh: gnuplot is needed to draw" >&2; exit 1; }

if [[ $draw_only == false ]]; then
  [[ -x $debond ]] || { echo "ensemble.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }
  echo "632 runs, some ten minutes on two processors. Each line below is a run."
  "$debond" prm/studies/ensemble_scene.prm "${force[@]}" \
    --set "Interface/Bonding/Pattern=homogeneous" --set "Interface/Bonding/Bonding degree={{0|0.1|0.2|0.3|0.4|0.5|0.55|0.6|0.7|0.8|0.9|1}}" \
    --set "Output/Directory=$results/ensemble_homogeneous"
  for study in ensemble ensemble_fraction ensemble_correlation; do
    echo "== $(date +%H:%M) $study"
    "$debond" "prm/studies/$study.prm" "${force[@]}"
  done
fi

for study in ensemble ensemble_fraction ensemble_correlation ensemble_homogeneous; do
  [[ -f $results/$study/study.csv ]] ||
    { echo "ensemble.sh: nothing to draw yet: there is no $results/$study/study.csv; run without --draw first" >&2; exit 1; }
done
gnuplot doc/studies/ensemble.gp
echo "Pictures: $results/ensemble.png, ensemble_fraction.png, ensemble_correlation.png, and the same as SVG"
if [[ $publish == true ]]; then
  for format in png svg; do
    cp $results/ensemble.$format $results/ensemble_fraction.$format $results/ensemble_correlation.$format doc/images/
  done
  echo "Published in doc/images"
fi
