# Figs. 5 and 6: friction coefficient and sliding distance on the contact face. Needs output/paper/fig_5_6
# (prm/paper/fig_5_6.prm).
dir = "output/paper/fig_5_6/"
file = dir . "profiles.csv"
angles = "1.15 1.5 2 3 5 10"
# an eighth of the points in the order of their radii: the others lie on the same curves
over_radius(angle) = sprintf("< awk -F, '$1 == %s && $3 > 0 && $2 > $3' %s | sort -t, -g -k4,4 | \
  awk -f doc/paper/over_radius.awk %sfriction_law.csv -", angle, file, dir)

format = "map"
load "doc/style.gp"
eval picture(dir . "fig_5", 1600, 660)
set multiplot layout 2, 6 margins 0.01, 0.86, 0.03, 0.9 spacing 0.005, 0.05
load "doc/paper/faces.gp"
# where debonding begins and where it ends, a_s and (1 + 2 b_s) a_s
set contour base
set cntrparam levels discrete 0.042, 0.10416
set cntrparam cubicspline points 10
set cntrparam firstlinetype 11
set for [i=11:12] linetype i linecolor rgb "#000000" linewidth 1
do for [row=1:2] {
  set cbrange [(row == 1 ? 0.4 : 0):(row == 1 ? 0.586 : 0.44)]
  tic = row == 1 ? 0.05 : 0.1
  set cbtics tic
  eval colours_of(row == 1 ? "mu" : "slip_mm")
  do for [i=1:6] {
    if (i == 1) {
      set colorbox user origin 0.87, (row == 1 ? 0.53 : 0.07) size 0.012, 0.36
      set cblabel (row == 1 ? "Friction coeff. {/:Italic μ}" : "Slip {/:Italic g}_s [mm]")
    } else { unset colorbox }
    if (row == 1) { set title word(angles, i) . "°" } else { unset title }
    data = face(file, word(angles, i), 5)
    if (row == 1) { splot data using "x_mm":"y_mm":"mu" with pm3d nocontour } else {
      splot data using "x_mm":"y_mm":"slip_mm" with pm3d nocontour, \
        data using "x_mm":"y_mm":"slip_mm" with lines nosurface
    }
  }
}
unset multiplot

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_6", 1400, 640)
  set multiplot layout 1, 2
  set bmargin 4.5
  set title "(a) over the contact face"
  set xlabel "Radius {/:Italic r} [mm]"
  set ylabel "Friction coefficient {/:Italic μ}"
  set xrange [0:2.5]
  set yrange [0.38:0.68]
  set key top right maxrows 2 samplen 1 width -1
  plot for [angle in angles] over_radius(angle) using "r_mm":"mu" with lines title angle . "°"
  set key samplen 2 width 0
  set title "(b) the law, {/:Italic a}_s = 42 μm, {/:Italic b}_s = 0.74"
  set xlabel "Sliding distance {/:Italic g}_s [μm]"
  set xrange [0:160]
  plot dir . "friction_law.csv" using (1000 * column("slip_mm")):"mu" with lines title "at every point", \
    marks("66,0.4") with points linestyle 1 title "published: debonded"
  unset multiplot
}
unset output
