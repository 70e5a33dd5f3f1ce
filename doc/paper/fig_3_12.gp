# Figs. 3 and 12: the analytical model. Needs output/paper/fig_3_12 (prm/paper/fig_3_12.prm).
dir = "output/paper/fig_3_12/"
t_max = 0.58 * 2.8113
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_3_12", 1400, 640)
  set multiplot layout 1, 2
  set title "Fig. 3"
  set xlabel "{/:Italic r} / {/:Italic R}"
  set ylabel "{/:Italic σ}_{θz} / {/:Italic t}_{t,max}"
  set yrange [0:1.05]
  set xtics 0.2
  set key bottom right
  plot for [angle in "0.13 1.13 2 3 5"] dir . "profiles.csv" \
    using (abs(column("angle_deg") - angle) < 1e-6 ? column("r_mm") / 2.5 : NaN):(column("traction_MPa") / t_max) \
    with lines title angle . "°"
  set title "Fig. 12"
  set xtics 1
  set xlabel angle_label
  set ylabel "Critical radius {/:Italic c} [mm]"
  set yrange [0:2.6]
  set xrange [0:4]
  plot dir . "torque.csv" using "angle_deg":(2.5 * sqrt(column("share_stick"))) with lines notitle
  unset multiplot
}
unset output
