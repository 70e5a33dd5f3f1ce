# Figs. 7 and 8: patterns of the initial bonding, and friction coefficient and sliding distance on the contact face for each,
# with the parameters of Table 6. Needs output/paper/partial_fitted_parameters (prm/paper/partial_fitted_parameters.prm).
load "doc/paper/style.gp"
dir = "output/paper/partial_fitted_parameters/"
file(i) = sprintf("%svariant-%03d/profiles.csv", dir, i)
angles = "1.15 1.5 2 3 5 10"
at(angle) = abs(column("angle_deg") - angle) < 1e-6
array name[4] = ["homogeneous", "(b)", "(c)", "(d)"]
unset grid
unset border
unset xtics
unset ytics
unset key
set size ratio -1
set xrange [-2.6:2.6]
set yrange [-2.6:2.6]
set palette defined (0 "#2c1e5c", 0.5 "#d04a62", 1 "#fbe9a0")

# before debonding begins phi is phi_0
set output dir . "fig_7.png"
set terminal pngcairo size 1100,320
set multiplot layout 1, 4 margins 0.01, 0.88, 0.04, 0.88 spacing 0.01, 0
set cbrange [0:1]
do for [i=1:4] {
  if (i == 4) { set colorbox user origin 0.895, 0.08 size 0.012, 0.76; set cblabel "φ_0" } else { unset colorbox }
  set title name[i]
  plot file(i) using (at(0.1) ? column("x_mm") : NaN):"y_mm":"phi" with points pointtype 5 pointsize 0.75 palette
}
unset multiplot
unset cblabel

# mu or g_s at all angles, a row for each pattern
do for [quantity in "mu slip_mm"] {
  set output dir . (quantity eq "mu" ? "fig_8.png" : "fig_8_slip.png")
  set terminal pngcairo size 1400,940
  set multiplot layout 4, 6 margins 0.04, 0.89, 0.02, 0.95 spacing 0.005, 0.01
  if (quantity eq "mu") { set cbrange [0.4:0.97] } else { set cbrange [0:0.15] }
  do for [row=1:4] {
    do for [i=1:6] {
      angle = word(angles, i) + 0.
      if (i == 6 && row == 4) {
        set colorbox user origin 0.905, 0.1 size 0.012, 0.75
        set cblabel (quantity eq "mu" ? "μ" : "g_s [mm]")
      } else { unset colorbox; unset cblabel }
      if (row == 1) { set title word(angles, i) . "°" } else { unset title }
      if (i == 1) { set ylabel name[row] } else { unset ylabel }
      plot file(row) using (at(angle) ? column("x_mm") : NaN):"y_mm":quantity with points pointtype 5 pointsize 0.7 palette
    }
  }
  unset multiplot
}
