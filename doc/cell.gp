# Sketch of an enriched cell for doc/explanation/contact.md, output/cell.png and cell.svg. At the top of the project:
#   gnuplot doc/cell.gp
azimuth = 28 * pi / 180; elevation = 24 * pi / 180
px(x, y, z) = x * cos(azimuth) + y * sin(azimuth)
py(x, y, z) = z * cos(elevation) + (y * cos(azimuth) - x * sin(azimuth)) * sin(elevation)
# quadratic B-splines on equal knots, in one element; control points 0 to 2 in both directions
N(i, t) = i == 0 ? (1 - t)**2 / 2. : i == 1 ? t * (1 - t) + 0.5 : t**2 / 2.
array H[9] = [0.02, 0.42, 0.05, 0.38, 0.95, 0.45, 0.00, 0.40, -0.05] # heights of the control points
height(s, t) = sum [i=0:2] sum [j=0:2] N(i, s) * N(j, t) * H[3 * j + i + 1]
X(s, t) = px(s, t, height(s, t)); Y(s, t) = py(s, t, height(s, t))
bottom = -1.0
control_x(i, j) = px(i - 0.5, j - 0.5, H[3 * j + i + 1]); control_y(i, j) = py(i - 0.5, j - 0.5, H[3 * j + i + 1])
text(x, y) = sprintf("at %g,%g", x, y)
set_arrow(tag, x, y, z, u, v, w) = sprintf("set arrow %d from %g,%g to %g,%g head filled size screen 0.012, 20 linewidth 2 \
  linecolor rgb '#000000' front", tag, px(x, y, z), py(x, y, z), px(x + u, y + v, z + w), py(x + u, y + v, z + w))

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/cell", 1000, 600)
  unset datafile columnheaders
  unset grid
  unset border
  unset tics
  set key at screen 0.99, 0.22
  set size ratio -1
  set xrange [-0.7:3.2]
  set yrange [-1.45:1.35]
  eval set_arrow(1, 0, 0, bottom, 0.4, 0, 0)
  eval set_arrow(2, 0, 0, bottom, 0, 0.5, 0)
  eval set_arrow(3, 0, 0, bottom, 0, 0, 0.35)
  set label 1 "{/:Italic ξ}" at px(0.42, 0, bottom), py(0.42, 0, bottom) - 0.1 front
  set label 2 "{/:Italic η}" at px(0, 0.5, bottom) + 0.02, py(0, 0.5, bottom) + 0.07 front
  set label 3 "{/:Italic ζ}" at px(0, 0, bottom + 0.35) - 0.1, py(0, 0, bottom + 0.35) front
  set samples 41
  plot sample [t=0:1] '+' using (X(0, t)):(Y(0, t)) with lines linewidth 3 linecolor rgb "#a08440" notitle, \
    for [k=1:4] [t=0:1] '+' using (X(k / 4., t)):(Y(k / 4., t)) with lines \
      linewidth (k % 4 == 0 ? 3 : 1) linecolor rgb (k % 4 == 0 ? "#a08440" : "#d8c48a") notitle, \
    for [k=0:4] [t=0:1] '+' using (X(t, k / 4.)):(Y(t, k / 4.)) with lines \
      linewidth (k % 4 == 0 ? 3 : 1) linecolor rgb (k % 4 == 0 ? "#a08440" : "#d8c48a") notitle, \
    for [k=0:1] [t=0:1] '+' using (px(k, t, bottom)):(py(k, t, bottom)) with lines linewidth 2 linecolor rgb "#555555" notitle, \
    for [k=0:1] [t=0:1] '+' using (px(t, k, bottom)):(py(t, k, bottom)) with lines linewidth 2 linecolor rgb "#555555" notitle, \
    for [k=0:3] [t=0:1] '+' using (t * X(k % 2, k / 2) + (1 - t) * px(k % 2, k / 2, bottom)): \
      (t * Y(k % 2, k / 2) + (1 - t) * py(k % 2, k / 2, bottom)) with lines linewidth 2 linecolor rgb "#555555" notitle, \
    for [j=0:2] [i=0:2:1] '+' using (control_x(int($1 + 0.5), j)):(control_y(int($1 + 0.5), j)) with lines \
      linewidth 1 dashtype 2 linecolor rgb blue notitle, \
    for [i=0:2] [j=0:2:1] '+' using (control_x(i, int($1 + 0.5))):(control_y(i, int($1 + 0.5))) with lines \
      linewidth 1 dashtype 2 linecolor rgb blue notitle, \
    [k=0:8:1] '+' using (control_x(int($1 + 0.5) % 3, int($1 + 0.5) / 3)):(control_y(int($1 + 0.5) % 3, int($1 + 0.5) / 3)) \
      with points pointtype 7 pointsize (1.4 * point) linecolor rgb blue title "control points {/:Bold x}_{/:Italic A} of the face", \
    [k=0:3:1] '+' using (px(int($1 + 0.5) % 2, int($1 + 0.5) / 2, bottom)):(py(int($1 + 0.5) % 2, int($1 + 0.5) / 2, bottom)) \
      with points pointtype 5 pointsize (1.4 * point) linecolor rgb red title "nodes {/:Bold x}_{/:Italic a} of FE\\_Q that stay", \
    [k=0:3:1] '+' using (X(int($1 + 0.5) % 2, int($1 + 0.5) / 2)):(Y(int($1 + 0.5) % 2, int($1 + 0.5) / 2)) \
      with points pointtype 64 pointsize (1.6 * point) linecolor rgb red title "nodes that follow the control points"
}
unset output
