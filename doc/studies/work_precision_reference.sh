#!/usr/bin/env bash
# Makes the reference of the work-precision study, prm/studies/data/work_precision_*.csv: runs
# prm/studies/work_precision_reference.prm (ten minutes or more, 8 GB), extrapolates torque and local values through the
# layers, the torque in the plane as well, thins the local values, and estimates the error of what it has made. Variants that
# are there are not run again.
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
[[ -x $debond ]] || { echo "work_precision_reference.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }
"$debond" prm/studies/work_precision_reference.prm --jobs 1
results=output/studies/work_precision_reference
data=prm/studies/data

# The torque at the last row of a variant.
last_torque() {
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "torque_Nmm") k = i } END { print $k }' "$results/variant-$(printf %03d "$1")/torque.csv"
}

# Twice as many layers divide their error by 2^order, by 45 x 45 elements with 4, 8 and 16 layers.
order=$(awk -v a="$(last_torque 5)" -v b="$(last_torque 4)" -v c="$(last_torque 3)" \
  'BEGIN { printf "%.2f", log((a - b) / (b - c)) / log(2) }')

# Rows of two variants with the same rows, extrapolated: X = X_fine + (X_fine - X_coarse) / (2^order - 1). Prints the columns
# $3 (names, separated by commas), of which those in $4 are extrapolated.
extrapolate() {
  awk -F, -v fine="$results/variant-$(printf %03d "$1")/$5" \
    -v coarse="$results/variant-$(printf %03d "$2")/$5" -v names="$3" -v which="$4" -v order="$order" '
    BEGIN {
      n = split(names, name, ","); m = split(which, list, ",")
      for (i = 1; i <= m; i++) extrapolated[list[i]] = 1
      getline header < fine; getline header < coarse
      w = split(header, column, ",")
      for (i = 1; i <= w; i++) number[column[i]] = i
      while ((getline a < fine) > 0 && (getline b < coarse) > 0) {
        split(a, A, ","); split(b, B, ",")
        line = ""
        for (i = 1; i <= n; i++) {
          k = number[name[i]]
          x = A[k]
          if (name[i] in extrapolated) x += (A[k] - B[k]) / (2^order - 1)
          line = line (i > 1 ? "," : "") sprintf("%.8g", x)
        }
        print line
      }
    }'
}

torque() { extrapolate "$1" "$2" time,angle_deg,torque_Nmm torque_Nmm torque.csv | awk -F, '$1 > 1 { print $2 "," $3 }'; }
profiles() { extrapolate "$1" "$2" angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm pressure_MPa,slip_mm profiles.csv; }

# Largest difference of two curves with the same rows, relative to the largest torque.
difference() {
  paste -d, "$1" "$2" | awk -F, '
    { d = $2 - $4; if (d < 0) d = -d; if (d > worst) worst = d; if ($2 > T_max) T_max = $2 } END { printf "%.1e", worst / T_max }'
}

# The order in the plane that three curves with the same rows, of 45, 60 and 90 elements across, show on average: the error of
# N elements is N^-order, so that (45^-p - 60^-p) / (60^-p - 90^-p) is the ratio of the sums of their differences.
order_in_plane() {
  paste -d, "$1" "$2" "$3" | awk -F, '
    { coarse += $2 - $4; fine += $4 - $6 }
    END {
      low = 0.1; high = 6
      while (high - low > 1e-3) {
        p = (low + high) / 2
        if ((45^-p - 60^-p) / (60^-p - 90^-p) < coarse / fine) low = p; else high = p
      }
      printf "%.2f", p
    }'
}

# Curves of 60 and 90 elements across, extrapolated with the order $3.
in_plane() {
  paste -d, "$1" "$2" | awk -F, -v order="$3" '{ printf "%s,%.8g\n", $3, $4 + ($4 - $2) / (1.5^order - 1) }'
}

# A number between 1 and 2, or the nearer of the two.
bounded() { awk -v p="$1" 'BEGIN { print (p < 1 ? 1 : p > 2 ? 2 : p) }'; }

made="# Made by doc/studies/work_precision_reference.sh: 90 x 90 and 24 x 24 elements, 10 x 10 points, linear bodies, 16 and 8
# layers graded by 1.5, extrapolated with the order $order in the layers"
mkdir -p "$data"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
torque 4 5 > "$work/fewer_layers"
torque 3 4 > "$work/modified_45"
torque 8 9 > "$work/modified_60"
torque 1 2 > "$work/modified_90"
torque 12 13 > "$work/coulomb_45"
torque 10 11 > "$work/coulomb_60"
torque 6 7 > "$work/coulomb_90"
layers=$(difference "$work/modified_45" "$work/fewer_layers")

# The file of a reference curve: $1 modified or coulomb, $2 a line that describes it. The error that is left is the change
# between extrapolating 8 and 4 or 16 and 8 layers, divided by 2^order for the 16, and what an order of 1.5 instead of 2 does
# in the plane, which is about what refining in the plane and through the layers together shows (tests/comparison).
curve() {
  local observed used plane total
  observed=$(order_in_plane "$work/$1"_{45,60,90})
  used=$(bounded "$observed")
  in_plane "$work/$1"_{60,90} "$used" > "$work/$1"
  in_plane "$work/$1"_{60,90} 1.5 > "$work/$1_lower_order"
  plane=$(difference "$work/$1" "$work/$1_lower_order")
  total=$(awk -v l="$layers" -v o="$order" -v p="$plane" 'BEGIN { printf "%.1e", l / 2^o + p }')
  echo "$made. The curves of 60 and 90"
  echo "# elements across made so are extrapolated with the order $used in the plane (45, 60 and 90 show $observed), which changes"
  echo "# that of 90 by $(difference "$work/$1" "$work/$1_90") of T_max at most."
  echo "# $2"
  echo "# Estimated error: $total of T_max. Extrapolating 8 and 4 instead of 16 and 8 layers changes the curve by $layers (a"
  echo "# quarter of which is left), an order of 1.5 in the plane by $plane."
  echo angle_deg,torque_Nmm
  cat "$work/$1"
}
curve modified "Modified Coulomb friction, up to 10 degrees." > "$data/work_precision_torque.csv"
curve coulomb "Constant friction, mu = 0.58, up to 1 degree." > "$data/work_precision_coulomb.csv"

# What is left in the plane of local values, which are not extrapolated there: 60 against 90 elements across, 16 layers. With
# second order 1 / (1.5^2 - 1) = 0.8 of the difference is left.
"$debond" prm/studies/work_precision_scene.prm --force --set "Bone/Cells=60, 60, 16" --set "Implant/Cells=16, 16" \
  --set "Interface/Quadrature points=10" --set "Load steps/Steps=1, 40, 20" --set "Load steps/Adaptive=false" \
  --set "Output/Reference profiles=$results/variant-001/profiles.csv" --set "Output/Directory=$results/in_plane" \
  --set Output/Console=quiet
local_in_plane=$(awk -F '[:,]' '/"(pressure|slip)_difference_rms"/ { value[++n] = 0.8 * $2 }
  END { printf "%.1e of the mean pressure, %.1e of the mean sliding distance", value[1], value[2] }' "$results/in_plane/summary.json")

# Of the 10 x 10 points of each element every other one of 4 x 4 that lie evenly; all of them within 0.5 mm of the axis, where
# the sliding distance has kinks (at the axis and at the border of what sticks). At all points of the reference itself the
# interpolation between these is wrong by 1.5e-5 of the pressure and 2.4e-5 of the sliding distance (root mean squares).
profiles 1 2 > "$work/profiles"
{
  echo "$made. Left in the plane (root mean"
  echo "# squares): $local_in_plane."
  echo "# Thinned: all points within 0.5 mm of the axis, 8 of the 100 points of each element elsewhere."
  echo angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm
  awk -F, 'BEGIN { place[1] = 0; place[3] = 1; place[6] = 2; place[8] = 3 }
    { k = (NR - 1) % 100; i = k % 10; j = int(k / 10)
      if ($2^2 + $3^2 < 0.25 || (i in place && j in place && (place[i] + place[j]) % 2 == 0))
        printf "%g,%.6f,%.6f,%.5g,%.7g,%.7g\n", $1, $2, $3, $4, $5, $6 }' "$work/profiles"
} > "$data/work_precision_profiles.csv"
grep -h "^#" "$data"/work_precision_*.csv
ls -l "$data"/work_precision_*.csv
