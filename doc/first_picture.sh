#!/usr/bin/env bash
# Makes the first picture of README.md, doc/images/data_set_1.png: the torque of the calibrated data set 1 with the published
# values, and phi on the contact face from the same scene on a finer mesh. Needs gnuplot; some ten seconds of computing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
debond=${DEBOND:-build/release/debond}
scene=prm/paper/data_set_1_calibrated.prm
curve=output/first_picture/curve
faces=output/first_picture/faces
angles="1 1.5 2.5 5" # degrees

"$debond" "$scene" --force --set "Output/Directory=$curve" --set "Output/Fields every=none" --set "Expert/Output/Console=quiet"
"$debond" "$scene" --force --set "Output/Directory=$faces" --set Accuracy=none --set "Output/Fields every=none" --set "Expert/Output/Console=quiet" \
  --set "Expert/Output/Profile angles=${angles// /, }" --set "Load steps/Steps=1, 100" \
  --set "Bone/Cells=30, 30, 8" --set "Implant/Cells=12, 4" --set "Expert/Interface/Quadrature points=9" \
  --set Bone/Element=spline --set Implant/Element=spline --set "Expert/Bone/Layer grading=2" --set "Expert/Implant/Layer grading=2" \
  --set "Bone/Material=linear" --set "Implant/Material=linear"
gnuplot -e "dir='$curve'; faces='$faces'; angles='$angles'; points=9; published='53.8 36.8 0.13 1.13'" doc/plot_torque.gp
cp "$curve/torque.png" doc/images/data_set_1.png
echo "Picture: doc/images/data_set_1.png"
