# Error over seconds for every stiffness of the interface, for doc/studies/stiffness.py.
dir = "output/studies/"
table = dir . "stiffness.csv"
families = "'trilinear' 'quadratic graded to the rim' 'splines' 'splines graded to the rim' 'splines that follow the rim'"
labels = "'trilinear' 'quadratic, graded' 'splines' 'splines, graded' 'splines, fitted'"
colours = "blue sky green orange red"
stiffnesses = "622 1800 1e4 1e5 1e6"
spoken = "622 1800 10^4 10^5 10^6 MPa/mm"
array symbol[5] = [5, 13, 9, 11, 7]
do for [format in "png svg"] {
  load "doc/style.gp"
  set logscale xy
  set format y "10^{%L}"
  set xrange [0.5:90]
  set yrange [5e-5:0.2]
  set xtics (1, 10)
  eval picture(dir . "stiffness", 1500, 640)
  set multiplot
  left = 0.085; width = 0.178
  do for [k=1:5] {
    set lmargin at screen left + (k - 1) * (width + 0.005)
    set rmargin at screen left + (k - 1) * (width + 0.005) + width
    set bmargin at screen 0.3; set tmargin at screen 0.89
    set title "ε = " . word(spoken, k) . (k == 5 ? " MPa/mm" : "") offset 0, -0.4
    if (k == 1) { set ylabel "Largest torque error / {/:Italic T}_{max}" offset 1; set format y "10^{%L}" } else { unset ylabel; set format y "" }
    if (k == 3) { set xlabel "Seconds of the process on one thread, with its start" } else { unset xlabel }
    if (k == 3) { set key at screen 0.5, 0.02 bottom center maxrows 2 samplen 2 width 2 } else { unset key }
    plot for [f=1:5] table using (strcol("stiffness") eq word(stiffnesses, k) && strcol("family") eq word(families, f) ? column("seconds") : NaN):"error" \
      with linespoints pointtype symbol[f] pointsize (1.4 * point) linewidth 1.5 linecolor rgb value(word(colours, f)) title word(labels, f)
  }
  unset multiplot
}
unset output
