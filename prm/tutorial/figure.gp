# doc/tutorial/fit.md: the measured and the fitted curve. For a fit of your own copy this file and change these two lines.
fit    = "output/tutorial/fit/fit.csv"
figure = "output/tutorial/figure.svg"

set terminal svg size 600, 400 font "Sans,14"
set output figure
set datafile separator comma
set datafile columnheaders
set xlabel "Rotation angle [°]"
set ylabel "Torque [N mm]"
set yrange [0:*]
plot fit using "angle_deg":"torque_Nmm_measured" with points pointtype 6 pointsize 0.3 linecolor rgb "#555555" title "measured", \
     fit using "angle_deg":"torque_Nmm_fitted" with lines linewidth 2 linecolor rgb "#c03028" title "fitted"
