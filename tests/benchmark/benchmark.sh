#!/usr/bin/env bash
# Times the main scene and compares with a stored baseline; see --help.
set -euo pipefail
export LC_ALL=C

usage="usage: benchmark.sh [OPTIONS] DEBOND MACHINE_SPEED SCENE

Times SCENE on the paper's three meshes and a very fine one, with Neo-Hookean
and with linear bodies, in adaptive steps (torque curve to 1e-3) and in 1000, with
one and with two threads, without field output and without the page of the results,
which another process makes. Prints one row for each:

  seconds    of the whole process, less those of an empty one (debond --version,
             which loads the same libraries and does nothing)
  phases     bulk (internal forces, triangular solves), condensation
             (factorisations of the bulk), contact, dense (system of the
             interface), output; the rest is set-up and libraries
  peak MB    largest memory held
  ratio      seconds over those of the baseline, both in units of what the
             machine takes for a fixed piece of work (MACHINE_SPEED): above one is
             slower than the baseline. Other processors do some work faster than
             other: there, time the program before a change, too

  --baseline FILE   compare with this file (default: baseline.csv beside this script)
  --write FILE      write a new baseline
  --quick           adaptive steps on the three smaller meshes only

Nothing else should run on the machine. Some ten minutes; one with --quick."

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
baseline=$here/baseline.csv
output=/dev/null
meshes=(coarse:15,15,2:3,2 medium:30,30,2:6,2 fine:60,60,2:12,2)
runs=(adaptive:linear adaptive:neo-hookean 1000:linear 1000:neo-hookean)
very_fine=yes
while [[ $# -gt 0 && $1 == -* ]]; do
  case $1 in
    --help) echo "$usage"; exit 0 ;;
    --baseline) baseline=$2; shift ;;
    --write) output=$2; shift ;;
    --quick) runs=(adaptive:linear adaptive:neo-hookean); very_fine= ;;
    *) echo "benchmark.sh: unknown option '$1' (see --help)" >&2; exit 1 ;;
  esac
  shift
done
[[ $# -eq 3 ]] || { echo "$usage" >&2; exit 1; }
[[ -f $baseline ]] || { echo "benchmark.sh: there is no baseline $baseline" >&2; exit 1; }
debond=$1
machine_speed=$2
scene=$3
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT

seconds_of() { # wall seconds of a command
  local start end
  start=$(date +%s.%N)
  "$@" > "$directory/log" || return 1 # it has said why
  end=$(date +%s.%N)
  awk -v a="$start" -v b="$end" 'BEGIN { printf "%.3f", b - a }'
}

value_of() { # a number from summary.json
  awk -F'[:,]' -v key="\"$1\"" '$1 ~ key { print $2 + 0 }' "$directory/run/summary.json"
}

seconds_of "$debond" --version > "$directory/first" # brings the libraries into the cache
empty=$(seconds_of "$debond" --version)
unit=$("$machine_speed")
echo "An empty program takes $empty s, taken off below; the fixed piece of work takes $unit s."
printf '%-8s %-9s %-11s %7s | %8s %5s %6s | %6s %8s %7s %6s %6s | %7s %6s\n' \
  steps mesh bodies threads seconds steps Newton bulk condens. contact dense output 'peak MB' ratio
echo "steps,mesh,bodies,threads,seconds,unit_seconds,accepted_steps,dofs" > "$directory/new"

time_run() { # STEPS BODIES MESH BONE IMPLANT THREADS
  local stepping=(--set "Load steps/Steps=1, 1000") seconds ratio
  if [[ $1 == adaptive ]]; then
    stepping=(--set "Load steps/Steps=1, 10" --set "Load steps/Adaptive=true")
  fi
  seconds=$(seconds_of "$debond" "$scene" --threads "$6" --set "Output/Directory=$directory/run" --force \
    --set "Output/Fields every=none" --set "Expert/Output/Console=quiet" --set "Output/Report=false" \
    --set "Bone/Cells=$4" --set "Implant/Cells=$5" \
    --set "Bone/Material=$2" --set "Implant/Material=$2" "${stepping[@]}")
  seconds=$(awk "BEGIN { print $seconds - $empty }")
  ratio=$(awk -F, -v key="$1,$3,$2,$6" -v s="$seconds" -v u="$unit" \
    '$1 "," $2 "," $3 "," $4 == key { printf "%.2f", (s / u) / ($5 / $6) }' "$baseline")
  printf '%-8s %-9s %-11s %7s | %8.2f %5d %6d | %6.2f %8.2f %7.2f %6.2f %6.2f | %7.0f %6s\n' \
    "$1" "$3" "$2" "$6" "$seconds" "$(value_of steps)" "$(value_of newton_iterations)" "$(value_of seconds_bulk)" \
    "$(value_of seconds_condensation)" "$(value_of seconds_contact)" "$(value_of seconds_dense_solve)" \
    "$(value_of seconds_output)" "$(value_of peak_memory_MB)" "${ratio:--}"
  echo "$1,$3,$2,$6,$seconds,$unit,$(value_of steps),$(value_of dofs)" >> "$directory/new"
}

for threads in 1 2; do
  for run in "${runs[@]}"; do
    for mesh in "${meshes[@]}"; do
      IFS=: read -r steps bodies <<< "$run"
      IFS=: read -r name bone implant <<< "$mesh"
      time_run "$steps" "$bodies" "$name" "$bone" "$implant" "$threads"
    done
  done
  if [[ -n $very_fine ]]; then
    time_run adaptive linear 'very fine' 120,120,4 24,4 "$threads"
  fi
done

# Growth of the cost of a step with the number of degrees of freedom.
awk -F, '$1 == "adaptive" && $3 == "linear" && $4 == 1 { cost[$2] = $5 / $7; dofs[$2] = $8 }
  END { if ("very fine" in cost)
          printf "Cost of a step, set-up included, from medium to very fine: dofs^%.2f\n",
            log(cost["very fine"] / cost["medium"]) / log(dofs["very fine"] / dofs["medium"]) }' "$directory/new"
cp "$directory/new" "$output"
