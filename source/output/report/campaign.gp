# Pictures of the report of a study or a calibration. Set before: svg, png (files to write), n_curves, file(i), name(i),
# legend_rows (0: no legend), most_bands, x, y (columns), x_label, y_label, n_reference (rows of the data block $reference);
# of a fit is_fit = 1, with the columns y . "_measured", "_fitted", "_lower_95", "_upper_95" of file(1);
# of an ensemble is_ensemble = 1, with the columns "torque_mean_Nmm" and the like of file(i), which is one group each.
set encoding utf8
set datafile separator comma
set datafile missing NaN
set datafile columnheaders

# a few curves are told apart by their colours, many by where they are between dark and light
few = 12
array colours[few] = [0xc03028, 0x2c1e5c, 0xe08a1e, 0x3a7d44, 0x2a78b0, 0x8e4585, 0x6b6b6b, 0xa0522d, 0x20a0a0, 0xd868a8, 0x98982a, 0x000000]
between(t, a, b, c) = int(t < 0.5 ? a + (b - a) * 2 * t : b + (c - b) * (2 * t - 1))
shade(t) = 65536 * between(t, 44, 208, 240) + 256 * between(t, 30, 74, 190) + between(t, 92, 98, 90)
colour(i) = n_curves > few ? shade((i - 1.0) / (n_curves - 1)) : colours[i]
title_of(i) = legend_rows > 0 ? name(i) : ""

# an axis begins at 0 where nothing is negative
least = 0; most = 0
heed(column_of_y) = sprintf("stats file(i) using (column('%s')) nooutput; least = STATS_min < least ? STATS_min : least; \
  most = STATS_max > most ? STATS_max : most", column_of_y)
do for [i=1:n_curves] {
  if (is_fit) { eval heed(y . "_measured"); eval heed(y . "_fitted") }
  if (is_ensemble) { eval heed("torque_p05_Nmm"); eval heed("torque_p95_Nmm") }
  if (!is_fit && !is_ensemble) { eval heed(y) }
}
if (n_reference > 0) { stats $reference using 2 nooutput; least = STATS_min < least ? STATS_min : least }
if (least > -1e-3 * most) { set yrange [0:*] }

height = is_fit ? 720 : 520 + 20 * (legend_rows > 1 ? legend_rows - 1 : 0)
do for [kind=1:2] {
  if (kind == 1) { set terminal svg size 900, height dynamic enhanced font "sans-serif,15" background "#ffffff" linewidth 1.2 }
  if (kind == 2) { set terminal pngcairo size 1350, 1.5 * height enhanced font "sans-serif,17" linewidth 2 }
  set output (kind == 1 ? svg : png)
  set xlabel x_label . "\n" # away from the legend
  set ylabel y_label noenhanced
  set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
  set border linecolor rgb "#555555"
  set key below left vertical maxrows (legend_rows > 0 ? legend_rows : 1) Left reverse noenhanced
  set xrange [*:*] noextend
  set offsets graph 0, graph 0.02, graph 0.08, graph 0
  if (is_fit) {
    set multiplot
    set lmargin at screen 0.11; set rmargin at screen 0.98
    set tmargin at screen 0.98; set bmargin at screen 0.42
    set key inside bottom right
    unset xlabel
    plot file(1) using x:(column(y . "_lower_95")):(column(y . "_upper_95")) with filledcurves linecolor rgb "#f0c8c0" title "95 % band", \
         file(1) using x:(column(y . "_measured")) with points pointtype 6 pointsize 0.6 linecolor rgb "#555555" title "measured", \
         file(1) using x:(column(y . "_fitted")) with lines linewidth 2 linecolor rgb "#c03028" title "fitted"
    set tmargin at screen 0.36; set bmargin at screen 0.1
    set xlabel x_label
    set ylabel "measured - fitted" noenhanced
    set xzeroaxis linetype 1 linecolor rgb "#c03028" linewidth 1.5
    set yrange [*:*]
    set offsets graph 0, graph 0.02, graph 0.08, graph 0.08
    plot file(1) using x:(column(y . "_measured") - column(y . "_fitted")) with points pointtype 6 pointsize 0.6 \
         linecolor rgb "#555555" notitle
    unset multiplot
  } else { if (is_ensemble && n_curves == 1) {
    plot file(1) using x:"torque_p05_Nmm":"torque_p95_Nmm" with filledcurves linecolor rgb "#f0c8c0" title "5 to 95 % of the members", \
         file(1) using x:"torque_mean_Nmm" with lines linewidth 2 linecolor rgb "#c03028" title "mean"
  } else { if (is_ensemble) {
    plot for [i=1:(n_curves > most_bands ? 0 : n_curves)] file(i) using x:"torque_p05_Nmm":"torque_p95_Nmm" with filledcurves \
           fillstyle transparent solid 0.18 noborder linecolor rgb colour(i) notitle, \
         for [i=1:n_curves] file(i) using x:"torque_mean_Nmm" with lines linewidth 1.6 linecolor rgb colour(i) title title_of(i)
  } else {
    plot for [i=1:n_curves] file(i) using x:y with lines linewidth (n_curves > few ? 1 : 1.6) linecolor rgb colour(i) title title_of(i), \
         $reference using 1:2 with points pointtype 6 pointsize 0.6 linecolor rgb "#555555" title (n_reference > 0 ? "reference" : "")
  } } }
  set output
}
