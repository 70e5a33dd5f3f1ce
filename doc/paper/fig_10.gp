# Fig. 10: torque curves of all patterns of the initial bonding with the same parameters. Needs
# output/paper/partial_equal_parameters (prm/paper/partial_equal_parameters.prm).
dir = "output/paper/partial_equal_parameters/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
array name[5] = ["homogeneous, φ_0 = 1", "homogeneous, φ_0 = 0.55", "(b), mean 0.55", "(c) disk, mean 0.55", \
  "(d) random, mean 0.55"]
array kind[5] = [0, 4, 1, 2, 3] # linetype; 0: grey. Patterns as in Fig. 9
array dash[5] = [1, 1, 1, 1, 2]
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_10", 1400, 640)
  set linetype 10 linecolor rgb grey linewidth 2
  set multiplot layout 1, 2
  set xlabel angle_label
  set ylabel torque_label
  do for [part=1:2] {
    set xrange [0:(part == 1 ? 10.2 : 2.5)]
    set yrange [0:60]
    if (part == 1) { eval key_below(2, -2) } else { unset key }
    plot for [i=1:5] file(i) using "angle_deg":"torque_Nmm" with lines linetype (kind[i] > 0 ? kind[i] : 10) \
      dashtype dash[i] title name[i], \
      marks('10,36.8') with points linestyle 1 title "published {/:Italic T}_∞"
  }
  unset multiplot
}
unset output
