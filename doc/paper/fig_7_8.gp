# Figs. 7 and 8: patterns of the initial bonding, and friction coefficient and sliding distance on the contact face for each,
# with the parameters of Table 6. Needs output/paper/fig_7_8 (prm/paper/partial_fitted_parameters.prm with 6 quadrature points).
dir = "output/paper/fig_7_8/"
file(i) = sprintf("%svariant-%03d/profiles.csv", dir, i)
angles = "1.15 1.5 2 3 5 10"
array name[4] = ["homogeneous", "(b)", "(c) disk", "(d) random"]
format = "map"

# before debonding begins phi is phi_0
load "doc/style.gp"
eval picture(dir . "fig_7", 1300, 375)
set multiplot layout 1, 4 margins 0.01, 0.86, 0.03, 0.86 spacing 0.01, 0
load "doc/paper/faces.gp"
set cbrange [0:1]
set pm3d corners2color c1 interpolate 1, 1 border retrace linewidth 1 # what jumps from element to element has no values in between
do for [i=1:4] {
  if (i == 4) {
    set colorbox user origin 0.87, 0.08 size 0.012, 0.74
    set cblabel "Bonding degree φ_0"
  } else { unset colorbox }
  set title name[i]
  splot face(file(i), "0.1", 6) using "x_mm":"y_mm":"phi" with pm3d
}
unset multiplot

# mu or g_s at all angles, a row for each pattern
do for [quantity in "mu slip_mm"] {
  load "doc/style.gp"
  eval picture(dir . (quantity eq "mu" ? "fig_8" : "fig_8_slip"), 1500, 1000)
  set multiplot layout 4, 6 margins 0.045, 0.87, 0.02, 0.95 spacing 0.005, 0.01
  load "doc/paper/faces.gp"
  eval colours_of(quantity)
  set pm3d interpolate 2, 2
  set cbrange [(quantity eq "mu" ? 0.4 : 0):(quantity eq "mu" ? 0.97 : 0.44)]
  do for [row=1:4] {
    do for [i=1:6] {
      if (i == 6 && row == 4) {
        set colorbox user origin 0.88, 0.12 size 0.012, 0.75
        set cblabel (quantity eq "mu" ? "Friction coefficient {/:Italic μ}" : "Sliding distance {/:Italic g}_s [mm]")
      } else { unset colorbox }
      if (row == 1) { set title word(angles, i) . "°" } else { unset title }
      if (i == 1) { set label 1 name[row] at graph -0.12, 0.5 center rotate } else { unset label 1 }
      splot face(file(row), word(angles, i), 6) using "x_mm":"y_mm":quantity with pm3d
    }
  }
  unset multiplot
}
unset output
