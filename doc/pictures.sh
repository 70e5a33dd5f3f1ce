#!/usr/bin/env bash
# Makes the pictures of the pages again, and puts them into doc/images as PNG and, but for maps, as SVG: doc/pictures.sh NAME...
#   geometry        the sketches and the friction law of doc/explanation
#   bodies          mesh, fronts and stresses (a minute); needs pvpython, see doc/results.md
#   paper           the figures of doc/reproduction.md (ten minutes, most of them Fig. 13); fig_1, fig_4, ... alone: see
#                   doc/paper/reproduce.sh
#   stability       those of doc/stability.md (two minutes)
#   convergence     that of half spaces in doc/verification.md (some minutes)
#   cap_pulled_off  that of a cap that is pulled off there (some minutes)
#   bonds           that of bonds on half spaces in doc/verification.md (a minute)
#   ensemble        those of doc/partial_bonding.md (ten minutes)
#   calibration     that of doc/calibration.md (a minute)
#   step_error      that of friction that turns in doc/speed_and_accuracy.md (ten minutes; CalculiX, if it is there)
#   work_precision  those of doc/speed_and_accuracy.md, and its tables (20 minutes on a quiet machine)
#   all             all of these
# Another program: DEBOND=FILE. Studies that are there already are not run again. Needs gnuplot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export DEBOND=${DEBOND:-build/release/debond}
figures="fig_1 fig_3_12 fig_4 fig_5_6 fig_7_8 fig_9 fig_10 fig_13"
[[ -x $DEBOND ]] || { echo "pictures.sh: there is no $DEBOND: build the program first, or set DEBOND" >&2; exit 1; }

# publish FILE...: pictures without their extension
publish() {
  local name
  for name in "$@"; do
    cp "$name.png" doc/images/
    if [[ -f $name.svg ]]; then cp "$name.svg" doc/images/; fi
  done
}

# phases that end at the angles of the pictures have files there
at_angles() {
  "$DEBOND" prm/coin_mode3_fast.prm --force --set "Output/Fields every=1000000" --set Output/Console=quiet "$@"
}

bodies() {
  "$DEBOND" prm/coin_mode3.prm --force --set "Load steps/Times=0, 1" --set "Load steps/Steps=1" --set Output/Directory=output/mesh
  pvpython doc/paraview/bodies.py mesh output/mesh --width 1200 --output output/mesh.png
  at_angles --set "Load steps/Times=0, 1, 1.05, 1.15" --set "Load steps/Steps=1, 2, 2" --set "Bone/Cells=40, 40, 10" \
    --set "Implant/Cells=8, 8" --set Output/Directory=output/stress
  pvpython doc/paraview/bodies.py stress output/stress --angles 0.5 1.5 --output output/stress.png
  at_angles --set "Load steps/Times=0, 1, 1.1, 1.15, 1.25, 1.5" --set "Load steps/Steps=1, 2, 2, 2, 4" \
    --set "Interface/Quadrature points=20" --set Output/Directory=output/front
  pvpython doc/paraview/debonding_front.py output/front --field mu slip_mm --angles 1 1.5 2.5 5 --width 1200 --output output/front.png
  "$DEBOND" prm/adhesion/coin_peeled.prm --force --set "Load steps/Times=0, 0.05, 0.1, 0.2, 0.5" --set "Output/Fields every=1000000" \
    --set "Load steps/Steps=15, 15, 30, 45" --set "Bone/Cells=30, 30, 6" --set "Implant/Cells=8, 4" \
    --set Output/Directory=output/peeled --set Output/Console=quiet
  pvpython doc/paraview/debonding_front.py output/peeled --field state left_by_opening pressure_MPa --times 0.05 0.1 0.2 0.5 --width 1200 \
    --output output/peeled.png
  publish output/mesh output/stress output/front output/peeled
  "$DEBOND" prm/coin_mode3_spline.prm --force --set Output/Directory=output/opened
  pvpython doc/paraview/open_results.py output/opened --pictures output/opened/pictures --width 1400
  cp output/opened/pictures/view-0008.png doc/images/opened.png
}

make_pictures() {
  case $1 in
    calibration)
      "$DEBOND" prm/calibrate/data_set_1.prm --force
      gnuplot -e "dir='output/calibrate/data_set_1'; source='Eq. (18)'" doc/plot_calibration.gp
      cp output/calibrate/data_set_1/fit.png doc/images/calibration_data_set_1.png
      ;;
    geometry)
      gnuplot doc/geometry.gp && gnuplot doc/towing.gp && gnuplot doc/cell.gp && gnuplot doc/law.gp
      publish output/geometry output/towing output/cell output/law
      ;;
    bodies) bodies ;;
    paper) doc/paper/reproduce.sh $figures && publish_figures $figures ;;
    fig_*) doc/paper/reproduce.sh "$1" && publish_figures "$1" ;;
    stability) doc/stability/stability.sh --draw --publish ;;
    convergence) doc/verification/convergence.sh && publish output/convergence ;;
    cap_pulled_off) doc/verification/cap_pulled_off.sh && publish output/cap_pulled_off_force ;;
    bonds) doc/verification/bonds_on_half_spaces.sh && publish output/bonds_on_half_spaces ;;
    step_error) doc/studies/step_error.py --publish ;;
    ensemble | work_precision) "doc/studies/$1.sh" --publish ;;
    all)
      local name
      for name in geometry bodies paper stability convergence cap_pulled_off bonds ensemble calibration step_error work_precision; do make_pictures $name; done
      ;;
    *)
      echo "pictures.sh: unknown name '$1'; the names stand at the top of this script" >&2
      exit 1
      ;;
  esac
}

publish_figures() {
  local name dir=output/paper
  for name in "$@"; do
    case $name in
      fig_1 | fig_3_12) publish $dir/$name/$name ;;
      fig_4) publish $dir/table_5/fig_4 ;;
      fig_5_6) publish $dir/fig_5_6/fig_5 $dir/fig_5_6/fig_6 ;;
      fig_7_8) publish $dir/fig_7_8/fig_7 $dir/fig_7_8/fig_8 ;;
      fig_9) publish $dir/partial_fitted_parameters/fig_9 ;;
      fig_10) publish $dir/partial_equal_parameters/fig_10 ;;
      fig_13) publish $dir/table_7/fig_13 ;;
    esac
  done
}

if (($# == 0)); then sed -n '2,15s/^# //p' "$0"; exit 1; fi
for name in "$@"; do make_pictures "$name"; done
