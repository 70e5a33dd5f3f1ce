# Fig. 10: torque curves of all patterns of the initial bonding with the same parameters. Needs
# output/paper/partial_equal_parameters (prm/paper/partial_equal_parameters.prm).
load "doc/paper/style.gp"
dir = "output/paper/partial_equal_parameters/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
set output dir . "fig_10.png"
set terminal pngcairo size 1400,560
array name[5] = ["homogeneous, φ_0 = 1", "homogeneous, φ_0 = 0.55", "(b), mean 0.55", "(c) disk, mean 0.55", \
  "(d) random, mean 0.55"]
array colour[5] = ["#999999", "#1b6ca8", "#c2452d", "#3a8f4d", "#d99a1c"]
array dash[5] = [1, 1, 1, 1, 2]
set key enhanced
set multiplot layout 1, 2
set xlabel "Rotation angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
set yrange [0:58]
set key bottom right
do for [part=1:2] {
  if (part == 2) { set xrange [0:2.5]; set yrange [0:58]; unset key; set ylabel "" }
  plot for [i=1:5] file(i) using "angle_deg":"torque_Nmm" with lines linewidth 2 linecolor rgb colour[i] \
    dashtype dash[i] title name[i]
}
unset multiplot
