# Pictures of the ensembles of randomly bonded implants, for doc/studies/ensemble.sh, which runs the studies.
dir = "output/studies/"
do for [format in "png svg"] {
  # ---- torque band of 200 implants, and the same near the peak
  load "doc/style.gp"
  eval picture(dir . "ensemble", 1400, 640)
  file = dir . "ensemble/ensemble.csv"
  homogeneous = dir . "ensemble_homogeneous/variant-007/curve.csv"
  set multiplot layout 1, 2
  set xlabel angle_label
  set ylabel torque_label
  do for [panel=1:2] {
    set title (panel == 1 ? "200 implants, 55 % bonded at random" : "Near the peak")
    set xrange [0:(panel == 1 ? 10 : 2.5)]
    set yrange [(panel == 1 ? 0 : 44.4):(panel == 1 ? 50 : 46.9)]
    if (panel == 1) { eval key_below(1, -1) } else { unset key }
    plot file using "angle_deg":"torque_p05_Nmm":"torque_p95_Nmm" with filledcurves fillstyle solid 0.5 noborder linecolor rgb sky title "5 to 95 %", \
      "" using "angle_deg":"torque_mean_Nmm" with lines linetype 1 title "mean", \
      homogeneous using "angle_deg":"torque_Nmm" with lines dashtype 2 linetype 4 title "homogeneous, φ_0 = 0.55"
  }
  unset multiplot

  # ---- T_max and D_adh over the bonded fraction
  load "doc/style.gp"
  eval picture(dir . "ensemble_fraction", 1400, 640)
  file = dir . "ensemble_fraction/ensemble_summary.csv"
  homogeneous = dir . "ensemble_homogeneous/study.csv"
  fraction = "Interface / Bonding / Bonded fraction"
  phi_0 = "Interface / Bonding / Bonding degree"
  array quantity[2] = ["T_max", "D_adh"]
  array label[2] = ["Largest torque {/:Italic T}_{max} [N mm]", "Adhesive dissipation {/:Italic D}_{adh} [N mm]"]
  set multiplot layout 1, 2
  set xlabel "Bonded fraction of the surface"
  set xrange [0:1]
  eval key_below(1, -1)
  do for [i=1:2] {
    col(what) = column(quantity[i] . "_" . what . "_Nmm")
    set ylabel label[i]
    if (i == 2) { set yrange [0:0.8] }
    plot file using (column(fraction)):(col("p05")):(col("p95")) with filledcurves fillstyle solid 0.5 noborder linecolor rgb sky title "20 patterns, 5 to 95 %", \
      "" using (column(fraction)):(col("mean")) with linespoints linetype 1 title "mean", \
      homogeneous using (column(phi_0)):(column(quantity[i] . "_Nmm")) with lines dashtype 2 linetype 4 \
        title "homogeneous"
    unset key
  }
  unset multiplot

  # ---- scatter over the correlation length
  load "doc/style.gp"
  eval picture(dir . "ensemble_correlation", 1400, 640)
  file = dir . "ensemble_correlation/ensemble_summary.csv"
  length = "Interface / Bonding / Correlation length"
  set multiplot layout 1, 2
  set xlabel "Correlation length of the pattern [mm]"
  set xrange [0:2.1]
  set key top left
  set ylabel "Largest torque {/:Italic T}_{max} [N mm]"
  plot file using (column(length)):"T_max_p05_Nmm":"T_max_p95_Nmm" with filledcurves fillstyle solid 0.5 noborder linecolor rgb sky title "40 patterns, 5 to 95 %", \
    "" using (column(length)):"T_max_p50_Nmm" with linespoints linetype 1 title "median"
  set ylabel "Standard deviation / mean [%]"
  set yrange [0:*]
  cv(name) = 100. * column(name . "_sd_Nmm") / column(name . "_mean_Nmm")
  plot file using (column(length)):(cv("T_max")) with linespoints linetype 1 title "{/:Italic T}_{max}", \
    "" using (column(length)):(cv("D_adh")) with linespoints linetype 4 pointtype 5 title "{/:Italic D}_{adh}", \
    "" using (column(length)):(cv("E_deb")) with linespoints linetype 3 pointtype 9 title "{/:Italic E}_{deb}"
  unset multiplot
}
unset output
