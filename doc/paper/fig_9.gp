# Fig. 9: torque curves of all patterns of the initial bonding, each with its own parameters of Table 6. Needs
# output/paper/partial_fitted_parameters (prm/paper/partial_fitted_parameters.prm).
dir = "output/paper/partial_fitted_parameters/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
array name[4] = ["homogeneous, φ_0 = 1", "(b)", "(c) disk", "(d) random"]
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_9", 1400, 640)
  set linetype 10 linecolor rgb grey linewidth 2
  set multiplot layout 1, 2
  set xlabel angle_label
  set ylabel torque_label
  do for [part=1:2] {
    set xrange [0:(part == 1 ? 10.2 : 2.5)]
    set yrange [0:60]
    if (part == 1) { eval key_below(2, 0) } else { unset key }
    plot for [i=1:4] file(i) using "angle_deg":"torque_Nmm" with lines linetype (i == 1 ? 10 : i - 1) title name[i], \
      marks('0.13,40.35\n1.13,53.8\n10,36.8') with points linestyle 1 title "published, data set 1"
  }
  unset multiplot
}
unset output
