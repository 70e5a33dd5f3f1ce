# Fig. 4: torque curves of both data sets. Needs output/paper/table_5 (prm/paper/table_5.prm).
load "doc/paper/style.gp"
dir = "output/paper/table_5/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
set output dir . "fig_4.png"
set terminal pngcairo size 1400,560
set multiplot layout 1, 2
set xlabel "Rotation angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
set yrange [0:*]
set key bottom right
array name[3] = ["Eqs. (14) to (16), fitted", "Eq. (18)", "finite elements, calibrated"]
do for [set=1:2] {
  set title sprintf("Data set %d", set)
  plot for [i=1:3] file(3 * set - 3 + i) using "angle_deg":"torque_Nmm" with lines linewidth 2 \
    title name[i]
}
unset multiplot
