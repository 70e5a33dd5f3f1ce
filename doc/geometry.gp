# Sketch of geometry, frames and kinematics for doc/explanation, output/geometry.png and geometry.svg. At the top of the project:
#   gnuplot doc/geometry.gp
R = 2.5; H = 3.; L = 12.5; D = 5. # of the main scene [mm]
# seen from above, x to the right, y to the back
azimuth = 25 * pi / 180; elevation = 24 * pi / 180
px(x, y, z) = x * cos(azimuth) + y * sin(azimuth)
py(x, y, z) = z * cos(elevation) + (y * cos(azimuth) - x * sin(azimuth)) * sin(elevation)
corner(x, y, z) = sprintf("%g,%g", px(x, y, z), py(x, y, z))
face(n, a, b, c, d, colour) = sprintf("set object %d polygon from %s to %s to %s to %s to %s fillcolor rgb '%s' fillstyle solid \
  border linecolor rgb '#555555' back", n, a, b, c, d, a, colour)
vector(x, y, z, u, v, w) = sprintf("from %s to %s", corner(x, y, z), corner(x + u, y + v, z + w))
h = L / 2
# the front half of a circle of the implant, t in [0, 1], and a whole one, t in [0, 2 pi]
front_x(t) = px(R * cos(azimuth + pi * (t - 1)), R * sin(azimuth + pi * (t - 1)), 0)
front_y(t, z) = py(R * cos(azimuth + pi * (t - 1)), R * sin(azimuth + pi * (t - 1)), z)
circle_x(r, t) = px(r * cos(t), r * sin(t), 0)
circle_y(r, t, z) = py(r * cos(t), r * sin(t), z)
# the two surfaces of the right panel, and the point of each
bone(s) = 0.18 * sin(0.7 * s) - 0.02 * s * s
implant(s) = bone(s) - 0.75 + 0.06 * s
slope(s) = 0.126 * cos(0.7 * s) - 0.04 * s
s_n = -1.5; s_1 = 0.25; s_x = 1.9
length = sqrt(1 + slope(s_1)**2)
n_x = -slope(s_1) / length; n_y = 1 / length
x_y = implant(s_x)
normal_gap = (s_x - s_1) * n_x + (x_y - bone(s_1)) * n_y

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/geometry", 1500, 740)
  unset grid
  unset border
  unset tics
  unset key
  set size ratio -1
  set style arrow 1 head filled size screen 0.008, 20 linewidth 2 linecolor rgb blue front
  set style arrow 2 head filled size screen 0.008, 20 linewidth 2 linecolor rgb red front
  set style arrow 3 heads size screen 0.006, 20 linewidth 1 linecolor rgb "#555555" front
  set style arrow 4 head filled size screen 0.008, 20 linewidth 2 linecolor rgb "#000000" front
  set multiplot

  # ---- bodies and chuck
  set origin 0, 0
  set size 0.57, 1
  set lmargin 0
  set rmargin 0
  set tmargin 3
  set bmargin 0
  set label 30 "Bodies, frame and chuck" at screen 0.285, 0.95 center
  set xrange [-10.4:10.8]
  set yrange [-9.2:9.3]
  eval face(1, corner(-h, -h, 0), corner(h, -h, 0), corner(h, h, 0), corner(-h, h, 0), "#f3ead2")
  eval face(2, corner(-h, -h, -D), corner(h, -h, -D), corner(h, -h, 0), corner(-h, -h, 0), "#e3d5b0")
  eval face(3, corner(h, -h, -D), corner(h, h, -D), corner(h, h, 0), corner(h, -h, 0), "#d3c294")
  eval "set arrow 1 " . vector(-h, -h - 0.6, -D, L, 0, 0) . " arrowstyle 3"
  set label 1 "12.5 mm" at px(0, -h - 0.6, -D), py(0, -h - 0.6, -D) offset 0, -1 center
  eval "set arrow 2 " . vector(h + 0.6, -h, -D, 0, L, 0) . " arrowstyle 3"
  set label 2 "12.5 mm" at px(h + 0.6, 0, -D), py(h + 0.6, 0, -D) offset 1, -0.7 left
  eval "set arrow 3 " . vector(-h - 0.4, -h, -D, 0, 0, D) . " arrowstyle 3"
  set label 3 "5 mm" at px(-h - 0.4, -h, -D / 2), py(-h - 0.4, -h, -D / 2) offset -0.8, 0 right
  set label 4 "Bone: bottom fixed,\nsides held normal to them" at px(-h + 0.25, -h, -D / 2), py(-h + 0.25, -h, -D / 2 + 0.4) left front
  eval "set arrow 4 " . vector((R + 0.4) * cos(azimuth), (R + 0.4) * sin(azimuth), 0, 0, 0, H) . " arrowstyle 3"
  set label 5 "3 mm" at px((R + 0.7) * cos(azimuth), (R + 0.7) * sin(azimuth), 0.58 * H), \
    py((R + 0.7) * cos(azimuth), (R + 0.7) * sin(azimuth), 0.58 * H) left front
  eval "set arrow 5 " . vector(0, 0, 0, R * cos(-0.2), R * sin(-0.2), 0) . " arrowstyle 3"
  set label 6 "{/:Italic R} = 2.5 mm" at px(R + 0.25, 0.2, 0), py(R + 0.25, 0.2, 0) left front
  set label 7 "contact face, {/:Italic z} = 0" at px(0.9, -4.6, 0), py(0.9, -4.6, 0) center front
  # frame of the bone, which is that of space
  do for [d=1:3] {
    eval sprintf("set arrow %d ", 5 + d) . vector(-6.0, -3.2, 0, d == 1 ? 1.9 : 0, d == 2 ? 2.6 : 0, d == 3 ? 2 : 0) . " arrowstyle 4"
    set label 7 + d "{/:Italic " . word("x y z", d) . "}" front \
      at px(-6.0 + (d == 1 ? 2.3 : 0), -3.2 + (d == 2 ? 3.4 : 0), d == 3 ? 2.6 : 0), \
      py(-6.0 + (d == 1 ? 2.3 : 0), -3.2 + (d == 2 ? 3.4 : 0), d == 3 ? 2.6 : 0) center
  }
  # chuck: translations, and the senses of the rotations
  set label 20 "" at px(0, 0, H), py(0, 0, H) point pointtype 7 pointsize (1.2 * point) linecolor rgb "#000000" front
  set label 21 "{/:Bold C}" at px(0, 0, H), py(0, 0, H) offset -1.5, -0.7 front
  eval "set arrow 20 " . vector(0, 0, H, 4.2, 0, 0) . " arrowstyle 1"
  eval "set arrow 21 " . vector(0, 0, H, 0, 5.2, 0) . " arrowstyle 1"
  eval "set arrow 22 " . vector(0, 0, H, 0, 0, 3.4) . " arrowstyle 1"
  set label 22 "{/:Italic u}_x, {/:Italic a}_x" at px(4.5, 0, H), py(4.5, 0, H) offset -0.5, 0.8 left textcolor rgb blue front
  set label 23 "{/:Italic u}_y, {/:Italic a}_y" at px(0, 5.4, H), py(0, 5.4, H) offset 0.5, 0.2 left textcolor rgb blue front
  set label 24 "{/:Italic u}_z" at px(0, 0, H + 3.4), py(0, 0, H + 3.4) offset -1, 0 right textcolor rgb blue front
  set label 25 "{/:Italic γ}" at px(0, 0, H + 2.1), py(0, 0, H + 2.1) offset -5, 0 right textcolor rgb red front
  set label 26 "Implant: its top face is the chuck,\n{/:Bold x} = {/:Bold C} + {/:Bold u} + {/:Bold Q} ({/:Bold X} - {/:Bold C} + {/:Bold v}),\n{/:Bold Q} = exp(skew({/:Bold a})) {/:Bold R}_z({/:Italic γ})" \
    at graph 0.02, 0.985 left front
  # the cylinder: its side, then its top, then the hidden part of the contact face
  plot sample [t=0:1:1./60] '+' using (front_x(t)):(front_y(t, 0)):(front_y(t, H)) with filledcurves linecolor rgb "#b9c4cf", \
    [t=0:2*pi:0.05] '+' using (circle_x(R, t)):(circle_y(R, t, H)) with filledcurves closed linecolor rgb "#dbe2e9", \
    [t=0:2*pi:0.05] '+' using (circle_x(R, t)):(circle_y(R, t, H)) with lines linewidth 1 linecolor rgb "#555555", \
    [t=0:2*pi:0.05] '+' using (circle_x(R, t)):(circle_y(R, t, 0)) with lines linewidth 1 dashtype 2 linecolor rgb "#555555", \
    [t=0:1] '+' using (front_x(t)):(front_y(t, 0)) with lines linewidth 1 linecolor rgb "#555555", \
    [t=-3.8:0.7] '+' using (circle_x(1.1, t)):(circle_y(1.1, t, H + 2)) with lines linecolor rgb red
  unset object
  unset arrow
  unset label

  # ---- a quadrature point
  set origin 0.57, 0
  set size 0.43, 1
  set label 30 "A quadrature point, gap exaggerated" at screen 0.785, 0.95 center
  set xrange [-3.5:3.5]
  set yrange [-4.3:2.7]
  set label 1 "Implant (slave)" at -3.0, 1.6 left front
  set label 2 "Bone (master)" at -3.0, -2.2 left front
  set arrow 1 from s_1, bone(s_1) to s_1 + 1.5 * n_x, bone(s_1) + 1.5 * n_y arrowstyle 4
  set label 3 "{/:Bold n}" at s_1 + 1.5 * n_x, bone(s_1) + 1.5 * n_y offset 1, 0 left front
  set arrow 2 from s_1, bone(s_1) to s_x, x_y arrowstyle 2
  set label 4 "{/:Bold g}" at (s_1 + s_x) / 2, (bone(s_1) + x_y) / 2 offset 0.8, 1 textcolor rgb red front
  set arrow 3 from s_1, bone(s_1) to s_1 + normal_gap * n_x, bone(s_1) + normal_gap * n_y arrowstyle 1
  set label 5 "{/:Italic g}_n {/:Bold n}" at s_1 + normal_gap * n_x / 2, bone(s_1) + normal_gap * n_y / 2 offset -1, -0.2 right textcolor rgb blue front
  set arrow 4 from s_1 + normal_gap * n_x, bone(s_1) + normal_gap * n_y to s_x, x_y arrowstyle 1
  set label 6 "{/:Bold g}_t" at (s_1 + s_x) / 2, x_y offset 0, -1.5 center textcolor rgb blue front
  set label 7 "{/:Bold x}" at s_x, x_y offset 0.9, 0.7 point pointtype 7 pointsize (1.4 * point) linecolor rgb "#000000" front
  set label 8 "{/:Bold y}({/:Italic ξ̂})" at s_1, bone(s_1) offset 1.2, 1 point pointtype 7 pointsize (1.4 * point) linecolor rgb "#000000" front
  set label 9 "{/:Bold y}({/:Italic ξ̂}^{ n})" at s_n, bone(s_n) offset -1, -1.5 point pointtype 6 pointsize (1.4 * point) linecolor rgb "#000000" front
  set label 10 "slip of this step" at (s_n + s_1) / 2 - 0.55, 0.75 center textcolor rgb green front
  set label 11 "{/:Bold g} = {/:Bold x} - {/:Bold y}({/:Italic ξ̂}) = {/:Italic g}_n {/:Bold n} + {/:Bold g}_t\nclosed while {/:Italic g}_n < 0: {/:Italic p} = -ε_n {/:Italic g}_n,\n{/:Bold t}_t = ε_t {/:Bold g}_t,  |{/:Bold t}_t| ≤ {/:Italic μ p}" \
    at 0.1, -3.0 center front
  plot sample [s=-3.2:3.4] '+' using (s):(implant(s)):(2.2) with filledcurves fillcolor rgb 0x88dbe2e9 notitle, \
    [s=-3.2:3.4] '+' using (s):(bone(s)):(-2.7) with filledcurves fillcolor rgb 0x88e3d5b0 notitle, \
    [s=-3.2:3.4] '+' using (s):(implant(s)) with lines linecolor rgb "#5a7894", \
    [s=-3.2:3.4] '+' using (s):(bone(s)) with lines linecolor rgb "#a08440", \
    [s=s_n:s_1] '+' using (s):(bone(s) + 0.12) with lines linewidth 3 linetype 3
  unset multiplot
}
unset output
