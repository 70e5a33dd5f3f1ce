# Fig. 4: torque curves of both data sets. Needs output/paper/table_5 (prm/paper/table_5.prm).
dir = "output/paper/table_5/"
file(i) = sprintf("%svariant-%03d/torque.csv", dir, i)
array name[3] = ["Eqs. (14) to (16), fitted", "Eq. (18)", "finite elements, calibrated"]
# Table 2: the end of the line at theta_lin, where T is 3/4 of T_max by Eq. (18); T_max at theta_max; T_inf
array published[2] = ['0.13,40.35\n1.13,53.8\n10,36.8', '0.11,44.63\n2.02,59.5\n10,44.4']
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_4", 1400, 640)
  set multiplot layout 1, 2
  set xlabel angle_label
  set ylabel torque_label
  set xrange [0:10.2]
  set yrange [0:70]
  eval key_below(2, 2)
  do for [set=1:2] {
    set title sprintf("Data set %d", set)
    plot for [i=1:3] file(3 * set - 3 + i) using "angle_deg":"torque_Nmm" with lines title name[i], \
      marks(published[set]) with points linestyle 1 title "published"
    unset key
  }
  unset multiplot
}
unset output
