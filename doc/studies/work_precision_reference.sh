#!/usr/bin/env bash
# Makes the reference of the work-precision study, prm/studies/data/work_precision_*.csv: runs
# prm/studies/work_precision_reference.prm (ten minutes or more, 8 GB), extrapolates torque and local values through the
# layers, thins the local ones, and estimates the error of what it has made. Variants that are there are not run again.
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
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "torque_Nmm") k = i } END { print $k }' "$results/variant-00$1/torque.csv"
}

# Twice as many layers divide their error by 2^order, by 45 x 45 elements with 4, 8 and 16 layers.
order=$(awk -v a="$(last_torque 5)" -v b="$(last_torque 4)" -v c="$(last_torque 3)" \
  'BEGIN { printf "%.2f", log((a - b) / (b - c)) / log(2) }')

# Rows of two variants with the same rows, extrapolated: X = X_fine + (X_fine - X_coarse) / (2^order - 1). Prints the columns
# $3 (names, separated by commas), of which those in $4 are extrapolated.
extrapolate() {
  awk -F, -v fine="$results/variant-00$1/$5" -v coarse="$results/variant-00$2/$5" -v names="$3" -v which="$4" -v order="$order" '
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

made="# Made by doc/studies/work_precision_reference.sh: 90 x 90 and 24 x 24 elements, 10 x 10 points, linear bodies, 16 and 8
# layers graded by 1.5, extrapolated with the order $order in the layers."
mkdir -p "$data"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
torque 1 2 > "$work/curve"
torque 3 4 > "$work/half"
torque 4 5 > "$work/half_and_fewer_layers"
torque 6 7 > "$work/coulomb"
in_plane=$(difference "$work/curve" "$work/half")
layers=$(difference "$work/half" "$work/half_and_fewer_layers")
{
  echo "$made"
  echo "# Estimated error: extrapolating 8 and 4 instead of 16 and 8 layers changes the curve by $layers of T_max at most, half"
  echo "# as many elements across by $in_plane."
  echo angle_deg,torque_Nmm
  cat "$work/curve"
} > "$data/work_precision_torque.csv"
{
  echo "$made"
  echo "# Constant friction, mu = 0.58, up to 1 degree."
  echo angle_deg,torque_Nmm
  cat "$work/coulomb"
} > "$data/work_precision_coulomb.csv"

# Of the 10 x 10 points of each element every other one of 4 x 4 that lie evenly; all of them within 0.5 mm of the axis, where
# the sliding distance has kinks (at the axis and at the border of what sticks). At all points of the reference itself the
# interpolation between these is wrong by 1.5e-5 of the pressure and 2.4e-5 of the sliding distance (root mean squares).
profiles 1 2 > "$work/profiles"
{
  echo "$made"
  echo "# Thinned: all points within 0.5 mm of the axis, 8 of the 100 points of each element elsewhere."
  echo angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm
  awk -F, 'BEGIN { place[1] = 0; place[3] = 1; place[6] = 2; place[8] = 3 }
    { k = (NR - 1) % 100; i = k % 10; j = int(k / 10)
      if ($2^2 + $3^2 < 0.25 || (i in place && j in place && (place[i] + place[j]) % 2 == 0))
        printf "%g,%.6f,%.6f,%.5g,%.7g,%.7g\n", $1, $2, $3, $4, $5, $6 }' "$work/profiles"
} > "$data/work_precision_profiles.csv"
echo "Order in the layers: $order. Estimated errors of the torque curve: layers $layers, plane $in_plane of T_max"
ls -l "$data"/work_precision_*.csv
