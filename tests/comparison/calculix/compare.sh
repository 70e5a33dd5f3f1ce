#!/usr/bin/env bash
# Runs a scene with CalculiX and with debond, with NURBS and with bilinear
# contact surfaces, and prints one table; see README.md. For usage: --help
set -euo pipefail
export LC_ALL=C OMP_NUM_THREADS=1

usage="usage: compare.sh [OPTIONS] SCENE.prm

Runs a scene with CalculiX (ccx) and with debond, and compares force and torque.

  --set ENTRY=VALUE    override an entry of the scene; may be repeated
  --directory PATH     keep all files there (default: a temporary directory,
                       which is removed)
  --element TYPE       element of CalculiX: C3D8 (default), C3D8I, C3D8R, C3D20
                       or C3D20R
  --within PERCENT     fail if debond with bilinear surfaces is further away
                       from CalculiX
  --nurbs-within PERCENT  the same for NURBS
  --help               print this text

Environment: DEBOND, CALCULIX_INPUT, CCX name the programs; by default those of
build/release and ccx."

fail() {
  echo "compare.sh: $*" >&2
  exit 1
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_directory=$(cd "$here/../../.." && pwd)
build=$source_directory/build/release
debond=${DEBOND:-$build/debond}
calculix_input=${CALCULIX_INPUT:-$build/tests/comparison/calculix/calculix_input}
ccx=${CCX:-ccx}

scene=
directory=
within=
nurbs_within=
sets=()
element=C3D8
while [ $# -gt 0 ]; do
  case $1 in
    --help) echo "$usage"; exit 0 ;;
    --set | --directory | --element | --within | --nurbs-within)
      [ $# -ge 2 ] || fail "$1 needs a value (see compare.sh --help)"
      case $1 in
        --set) sets+=(--set "$2") ;;
        --directory) directory=$2 ;;
        --element) element=$2 ;;
        --within) within=$2 ;;
        --nurbs-within) nurbs_within=$2 ;;
      esac
      shift ;;
    -*) fail "unknown option '$1' (see compare.sh --help)" ;;
    *) [ -z "$scene" ] || fail "one scene at a time: '$scene' or '$1'?"; scene=$1 ;;
  esac
  shift
done
[ -n "$scene" ] || fail "no scene is given (see compare.sh --help)"
command -v "$ccx" > /dev/null ||
  fail "CalculiX is not installed: '$ccx' not found (Debian: apt install calculix-ccx; or set CCX)"
command -v "$debond" > /dev/null ||
  fail "$debond not found: build it with cmake --build --preset release, or set DEBOND"
command -v "$calculix_input" > /dev/null ||
  fail "$calculix_input not found: build it with cmake --build --preset release --target calculix_input," \
    "or set CALCULIX_INPUT"

ccx=$(realpath "$(command -v "$ccx")") # it runs elsewhere

if [ -z "$directory" ]; then
  directory=$(mktemp -d)
  trap 'rm -rf "$directory"' EXIT
else
  mkdir -p "$directory"
  directory=$(cd "$directory" && pwd)
fi

# timed NAME COMMAND...: runs a command, which prints into NAME.log, and sets
# $seconds: of the processor, so that other work on the machine matters less.
timed() {
  local name=$1 log=$directory/$1.log TIMEFORMAT="%U %S"
  shift
  { time "$@" > "$log" 2>&1; } 2> "$directory/seconds" || {
    tail -n 20 "$log" >&2
    fail "$name failed; its last lines are above"
  }
  seconds=$(awk "{ printf \"%.1f\", \$1 + \$2 }" "$directory/seconds")
}

rm -f "$directory"/calculix.*
"$calculix_input" "$scene" "$directory/calculix.inp" --element "$element" "${sets[@]}"
run_calculix() (
  cd "$directory" && exec "$ccx" calculix
)
timed calculix run_calculix
all_seconds=$seconds

version=$("$ccx" -v | awk '{ for (i = 1; i < NF; ++i) if ($i == "Version") print $(i + 1) }') || true

awk -f "$here/reactions.awk" "$directory/calculix.inp" "$directory/calculix.dat" > "$directory/calculix.csv" || {
  tail -n 20 "$directory/calculix.log" >&2
  fail "CalculiX did not finish all steps; its last lines are above"
}

# The same columns from torque.csv, whose row of the first time CalculiX has not.
for surface in nurbs bilinear; do
  timed "debond_$surface" "$debond" "$scene" "${sets[@]}" --set "Output/Directory=$directory/$surface" --force \
    --set "Output/Fields every=none" --set "Output/Curve=Rotation z, Moment z" \
    --set "Expert/Bone/Contact surface=$surface" --set "Expert/Implant/Contact surface=$surface"
  all_seconds+=" $seconds"
  awk -F, '
    FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    FNR > 2 { print $column["time"] "," $column["angle_deg"] "," $column["force_N"] "," $column["torque_Nmm"] }
    ' "$directory/$surface/torque.csv" > "$directory/$surface.csv"
done

# Forces are compared in steps without rotation and at the end, torques where
# the implant is turned. Differences are relative to CalculiX, near zero to a
# tenth of its largest value (or 0.01 mm times the force).
awk -F, -v header="CalculiX $version ($element) and debond: $scene" \
  -v seconds="$all_seconds" -v within="$within" -v nurbs_within="$nurbs_within" '
  function abs(x) { return x < 0 ? -x : x }
  function max(x, y) { return x > y ? x : y }
  function percent(value, reference, scale) {
    scale = max(abs(reference), max(0.1 * largest, 0.01 * largest_force))
    return scale > 0 ? 100 * (value - reference) / scale : 0
  }
  function table(title, first_column,     i, k, d, is_turned) {
    largest = 0
    for (i = 1; i <= n; ++i) largest = max(largest, abs(v[1, i, first_column]))
    if (first_column == 3) largest_force = largest
    printf "%-10s %10s %10s | %10s %9s | %10s %9s\n",
      title, "angle", "CalculiX", "nurbs", "diff [%]", "bilinear", "diff [%]"
    for (i = 1; i <= n; ++i)
      {
        is_turned = i > 1 ? v[1, i, 2] != v[1, i - 1, 2] : v[1, i, 2] != 0
        if (first_column == 4 ? v[1, i, 2] == 0 : is_turned && i < n) continue
        d[2] = percent(v[2, i, first_column], v[1, i, first_column])
        d[3] = percent(v[3, i, first_column], v[1, i, first_column])
        for (k = 2; k <= 3; ++k) worst[k] = max(worst[k], abs(d[k]))
        printf "%-10s %10.4g %10.4f | %10.4f %+9.3f | %10.4f %+9.3f\n", "", v[1, i, 2],
          v[1, i, first_column], v[2, i, first_column], d[2], v[3, i, first_column], d[3]
      }
  }
  FNR == 1 { ++file }
  { for (i = 1; i <= 4; ++i) v[file, FNR, i] = $i; count[file] = FNR }
  END {
    n = count[1]
    if (count[2] != n || count[3] != n) { print "compare.sh: the programs gave different numbers of rows"; exit 1 }
    print header
    table("F [N]", 3)
    table("T [N mm]", 4)
    split(seconds, s, " ")
    printf "%-10s %10s %10.1f | %10.1f %9s | %10.1f\n", "seconds", "", s[1], s[2], "", s[3]
    printf "Largest difference: nurbs %.3f %%, bilinear %.3f %%\n", worst[2], worst[3]
    if (nurbs_within != "" && worst[2] > nurbs_within + 0) {
      print "FAILED: nurbs differs by more than " nurbs_within " %"; bad = 1 }
    if (within != "" && worst[3] > within + 0) {
      print "FAILED: bilinear differs by more than " within " %"; bad = 1 }
    exit bad
  }' "$directory/calculix.csv" "$directory/nurbs.csv" "$directory/bilinear.csv" | tee "$directory/table.txt"
