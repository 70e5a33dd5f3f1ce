#!/usr/bin/env bash
# Makes tables and figures of the paper again: doc/paper/reproduce.sh [--jobs N] [--force] NAME...
#   NAME: calibrated closed_form_b contradictions table_1 table_3 table_4_set_1 table_4_set_2 table_5 table_7 table_7_meshes table_7_steps table_7_layers
#         table_7_layers_printed fig_1 fig_3_12 fig_4 fig_5_6 fig_7_8 fig_9 fig_10 fig_13
#         partial_equal_parameters partial_fitted_parameters all
# Results go to output/paper. Variants of studies that are there already are not run again. Pictures need gnuplot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
[[ -x $debond ]] || { echo "reproduce.sh: there is no $debond: build the program first, or set DEBOND" >&2; exit 1; }

options=()
run() { "$debond" "prm/paper/$1.prm" "${options[@]}" "${@:2}"; }
picture() { gnuplot "doc/paper/$1.gp" && echo "Picture: output/paper/$2"; }

reproduce() {
  case $1 in
    closed_form_b) python3 doc/paper/closed_form_b.py --print-only ;;
    table_1) for cells in "15, 15, 2|3, 2" "30, 30, 2|6, 2" "60, 60, 2|12, 2"; do
        "$debond" --check prm/paper/main_scene.prm --set "Bone/Cells=${cells%|*}" --set "Implant/Cells=${cells#*|}"
      done ;;
    fig_1) run fig_1; picture fig_1 fig_1/fig_1.png ;;
    fig_3_12) run fig_3_12; picture fig_3_12 fig_3_12/fig_3_12.png ;;
    fig_4) run table_5; picture fig_4 table_5/fig_4.png ;;
    fig_5_6) run fig_5_6; picture fig_5_6 "fig_5_6/fig_5.png and fig_6.png" ;;
    fig_7_8) # a point every 0.04 mm, for smooth maps
      run partial_fitted_parameters --set "Expert/Interface/Quadrature points=6" --set Output/Directory=output/paper/fig_7_8
      picture fig_7_8 "fig_7_8/fig_7.png, fig_8.png and fig_8_slip.png"
      ;;
    fig_9) run partial_fitted_parameters; picture fig_9 partial_fitted_parameters/fig_9.png ;;
    fig_10) run partial_equal_parameters; picture fig_10 partial_equal_parameters/fig_10.png ;;
    fig_13) run table_7; picture fig_13 table_7/fig_13.png ;;
    all)
      local name
      for name in table_1 calibrated contradictions table_3 table_4_set_1 table_4_set_2 fig_4 fig_1 fig_3_12 fig_5_6 fig_7_8 fig_9 fig_10 \
        table_7_meshes table_7_steps table_7_layers table_7_layers_printed fig_13 closed_form_b; do
        reproduce "$name"
      done
      ;;
    *)
      if [[ ! -f prm/paper/$1.prm ]]; then
        echo "reproduce.sh: unknown name '$1'; the names stand at the top of this script" >&2
        exit 1
      fi
      run "$1"
      ;;
  esac
}

while [[ "${1:-}" == --* ]]; do
  options+=("$1")
  if [[ $1 == --jobs ]]; then options+=("${2:-}"); shift; fi
  shift
done
if (($# == 0)); then sed -n '2,6s/^# //p' "$0"; exit 1; fi
for name in "$@"; do reproduce "$name"; done
