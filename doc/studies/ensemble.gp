# Pictures of the ensembles of randomly bonded implants, for doc/studies/ensemble.sh, which runs the studies.
load "doc/paper/style.gp"
dir = "output/studies/"
set tics nomirror
band = 0x9ecae1
mean_colour = 0x08519c
other = 0xd62728

# ---- torque band of 200 implants, and the same near the peak
set output dir . "ensemble.png"
set terminal pngcairo size 1500,650 enhanced font "Sans,16" linewidth 1.5
file = dir . "ensemble/ensemble.csv"
homogeneous = dir . "ensemble_homogeneous/variant-007/torque.csv"
set multiplot layout 1, 2
set xlabel "Angle {/:Italic θ} [°]"
set ylabel "Torque {/:Italic T} [N mm]"
do for [panel=1:2] {
  if (panel == 1) {
    set title "200 implants, 55 % of the surface bonded at random"
    set xrange [0:10]
    set yrange [0:50]
    set key bottom right Left reverse samplen 2
  } else {
    set title "Near the peak"
    set xrange [0:2.5]
    set yrange [44.4:46.9]
    set key top right Left reverse samplen 2
  }
  plot file using "angle_deg":"torque_p05_Nmm":"torque_p95_Nmm" with filledcurves linecolor rgb band title "5 to 95 %", \
    "" using "angle_deg":"torque_mean_Nmm" with lines linewidth 1.5 linecolor rgb mean_colour title "mean", \
    homogeneous using "angle_deg":"torque_Nmm" with lines linewidth 1.5 dashtype 2 linecolor rgb other title "homogeneous, φ₀ = 0.55"
}
unset multiplot

# ---- T_max over the bonded fraction
reset
load "doc/paper/style.gp"
set tics nomirror
set output dir . "ensemble_fraction.png"
set terminal pngcairo size 1500,650 enhanced font "Sans,16" linewidth 1.5
file = dir . "ensemble_fraction/ensemble_summary.csv"
homogeneous = dir . "ensemble_homogeneous/study.csv"
fraction = "Interface / Bonding / Bonded fraction"
phi_0 = "Interface / Bonding / Initial bonding"
set multiplot layout 1, 2
set xlabel "Bonded fraction of the surface"
set xrange [0:1]
set key top left Left reverse samplen 2
array quantity[2] = ["T_max", "D_adh"]
array unit[2] = ["_Nmm", "_Nm"]
array label[2] = ["Largest torque {/:Italic T}_{max} [N mm]", "Work of adhesion {/:Italic D}_{adh} [10^{-3} N m]"]
do for [i=1:2] {
  scale = (i == 1 ? 1. : 1e3)
  col(what) = scale * column(quantity[i] . "_" . what . unit[i])
  set ylabel label[i]
  plot file using (column(fraction)):(col("p05")):(col("p95")) with filledcurves linecolor rgb band title "20 random patterns, 5 to 95 %", \
    "" using (column(fraction)):(col("mean")) with linespoints pointtype 7 linecolor rgb mean_colour title "their mean", \
    homogeneous using (column(phi_0)):(scale * column(quantity[i] . unit[i])) with lines dashtype 2 linecolor rgb other title "homogeneous, φ₀ = the fraction"
}
unset multiplot

# ---- scatter over the correlation length
reset
load "doc/paper/style.gp"
set tics nomirror
set output dir . "ensemble_correlation.png"
set terminal pngcairo size 1500,650 enhanced font "Sans,16" linewidth 1.5
file = dir . "ensemble_correlation/ensemble_summary.csv"
length = "Interface / Bonding / Correlation length"
set multiplot layout 1, 2
set xlabel "Correlation length of the pattern [mm]"
set xrange [-0.1:2.1]
set key top left Left reverse samplen 2
set ylabel "Largest torque {/:Italic T}_{max} [N mm]"
plot file using (column(length)):"T_max_p05_Nmm":"T_max_p95_Nmm" with filledcurves linecolor rgb band title "40 random patterns, 5 to 95 %", \
  "" using (column(length)):"T_max_p50_Nmm" with linespoints pointtype 7 linecolor rgb mean_colour title "median"
set ylabel "Standard deviation / mean [%]"
set yrange [0:*]
cv(name, unit) = 100. * column(name . "_sd" . unit) / column(name . "_mean" . unit)
plot file using (column(length)):(cv("T_max", "_Nmm")) with linespoints pointtype 7 linecolor rgb mean_colour title "T_{max}" enhanced, \
  "" using (column(length)):(cv("D_adh", "_Nm")) with linespoints pointtype 5 linecolor rgb other title "D_{adh}" enhanced, \
  "" using (column(length)):(cv("E_deb", "_Nm")) with linespoints pointtype 9 linecolor rgb "#2ca02c" title "E_{deb}" enhanced
unset multiplot
