#!/bin/sh
# Runs one bad scene as a user would and compares what the program says with what it must say.
#   run.sh PROGRAM NAME DIRECTORY
# NAME.prm is run with the program; what is no plain scene is a script NAME.sh, in which `debond` is the program. Either
# is run in an empty DIRECTORY that holds NAME.prm and the folder files. What was written to the error stream, the exit
# code and the names of all files that were left behind must be those in NAME.output.
set -u
program=$1 name=$2 directory=$3
here=$(cd "$(dirname "$0")" && pwd)

debond() {
  "$program" "$@" > /dev/null 2>> errors
  echo "exit code $?" >> errors
}

chmod -R u+rwx "$directory" 2> /dev/null
rm -rf "$directory" && mkdir -p "$directory" && cd "$directory" || exit 1
ln -s "$here/files" files
: > errors
if [ -e "$here/$name.sh" ]; then
  . "$here/$name.sh"
else
  cp "$here/$name.prm" .
  touch before
  debond "$name.prm"
fi
{
  # what a machine has is its own
  sed -E 's/ and [0-9.]+ [MG]B are available/ and N GB are available/' errors
  find . -type f ! -name errors ! -name before ! -name "$name.prm" ! -path "./input*" | LC_ALL=C sort |
    sed 's/^/left behind: /'
} > "$directory.said"
diff "$here/$name.output" "$directory.said"
