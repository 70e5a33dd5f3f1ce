# Picture of a calibration, DIR/fit.png: what has been measured, the fit with its 95 % band, and below it the residuals, of
# all experiments that have been done. doc/pictures.sh calibration uses it.
#
#   gnuplot -e "dir='output/calibrate/data_set_1'" doc/plot_calibration.gp
#
# One of several experiments: files='fit-2.csv'. Another curve than the torque: curve='chuck_Fz_N', label='Axial force [N]'.
# A curve that was not measured: source='Eq. (18)'.

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/calibrate/data_set_1'\" doc/plot_calibration.gp"
  exit status 1
}
if (!exists("curve")) { curve = "torque_Nmm" }
if (!exists("label")) { label = "Torque {/:Italic T} [N mm]" }
if (!exists("files")) { files = system("cd '" . dir . "' && grep -l '" . curve . "_measured' fit*.csv") }
data(i) = dir . "/" . word(files, i)
if (!exists("source")) { source = "measured" }
measured = curve . "_measured"
fitted = curve . "_fitted"
array points_of = ["#c03028", "#2e8b3d", "#8a5fbf", "#b07a00"]
array lines_of = ["#08519c", "#0b5d1e", "#4a2a80", "#6b4a00"]
colour(i) = (i - 1) % 4 + 1
name(i) = words(files) > 1 ? sprintf(" %d", i) : ""

set terminal pngcairo size 1200, 900 enhanced font "Sans,16" linewidth 1.5
set output dir . "/fit.png"
set encoding utf8
set datafile separator comma
set datafile columnheaders
set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set lmargin 11
set xrange [*:*] noextend
over = system("head -1 '" . data(1) . "' | cut -d, -f1")

set multiplot
set origin 0, 0.33
set size 1, 0.67
set bmargin 0.5
set format x ""
set key top right
set offsets graph 0, graph 0, graph 0.05, graph 0
least = 0
most = 0
do for [i = 1:words(files)] {
  stats data(i) using (column(measured)) nooutput
  least = least < STATS_min ? least : STATS_min
  most = most > STATS_max ? most : STATS_max
}
if (least > -0.02 * most) { set yrange [0:*] }
set ylabel label
set title system("sed -n 's/^ *set Title *= *//p' " . dir . "/parameters.prm") noenhanced
plot for [i = 1:words(files)] data(i) using over:(column(curve . "_lower_95")):(column(curve . "_upper_95")) \
       with filledcurves linecolor rgb "#9ecae1" title i == 1 ? "95 % band of the fit" : "", \
     for [i = 1:words(files)] data(i) using over:(column(fitted)) with lines linecolor rgb lines_of[colour(i)] title "fit" . name(i), \
     for [i = 1:words(files)] data(i) using over:(column(measured)) \
       with points pointtype 6 pointsize 0.7 linecolor rgb points_of[colour(i)] title source . name(i)

unset title
set yrange [*:*]
set origin 0, 0
set size 1, 0.33
set tmargin 0.5
set bmargin 3.5
set format x "%g"
set xlabel over eq "angle_deg" ? "Rotation angle {/:Italic θ} [°]" : over
set ylabel source . " - fit"
set ytics font ",12"
set xzeroaxis linetype 1 linecolor rgb "#08519c"
plot for [i = 1:words(files)] data(i) using over:(column(measured) - column(fitted)) \
       with points pointtype 6 pointsize 0.7 linecolor rgb points_of[colour(i)] notitle
unset multiplot
