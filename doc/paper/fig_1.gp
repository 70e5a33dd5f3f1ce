# Fig. 1: modified Coulomb law. Needs output/paper/fig_1 (prm/paper/fig_1.prm).
load "doc/paper/style.gp"
dir = "output/paper/fig_1/"
file(i) = sprintf("%svariant-%03d/friction_law.csv", dir, i)
set output dir . "fig_1.png"
set terminal pngcairo size 1400,560
set multiplot layout 1, 2
set xlabel "Sliding distance {/:Italic g}_s [mm]"
set ylabel "{/:Italic t}_t / {/:Italic t}_{t,max}"
set yrange [0.65:1.02]
set xrange [0:1]
set key bottom left
array a[4] = [0.11, 0.22, 0.33, 0.44]
array b[4] = [0.25, 0.5, 1, 2]
set title "(a) {/:Italic b}_s = 1, {/:Italic a}_s ="
plot for [i=1:4] file(i) using "slip_mm":"mu_over_initial" with lines linewidth 2 title sprintf("%.2f mm", a[i])
set title "(b) {/:Italic a}_s = 0.22 mm, {/:Italic b}_s ="
plot for [i=5:8] file(i) using "slip_mm":"mu_over_initial" with lines linewidth 2 title sprintf("%.2f", b[i-4])
unset multiplot
