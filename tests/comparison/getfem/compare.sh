#!/usr/bin/env bash
# Runs coin.py and debond on the same cells with bilinear contact surfaces and
# compares the torques at four angles. Usage: compare.sh DEBOND PYTHON PERCENT
set -euo pipefail
export LC_ALL=C
debond=$1
python=$2
within=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT

"$python" "$here/coin.py" --bone 15,15,2 --implant 6,2 > "$directory/getfem.csv"
"$debond" "$here/../coin.prm" --set "Output/Directory=$directory/debond" --set Expert/Output/Console=quiet \
  --set "Bone/Cells=15,15,2" --set "Implant/Cells=6,2" \
  --set "Expert/Bone/Contact surface=bilinear" --set "Expert/Implant/Contact surface=bilinear"

# torque.csv has one row more, that of the first time.
awk -F, -v within="$within" '
  FNR == 1 { ++file; for (i = 1; i <= NF; ++i) if ($i == "torque_Nmm") column = i; next }
  file == 1 { ++n; getfem[n] = $column; angle[n] = $1; next }
  FNR > 2 { debond[FNR - 2] = $column; rows = FNR - 2 }
  END {
    if (rows != n) { print "different numbers of rows"; exit 1 }
    printf "%10s %12s %12s %9s\n", "angle", "GetFEM", "debond", "diff [%]"
    for (i = 2; i <= n; ++i)
      {
        difference = 100 * (debond[i] / getfem[i] - 1)
        printf "%10g %12.4f %12.4f %+9.4f\n", angle[i], getfem[i], debond[i], difference
        if (difference > within || -difference > within) bad = 1
      }
    if (bad) print "FAILED: they differ by more than " within " %"
    exit bad
  }' "$directory/getfem.csv" "$directory/debond/torque.csv"
