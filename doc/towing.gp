# Sketch of a point that tows its interacting point, for doc/explanation/contact.md, output/towing.png and towing.svg. At the top of the project:
#   gnuplot doc/towing.gp
L = 0.5; turn = 1.5; n = 300 # length of the gap over the radius of the path; angle of the path [rad]
alpha = 1.45                 # from the path's direction to the gap, at the beginning
set print $towed
print "x,y,anchor_x,anchor_y,angle"
do for [i = 0:n] {
  t = turn * i / n
  x = sin(t); y = cos(t)    # clockwise, beginning to the right
  angle = alpha - t
  print sprintf("%g,%g,%g,%g,%g", x, y, x - L * cos(angle), y - L * sin(angle), t)
  alpha = alpha + turn / n * (1. - sin(alpha) / L)
  if (i == 100) { x_1 = x; y_1 = y; g_x = L * cos(angle); g_y = L * sin(angle); t_1 = t; alpha_1 = alpha }
}
unset print
end_x = x_1 + 0.42 * cos(t_1); end_y = y_1 - 0.42 * sin(t_1)

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/towing", 900, 560)
  unset border; unset tics; unset grid; unset key
  set size ratio -1
  set xrange [-0.35:1.6]; set yrange [0:1.15]
  set arrow 1 from x_1, y_1 to end_x, end_y linewidth 2 linecolor rgb "#0072B2" front
  set arrow 2 from x_1 - g_x, y_1 - g_y to x_1, y_1 linewidth 3 linecolor rgb "#D55E00" front
  set object 1 circle at x_1, y_1 size 0.2 arc [-t_1 * 180 / pi : (alpha_1 - t_1) * 180 / pi] \
    nowedge fillstyle empty border linecolor rgb "#000000" linewidth 1.5 front
  set arrow 3 from x_1, y_1 to x_1 + g_x * 0.55, y_1 + g_y * 0.55 nohead linewidth 1 dashtype 2 linecolor rgb "#D55E00" front
  set label 1 "{/:Bold x}" at x_1 - 0.015, y_1 + 0.055 right front
  set label 2 "{/:Bold y}({/:Italic ξ̂})" at x_1 - g_x - 0.09, y_1 - g_y + 0.01 right front
  set label 3 "{/:Bold g}" at x_1 - 0.62 * g_x - 0.03, y_1 - 0.62 * g_y + 0.01 right front
  set label 7 "length of {/:Bold g}: {/:Italic L} = {/:Italic μ p} / {/:Italic ε}_t" at 1.1, 1.0 left front
  set label 4 "{/:Italic α}" at x_1 + 0.23 * cos(alpha_1 / 2 - t_1), y_1 + 0.23 * sin(alpha_1 / 2 - t_1) left front
  set label 5 "path of the point," at 1.0, 0.5 left front
  set label 8 "seen from the master" at 1.0, 0.43 left front
  set label 6 "path of the\ninteracting point" at 0.0, 0.36 left front
  plot $towed using 1:2 with lines linewidth 2 linecolor rgb "#0072B2", \
       $towed using 3:4 with lines linewidth 2 linecolor rgb "#555555", \
       $towed every 30 using 1:2:($3-$1):($4-$2) with vectors nohead linewidth 0.8 linecolor rgb "#BBBBBB"
  unset output
}
