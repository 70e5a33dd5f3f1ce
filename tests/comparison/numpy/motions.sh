#!/bin/bash
# Motions that no scene here has, compared with debond as the scenes are: motions.sh PROGRAM [NAME]. All are made from
# general_motion.prm, and done in both slip directions. Prints the largest differences of each; four minutes in all.
debond=$(realpath "$1")
only=$2
cd "$(dirname "$(realpath "$0")")/../../.." || exit
failed=0

# motion NAME ENTRY=VALUE...: components of the chuck that are not named rest
motion()
{
  local name=$1 component direction entry options=() results
  shift
  [ -z "$only" ] || [ "$only" = "$name" ] || return
  for component in Translation\ {x,y,z} Rotation\ {x,y,z}; do
    [[ "$*" == *"Chuck/$component/"* ]] || options+=(--set "Chuck/$component/Value=0")
  done
  for entry in "Expert/Interface/Quadrature points=4" "$@"; do
    options+=(--set "$entry")
  done
  for direction in trial integrated; do
    if results=$(tests/comparison/numpy/compare.py --debond "$debond" "${options[@]}" \
                   --set "Expert/Slip direction=$direction" tests/comparison/numpy/general_motion.prm 2>&1); then
      echo "$name, $direction: $(awk '$4 + 0 > worst { worst = $4 + 0 } END { print worst }' <<< "$results")"
    else
      echo "$name, $direction: $results"
      failed=1
    fi
  done
}

motion growing_twist_cycles "Interface/Bonding/Pattern=expression" "Expert/Interface/Bonding/Resolution=quadrature point" \
  "Bone/Size=9, 7, 4" "Bone/Cells=7, 7, 3" "Expert/Bone/Layer grading=1.5" "Implant/Radius=2" "Implant/Height=2.5" \
  "Implant/Cells=4, 3" "Bone/Young modulus=600" "Implant/Young modulus=2500" "Bone/Poisson ratio=0.4" \
  "Implant/Poisson ratio=0.4" "Interface/Normal stiffness=900" "Interface/Tangential stiffness=350" \
  "Interface/Characteristic slip distance=0.02" "Interface/Transition factor=0.9" \
  "Interface/Bonding/Expression=0.5 + 0.5 * sin(7 * x + 3 * y) * cos(5 * y - 2 * x)" \
  "Chuck/Press/Value=0.03 * min(t, 1)" "Chuck/Rotation z/Value=1.5 * max(t - 1, 0) * sin(2 * pi * max(t - 1, 0))" \
  "Load steps/Times=0, 1, 3" "Load steps/Steps=2, 40"
motion depth_varies_while_twisting "Bone/Young modulus=1200" "Implant/Young modulus=6000" "Interface/Normal stiffness=1500" \
  "Interface/Tangential stiffness=2500" "Interface/Characteristic slip distance=0.012" \
  "Chuck/Press/Value=0.02 * min(t, 1) - 0.0185 * sin(2 * pi * max(t - 1, 0))" \
  "Chuck/Rotation z/Value=3 * max(t - 1, 0)" "Chuck/Translation x/Value=0.004 * cos(9 * max(t - 1, 0))" \
  "Load steps/Times=0, 1, 3" "Load steps/Steps=1, 40"
motion tilt_opens_while_sheared_to_and_fro "Bone/Young modulus=700" "Implant/Young modulus=3000" "Bone/Poisson ratio=0.4" \
  "Interface/Normal stiffness=800" "Interface/Tangential stiffness=500" "Interface/Characteristic slip distance=0.01" \
  "Chuck/Press/Value=0.02 * min(t, 1)" "Chuck/Translation y/Value=0.05 * sin(2 * pi * max(t - 1, 0))" \
  "Chuck/Rotation x/Value=2 * sin(3 * pi * max(t - 1, 0))" "Chuck/Rotation y/Value=-0.8 * max(t - 1, 0)" \
  "Load steps/Times=0, 1, 2.5" "Load steps/Steps=1, 40"
motion bone_slave_cycles_and_depth "Expert/Interface/Slave=bone" "Bone/Cells=9, 9, 2" "Expert/Interface/Quadrature points=3" \
  "Bone/Young modulus=800" "Implant/Young modulus=3000" "Bone/Poisson ratio=0.4" "Interface/Normal stiffness=900" \
  "Interface/Tangential stiffness=400" "Interface/Characteristic slip distance=0.015" \
  "Chuck/Press/Value=0.03 * min(t, 1) + 0.012 * sin(3 * max(t - 1, 0))" \
  "Chuck/Rotation z/Value=4 * sin(2 * pi * max(t - 1, 0))" "Load steps/Times=0, 1, 2.5" "Load steps/Steps=1, 36"
motion zigzag_in_x_and_y "Interface/Bonding/Pattern=expression" "Expert/Interface/Bonding/Resolution=quadrature point" \
  "Bone/Young modulus=1500" "Implant/Young modulus=9000" "Interface/Normal stiffness=3000" \
  "Interface/Tangential stiffness=1200" "Interface/Characteristic slip distance=0.008" \
  "Interface/Bonding/Expression=exp(-((x - 1)^2 + (y + 0.5)^2) / 2)" "Chuck/Press/Value=0.012 * min(t, 1)" \
  "Chuck/Translation x/Value=0.03 * abs(((max(t - 1, 0) * 2 + 0.5) - 2 * (0.5 + 0.5 * sin(pi * max(t - 1, 0)))) ) - 0.015" \
  "Chuck/Translation y/Value=0.02 * (abs(max(t - 1, 0) - 0.5) - abs(max(t - 1, 0) - 1.2) + abs(max(t - 1, 0) - 1.7) - 1)" \
  "Load steps/Times=0, 1, 3" "Load steps/Steps=1, 40"
motion forty_degrees_and_back "Implant/Radius=1.8" "Implant/Height=4" "Implant/Cells=5, 2" "Bone/Young modulus=500" \
  "Implant/Young modulus=2000" "Implant/Poisson ratio=0.4" "Interface/Normal stiffness=600" \
  "Interface/Tangential stiffness=300" "Interface/Characteristic slip distance=0.2" "Chuck/Press/Value=0.04 * min(t, 1)" \
  "Chuck/Rotation z/Value=40 * min(max(t - 1, 0), 1) - 60 * max(t - 2, 0)" "Chuck/Translation x/Value=0.1 * max(t - 1.5, 0)" \
  "Load steps/Times=0, 1, 2, 3" "Load steps/Steps=1, 9, 15"
motion table_with_tilt "Interface/Bonding/Pattern=expression" "Expert/Interface/Bonding/Resolution=quadrature point" \
  "Bone/Young modulus=1000" "Implant/Young modulus=5000" "Bone/Poisson ratio=0.4" "Implant/Poisson ratio=0.35" \
  "Interface/Normal stiffness=800" "Interface/Tangential stiffness=2500" "Interface/Friction law=table" \
  "Interface/Friction table=tests/comparison/numpy/table.csv" \
  "Interface/Bonding/Expression=0.5 + 0.4 * cos(3 * angle * pi / 180) * r / R" "Chuck/Press/Value=0.015 * min(t, 1)" \
  "Chuck/Rotation x/Value=0.8 * sin(4 * max(t - 1, 0))" "Chuck/Rotation y/Value=0.6 * cos(5 * max(t - 1, 0)) - 0.6" \
  "Chuck/Rotation z/Value=2.5 * sin(3 * max(t - 1, 0))" "Chuck/Translation y/Value=0.02 * max(t - 1, 0)" \
  "Load steps/Times=0, 1, 2.5" "Load steps/Steps=1, 36"
motion large_tilt_small_linear_bone "Bone/Material=linear" "Bone/Poisson ratio=0.4" "Implant/Poisson ratio=0.4" \
  "Implant/Radius=1.5" "Implant/Height=5" "Implant/Cells=4, 3" "Bone/Young modulus=400" "Implant/Young modulus=1500" \
  "Interface/Normal stiffness=500" "Interface/Tangential stiffness=350" "Interface/Characteristic slip distance=0.03" \
  "Chuck/Press/Value=0.05 * min(t, 1)" "Chuck/Rotation x/Value=6 * sin(2 * max(t - 1, 0))" \
  "Chuck/Rotation y/Value=-5 * max(t - 1, 0)" "Chuck/Rotation z/Value=-12 * max(t - 1, 0)" \
  "Chuck/Translation x/Value=0.1 * max(t - 1, 0)" "Load steps/Times=0, 1, 2.5" "Load steps/Steps=1, 30"
motion stiff_interface_friction_while_pressing "Bone/Young modulus=2000" "Implant/Young modulus=9000" "Bone/Poisson ratio=0.4" \
  "Interface/Normal stiffness=20000" "Interface/Tangential stiffness=12000" "Interface/Characteristic slip distance=0.004" \
  "Interface/Friction coefficient unbroken=0.3" "Interface/Friction coefficient broken=0.1" \
  "Chuck/Press/Value=0.02 * t" "Chuck/Rotation z/Value=2 * max(t - 1, 0) * (3 - t)" \
  "Chuck/Translation y/Value=0.01 * max(t - 1, 0)" "Load steps/Times=0, 1, 3" "Load steps/Steps=6, 30"
motion bond_weaker_than_none_friction_late "Bone/Young modulus=700" "Implant/Young modulus=2500" \
  "Interface/Normal stiffness=900" "Interface/Tangential stiffness=600" "Interface/Characteristic slip distance=0.01" \
  "Interface/Transition factor=0.4" "Interface/Friction coefficient unbroken=0.3" "Interface/Friction coefficient broken=0.6" \
  "Interface/Friction starts at=1.5" "Chuck/Press/Value=0.02 * min(t, 1)" \
  "Chuck/Rotation y/Value=1.2 * min(max(t - 1, 0), 1) - 2 * max(t - 2, 0)" \
  "Chuck/Rotation z/Value=3 * sin(2.5 * max(t - 1, 0))" "Chuck/Translation x/Value=0.03 * max(t - 1.2, 0)" \
  "Load steps/Times=0, 1, 3" "Load steps/Steps=1, 40"
exit $failed
