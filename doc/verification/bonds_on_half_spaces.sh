#!/usr/bin/env bash
# Runs the studies of bonds on half spaces in prm/verification and draws output/bonds_on_half_spaces.png. Takes a minute; what is
# there already is not run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
for study in kendall bonded_disk_torsion; do
  "$debond" "prm/verification/$study.prm"
done
gnuplot doc/verification/bonds_on_half_spaces.gp
echo "Picture: output/bonds_on_half_spaces.png"
