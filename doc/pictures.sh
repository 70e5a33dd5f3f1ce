#!/usr/bin/env bash
# Makes the pictures of the pages again, and puts them into doc/images as PNG and, but for maps, as SVG: doc/pictures.sh NAME...
#   setup           setup.png from setup.svg, which is drawn by hand; needs rsvg-convert (Debian: librsvg2-bin)
#   first           data_set_1: the curve of the first run with maps of phi (some seconds)
#   geometry        the sketches and the friction law of doc/explanation
#   half_bonded     torque and phi_0 of half-bonded coins (ten seconds)
#   bone            bone that is crushed and sheared (ten seconds)
#   film            front.webm and front_film.png (half a minute); needs NumPy, Matplotlib and ffmpeg
#   report          the page of a run, seen by chromium; needs ImageMagick
#   tutorial_fit    the fit of the tutorial (ten seconds)
#   bodies          mesh, fronts and stresses (two minutes); needs pvpython, see doc/howto/paraview.md
#   paper           the figures of doc/evidence/reproduction.md (three minutes); fig_1, fig_4, ... alone: see
#                   doc/paper/reproduce.sh
#   stability       those of doc/evidence/stability.md (half a minute)
#   convergence     that of half spaces in doc/evidence/verification.md (a minute)
#   cap_pulled_off  that of a cap that is pulled off there (two minutes)
#   bonds           that of bonds on half spaces there (a minute)
#   ensemble        those of random patterns of bonding (ten minutes)
#   calibration     that of doc/howto/calibration.md (ten seconds)
#   step_error      that of friction that turns in doc/evidence/speed_and_accuracy.md (ten minutes; CalculiX, if it is there)
#   work_precision  the others there, and their tables (20 minutes on a quiet machine)
#   all             all of these
# Another program: DEBOND=FILE; another Python: PYTHON=FILE. Studies that are there already are not run again. Needs gnuplot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export DEBOND=${DEBOND:-build/release/debond}
figures="fig_1 fig_3_12 fig_4 fig_5_6 fig_7_8 fig_9 fig_10 fig_13"
[[ -x $DEBOND ]] || { echo "pictures.sh: there is no $DEBOND: build the program first, or set DEBOND" >&2; exit 1; }

# by half, if pngquant is there and 256 colours are enough
shrink() {
  ! command -v pngquant > /dev/null || pngquant --force --ext .png --skip-if-larger --quality 85-100 "$1" || true
}

# publish FILE...: pictures without their extension
publish() {
  local name
  for name in "$@"; do
    cp "$name.png" doc/images/
    shrink "doc/images/$(basename "$name").png"
    if [[ -f $name.svg ]]; then cp "$name.svg" doc/images/; fi
  done
}

# phases that end at the angles of the pictures have files there
at_angles() {
  "$DEBOND" prm/coin_mode3_fast.prm --force --set "Output/Fields every=1000000" --set Expert/Output/Console=quiet "$@"
}

# coins with maps that are smooth, of a scene that is otherwise that of the first run
coin() {
  "$DEBOND" prm/paper/data_set_1_calibrated.prm --force --set Accuracy=none --set Expert/Output/Console=quiet --set "Output/Fields every=none" \
    --set "Bone/Cells=30, 30, 2" --set Bone/Material=linear --set Implant/Material=linear "$@"
}

bone() {
  local name
  for name in bone/coin_pressed bone/coin_stronger_than_bone coin_mode3; do
    "$DEBOND" "prm/$name.prm" --force --set Expert/Output/Console=quiet --set "Output/Directory=output/$name"
  done
  gnuplot doc/bone.gp
  publish output/bone/bone
}

half_bonded() {
  local name
  for name in full disk side random; do
    local pattern=()
    case $name in
      disk) pattern=(--set Interface/Bonding/Pattern=disk --set "Interface/Bonding/Bonded fraction=0.5") ;;
      side) pattern=(--set Interface/Bonding/Pattern=expression --set "Interface/Bonding/Expression=if(x > 0, 1, 0)") ;;
      random)
        pattern=(--set Interface/Bonding/Pattern=random --set "Interface/Bonding/Bonded fraction=0.5"
          --set "Interface/Bonding/Correlation length=0.6")
        ;;
    esac
    coin --set "Output/Directory=output/half_bonded/$name" --set "Expert/Output/Profile angles=0.1" --set "Load steps/Times=0, 1, 1.05, 2" \
      --set "Load steps/Steps=1, 50, 95" --set "Implant/Cells=24, 2" --set "Expert/Interface/Quadrature points=3" \
      --set "Expert/Interface/Bonding/Resolution=quadrature point" "${pattern[@]}"
  done
  gnuplot doc/half_bonded.gp
  publish output/half_bonded/half_bonded
}

film() {
  local angles python=${PYTHON:-python3}
  angles=$("$python" doc/film.py --angles)
  coin --set Output/Directory=output/film --set "Expert/Output/Profile angles=$angles" \
    --set "Load steps/Steps=1, 500" --set "Implant/Cells=12, 2" --set "Expert/Interface/Quadrature points=5"
  "$python" doc/film.py output/film --film doc/images/front.webm --still doc/images/front_film.png
  rm output/film/profiles.csv # a hundred megabytes
}

bodies() {
  "$DEBOND" prm/paper/main_scene.prm --force --set "Load steps/Times=0, 1" --set "Load steps/Steps=1" --set Output/Directory=output/mesh
  pvpython doc/paraview/bodies.py mesh output/mesh --width 1200 --output output/mesh.png
  at_angles --set "Load steps/Times=0, 1, 1.05, 1.2" --set "Load steps/Steps=1, 2, 2" --set "Bone/Cells=40, 40, 10" \
    --set "Implant/Cells=8, 8" --set Output/Directory=output/stress
  pvpython doc/paraview/bodies.py stress output/stress --angles 0.5 2 --output output/stress.png
  at_angles --set "Load steps/Times=0, 1, 1.12, 1.2, 1.35, 1.7" --set "Load steps/Steps=1, 2, 2, 2, 4" \
    --set "Expert/Interface/Quadrature points=20" --set Output/Directory=output/front
  pvpython doc/paraview/debonding_front.py output/front --field mu slip_mm --angles 1.2 2 3.5 7 --width 1200 --output output/front.png
  "$DEBOND" prm/adhesion/coin_peeled.prm --force --set "Load steps/Times=0, 0.05, 0.1, 0.2, 0.5" --set "Output/Fields every=1000000" \
    --set "Load steps/Steps=15, 15, 30, 45" --set "Bone/Cells=30, 30, 6" --set "Implant/Cells=8, 4" \
    --set Output/Directory=output/peeled --set Expert/Output/Console=quiet
  pvpython doc/paraview/debonding_front.py output/peeled --field state left_by_opening pressure_MPa --times 0.05 0.1 0.2 0.5 --width 1200 \
    --output output/peeled.png
  publish output/mesh output/stress output/front output/peeled
  "$DEBOND" prm/coin_mode3_spline.prm --force --set Output/Directory=output/opened
  pvpython doc/paraview/open_results.py output/opened --pictures output/opened/pictures --width 1400
  cp output/opened/pictures/view-0007.png doc/images/opened.png
}

make_pictures() {
  case $1 in
    setup) rsvg-convert doc/images/setup.svg --output doc/images/setup.png ;;
    first) doc/first_picture.sh ;;
    half_bonded) half_bonded ;;
    bone) bone ;;
    film) film ;;
    report)
      "$DEBOND" prm/paper/data_set_1_calibrated.prm --force --set Output/Directory=output/report --set Expert/Output/Console=quiet
      chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1200,2000 --screenshot=output/report/report.png \
        "file://$PWD/output/report/report.html"
      convert output/report/report.png -crop 1200x1500+0+0 +repage doc/images/report.png # curve, values and the first maps
      shrink doc/images/report.png
      ;;
    tutorial_fit)
      "$DEBOND" prm/tutorial/fit.prm --force
      gnuplot -e "dir='output/tutorial/fit'; source='curve to be fitted, made up'" doc/plot_calibration.gp
      cp output/tutorial/fit/fit.png doc/images/tutorial_fit.png
      ;;
    calibration)
      "$DEBOND" prm/calibrate/data_set_1.prm --force
      gnuplot -e "dir='output/calibrate/data_set_1'; source='Eq. (18)'; heading='Data set 1: five parameters fitted to Eq. (18)'" \
        doc/plot_calibration.gp
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
      for name in setup first geometry half_bonded bone film report tutorial_fit bodies paper stability convergence cap_pulled_off bonds ensemble calibration step_error work_precision; do make_pictures $name; done
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

if (($# == 0)); then sed -n '2,22s/^# //p' "$0"; exit 1; fi
for name in "$@"; do make_pictures "$name"; done
