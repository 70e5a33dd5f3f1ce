#!/bin/sh
# What is read and written does not depend on the locale: the same scenes in the locale C and in that of Germany, with
# a decimal comma and points between thousands, must make the same files to the last byte. By the library, by Python,
# and by the program, whose programs for pictures see the locale in the environment.
#   locale.sh IN_LOCALE DEBOND DIRECTORY [PYTHON...]
# PYTHON runs scripts with the module; without it that part is left out.
set -eu
export LC_ALL=C
in_locale=$1 debond=$2 directory=$3
shift 3
here=$(cd "$(dirname "$0")" && pwd)
german=de_DE.UTF-8
rm -rf "$directory" && mkdir -p "$directory/input" "$directory/C" "$directory/$german" && cd "$directory"
localedef -i de_DE -f UTF-8 "$directory/$german.locale" || [ -e "$german.locale/LC_NUMERIC" ]
mkdir locales && mv "$german.locale" "locales/$german"
export LOCPATH="$directory/locales"

# Inputs: a picture, voxels, and tables of this program and of an instrument that writes commas.
cp "$here"/input/*.prm "$here"/input/picture.png input
printf 'ObjectType = Image\nNDims = 3\nDimSize = 25 25 10\nElementSpacing = 0.5 0.5 0.5\nElementType = MET_UCHAR\n' > input/voxels.mhd
echo 'ElementDataFile = voxels.raw' >> input/voxels.mhd
awk 'BEGIN { for (i = 0; i < 6250; ++i) printf "%c", 33 + (i * 7) % 90 }' > input/voxels.raw
printf 'slip_mm,phi\n0,1\n0.02,0.98\n0.05,0.85\n0.1,0.25\n0.25,0\n' > input/law.csv
printf 'time,rz_deg\n0,0\n1,0\n1.25,0.125\n1.5,0.5\n2,1.25\n' > input/turns.csv
awk 'BEGIN {
  print "Time;Angle;Torque"; print "s;deg;N m"
  for (i = 0; i <= 50; ++i) {
    line = sprintf("%d;%.2f;%.5f", i, i * 0.05, 0.03 * (1 - exp(-i / 8)) * (1 - 0.2 * i / 50))
    gsub(/\./, ",", line); print line
  }
}' > input/measured.csv

# Without what tells of the run and not of the result: when, for how long, by which command, in how much memory. Of
# checkpoints, which hold seconds, the lines at their beginning.
plain() {
  find "$1" -type f ! -name 'checkpoint-*' ! -name study.csv -exec sed -i -E '/Written by|run time|<td>date<|seconds?,|<td>[a-zA-Z_]*(second|memory)/d
    s/"[a-z_]*(second|memory)[A-Za-z_]*": [^,}]*//g; s/"(date|command|host)": "[^"]*"//g; s/, [0-9.e-]+ s$//; /^[0-9.]+ (s|min), /d' {} +
  find "$1" -type f -name 'checkpoint-*' -exec sed -i -nE '/^(format|program|step|parameters|state) [0-9.]*$/p' {} +
  [ ! -d "$1/program/ensemble" ] || (cd "$1/program/ensemble"
   sed -i -E 's/<td class="short">[0-9.e-]+<\/td><\/tr>$//' report.html # seconds of each variant
   awk -F, -v OFS=, '{ gsub(/"[^"]*"/, "") }
     NR == 1 { for (i = 1; i <= NF; ++i) of_run[i] = $i ~ /seconds|memory/ }
     { for (i = 1; i <= NF; ++i) if (of_run[i]) $i = ""; print }' study.csv > plain_study.csv
   rm study.csv)
}

for locale in C $german; do
  mkdir "$locale/library" "$locale/python" "$locale/program"
  for part in library python program; do ln -s ../../input "$locale/$part/input"; done
  (cd "$locale/library"
   "$in_locale" $locale input/everything.prm input/expression.prm input/pattern.prm input/closed.prm > ../number)
  if [ $# -gt 0 ]; then
    (cd "$locale/python" && "$@" "$here/in_locale.py" $locale input/rigid.prm > result 2> ../point)
  fi
  (cd "$locale/program"
   export LC_ALL=$locale
   "$debond" input/expression.prm --force > console
   "$debond" --check input/everything.prm > check
   if [ $# -gt 0 ]; then
     "$debond" input/fit.prm --force > fit-console
     "$debond" --check input/ensemble.prm > ensemble-check
     "$debond" input/ensemble.prm --force --jobs 1 > ensemble-console # variants in order
     "$debond" --compare ensemble input/measured.csv > compared
   fi)
done

# The locale is one that would change numbers.
[ "$(cat C/number)" = 1234.5 ] && [ "$(cat $german/number)" = 1.234,5 ]
[ $# -eq 0 ] || { [ "$(cat C/point)" = . ] && [ "$(cat $german/point)" = , ]; }
rm -f ./*/number ./*/point
plain C
plain $german
diff -r C $german && find C -type f | LC_ALL=C sort
