#!/usr/bin/env bash
# Runs every scene of prm/stability with every run that its comments list, and prints the table of doc/evidence/stability.md; a line on
# the error output says so if an outcome is not the expected one. Some three minutes. Runs stay in output/stability/runs.
#   doc/stability/stability.sh [--draw] [--publish] [SCENE ...]
#     --draw    make the pictures output/stability/*.png and *.svg instead (some two minutes)
#     --publish copy the pictures to doc/images
#     SCENE     only these, for instance slip_direction
# Before: cmake --build --preset release --target debond
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
results=output/stability
pictures="slip_direction chatter penalty snap_back"
draw=false publish=false scenes=()
for option in "$@"; do
  case $option in
    --draw) draw=true ;;
    --publish) publish=true ;;
    -*) sed -n '2,8s/^# //p' "$0"; exit 1 ;;
    *) scenes+=("$option") ;;
  esac
done
[[ -x $debond ]] || { echo "stability.sh: there is no $debond: build it first" >&2; exit 1; }
mkdir -p $results

# a run for a picture: the scene, the name of its results, and overrides
run() {
  local scene=$1 name=$2 options=()
  shift 2
  for override in "$@"; do options+=(--set "$override"); done
  "$debond" "prm/stability/$scene.prm" --force --set "Output/Directory=$results/$name" --set Expert/Output/Console=quiet "${options[@]}"
}

draw_pictures() {
  command -v gnuplot > /dev/null || { echo "stability.sh: gnuplot is needed to draw" >&2; exit 1; }
  run slip_direction integrated
  run slip_direction previous_gap "Expert/Slip direction=previous gap" "Load steps/Steps=1, 50"
  run slip_direction previous_gap_fine "Expert/Slip direction=previous gap"
  run softening implicit "Load steps/Steps=1, 1000"
  for steps in 50 100 1000; do
    run softening explicit_$steps "Expert/Friction update=explicit" "Load steps/Steps=1, $steps"
  done
  run chatter nurbs "Load steps/Steps=1, 80"
  run chatter bilinear "Expert/Bone/Contact surface=bilinear" "Load steps/Steps=1, 80"
  echo "penalty_MPa_per_mm,iterations" > $results/penalty.csv
  for penalty in 6 60 600 1800 18000 60000 180000 600000; do
    run coin penalty "Interface/Normal stiffness=$penalty" "Interface/Tangential stiffness=auto"
    echo "$penalty,$(sed -n 's/.*"newton_iterations": \([0-9]*\).*/\1/p' $results/penalty/summary.json)" >> $results/penalty.csv
  done
  for scene in snap_back snap_back_viscous snap_back_path snap_back_bulk; do run $scene $scene; done
  run snap_back snap_back_closed_form Model=foundation "Chuck/Rotation z/Stiffness=none"
  run snap_back_bulk snap_back_bulk_jump "Load steps/Path following=none"
  for picture in $pictures; do gnuplot doc/stability/$picture.gp; done
  echo "Pictures, also as SVG:" $(printf "$results/%s.png " $pictures)
}

if [[ $draw == true ]]; then
  draw_pictures
elif [[ $publish == false ]]; then
  echo "| scene | run | outcome | judged | iterations | shortest step | energy defect | rows with warnings |"
  echo "| --- | --- | --- | --- | --- | --- | --- | --- |"
  for file in prm/stability/*.prm; do
    scene=$(basename "$file" .prm)
    [[ ${#scenes[@]} == 0 || " ${scenes[*]} " == *" $scene "* ]] || continue
    for run in $(sed -n -E 's/^# (slow )?run ([^ :]+):.*/\2/p' "$file"); do
      tests/check_scene.py "$debond" "$file" "$results/runs/$scene.$run" "$run" > $results/row.txt 2> /dev/null ||
        echo "stability.sh: $scene.$run is not as expected" >&2
      tail -n 1 $results/row.txt
    done
  done
fi
if [[ $publish == true ]]; then
  for picture in $pictures; do
    for format in png svg; do cp $results/$picture.$format doc/images/stability_$picture.$format; done
  done
  echo "Published in doc/images"
fi
