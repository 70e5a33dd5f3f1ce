#!/bin/sh
# Runs the bad scenes of a group as a user would and compares what the program says with what it must say.
#   run.sh PROGRAM GROUP.scenes DIRECTORY [PYTHON...]
# split.awk says what is in a group. A scene is run with the program; in a script `debond` is the program. Either is run in
# a directory of its own, DIRECTORY/NAME, which holds the scene and the folder files. What was written to the error stream,
# the exit code and the names of all files that were left behind must be those in the group. All are run; the names of those
# that fail are printed with the difference.
# With PYTHON, a command that finds the module of Python, scenes that are refused when they are read are read by library.py
# instead of the program; the first scene of the group, and all that is not refused so, is left to the program.
set -u
program=$1 group=$2 directory=$3
shift 3
here=$(cd "$(dirname "$0")" && pwd)

# say FILE WORDS...: runs the program with these words, what it writes to the error stream behind FILE; returns the exit code
say() {
  file=$1
  shift
  if [ -n "$library" ]; then
    printf '%s\0' "$PWD" "$@" > "$library/question"
    read -r code < "$library/answer"
    if [ "$code" != none ]; then
      cat "$library/message" >> "$file"
      return "$code"
    fi
  fi
  library=$pipes # from the second on
  "$program" "$@" > /dev/null 2>> "$file"
}

debond() {
  say errors "$@"
  echo "exit code $?" >> errors
}

chmod -R u+rwx "$directory" 2> /dev/null
rm -rf "$directory" && mkdir -p "$directory/scenes" "$directory/library" || exit 1
directory=$(cd "$directory" && pwd)
LC_ALL=C awk -v directory="$directory/scenes" -f "$here/split.awk" "$group" || exit 1
pipes='' library=''
if [ $# -gt 0 ]; then
  pipes=$directory/library
  mkfifo "$pipes/question" "$pipes/answer" || exit 1
  { "$@" "$here/library.py" "$pipes" || kill $$; } & # rather than wait for it for ever
fi
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
    say said "$name.prm"
    { echo "exit code $?" && cat said; } > errors && rm said
  fi
  {
    # what a machine has is its own, and how its processor aligns what a point holds: one digit
    perl -pe 's/ and [0-9.]+ [MG]B are available/ and N GB are available/;
              s/(Quadrature points|needs some) ([0-9.e+-]+) GB/sprintf "%s %.1g GB", $1, $2/ge' errors
    find . -type f ! -name errors ! -name "$name.prm" ! -path "./input*" | LC_ALL=C sort | sed 's/^/left behind: /'
  } > "$directory/$name.said"
  scenes=$((scenes + 1))
  if ! diff "$expected" "$directory/$name.said" > "$directory/$name.diff"; then
    failed=$((failed + 1))
    echo "$name:"
    cat "$directory/$name.diff"
  fi
done
[ -z "$pipes" ] || : > "$pipes/question" # that was all
wait
echo "$failed of $scenes failed"
[ $failed -eq 0 ]
