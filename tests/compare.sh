#!/bin/sh
# Runs a test and compares what it prints, errors included, with what it must print. As in the tests of deal.II, numbers
# may differ by 1e-6 or by 1e-8 of the larger one. Without a file EXPECTED each line must say that something is so: end
# in `: yes'.
#   compare.sh EXPECTED DIRECTORY COMMAND...
# COMMAND is run in DIRECTORY, which is emptied first; the output stays there.
expected=$1 directory=$2
shift 2
rm -rf "$directory" && mkdir -p "$directory" && cd "$directory" || exit 1
"$@" > output 2>&1
code=$?
if [ $code -ne 0 ]; then
  cat output
  echo "exit code $code"
  exit 1
fi
if [ ! -e "$expected" ]; then
  ! grep -v ': yes$' output && [ -s output ]
  exit
fi
numdiff -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' "$expected" output > diff && exit
head -n 60 diff
exit 1
