#!/usr/bin/env bash
# The paper's procedure of Section 4.1, stage by stage, for several mu_b, against the stand-ins for the measured curves:
# doc/paper/staged.sh [SET...], a table as Table 4. Each stage is a calibration that begins with the scene that the one
# before has fitted.
#   1. the initial slope, theta <= theta_lin: the tangential stiffness (the paper: E_b, which hardly changes the slope)
#   2. 9 to 10 degrees, where the paper takes all to be debonded: the depth d, with Coulomb's law and mu_b
#   3. where the torque is largest: mu_ub, with Coulomb's law
#   4. the whole curve: a_s and b_s, by the mean of Eq. (19)
# Last, all at once: least squares of the whole curve in all five. Results go to output/paper/staged.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
mu_b=${MU_B:-0.20 0.25 0.30 0.35 0.40 0.45 0.50}

# stage NAME SCENE OPTIONS...: leaves output/.../NAME/fitted.prm
stage() {
  local name=$1 scene=$2
  shift 2
  local options=()
  for option in "$@" "Task=calibrate" "Output/Directory=$here/$name"; do options+=(--set "$option"); done
  "$debond" "$scene" --force "${options[@]}" > "$log" 2>&1 || { cat "$log" >&2; exit 1; }
}

# value NAME UNKNOWN: what has been found
value() {
  python3 -c "import json, sys
result = json.load(open(sys.argv[1]))
print(result['curves'][0][sys.argv[2]] if sys.argv[2] == 'e_mp' else result['unknowns'][sys.argv[2]]['value'])" \
    "$here/$1/calibration.json" "$2"
}

interface=Interface
push="Chuck/Translation z/Value"
echo "| set | procedure | mu_b | d [um] | mu_ub | a_s [um] | b_s | eps_t [MPa/mm] | e_mp [%] |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for set in "${@:-1}"; do
  if [[ $set == 1 ]]; then
    peak="0.9, 1.13" linear=0.13 depth=0.0049 eps_n=622
  else
    peak="1, 1.33" linear=0.11 depth=0.0051 eps_n=710
  fi
  for mu in $mu_b; do
    here=output/paper/staged/$set-$mu
    mkdir -p "$here"
    log=$here/log
    # stages begin with numbers of about the right size: d goes with 1 / mu_b
    guess=$(python3 -c "print($depth * 0.4 / $mu)")
    unknown_depth="$push=-<<d: $guess in 0.0005..0.03 log>> * min(t, 1)"
    base=("Output/Reference curve=prm/paper/data/closed_form_b_data_set_$set.csv" "$interface/Penalty stiffness=$eps_n"
          "Bone/Young modulus=$([[ $set == 1 ]] && echo 18000 || echo 21000)" "$interface/Friction coefficient broken=$mu")
    stage slope prm/coin_mode3_fast.prm "${base[@]}" "$push=-$guess * min(t, 1)" "$interface/Friction law=coulomb" \
      "$interface/Friction coefficient broken=$(python3 -c "print(1.46 * $mu)")" \
      "$interface/Tangential penalty stiffness=<<eps_t: 400 in 100..3000 log>>" "Calibration/Windows=0, $linear"
    stage load "$here/slope/fitted.prm" "$interface/Friction coefficient broken=$mu" "$unknown_depth" "Calibration/Windows=9, 10"
    stage peak "$here/load/fitted.prm" "$interface/Friction coefficient broken=<<mu_ub: $(python3 -c "print(1.46 * $mu)") in 0.1..3>>" \
      "Calibration/Windows=$peak"
    stage fall "$here/load/fitted.prm" "$interface/Friction law=modified coulomb" \
      "$interface/Friction coefficient unbroken=$(value peak mu_ub)" "Calibration/Windows=" "Calibration/Measure=e_mp" \
      "$interface/Sliding threshold=<<a_s: 0.04 in 0.002..0.2 log>>" "$interface/Transition factor=<<b_s: 0.74 in 0.05..5 log>>"
    echo "| $set | staged | $mu | $(value load d) | $(value peak mu_ub) | $(value fall a_s) | $(value fall b_s) | $(value slope eps_t) | $(value fall e_mp) |"
    stage once prm/coin_mode3_fast.prm "${base[@]}" "$unknown_depth" \
      "$interface/Friction coefficient unbroken=<<mu_ub: $(python3 -c "print(1.46 * $mu)") in 0.1..3>>" \
      "$interface/Tangential penalty stiffness=<<eps_t: 400 in 100..3000 log>>" \
      "$interface/Sliding threshold=<<a_s: 0.04 in 0.002..0.2 log>>" "$interface/Transition factor=<<b_s: 0.74 in 0.05..5 log>>"
    echo "| $set | at once | $mu | $(value once d) | $(value once mu_ub) | $(value once a_s) | $(value once b_s) | $(value once eps_t) | $(value once e_mp) |"
  done
done | awk -F'|' '{ printf "|%s|%s|%s| %.2f | %.3f | %.1f | %.2f | %.0f | %.3f |\n", $2, $3, $4, 1000 * $5, $6, 1000 * $7, $8, $9, 100 * $10 }'
