# Pictures of the report of a study or a calibration. Set before: svg, png (files to write), n_curves, file(i), name(i), and
# x, y (columns), x_label, y_label, n_reference (rows of the data block $reference); of a fit is_fit = 1, with the columns y .
# "_measured", "_fitted", "_lower_95", "_upper_95" of file(1); of an ensemble is_ensemble = 1, with "torque_mean_Nmm" and the like.
set encoding utf8
set datafile separator comma
set datafile missing NaN
set datafile columnheaders
colours = "#c03028 #2c1e5c #e08a1e #3a7d44 #2a78b0 #8e4585 #6b6b6b #a0522d"
do for [kind=1:2] {
  if (kind == 1) { set terminal svg size 900, 520 dynamic enhanced font "sans-serif,15" background "#ffffff" linewidth 1.2 }
  if (kind == 2) { set terminal pngcairo size 1350, 780 enhanced font "sans-serif,17" linewidth 2 }
  set output (kind == 1 ? svg : png)
  set xlabel x_label
  set ylabel y_label noenhanced
  set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
  set border linecolor rgb "#555555"
  set key below left vertical maxrows 10 noenhanced
  set xrange [*:*] noextend
  set offsets graph 0, graph 0.02, graph 0.08, graph 0
  if (is_fit) {
    plot file(1) using x:(column(y . "_lower_95")):(column(y . "_upper_95")) with filledcurves linecolor rgb "#f0c8c0" title "95 % band", \
         file(1) using x:(column(y . "_measured")) with points pointtype 6 pointsize 0.6 linecolor rgb "#555555" title "measured", \
         file(1) using x:(column(y . "_fitted")) with lines linewidth 2 linecolor rgb "#c03028" title "fitted"
  } else { if (is_ensemble) {
    plot file(1) using x:"torque_p05_Nmm":"torque_p95_Nmm" with filledcurves linecolor rgb "#f0c8c0" title "5 to 95 % of the members", \
         file(1) using x:"torque_mean_Nmm" with lines linewidth 2 linecolor rgb "#c03028" title "mean"
  } else {
    plot for [i=1:n_curves] file(i) using x:y with lines linewidth (n_curves > 8 ? 0.7 : 1.6) \
           linecolor rgb (n_curves > 8 ? "#b8a8c8" : word(colours, i)) title (n_curves > 8 ? "" : name(i)), \
         $reference using 1:2 with points pointtype 6 pointsize 0.6 linecolor rgb "#555555" title (n_reference > 0 ? "reference" : "")
  } }
  set output
}
