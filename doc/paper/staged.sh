#!/usr/bin/env bash
# The paper's procedure of Section 4.1, stage by stage, against the stand-ins for the measured curves. Each stage is a
# calibration that begins with the scene that the one before has fitted.
#   doc/paper/staged.sh [1 | 2 | patterns]...
# 1, 2: the data set, for several mu_b, a table as Table 4. patterns: data set 1, mu_b = 0.40, the four patterns of the
# initial bonding, as Table 6.
#   1. the initial slope, theta <= theta_lin: the tangential stiffness (the paper: E_b, which hardly changes the slope)
#   2. 9 to 10 degrees, where the paper takes all to be debonded: the depth d, with Coulomb's law and mu_b
#   3. where the torque is largest: mu_ub, with a bond that does not break
#   4. the whole curve: a_s and b_s, by the mean of Eq. (19), of patterns by least squares
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

# row LABEL MU PROCEDURE D MU_UB FALL SLOPE: the last two are the stages that found a_s, b_s and eps_t
row() {
  awk -v label="$1" -v mu="$2" -v what="$3" -v d="$4" -v mu_ub="$5" -v a_s="$(value "$6" a_s)" -v b_s="$(value "$6" b_s)" \
    -v eps_t="$(value "$7" eps_t)" -v e_mp="$(value "$6" e_mp)" 'BEGIN {
    printf "| %s | %s | %s | %.2f | %.3f | %.0f | %.1f | %.0f | %.2f |\n", label, what, mu, 1000 * d, mu_ub, 1000 * a_s, b_s, eps_t, 100 * e_mp }'
}

interface=Interface
measure=e_mp
sharpest=0.05
push="Chuck/Press/Value"

# fit LABEL SET MU OPTIONS...: the stages, and all at once
fit() {
  local label=$1 set=$2 mu=$3
  shift 3
  here="output/paper/staged/$label-$mu"
  mkdir -p "$here"
  log=$here/log
  local peak linear depth eps_n young
  if [[ $set == 1 ]]; then
    peak="0.9, 1.13" linear=0.13 depth=0.0049 eps_n=622 young=18000
  else
    peak="1, 1.33" linear=0.11 depth=0.0051 eps_n=710 young=21000
  fi
  # stages begin with numbers of about the right size: d goes with 1 / mu_b
  local guess mu_guess
  guess=$(python3 -c "print($depth * 0.4 / $mu)")
  mu_guess=$(python3 -c "print(1.46 * $mu)")
  local unknown_depth="$push=<<d: $guess in 0.0005..0.03 log>> * min(t, 1)"
  local unknown_mu="$interface/Friction coefficient unbroken=<<mu_ub: $mu_guess in 0.1..3>>"
  local unknown_eps="$interface/Tangential stiffness=<<eps_t: 400 in 100..3000 log>>"
  local unknown_law=("$interface/Characteristic slip distance=<<a_s: 0.1 in 0.002..0.2 log>>" "$interface/Transition factor=<<b_s: 0.74 in $sharpest..5 log>>")
  local base=("Output/Reference curve=prm/paper/data/closed_form_b_data_set_$set.csv" "$interface/Normal stiffness=$eps_n"
              "Bone/Young modulus=$young" "$interface/Friction coefficient broken=$mu" "$@")
  stage slope prm/coin_mode3_fast.prm "${base[@]}" "$push=$guess * min(t, 1)" "$interface/Friction law=coulomb" \
    "$interface/Friction coefficient=$mu_guess" "$unknown_eps" "Calibration/Windows=0, $linear"
  stage load "$here/slope/fitted.prm" "$interface/Friction coefficient=$mu" "$unknown_depth" "Calibration/Windows=9, 10"
  stage peak "$here/load/fitted.prm" "$interface/Friction law=modified coulomb" "$unknown_mu" \
    "$interface/Characteristic slip distance=0.3" "Calibration/Windows=$peak"
  stage fall "$here/peak/fitted.prm" "${unknown_law[@]}" "Calibration/Windows=none" "Expert/Calibration/Measure=$measure"
  row "$label" "$mu" staged "$(value load d)" "$(value peak mu_ub)" fall slope
  stage once prm/coin_mode3_fast.prm "${base[@]}" "$unknown_depth" "$unknown_mu" "$unknown_eps" "${unknown_law[@]}"
  row "$label" "$mu" "at once" "$(value once d)" "$(value once mu_ub)" once once
}

echo "| set | procedure | mu_b | d [um] | mu_ub | a_s [um] | b_s | eps_t [MPa/mm] | e_mp [%] |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for what in "${@:-1}"; do
  if [[ $what != patterns ]]; then
    for mu in $mu_b; do fit "$what" "$what" "$mu"; done
    continue
  fi
  # elements of the implant as in the paper; without a closed form the search begins at the guess
  bonding=$interface/Bonding
  measure="least squares" # of these runs of seconds the mean of Eq. (19) takes some 70
  sharpest=0.2 # a fall that is more sudden goes in jumps, with steps without number
  mesh=("Implant/Cells=20, 2" "Expert/$interface/Quadrature points=3" "Expert/Calibration/Starts=1")
  part=("$bonding/Bonded fraction=0.55" "Expert/$bonding/Resolution=element")
  fit "1, homogeneous" 1 0.40 "${mesh[@]}"
  fit "1, (b)" 1 0.40 "${mesh[@]}" "$bonding/Pattern=image" "$bonding/File=prm/paper/data/bonding_pattern_b.png" "Expert/$bonding/Threshold=0.5"
  fit "1, (c)" 1 0.40 "${mesh[@]}" "${part[@]}" "$bonding/Pattern=disk"
  fit "1, (d)" 1 0.40 "${mesh[@]}" "${part[@]}" "$bonding/Pattern=random" "$bonding/Seed=1"
done
