# Figs. 5 and 6: friction coefficient and sliding distance on the contact face. Needs output/paper/fig_5_6
# (prm/paper/fig_5_6.prm).
load "doc/paper/style.gp"
dir = "output/paper/fig_5_6/"
file = dir . "profiles.csv"
angles = "1.15 1.5 2 3 5 10"
at(angle) = abs(column("angle_deg") - angle) < 1e-6

set output dir . "fig_5.png"
set terminal pngcairo size 1500,600
set multiplot layout 2, 6 margins 0.02, 0.9, 0.03, 0.9 spacing 0.005, 0.06
set size ratio -1
unset grid
unset border
unset xtics
unset ytics
unset key
set xrange [-2.6:2.6]
set yrange [-2.6:2.6]
set palette defined (0 "#2c1e5c", 0.5 "#d04a62", 1 "#fbe9a0")
do for [row=1:2] {
  if (row == 1) { set cbrange [0.4:0.586] } else { set cbrange [0:0.15] }
  do for [i=1:6] {
    angle = word(angles, i) + 0.
    if (i == 6) { set colorbox; set cblabel (row == 1 ? "μ" : "g_s [mm]") } else { unset colorbox; unset cblabel }
    if (row == 1) { set title word(angles, i) . "°" } else { unset title }
    plot file using (at(angle) ? column("x_mm") : NaN):"y_mm":(row == 1 ? column("mu") : column("slip_mm")) \
      with points pointtype 5 pointsize 0.8 palette
  }
}
unset multiplot

reset
load "doc/paper/style.gp"
set output dir . "fig_6.png"
set terminal pngcairo size 1400,560
set multiplot layout 1, 2
set title "(a)"
set xlabel "Radius {/:Italic r} [mm]"
set ylabel "Friction coefficient {/:Italic μ}"
set yrange [0.38:0.66]
set key top right maxrows 2
plot for [angle in angles] file using (at(angle) ? column("r_mm") : NaN):"mu" \
  with points pointtype 7 pointsize 0.35 notitle, \
  for [i=1:6] NaN with points pointtype 7 pointsize 1 linetype i title word(angles, i) . "°"
set title "(b) at {/:Italic r} = {/:Italic R}; {/:Italic a}_s = 42 μm, {/:Italic b}_s = 0.74"
set xlabel "Sliding distance {/:Italic g}_s [μm]"
plot dir . "friction_law.csv" using (1000 * column("slip_mm")):"mu" with lines linewidth 2 notitle
unset multiplot
