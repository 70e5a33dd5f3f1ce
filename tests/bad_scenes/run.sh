#!/bin/sh
# Runs the bad scenes of a group as a user would and compares what the program says with what it must say.
#   run.sh PROGRAM GROUP.scenes DIRECTORY
# split.awk says what is in a group. A scene is run with the program; in a script `debond` is the program. Either is run in
# a directory of its own, DIRECTORY/NAME, which holds the scene and the folder files. What was written to the error stream,
# the exit code and the names of all files that were left behind must be those in the group. All are run; the names of those
# that fail are printed with the difference.
set -u
program=$1 group=$2 directory=$3
here=$(cd "$(dirname "$0")" && pwd)

debond() {
  "$program" "$@" > /dev/null 2>> errors
  echo "exit code $?" >> errors
}

chmod -R u+rwx "$directory" 2> /dev/null
rm -rf "$directory" && mkdir -p "$directory/scenes" || exit 1
LC_ALL=C awk -v directory="$directory/scenes" -f "$here/split.awk" "$group" || exit 1
scenes=0 failed=0
for expected in "$directory"/scenes/*.expected; do
  name=$(basename "$expected" .expected)
  mkdir "$directory/$name" && cd "$directory/$name" || exit 1
  ln -s "$here/files" files
  : > errors
  if [ -e "../scenes/$name.sh" ]; then
    (. "../scenes/$name.sh")
  else
    cp "../scenes/$name.prm" .
    "$program" "$name.prm" > /dev/null 2> errors
    { echo "exit code $?" && cat errors; } > said && mv said errors
  fi
  {
    # what a machine has is its own
    sed -E 's/ and [0-9.]+ [MG]B are available/ and N GB are available/' errors
    find . -type f ! -name errors ! -name "$name.prm" ! -path "./input*" | LC_ALL=C sort | sed 's/^/left behind: /'
  } > "$directory/$name.said"
  scenes=$((scenes + 1))
  if ! diff "$expected" "$directory/$name.said" > "$directory/$name.diff"; then
    failed=$((failed + 1))
    echo "$name:"
    cat "$directory/$name.diff"
  fi
done
echo "$failed of $scenes failed"
[ $failed -eq 0 ]
