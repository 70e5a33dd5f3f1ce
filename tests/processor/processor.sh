#!/bin/bash
# processor.sh QEMU PROGRAM SCENE: runs the scene on an emulated processor without any extension, and prints the result, or
# what the program says of that processor, without the names of what is missing.
qemu=$1 program=$2 scene=$3
cd "$(dirname "$scene")/.." || exit 1
"$qemu" -cpu kvm64 "$program" "$scene" --threads 1 --set "Output/Directory=$OLDPWD/results" \
  --set "Output/Fields every=none" --set "Output/Report=false" 2>&1 > "$OLDPWD/log" | sed 's/with .*, which/with ..., which/'
echo "exit code ${PIPESTATUS[0]}"
grep -o "Largest torque 53" "$OLDPWD/log" || [ ! -s "$OLDPWD/log" ]
