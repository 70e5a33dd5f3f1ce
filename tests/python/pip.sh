#!/usr/bin/env bash
# What doc/howto/python.md says of pip, in a copy of the project: a virtual environment, the module compiled by pip, one curve.
# Usage: pip.sh PYTHON PROJECT SCRATCH
set -euo pipefail
python=$1 project=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
cp -r "$project"/{CMakeLists.txt,CITATION.cff,CHANGELOG.md,LICENSE,README.md,pyproject.toml,setup.py} .
cp -r "$project"/{cmake,doc,include,prm,python,source,tests} .
"$python" -m venv --system-site-packages venv
venv/bin/pip install --no-build-isolation . > pip.log 2>&1 || { tail -n 30 pip.log; exit 1; }
"$scratch/venv/bin/python" - "$scratch" <<'END'
import sys
import debond
assert debond.__file__.startswith(sys.argv[1]), debond.__file__
peak = debond.Scene("prm/coin_mode3_fast.prm").run().rows["torque_Nmm"].max()
assert 45 < peak < 55, peak
print("the module that pip has compiled, version", debond.__version__, "works")
END
