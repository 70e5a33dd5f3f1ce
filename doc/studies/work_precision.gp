# Error against seconds, for doc/studies/work_precision.sh, which makes the tables. Variables codes:
# CSV file or "", methods: list of what is in it, CODE/METHOD.
load "doc/paper/style.gp"
dir = "output/studies/"
table = dir . "work_precision.csv"
tiers = "mathieu analytical foundation rigid linear neo-hookean"
meshes = "none coarse lean medium fine very_fine"
colour(tier) = tier eq "mathieu" ? 0x7f7f7f : tier eq "analytical" ? 0xb8860b : tier eq "foundation" ? 0x2ca02c : \
  tier eq "rigid" ? 0x9467bd : tier eq "linear" ? 0x1f77b4 : 0xd62728
array symbol[6] = [3, 9, 15, 7, 5, 13]
spaced(word) = word eq "very_fine" ? "very fine" : word
is(tier, mesh) = strcol("tier") eq tier && strcol("mesh") eq spaced(mesh)
best(x) = x > 0 ? x : NaN

set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set mxtics 10
set mytics 10
set grid xtics ytics
set xlabel "Wall seconds of the run"
set tics nomirror

# ---- the torque curve
set terminal pngcairo size 1700,1000 enhanced font "Sans,17" linewidth 1.5
set output dir . "work_precision.png"
set rmargin 58
set key at graph 1.03, 1.0 left top Left reverse samplen 1.5 spacing 1.1
set ylabel "Largest error of the torque curve / {/:Italic T}_{max}"
set xrange [5e-3:500]
set yrange [3e-5:1]
front = dir . "front_torque.csv"
load dir . "front_labels.gp"
# what the reference is known to
floor = 5.5e-5
set arrow 1 from graph 0, first floor to graph 1, first floor nohead dashtype 2 linecolor rgb "#888888"
set label 2 "error of the reference" at graph 0.01, first floor * 1.15 font "Sans,13" textcolor rgb "#666666"
plot for [tier in tiers] for [m=1:6] table using (is(tier, word(meshes, m)) ? column("seconds") : NaN):"error_torque" \
    with points pointtype symbol[m] pointsize 1.5 linecolor rgb (colour(tier) + 0x60000000) notitle, \
  front using "seconds":"error_torque" with steps linewidth 1.5 linecolor rgb "#000000" title "best in its time", \
  front using "seconds":"error_torque":(sprintf("%d", $0 + 1)) with labels offset -0.6, -0.7 right font "Sans,15" notitle, \
  for [tier in tiers] NaN with points pointtype 7 pointsize 1.6 linecolor rgb colour(tier) title tier, \
  for [m=1:6] NaN with points pointtype symbol[m] pointsize 1.6 linecolor rgb "#444444" title (m == 1 ? "closed form" : spaced(word(meshes, m)) . " mesh")
unset label
unset arrow

# ---- local values
set output dir . "work_precision_local.png"
set terminal pngcairo size 1700,800 enhanced font "Sans,17" linewidth 1.5
set multiplot layout 1, 2
set rmargin 2
set yrange [1e-5:3]
array what[2] = ["pressure", "slip"]
array name[2] = ["local pressure", "local sliding distance {/:Italic g}_s"]
do for [i=1:2] {
  set ylabel "RMS error of the " . name[i] . " / its mean"
  if (i == 2) { unset key } else { set key inside top right Left reverse samplen 1 spacing 1.05 maxrows 6 font "Sans,15" }
  error = "error_" . what[i]
  plot for [tier in tiers] for [m=1:6] table using (is(tier, word(meshes, m)) ? column("seconds") : NaN):(best(column(error))) \
      with points pointtype symbol[m] pointsize 1.3 linecolor rgb (colour(tier) + 0x60000000) notitle, \
    dir . "front_" . what[i] . ".csv" using "seconds":error with steps linewidth 1.5 linecolor rgb "#000000" title "best in its time", \
    for [tier in tiers] NaN with points pointtype 7 pointsize 1.5 linecolor rgb colour(tier) title tier, \
    for [m=2:6] NaN with points pointtype symbol[m] pointsize 1.5 linecolor rgb "#444444" title spaced(word(meshes, m)) . " mesh"
}
unset multiplot

# ---- constant friction, other codes
set output dir . "work_precision_codes.png"
set terminal pngcairo size 1300,900 enhanced font "Sans,17" linewidth 1.5
set rmargin 2
set key top right Left reverse samplen 1.5
set ylabel "Largest error of the torque at 0.05, 0.1, ... 1° / {/:Italic T}_{max}"
set xrange [0.02:1000]
set yrange [1e-4:1]
ours = dir . "work_precision_coulomb.csv"
front = dir . "front_coulomb.csv"
set datafile missing "nan"
surfaces = "nurbs bilinear"
array surface_colour[2] = [0x1f77b4, 0x17becf]
# gnuplot cannot plot a file that is not there: this table stands in for it
others = codes eq "" ? ours : codes
# "CalculiX/C3D8" of methods and its rows: code "CalculiX", label "C3D8 30 x 30 x 4 / 12 x 12 x 4", which ends with the cells
code(m) = m[1:strstrt(m, "/") - 1]
method(m) = m[strstrt(m, "/") + 1:]
of(m) = codes eq "" ? 0 : strcol("code") eq code(m) && word(strcol("label"), 1) eq method(m)
# bone over implant
cells(label) = label[strlen(word(label, 1)) + 2:strstrt(label, " / ") + 1] . "\n" . label[strstrt(label, " / ") + 3:]
code_colour(m) = code(m) eq "CalculiX" ? 0xd62728 : 0xff7f0e
array open_symbol[6] = [4, 6, 8, 10, 12, 14]
# cells of the first method are written above, of others below, since points of C3D8 and C3D8-round lie close
above(k) = k == 1 ? 0.9 : -0.1
plot for [s=1:2] for [m=2:6] ours using (strcol("surface") eq word(surfaces, s) && is("linear", word(meshes, m)) ? column("seconds") : NaN):"error_torque" \
    with points pointtype symbol[m] pointsize 1.5 linecolor rgb (surface_colour[s] + 0x40000000) notitle, \
  front using "seconds":"error_torque" with steps linewidth 1.5 linecolor rgb "#000000" title "debond, best in its time", \
  for [s=1:2] NaN with points pointtype 7 pointsize 1.6 linecolor rgb surface_colour[s] title "debond, " . (s == 1 ? "NURBS" : "bilinear") . " surfaces", \
  for [m=2:5] NaN with points pointtype symbol[m] pointsize 1.6 linecolor rgb "#444444" title spaced(word(meshes, m)) . " mesh", \
  for [k=1:words(methods)] others using (of(word(methods, k)) ? column("seconds") : NaN):"error_torque" \
    with points pointtype open_symbol[k] pointsize 2 linewidth 1.5 linecolor rgb code_colour(word(methods, k)) \
    title code(word(methods, k)) . " " . method(word(methods, k)), \
  for [k=1:words(methods)] others using (of(word(methods, k)) ? column("seconds") : NaN):"error_torque":(codes eq "" ? "" : cells(strcol("label"))) \
    with labels offset 1, above(k) left font "Sans,11" textcolor rgb code_colour(word(methods, k)) noenhanced notitle
