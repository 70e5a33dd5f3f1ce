#!/usr/bin/env bash
# Builds and installs program, library, scenes and Python package for conda; see meta.yaml.
set -euo pipefail
cmake ${CMAKE_ARGS:-} -S . -B build/conda -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" \
  -DDEBOND_NATIVE=OFF -DPython_EXECUTABLE="$PYTHON" -DNUMDIFF_EXECUTABLE=/bin/true
cmake --build build/conda --parallel "${CPU_COUNT:-2}" --target debond debond_library debond_python
cmake --install build/conda

# the install rules put Python's files where Debian has them
mkdir -p "$SP_DIR"
mv "$PREFIX"/lib/python3/dist-packages/* "$SP_DIR"
rmdir "$PREFIX"/lib/python3/dist-packages "$PREFIX"/lib/python3
