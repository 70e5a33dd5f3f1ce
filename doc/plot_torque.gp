# Picture of the torque over the rotation angle of one run, DIR/torque.png:
#
#   gnuplot -e "dir='output/coin'" doc/plot_torque.gp
#
# Together with another run, with the seconds that each took:
#
#   gnuplot -e "dir='output/coin'; other='output/coin_fast'" doc/plot_torque.gp
#
# With a curve to compare with (CSV with the columns angle_deg,torque_Nmm; another run's torque.csv will do):
#
#   gnuplot -e "dir='output/coin'; reference='measured.csv'" doc/plot_torque.gp

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/coin'\" doc/plot_torque.gp"
  exit status 1
}
file = dir . "/torque.csv"

set terminal pngcairo size 1200,800 enhanced font "Sans,16" linewidth 1.5
set output dir . "/torque.png"
set encoding utf8
set datafile separator comma
set datafile columnheaders

set title "Torque on the implant: " . dir noenhanced
set xlabel "Rotation angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set key top right noenhanced
set xrange [*:*] noextend
set offsets graph 0, graph 0, graph 0.05, graph 0
stats file using "torque_Nmm" nooutput
if (STATS_max > 0 && STATS_min > -1e-3 * STATS_max) {
  set yrange [0:*] # begins at zero in spite of rounding errors
}

seconds(d) = real(system("sed -n 's/.*\"wall_seconds\": *\\([0-9.e+-]*\\).*/\\1/p' " . d . "/summary.json"))
label(d) = sprintf("%s, %.2g s", d, seconds(d))

if (exists("other")) {
  plot file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb "#c03028" title label(dir), \
       other . "/torque.csv" using "angle_deg":"torque_Nmm" with linespoints pointtype 7 pointsize 0.6 \
         linewidth 1 linecolor rgb "#2c1e5c" title label(other)
} else { if (exists("reference")) {
  plot reference using "angle_deg":"torque_Nmm" with points pointtype 6 linecolor rgb "#555555" title reference, \
       file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb "#c03028" title "debond"
} else {
  plot file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb "#c03028" notitle
} }
