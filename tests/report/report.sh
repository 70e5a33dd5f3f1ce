#!/bin/bash
# report.sh DEBOND: the pages that runs, studies and calibrations leave. Prints what must be so.
set -u
debond=$1
cp "$(dirname "$0")/scene.prm" .
# the words of a page, without the pictures
words() { sed 's/src="data[^"]*"//g' "$1/report.html"; }
# "a run: 1 curve, 12 maps, nothing from elsewhere"
pictures() {
  echo "$1: $(grep -c 'class="curve"><img' "$1/report.html") curves, $(grep -c '<figure>' "$1/report.html") maps," \
    "$(words "$1" | grep -c -i -e 'http' -e '<script' -e '<link') from elsewhere," \
    "$(($(stat -c %s "$1/report.html") < 3000000)) below 3 MB"
}

"$debond" scene.prm
pictures run
words run | grep -o -e "largest load (within 0.1 %)</fig" | sort -u
words run | grep -o -e "<h1>.*</h1>" -e "The torque is largest" -e "Load steps / Steps" -e "half of the bond is broken" -e "command" | sort -u
# numbers of the page, and the same of the summary
words run | sed 's/<[^>]*>/ /g' | grep -o -E -e "largest, +[0-9.]+ N mm" -e "stiffness is +[0-9.]+ N mm/rad" -e "(chuck|bodies at the end|interface at the end|dissipated) +[0-9.]+ N mm"
grep -E -e '"(T_max|initial_stiffness|work|E_bulk|E_interface|dissipation)_Nmm' run/summary.json
head -c 5 run/torque.svg
echo " $(head -c 4 run/torque.png | tail -c 3)"
grep -c '"command"' run/summary.json
head -n 1 run/parameters.prm | grep -o "^# Written by debond"
# made anew it is the same page
cp run/report.html before.html
"$debond" --report run && cmp before.html run/report.html && echo "the same page"

echo "a run that fails, and one without a report"
"$debond" scene.prm --set "Interface/Sliding threshold=1e-6" --set Output/Directory=failed > /dev/null 2>&1
words failed | grep -o -e "not finished" | head -n 1
"$debond" scene.prm --set Output/Report=false --set Output/Directory=without
ls without | grep -c -e report -e maps

echo "without gnuplot"
mkdir -p path && for tool in sh env; do ln -sf "$(command -v $tool)" path/; done
PATH=$PWD/path "$debond" scene.prm --set Output/Directory=plain
words plain | grep -o "There are no pictures: gnuplot"

echo "a pull, a study, a calibration"
"$debond" scene.prm --set "Chuck/Rotation z/Value=0" --set "Chuck/Translation x/Value=0.05 * max(t - 1, 0)" --set Output/Directory=shear
pictures shear
"$debond" scene.prm --set "Interface/Sliding threshold={{0.02|1e-6|0.04}}" --set Output/Directory=study > /dev/null 2>&1
pictures study
words study | grep -o -e "<h1>.*</h1>" -e "2 of 3 variants are done" -e "variant 2, Sliding threshold = 1e-6"
"$debond" scene.prm --set Interface/Bonding/Pattern=random --set "Interface/Bonding/Bonded fraction={{0.4|0.7}}" \
  --set "Interface/Bonding/Seed={{1..3}}" --set Output/Directory=ensemble > /dev/null
# of both groups: implants, and the mean of T_max as the table of the ensemble has it
words ensemble | grep -o -e "<h2>Random patterns</h2>" -e "<tr><td>0.[47]</td><td>3</td><td>[^<]*" | sed 's/<[^>]*>/ /g'
cut -d , -f 1,2,4 ensemble/ensemble_summary.csv
# both are in the legend, and the axis begins at 0
grep -o -e "Bonded fraction = 0.[47]" -e ">-[0-9.]*<" ensemble/torque.svg | sort -u
# what is varied one at a time is named where it differs
"$debond" scene.prm --set Model=foundation --set "Interface/Sliding threshold={{0.02|0.03}}" \
  --set "Bone/Young modulus={{15000|16500}}" --set "Implant/Young modulus={{110000|120000}}" \
  --set "Study/Factors varied at once=1" --set Output/Directory=factors | grep -o "variant-00.: [^:]*:" | sort
words factors | grep -o -e "<th>changed</th>" -e "<td>.</td><td>[^<]*"
"$debond" scene.prm --set "Interface/Friction coefficient broken=<<mu_b: 0.3 in 0.1..1>>" --set Task=calibrate \
  --set "Interface/Sliding threshold=<<a_s: 0.03 in 0.01..0.1>>" --set "Calibration/Angle offset=0.001" \
  --set "Output/Reference curve=run/torque.csv" --set Output/Directory=calibration > /dev/null
pictures calibration
words calibration | grep -o -e "<h1>.*</h1>" -e "<td>mu_b</td>" -e "<td>mm</td>" -e "<td>Angle offset.*</td>"
grep "Title" calibration/fitted.prm

# made anew, pages still name the command that the results come from
for directory in study calibration; do
  "$debond" --report $directory
  words $directory | grep "<td>command</td>" | grep -o -e "Output/Directory=$directory" -e "--report"
done

echo "refused"
mkdir -p nothing
"$debond" --report nothing 2>&1
"$debond" --report run --force 2>&1
true
