# Pictures of a calibration, DIR/fit.png: what has been measured, the fit with its 95 % band, and below it the residuals.
#
#   gnuplot -e "dir='output/calibrate/data_set_1'" doc/plot_calibration.gp
#
# Of several experiments the first; another one: file='fit-2.csv'. Another curve than the torque: curve='chuck_Fz_N',
# label='Axial force [N]'.

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/calibrate/data_set_1'\" doc/plot_calibration.gp"
  exit status 1
}
if (!exists("file")) { file = (system("test -s '" . dir . "/fit.csv' && echo yes") eq "yes" ? "fit.csv" : "fit-1.csv") }
if (!exists("curve")) { curve = "torque_Nmm" }
if (!exists("label")) { label = "Torque {/:Italic T} [N mm]" }
data = dir . "/" . file

set terminal pngcairo size 1200, 900 enhanced font "Sans,16" linewidth 1.5
set output dir . "/fit.png"
set encoding utf8
set datafile separator comma
set datafile columnheaders
set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set lmargin 11
set xrange [*:*] noextend
over = system("head -1 '" . data . "' | cut -d, -f1")

set multiplot
set origin 0, 0.33
set size 1, 0.67
set bmargin 0.5
set format x ""
set key top right
set offsets graph 0, graph 0, graph 0.05, graph 0
stats data using (column(curve . "_measured")) nooutput
if (STATS_min > -0.02 * STATS_max) { set yrange [0:*] }
set ylabel label
set title system("sed -n 's/^ *set Title *= *//p' " . dir . "/parameters.prm") noenhanced
plot data using over:(column(curve . "_lower_95")):(column(curve . "_upper_95")) \
       with filledcurves linecolor rgb "#9ecae1" title "95 % band of the fit", \
     data using over:(column(curve . "_fitted")) with lines linecolor rgb "#08519c" title "fit", \
     data using over:(column(curve . "_measured")) with points pointtype 6 pointsize 0.7 linecolor rgb "#c03028" title "measured"

unset title
set yrange [*:*]
set origin 0, 0
set size 1, 0.33
set tmargin 0.5
set bmargin 3.5
set format x "%g"
set xlabel over eq "angle_deg" ? "Rotation angle {/:Italic θ} [°]" : over
set ylabel "measured - fit"
set xzeroaxis linetype 1 linecolor rgb "#08519c"
plot data using over:(column(curve . "_measured") - column(curve . "_fitted")) \
       with points pointtype 6 pointsize 0.7 linecolor rgb "#c03028" notitle
unset multiplot
