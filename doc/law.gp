# The friction law of doc/explanation/interface.md, output/law.png and law.svg. At the top of the project:
#   gnuplot doc/law.gp
a = 22.; b = 0.74; unbroken = 0.58; broken = 0.40 # data set 1: [um], and dimensionless
s(g, b) = g < a ? 1. : g > (1. + 2. * b) * a ? 0. : 0.5 - 0.5 * sin(pi / (2. * b) * (g / a - b - 1.))
mu(g, phi_0) = broken + phi_0 * s(g, b) * (unbroken - broken)
end = (1. + 2. * b) * a

do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/law", 1200, 460)
  set multiplot layout 1, 2
  set xrange [0:100]
  set xtics 20
  set xlabel "Sliding distance {/:Italic g}_s [µm]"
  set samples 301
  set arrow 1 from a, graph 0 to a, graph 1 nohead dashtype 2 linecolor rgb grey back
  set label 1 "{/:Italic a}_s" at a, graph 0.05 offset -0.5, 0 right
  set key top right
  set ylabel "Bonding state {/:Italic φ} / {/:Italic φ}_0"
  set yrange [0:1.05]
  plot s(x, 0.3) linetype 2 title "{/:Italic b}_s = 0.3", s(x, b) linetype 1 title "{/:Italic b}_s = 0.74", \
    s(x, 1.5) linetype 3 title "{/:Italic b}_s = 1.5"
  set arrow 2 from end, graph 0 to end, graph 1 nohead dashtype 2 linecolor rgb grey back
  set label 2 "(1 + 2 {/:Italic b}_s) {/:Italic a}_s" at end, graph 0.05 offset 0.5, 0 left
  set ylabel "Friction coefficient {/:Italic μ}"
  set yrange [0.35:0.60]
  set arrow 3 from 0, broken to 100, broken nohead dashtype 3 linecolor rgb grey back
  set label 3 "{/:Italic μ}_b" at 98, broken offset 0, -0.7 right
  set label 4 "{/:Italic μ}_{ub}" at 98, unbroken offset 0, 0.6 right
  set arrow 4 from 0, unbroken to 100, unbroken nohead dashtype 3 linecolor rgb grey back
  set key at graph 0.98, 0.85
  plot mu(x, 1.) linetype 1 title "{/:Italic φ}_0 = 1", mu(x, 0.5) linetype 3 title "{/:Italic φ}_0 = 0.5", \
    mu(x, 0.) linetype 2 title "{/:Italic φ}_0 = 0"
  unset multiplot
}
unset output
