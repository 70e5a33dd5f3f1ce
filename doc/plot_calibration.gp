# Picture of a calibration, DIR/fit.png: the points to be met, the fit with its 95 % band, and below it the residuals, of
# all experiments that have been done. doc/pictures.sh calibration uses it.
#
#   gnuplot -e "dir='output/calibrate/data_set_1'" doc/plot_calibration.gp
#
# One of several experiments: files='fit-2.csv'. Another curve than the torque: curve='chuck_Fz_N', label='Axial force [N]'.
# A curve that was not measured: source='Eq. (18)'. Another title: heading='Fit'.

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/calibrate/data_set_1'\" doc/plot_calibration.gp"
  exit status 1
}
if (!exists("curve")) { curve = "torque_Nmm" }
if (!exists("label")) { label = "Torque {/:Italic T} [N mm]" }
unit = label[strstrt(label, "["):]
if (!exists("files")) { files = system("cd '" . dir . "' && grep -l '" . curve . "_measured' fit*.csv") }
data(i) = dir . "/" . word(files, i)
if (!exists("source")) { source = "measured" }
measured = curve . "_measured"
fitted = curve . "_fitted"
array points_of = ["#333333", "#009e73", "#cc79a7", "#e69f00"]
array lines_of = ["#0072b2", "#00593f", "#8a3f6b", "#9a6a00"]
colour(i) = (i - 1) % 4 + 1
name(i) = words(files) > 1 ? sprintf(" %d", i) : ""

format = "png"
load "doc/style.gp"
eval picture(dir . "/fit", 1200, 900)
set lmargin 9
set xrange [*:*] noextend
over = system("head -1 '" . data(1) . "' | cut -d, -f1")

set multiplot
set origin 0, 0.33
set size 1, 0.67
set bmargin 0.5
set format x ""
set key top right Left reverse
set offsets graph 0, graph 0, graph 0.05, graph 0
least = 0
most = 0
do for [i = 1:words(files)] {
  stats data(i) using (column(measured)) nooutput
  least = least < STATS_min ? least : STATS_min
  most = most > STATS_max ? most : STATS_max
}
size_of_points = STATS_records > 150 ? 0.4 : 0.7
if (least > -0.02 * most) { set yrange [0:*] }
set ylabel label
if (!exists("heading")) { heading = system("sed -n 's/^ *set Title *= *//p' " . dir . "/parameters.prm") }
set title heading noenhanced
plot for [i = 1:words(files)] data(i) using over:(column(curve . "_lower_95")):(column(curve . "_upper_95")) \
       with filledcurves linecolor rgb "#9ecae1" fillstyle solid 1 title i == 1 ? "95 % band of the fit" : "", \
     for [i = 1:words(files)] data(i) using over:(column(measured)) \
       with points pointtype 6 pointsize (size_of_points * point) linecolor rgb points_of[colour(i)] title source . name(i), \
     for [i = 1:words(files)] data(i) using over:(column(fitted)) with lines linecolor rgb lines_of[colour(i)] title "fit" . name(i)

unset title
set yrange [*:*]
set origin 0, 0
set size 1, 0.33
set tmargin 0.5
set bmargin 3.5
set format x "%g"
set xlabel over eq "angle_deg" ? angle_label : over
set ylabel "Residual " . unit
set xzeroaxis linetype 1 linecolor rgb "#0072b2"
plot for [i = 1:words(files)] data(i) using over:(column(measured) - column(fitted)) \
       with points pointtype 6 pointsize (size_of_points * point) linecolor rgb points_of[colour(i)] notitle
unset multiplot
