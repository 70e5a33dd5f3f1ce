#!/usr/bin/env bash
# Error of the torque against wall seconds for debond, CalculiX and GetFEM on
# the scene coin.prm; see README.md. For usage: --help
set -euo pipefail
export LC_ALL=C

usage="usage: work_precision.sh [OPTIONS] OUTPUT.csv

Solves coin.prm with debond, CalculiX (ccx) and GetFEM on several meshes and
writes a row for each run: code, label, wall seconds of the whole process, error
(largest difference of the torque from the reference over the largest torque),
unknowns, increments, start (seconds of an empty process: debond --version,
ccx -v, import getfem). A code that is not installed is left out.

  --curve             a torque curve with a value every 0.05 degrees (debond and
                      CalculiX only) instead of four angles, one step to each;
                      references are
                      prm/studies/data/work_precision_coulomb.csv and
                      work_precision_reference.csv
  --at-most SECONDS   leave out runs that need more processor seconds
  --only CODE         debond, CalculiX or GetFEM; may be repeated
  --processor         seconds of the processors instead of the wall, for a
                      machine with other work; two threads then look worse
  --list              print the runs and their seconds, run nothing
  --factors           run nothing, print of an OUTPUT.csv how many times faster
                      debond reaches the same error (also printed after a run)
  --without-start     of these factors: leave out the start of the programs
  --help              print this text

Environment: DEBOND, CALCULIX_INPUT, CCX, PYTHON name the programs; by default
those of build/release, ccx and /usr/bin/python3."

# code | method | bone across | implant across | layers (bone+implant if they
# differ) | threads | processor seconds (rough), for the curve (-: left out).
# The method is the element and, with 'round', a polygon of the same area as the
# disk: what a careful user of straight elements would take. debond: 'nurbs',
# trilinear cells below a face of NURBS, or 'splines'.
runs="
debond   nurbs        15  3  2   2 0.1  0.15
debond   nurbs        15  3  4   2 0.1  0.15
debond   nurbs        20  4  4+2 2 0.2  0.2
debond   nurbs        20  4  6+2 2 0.2  0.3
debond   nurbs        20  4  8+3 2 0.3  0.4
debond   nurbs        30  6  4   2 0.3  0.4
debond   nurbs        30  6  8   2 0.6  0.8
debond   nurbs        40  8 12+6 2 2    3
debond   nurbs        45  9 12   2 4    5
debond   nurbs        60 12 16   2 15   20
debond   splines      16  3  4+2 2 0.1  0.1
debond   splines      20  4  6+3 2 0.1  0.15
debond   splines      30  5  8+4 2 0.2  0.25
debond   splines      40  6  8+4 2 0.3  0.4
debond   splines      60  8 10+6 2 0.5  0.8
debond   splines      80 10 10+8 2 1    1.5
debond   adaptive     20  4  6+2 2 0.3  -
debond   adaptive     30  6  8   2 1    -
CalculiX C3D8         15  6  2   1 1.3  6
CalculiX C3D8         30 12  2   1 5    20
CalculiX C3D8         30 12  4   1 12   50
CalculiX C3D8         30 24  4   1 21   -
CalculiX C3D8-round   15  6  2   1 1.3  6
CalculiX C3D8-round   30 12  2   1 5    20
CalculiX C3D8-round   30 12  4   1 12   50
CalculiX C3D8-round   30 12  8   1 40   150
CalculiX C3D20R       15  6  2   1 11   55
CalculiX C3D20R       15 12  2   1 22   -
CalculiX C3D20R       15 12  2   2 24   -
CalculiX C3D20R       15 12  4   1 42   -
GetFEM   Q1           15  6  2   1 0.7  -
GetFEM   Q1           30 12  4   1 5    -
GetFEM   Q1-round     15  6  2   1 0.7  -
GetFEM   Q1-round     30 12  4   1 5    -
GetFEM   Q2           15  3  2   1 9    -
GetFEM   Q2           15  6  2   1 10   -
GetFEM   Q2           15  6  4   1 24   -
"

fail() {
  echo "work_precision.sh: $*" >&2
  exit 1
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/release
debond=${DEBOND:-$build/debond}
calculix_input=${CALCULIX_INPUT:-$build/tests/comparison/calculix/calculix_input}
ccx=${CCX:-ccx}
python=${PYTHON:-/usr/bin/python3}
reference=$here/work_precision_reference.csv
steps=(1 1 1 1 1) # of coin.prm's phases
curve=false

output=
at_most=1e9
only=
list=false
clock=wall
factors=false
without_start=0
while [ $# -gt 0 ]; do
  case $1 in
    --help) echo "$usage"; exit 0 ;;
    --list) list=true ;;
    --processor) clock=processor ;;
    --curve) curve=true; steps=(1 1 1 4 14); reference=$here/../../prm/studies/data/work_precision_coulomb.csv ;;
    --factors) factors=true ;;
    --without-start) without_start=1 ;;
    --at-most | --only)
      [ $# -ge 2 ] || fail "$1 needs a value (see work_precision.sh --help)"
      case $1 in
        --at-most) at_most=$2 ;;
        --only) only+=" $2" ;;
      esac
      shift ;;
    -*) fail "unknown option '$1' (see work_precision.sh --help)" ;;
    *) [ -z "$output" ] || fail "one file to write: '$output' or '$1'?"; output=$1 ;;
  esac
  shift
done
[[ $at_most =~ ^[0-9.]+(e[0-9]+)?$ ]] || fail "--at-most: expected a number of seconds, got '$at_most'"
for code in $only; do
  [[ $code =~ ^(debond|CalculiX|GetFEM)$ ]] || fail "--only: expected debond, CalculiX or GetFEM, got '$code'"
done
$list || [ -n "$output" ] || fail "no file to write is given (see work_precision.sh --help)"

# For each run of another code its seconds over those that debond (nurbs and
# splines) needs for the same error, logarithms linear between the best of its
# runs. An error larger than debond's largest is given debond's least seconds; a
# smaller one no factor.
print_factors() {
  awk -F, -v OFS=, -v without="$without_start" '
    FNR == 1 { next }
    { $3 -= without * $7 }
    $1 == "debond" && $2 ~ /^(nurbs|splines)/ { ++all; s[all] = $3; e[all] = $4; next }
    $1 != "debond" { ++m; row[m] = $0 }
    function front(     i, k, best) { # faster runs first, each closer than the last
      for (best = 1e9; ; best = e[k])
        {
          k = 0
          for (i = 1; i <= all; ++i)
            if (e[i] < best && (!k || s[i] < s[k])) k = i
          if (!k) return
          ++n; seconds[n] = s[k]; error[n] = e[k]
        }
    }
    function at(e,     i, w) {
      if (e >= error[1]) return seconds[1]
      for (i = 1; i < n; ++i)
        if (error[i + 1] <= e && e <= error[i])
          {
            w = log(e / error[i]) / log(error[i + 1] / error[i])
            return exp((1 - w) * log(seconds[i]) + w * log(seconds[i + 1]))
          }
      return 0
    }
    END {
      if (!all || !m) exit
      front()
      printf "%-9s %-45s %9s %9s %9s %7s\n", "code", "label", "error", "seconds", "debond", "factor"
      for (k = 1; k <= m; ++k)
        {
          split(row[k], part, ",")
          own = at(part[4])
          printf "%-9s %-45s %9.2e %9.2f %9s %7s\n", part[1], part[2], part[4], part[3],
            own ? sprintf("%.2g", own) : "-", own ? sprintf("%.1f", part[3] / own) : "-"
        }
    }' "$1"
}

if $factors; then
  [ -f "$output" ] || fail "--factors: no file '$output'"
  print_factors "$output"
  exit
fi

has() { # whether the programs of a code are there; says what is not
  case $1 in
    debond) command -v "$debond" > /dev/null || fail "$debond not found: build it, or set DEBOND" ;;
    CalculiX)
      command -v "$ccx" > /dev/null || { echo "No CalculiX: '$ccx' not found (Debian: calculix-ccx)." >&2; return 1; }
      command -v "$calculix_input" > /dev/null || {
        echo "No CalculiX: build its input with cmake --build --preset release --target calculix_input." >&2; return 1; } ;;
    GetFEM)
      "$python" -c "import getfem" 2> /dev/null ||
        { echo "No GetFEM: '$python' cannot import getfem (Debian: python3-getfem++)." >&2; return 1; } ;;
  esac
}

chosen=
for code in debond CalculiX GetFEM; do
  [[ -n $only && " $only " != *" $code "* ]] && continue
  $list || has "$code" || continue
  chosen+=$(awk -v code="$code" -v most="$at_most" -v curve="$curve" '
    curve == "true" { $7 = $8 }
    $1 == code && $7 != "-" && $7 + 0 <= most + 0' <<< "$runs")$'\n'
done
# Runs below two seconds are repeated.
awk 'NF { s += $7 * ($7 < 2 ? 3 : 1); n++ }
     END { printf "%d runs, about %.0f minutes on a machine with nothing else to do.\n", n, s / 60 + 0.5 }' <<< "$chosen" >&2
$list && { grep . <<< "$chosen"; exit 0; }

directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT
ccx=$(realpath "$(command -v "$ccx" || echo .)") # it runs elsewhere

# timed COMMAND...: sets $seconds to the seconds of the command; of one that takes
# less than two seconds to the least of three runs.
timed() {
  local TIMEFORMAT="%R %U %S" once
  seconds=
  for _ in 1 2 3; do
    { time "$@" > "$directory/log" 2> "$directory/errors"; } 2> "$directory/time" || {
      tail -n 10 "$directory/log" "$directory/errors" >&2
      fail "$label failed; its last lines are above"
    }
    once=$(awk -v clock="$clock" '{ print clock == "wall" ? $1 : $2 + $3 }' "$directory/time")
    seconds=$(awk -v a="$once" -v b="${seconds:-$once}" 'BEGIN { print a < b ? a : b }')
    if awk -v s="$once" 'BEGIN { exit s < 2 }'; then break; fi
  done
}

# Seconds that a code takes to start, once it has been loaded.
declare -A empty
measure_empty() {
  [ -n "${empty[$1]:-}" ] && return
  local command=("$debond" --version)
  case $1 in
    CalculiX) command=("$ccx" -v) ;;
    GetFEM) command=("$python" -c "import getfem") ;;
  esac
  label="an empty run of $1"
  empty[$1]=0
  timed may_fail "${command[@]}"
  empty[$1]=$seconds
}
may_fail() { # ccx -v says its version and fails
  "$@" || true
}

equal_area_radius() { # of a polygon with four times as many sides as cells across
  awk -v n="$((4 * $1))" 'BEGIN { pi = atan2(0, -1); printf "%.8f", 2.5 * sqrt(2 * pi / (n * sin(2 * pi / n))) }'
}

# Each of these runs a code and sets $seconds, $unknowns and $increments; rows
# "angle,torque" go to the file curve.
cells_of_scene() {
  echo "--set Bone/Cells=$bone,$bone,${layers%+*} --set Implant/Cells=$implant,${layers#*+}" \
    "--set Implant/Radius=$radius"
}

run_debond() {
  local adaptive=false body splines=()
  [ "$method" = adaptive ] && adaptive=true
  if [ "$method" = splines ]; then
    for body in Bone Implant; do splines+=(--set "$body/Element=spline" --set "Expert/$body/Layer grading=2"); done
  fi
  # shellcheck disable=SC2046 # no value has a blank
  timed "$debond" "$here/coin.prm" $(cells_of_scene) "${splines[@]}" --force --set "Output/Directory=$directory/debond" \
    --set Expert/Output/Console=quiet --set "Load steps/Adaptive=$adaptive" --set "Load steps/Steps=$steps_of_scene" \
    --threads "$threads"
  awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
           { print $column["angle_deg"] "," $column["torque_Nmm"] }' "$directory/debond/torque.csv" > "$directory/curve"
  unknowns=$(awk -F'[:,]' '$1 ~ /"unknowns"/ { print $2 + 0 }' "$directory/debond/summary.json")
  increments=$(awk 'END { print NR - 2 }' "$directory/debond/torque.csv")
}

calculix_in_directory() (
  cd "$directory" && exec env OMP_NUM_THREADS="$threads" "$ccx" calculix
)

run_CalculiX() {
  rm -f "$directory"/calculix.*
  # shellcheck disable=SC2046
  "$calculix_input" "$here/coin.prm" "$directory/calculix.inp" --element "${method%-round}" $(cells_of_scene) \
    --set "Load steps/Steps=$steps_of_scene"
  timed calculix_in_directory
  awk -f "$here/calculix/reactions.awk" "$directory/calculix.inp" "$directory/calculix.dat" |
    awk -F, '{ print $2 "," $4 }' > "$directory/curve" || fail "$label did not finish all steps"
  unknowns=$(awk 'found { print $1; exit } /number of equations/ { found = 1 }' "$directory/log")
  increments=$(awk 'NR > 2' "$directory/calculix.sta" | wc -l)
}

run_GetFEM() {
  local degree=${method:1:1}
  timed "$python" "$here/getfem/coin.py" --bone "$bone,$bone,$layers" --implant "$implant,$layers" \
    --radius "$radius" --degree "$degree"
  awk -F, 'NR > 1 { print $1 "," $2 }' "$directory/log" > "$directory/curve"
  unknowns=$(awk '$1 == "unknowns" { print $2 }' "$directory/errors")
  increments=$(wc -l < "$directory/curve")
}

error_of_curve() {
  awk -F, '/^#/ || /angle_deg/ { next }
    NR == FNR { reference[$1] = $2; if ($2 > largest) largest = $2; n++; next }
    { for (angle in reference)
        if ($1 - angle < 1e-9 && angle - $1 < 1e-9)
          { found[angle] = 1; d = $2 - reference[angle]; if (d < 0) d = -d; if (d > worst) worst = d } }
    END { for (angle in found) n--
          if (n) exit 1
          printf "%.3g", worst / largest }' "$reference" "$directory/curve"
}

steps_of_scene=$(IFS=,; echo "${steps[*]}")
echo "code,label,seconds,error_torque,unknowns,increments,start" > "$directory/table"
while read -r code method bone implant layers threads _; do
  [ -n "$code" ] || continue
  measure_empty "$code"
  label="$method $bone x $bone x ${layers%+*} / $implant x $implant x ${layers#*+}"
  [ "$threads" = 1 ] || [ "$code" = debond ] || label+=" $threads threads"
  radius=2.5
  [[ $method == *-round ]] && radius=$(equal_area_radius "$implant")
  "run_$code" < /dev/null
  error=$(error_of_curve) || fail "$code $label: an angle of $reference is missing"
  echo "$code,$label,$seconds,$error,$unknowns,$increments,${empty[$code]}" | tee -a "$directory/table" >&2
done <<< "$chosen"
mkdir -p "$(dirname "$output")"
mv "$directory/table" "$output"
print_factors "$output"
