#!/usr/bin/env bash
# Runs prm/verification/cap_pulled_off.prm and draws output/cap_pulled_off_force.png. Takes some minutes; what is there already is
# not run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
"${DEBOND:-build/release/debond}" prm/verification/cap_pulled_off.prm
gnuplot doc/verification/cap_pulled_off.gp
echo "Picture: output/cap_pulled_off_force.png"
