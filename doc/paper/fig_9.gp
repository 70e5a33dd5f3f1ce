# Fig. 9: torque curves of all patterns of the initial bonding, each with its own parameters of Table 6. Needs
# output/paper/partial_fitted_parameters (prm/paper/partial_fitted_parameters.prm).
load "doc/paper/style.gp"
dir = "output/paper/partial_fitted_parameters/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
set output dir . "fig_9.png"
set terminal pngcairo size 1400,560
array name[4] = ["homogeneous, φ_0 = 1", "(b)", "(c) disk", "(d) random"]
array colour[4] = ["#999999", "#c2452d", "#3a8f4d", "#d99a1c"]
set key enhanced
set multiplot layout 1, 2
set xlabel "Rotation angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
set yrange [0:60]
set key bottom right
do for [part=1:2] {
  if (part == 2) { set xrange [0:2.5]; set yrange [0:60]; unset key; set ylabel "" }
  plot for [i=1:4] file(i) using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb colour[i] title name[i]
}
unset multiplot
