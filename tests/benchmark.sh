#!/usr/bin/env bash
# Times the main scene on the paper's three meshes, with Neo-Hookean and with
# linear bodies, in adaptive steps (curve to 1e-3) and in 1000: seconds of the whole process less those of `debond --version`
# (which loads the same libraries and does nothing), Newton iterations, seconds
# per phase, peak memory. No field output. Usage: benchmark.sh DEBOND SCENE
set -euo pipefail
export LC_ALL=C
debond=$1
scene=$2
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT

seconds_of() { # wall seconds of a command
  local start end
  start=$(date +%s.%N)
  "$@" > "$directory/log"
  end=$(date +%s.%N)
  awk -v a="$start" -v b="$end" 'BEGIN { printf "%.3f", b - a }'
}

value_of() { # a number from summary.json
  awk -F'[:,]' -v key="\"$1\"" '$1 ~ key { print $2 + 0 }' "$directory/run/summary.json"
}

seconds_of "$debond" --version > "$directory/first" # brings the libraries into the cache
empty=$(seconds_of "$debond" --version)
echo "An empty program takes $empty s; this is taken off the seconds below."
printf '%-8s %-8s %-12s %8s %7s | %7s %8s %9s %8s %8s | %8s\n' \
  steps mesh bodies seconds Newton bulk condens. contact dense output 'peak MB'
for run in adaptive:linear adaptive:neo-hookean 1000:linear 1000:neo-hookean; do
  IFS=: read -r steps material <<< "$run"
  stepping=(--set "Load steps/Steps=1, 1000")
  if [[ $steps == adaptive ]]; then
    stepping=(--set "Load steps/Steps=1, 10" --set "Load steps/Adaptive=true")
  fi
  for mesh in coarse:15:3 medium:30:6 fine:60:12; do
    IFS=: read -r name bone implant <<< "$mesh"
    seconds=$(seconds_of "$debond" "$scene" --set "Output/Directory=$directory/run" --force \
      --set "Output/Fields every=0" --set "Output/Console=quiet" \
      --set "Bone/Cells=$bone, $bone, 2" --set "Implant/Cells=$implant, 2" \
      --set "Bone/Material=$material" --set "Implant/Material=$material" "${stepping[@]}")
    printf '%-8s %-8s %-12s %8.2f %7d | %7.2f %8.2f %9.2f %8.2f %8.2f | %8.0f\n' \
      "$steps" "$name" "$material" "$(awk "BEGIN { print $seconds - $empty }")" \
      "$(value_of newton_iterations)" "$(value_of seconds_bulk)" \
      "$(value_of seconds_condensation)" "$(value_of seconds_contact)" \
      "$(value_of seconds_dense_solve)" "$(value_of seconds_output)" \
      "$(value_of peak_memory_MB)"
  done
done
