# Torque of a coin that is bonded all over and of three that are half bonded, with their phi_0, output/half_bonded/half_bonded.png.
# Needs the runs of doc/pictures.sh half_bonded.
dir = "output/half_bonded/"
array run[4] = ["full", "disk", "side", "random"]
array name[4] = ["all over", "half: disk", "half: one side", "half: patches"]
array colour[4] = ["#000000", "#e69f00", "#0072b2", "#009e73"] # as in doc/style.gp
array dash[4] = [1, 1, 1, 2]
points = 3 # per element and direction
format = "map"
load "doc/style.gp"
eval picture(dir . "half_bonded", 1200, 1000)
set multiplot
set lmargin at screen 0.09; set rmargin at screen 0.97; set tmargin at screen 0.97; set bmargin at screen 0.47
set xlabel angle_label
set ylabel torque_label
set xrange [0:10]
set yrange [0:60]
set key bottom right
plot for [i=1:4] dir . run[i] . "/torque.csv" using "angle_deg":"torque_Nmm" with lines linewidth 3 dashtype dash[i] \
  linecolor rgb colour[i] title name[i]
unset key
unset xlabel
unset ylabel
load "doc/paper/faces.gp"
eval colours_of("phi")
set pm3d corners2color c1 interpolate 1, 1 border retrace linewidth 1 # what jumps from point to point has no values in between
set cbrange [0:1]
set tmargin at screen 0.3
set bmargin at screen 0.03
do for [i=1:4] {
  set lmargin at screen 0.02 + 0.85 / 4 * (i - 1)
  set rmargin at screen 0.01 + 0.85 / 4 * i
  set title name[i] offset 0, -0.3 textcolor rgb colour[i]
  if (i == 4) {
    set colorbox user origin 0.88, 0.07 size 0.015, 0.19
    set cbtics 0.5
    set label 1 "{/:Italic φ}_0" at screen 0.8875, 0.3 center enhanced
  } else { unset colorbox }
  splot face(dir . run[i] . "/profiles.csv", "0.1", points) using "x_mm":"y_mm":"phi" with pm3d
}
unset multiplot
unset output
