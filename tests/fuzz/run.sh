#!/usr/bin/env bash
# Fuzzes each reader for some seconds, starting from the seeds, and fails on a finding, whose input is then in
# build/fuzz/findings: it is to become a bad scene or a seed. What was learnt stays in build/fuzz/corpus.
#   cmake --preset fuzz && cmake --build --preset fuzz && tests/fuzz/run.sh SECONDS [READER...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=${1:?usage: run.sh SECONDS [READER...]}
shift
readers=("$@")
if ((${#readers[@]} == 0)); then readers=(scene csv image expression); fi

here=$PWD/tests/fuzz work=$PWD/build/fuzz files=$PWD/tests/bad_scenes/files
mkdir -p "$work/findings"
export ASAN_OPTIONS=detect_leaks=0 # libFuzzer looks for leaks itself
seeds_of() {
  case $1 in
    scene)
      mkdir -p "$work/bad_scenes"
      LC_ALL=C awk -v directory="$work/bad_scenes" -f tests/bad_scenes/split.awk tests/bad_scenes/*.scenes
      ls prm/*.prm "$files"/*.prm "$work"/bad_scenes/*.prm
      ;;
    csv) ls "$files"/*.csv "$here"/seeds/csv/* ;;
    image) ls "$files"/*.png "$here"/seeds/image/* ;;
    expression) ls "$here"/seeds/expression/* ;;
  esac
}

failed=0
for reader in "${readers[@]}"; do
  corpus=$work/corpus/$reader
  mkdir -p "$corpus"
  seeds_of "$reader" | xargs -d '\n' cp -t "$corpus"
  options=(-max_total_time="$seconds" -timeout=60 -max_len=8192 -rss_limit_mb=4096 -print_final_stats=1
           -artifact_prefix="$work/findings/$reader-")
  if [[ -e $here/$reader.dict ]]; then
    cat "$here/$reader.dict" > "$work/$reader.dict"
    # entries, choices and values
    if [[ $reader == scene ]]; then
      { grep -oE '`[^`"\\]+`' doc/reference/parameters.md | tr '`' '"'; sed -nE 's|^### (.* / )?(.*)|"\2"|p' doc/reference/parameters.md; } |
        sort -u >> "$work/$reader.dict"
    fi
    options+=(-dict="$work/$reader.dict")
  fi
  echo "== $reader"
  (cd "$work" && "tests/fuzz/fuzz_$reader" "${options[@]}" "$corpus") > "$work/$reader.log" 2>&1 || {
    failed=1
    echo "a finding:"
    tail -60 "$work/$reader.log"
  }
  grep -E '^(Done|stat::number_of_executed_units|stat::peak_rss)|cov:' "$work/$reader.log" | tail -4 || true
done
exit $failed
