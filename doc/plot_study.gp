# Picture of the torque curves of all variants of a study, DIR/study.png and study.svg, at the top of the project:
#
#   gnuplot -e "dir='output/study'" doc/plot_study.gp
#
# The curves are named by the entries that the study varies, or, if there are more than 12, only coloured, from
# the first (dark) to the last (yellow).

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/study'\" doc/plot_study.gp"
  exit status 1
}
set datafile separator comma
set datafile columnheaders
stats dir . "/study.csv" using "variant" nooutput
n = int(STATS_max)
# with adaptive steps curve.csv is the curve, and torque.csv its rows
finest(d) = d . (system("test -s '" . d . "/curve.csv' && echo yes") eq "yes" ? "/curve.csv" : "/torque.csv")
file(i) = finest(sprintf("%s/variant-%03d", dir, i))
curve(i) = system("test -s " . file(i) . " && echo 1 || echo 0") + 0 ? file(i) : "/dev/null"
title_of_scene = system("sed -n 's/^set Title *= *//p' " . dir . "/variant-001/parameters.prm")
name(i) = system(sprintf("awk -v variant=%d -f doc/studies/variant_name.awk %s/study.csv", i, dir))

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "/study", 1000, n <= 12 ? 600 + 27 * n : 700)
  set title title_of_scene noenhanced
  set xlabel angle_label
  set ylabel torque_label
  set key at screen 0.05, 0.01 bottom left maxcols 1 noenhanced
  set bmargin 4 + (n <= 12 ? 1.25 * n : 0)
  set xrange [*:*] noextend
  set offsets graph 0, graph 0, graph 0.05, graph 0
  set autoscale yfixmin
  unset colorbox
  plot for [i=1:n] curve(i) using "angle_deg":"torque_Nmm" with lines linewidth 2 \
    linecolor palette fraction (n > 1 ? (i - 1.) / (n - 1) : 0) title (n <= 12 ? name(i) : "")
}
unset output
