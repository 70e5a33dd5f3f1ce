# Bone that is crushed, friction over pressure, and bone that is sheared: doc/images/bone.png and .svg, for doc/pictures.sh bone.
# Needs the results of prm/bone/coin_pressed.prm, prm/bone/coin_stronger_than_bone.prm and prm/coin_mode3.prm in output.
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/bone/bone", 1500, 480)
  set multiplot layout 1, 3 margins 0.06, 0.985, 0.22, 0.96 spacing 0.095, 0
  set key top left samplen 2
  set xlabel "Depth of the press (µm)"; set ylabel "Pressure (MPa)" offset 1
  set xtics 4
  plot [0:14] [0:5] "output/bone/coin_pressed/curve.csv" using (-1e3 * column("chuck_uz_mm")):(-column("chuck_Fz_N") / (pi * 2.5**2)) \
    with lines title "pressed twice", 2.5 with lines dashtype 2 linecolor rgb grey linewidth 1 title "{/:Italic p}_c"
  set key top right
  set xlabel "Pressure (MPa)"; set ylabel "Friction coefficient" offset 1.5
  set xtics 15
  plot [0:50] [0:0.16] 0.0673 * (x / 27.24)**-0.419 title "{/:Italic n} = 0.581", 0.0673 * (x / 27.24)**(-1./3) dashtype 2 title "{/:Italic n} = 2/3", \
    marks('13.62,0.091\n27.24,0.067\n40.86,0.058') using 1:2 with points linestyle 1 title "measured"
  set key bottom right
  set xlabel "Angle (degrees)"; set ylabel "Torque (N mm)"
  set xtics 2
  plot [0:10] [0:60] "output/coin_mode3/curve.csv" using "angle_deg":"torque_Nmm" with lines title "the bond breaks", \
    "output/bone/coin_stronger_than_bone/curve.csv" using "angle_deg":"torque_Nmm" with lines title "the bone shears"
  unset multiplot
  unset output
}
