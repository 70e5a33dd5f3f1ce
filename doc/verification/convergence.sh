#!/usr/bin/env bash
# Runs the refinement studies of prm/verification and draws output/convergence.png. Takes some minutes; what is there
# already is not run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debond=${DEBOND:-build/release/debond}
for study in reissner_sagoci torsional_partial_slip hertz lubkin; do
  "$debond" "prm/verification/${study}_refinement.prm"
done
gnuplot doc/verification/convergence.gp
echo "Picture: output/convergence.png"
