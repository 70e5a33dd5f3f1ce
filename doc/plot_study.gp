# Picture of the torque curves of all variants of a study, DIR/study.png:
#
#   gnuplot -e "dir='output/study'" doc/plot_study.gp

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/study'\" doc/plot_study.gp"
  exit status 1
}
set terminal pngcairo size 1200,800 enhanced font "Sans,16" linewidth 1.5
set output dir . "/study.png"
set encoding utf8
set datafile separator comma
set datafile columnheaders

stats dir . "/study.csv" using "variant" nooutput
n = int(STATS_max)
file(i) = sprintf("%s/variant-%03d/torque.csv", dir, i)
written(i) = int(system("test -s " . file(i) . " && echo 1 || echo 0"))

set title "Torque on the implant: " . dir noenhanced
set xlabel "Rotation angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set key top right noenhanced
set xrange [*:*] noextend
set offsets graph 0, graph 0, graph 0.05, graph 0
set autoscale yfixmin
set palette defined (0 "#2c1e5c", 0.5 "#d04a62", 1 "#e8a33d")
unset colorbox
frac(i) = n > 1 ? (i - 1.) / (n - 1) : 0.
plot for [i=1:n] (written(i) ? file(i) : "/dev/null") using "angle_deg":"torque_Nmm" with lines linewidth 2 \
  linecolor palette fraction frac(i) title (n <= 24 ? sprintf("variant %d", i) : "")
