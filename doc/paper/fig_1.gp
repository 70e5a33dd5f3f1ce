# Fig. 1: modified Coulomb law. Needs output/paper/fig_1 (prm/paper/fig_1.prm).
dir = "output/paper/fig_1/"
# the law is constant beyond the last row
file(i) = sprintf("< awk -F, -v OFS=, '{ print } END { $1 = 3; print }' %svariant-%03d/friction_law.csv", dir, i)
array a[4] = [0.11, 0.22, 0.33, 0.44]
array b[4] = [0.25, 0.5, 1, 2]
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_1", 1400, 640)
  set multiplot layout 1, 2
  set xlabel "Sliding distance {/:Italic g}_s [mm]"
  set ylabel "Friction {/:Italic t}_t / {/:Italic t}_{t,max}"
  set yrange [0.65:1.02]
  set xrange [0:2]
  set key top right
  set title "(a) {/:Italic b}_s = 1"
  plot for [i=1:4] file(i) using "slip_mm":"mu_over_initial" with lines title sprintf("{/:Italic a}_s = %.2f mm", a[i])
  set title "(b) {/:Italic a}_s = 0.22 mm"
  plot for [i=5:8] file(i) using "slip_mm":"mu_over_initial" with lines title sprintf("{/:Italic b}_s = %.2f", b[i-4])
  unset multiplot
}
unset output
