# Picture of the torque over the rotation angle of one run, DIR/torque.png:
#
#   gnuplot -e "dir='output/coin'" doc/plot_torque.gp
#
# With published values marked, T_max and T_inf [N mm], theta_lin and theta_max [degrees]:
#
#   gnuplot -e "dir='output/data_set_1_calibrated'; published='53.8 36.8 0.13 1.13'" doc/plot_torque.gp
#
# Together with another run, with the seconds that each took:
#
#   gnuplot -e "dir='output/coin'; other='output/coin_fast'" doc/plot_torque.gp
#
# With a curve to compare with (CSV with the columns angle_deg,torque_Nmm; another run's torque.csv or curve.csv will do):
#
#   gnuplot -e "dir='output/coin'; reference='measured.csv'" doc/plot_torque.gp
#
# With the bonding state phi on the contact face below, from the profiles.csv of a run with Expert / Output / Profile angles:
# faces='DIRECTORY', angles='1 1.5 2.5 5' [degrees] and points=9, its Expert / Interface / Quadrature points, as in doc/first_picture.sh.

if (!exists("dir")) {
  print "usage: gnuplot -e \"dir='output/coin'\" doc/plot_torque.gp"
  exit status 1
}
# with adaptive steps curve.csv is the curve, and torque.csv its rows
finest(d) = d . (system("test -s '" . d . "/curve.csv' && echo yes") eq "yes" ? "/curve.csv" : "/torque.csv")
file = finest(dir)
if (!exists("faces")) { angles = "" }
n_faces = words(angles)

format = "png"
load "doc/style.gp"
eval picture(dir . "/torque", 1200, n_faces ? 1150 : 800)
set xlabel angle_label
set ylabel torque_label
set key top right noenhanced
set xrange [*:*] noextend
set offsets graph 0, graph 0, graph 0.05, graph 0
stats file using "torque_Nmm" nooutput
if (STATS_max > 0 && STATS_min > -1e-3 * STATS_max) {
  set yrange [0:*] # begins at zero in spite of rounding errors
}

text(d, pattern) = system("sed -n '" . pattern . "' " . d)
title_of(d) = text(d . "/parameters.prm", "s/^ *set Title *= *//p")
seconds(d) = real(text(d . "/summary.json", "s/.*\"wall_seconds\": *\\([0-9.e+-]*\\).*/\\1/p"))
label(d) = sprintf("%s, %.2g s", d, seconds(d))
set title title_of(dir) noenhanced

at_face(i) = abs(column("angle_deg") - word(angles, i)) < 1e-6

do for [i=1:n_faces] { # where on the curve the faces are
  stats faces . "/torque.csv" using (at_face(i) ? column("torque_Nmm") : NaN) nooutput
  set label 10 + i "" at first real(word(angles, i)), first STATS_max point pointtype 7 pointsize (1.3 * point) linecolor rgb blue
}

set multiplot
if (n_faces) { set lmargin at screen 0.09; set rmargin at screen 0.97; set tmargin at screen 0.955; set bmargin at screen 0.38 }
if (exists("published")) {
  T_max = real(word(published, 1))
  T_inf = real(word(published, 2))
  lin   = real(word(published, 3))
  peak  = real(word(published, 4))
  do for [i=1:2] {
    T = real(word(published, i))
    set arrow i from graph 0, first T to graph 1, first T nohead dashtype 2 linewidth 1 linecolor rgb "#333333" back
    set label i sprintf("published {/:Italic T}_{%s} = %.1f N mm", i == 1 ? "max" : "∞", T) \
      at graph 0.985, first T right offset 0, 0.9 textcolor rgb "#333333" enhanced
  }
  unset key
}
if (exists("other")) {
  plot file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb blue title label(dir), \
       finest(other) using "angle_deg":"torque_Nmm" with lines linewidth 1 linecolor rgb red notitle, \
       other . "/torque.csv" using "angle_deg":"torque_Nmm" with points pointtype 7 pointsize (0.6 * point) \
         linecolor rgb red title label(other)
} else { if (exists("reference")) {
  plot reference using "angle_deg":"torque_Nmm" with points pointtype 6 linecolor rgb "#555555" title reference, \
       file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb blue title "debond"
} else {
  plot file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb blue notitle
} }

if (exists("published")) { # the beginning, enlarged
  high = n_faces ? 0.60 : 0.47
  set lmargin at screen 0.45
  set rmargin at screen 0.94
  set bmargin at screen (n_faces ? 0.44 : 0.19)
  set tmargin at screen high
  unset title
  unset xlabel
  unset ylabel
  unset label
  unset arrow 2
  unset offsets
  set xrange [0:2.2 * peak]
  set yrange [0:1.4 * T_max]
  set ytics 20
  do for [i=3:4] {
    angle = real(word(published, i))
    set arrow i from first angle, graph 0 to first angle, graph 1 nohead dashtype 2 linewidth 1 linecolor rgb "#333333" back
    set label i sprintf("{/:Italic θ}_{%s} = %g°", i == 3 ? "lin" : "max", angle) \
      at first angle, graph 0.14 left offset 0.7, 0 textcolor rgb "#333333" enhanced
  }
  set label 1 sprintf("published {/:Italic T}_{max}") at graph 0.985, first T_max right offset 0, 0.7 textcolor rgb "#333333" enhanced
  plot file using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb blue notitle
  unset label
  unset arrow
}

if (n_faces) {
  unset label
  unset xlabel
  unset ylabel
  unset offsets
  load "doc/paper/faces.gp"
  eval colours_of("phi")
  set cbrange [0:1]
  set tmargin at screen 0.28
  set bmargin at screen 0.03
  do for [i=1:n_faces] {
    set lmargin at screen 0.03 + 0.81 / n_faces * (i - 1)
    set rmargin at screen 0.02 + 0.81 / n_faces * i
    set title word(angles, i) . "°" offset 0, -0.5
    if (i == n_faces) {
      set colorbox user origin 0.85, 0.06 size 0.015, 0.19
      set cbtics ("0 broken" 0, "0.5" 0.5, "1 bonded" 1)
      set label 1 "{/:Italic φ}" at screen 0.8575, 0.275 center enhanced
    } else { unset colorbox }
    splot face(faces . "/profiles.csv", word(angles, i), points) using "x_mm":"y_mm":"phi" with pm3d
  }
}
unset multiplot
unset output
