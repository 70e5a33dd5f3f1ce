#!/usr/bin/env bash
# Makes the reference of the work-precision study, prm/studies/data/work_precision_*.csv: runs
# prm/studies/work_precision_reference.prm (two minutes, 2 GB), thins the local values, and says by how much a coarser
# solution differs from what it has made. Variants that are there are not run again.
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
[[ -x $debond ]] || { echo "work_precision_reference.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }
"$debond" prm/studies/work_precision_reference.prm --jobs 1
results=output/studies/work_precision_reference
data=prm/studies/data
made="# Made by doc/studies/work_precision_reference.sh: splines, 200 x 200 x 14 and 32 x 32 x 14 cells, 8 x 8 points, linear bodies."

# The columns $3 of $2 of a variant, from the beginning of the rotation on.
columns() {
  awk -F, -v names="$3" '
    NR == 1 { n = split(names, name, ","); for (i = 1; i <= NF; i++) number[$i] = i; next }
    !("time" in number) || $number["time"] > 1 {
      line = ""
      for (i = 1; i <= n; i++) line = line (i > 1 ? "," : "") sprintf("%.8g", $number[name[i]])
      print line
    }' "$results/variant-$(printf %03d "$1")/$2"
}

# Largest difference of two curves with the same rows, relative to the largest torque.
difference() {
  paste -d, "$1" "$2" | awk -F, '
    { d = $2 - $4; if (d < 0) d = -d; if (d > worst) worst = d; if ($2 > T_max) T_max = $2 } END { printf "%.1e", worst / T_max }'
}

# A reference curve: variants $1 and $2, and a line that describes it.
curve() {
  local fine coarse
  fine=$(columns "$1" torque.csv angle_deg,torque_Nmm)
  coarse=$(columns "$2" torque.csv angle_deg,torque_Nmm)
  echo "$made"
  echo "# $3"
  echo "# 140 x 140 x 10 and 24 x 24 x 10 cells, whose error is twice as large or more, differ by $(difference <(echo "$fine") <(echo "$coarse")) of T_max at most."
  echo angle_deg,torque_Nmm
  echo "$fine"
}
mkdir -p "$data"
curve 1 2 "Modified Coulomb friction, up to 10 degrees." > "$data/work_precision_torque.csv"
curve 3 4 "Constant friction, mu = 0.58, up to 1 degree." > "$data/work_precision_coulomb.csv"

# The coarser solution of the local values again, with the finer one as its reference.
"$debond" prm/studies/work_precision_scene.prm --force --set "Bone/Cells=140, 140, 10" --set "Implant/Cells=24, 10" \
  --set Bone/Element=spline --set Implant/Element=spline --set "Expert/Bone/Layer grading=2" --set "Expert/Implant/Layer grading=2" \
  --set "Expert/Interface/Quadrature points=8" --set "Load steps/Times=0, 1, 1.1, 2" --set "Load steps/Steps=1, 40, 20" \
  --set "Load steps/Adaptive=false" --set "Expert/Output/Reference profiles=$results/variant-001/profiles.csv" \
  --set "Output/Directory=$results/local" --set Expert/Output/Console=quiet
local=$(awk -F '[:,]' '/"(pressure|slip)_difference_rms"/ { value[++n] = $2 }
  END { printf "%.1e of the mean pressure, %.1e of the mean sliding distance", value[1], value[2] }' "$results/local/summary.json")

# Of the 8 x 8 points of each element 4; all of them within 0.5 mm of the axis, where the sliding distance has kinks (at the
# axis and at the border of what sticks).
{
  echo "$made"
  echo "# 140 x 140 x 10 and 24 x 24 x 10 cells differ by (root mean squares) $local."
  echo "# Thinned: all points within 0.5 mm of the axis, 4 of the 64 points of each element elsewhere."
  echo angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm
  columns 1 profiles.csv angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm | awk -F, '
    { k = (NR - 1) % 64; i = k % 8; j = int(k / 8)
      if ($2^2 + $3^2 < 0.25 || ((i == 1 || i == 5) && (j == 2 || j == 6)))
        printf "%g,%.6f,%.6f,%.5g,%.7g,%.7g\n", $1, $2, $3, $4, $5, $6 }'
} > "$data/work_precision_profiles.csv"
grep -h "^#" "$data"/work_precision_*.csv
ls -l "$data"/work_precision_*.csv
