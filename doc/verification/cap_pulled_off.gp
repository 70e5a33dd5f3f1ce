# Pull-off force of a cap over Maugis' parameter, output/cap_pulled_off.png. Needs the results of prm/verification/cap_pulled_off.prm:
# doc/verification/cap_pulled_off.sh runs it.
exact = "prm/verification/data/cap_pulled_off.csv"
array E[6] = [10000, 4000, 2000, 1000, 500, 200]
set print $ours
print "lambda,pull"
w = exp(1) * 5 * 0.005
lambda(E) = 10 * (50 / (pi * w * (4. / 3 * E / 0.91)**2))**(1. / 3)
set datafile separator comma
set datafile columnheaders
do for [i=1:6] {
  stats sprintf("output/cap_pulled_off/variant-%03d/reactions.csv", i) using "force_N" nooutput
  print sprintf("%g,%g", lambda(E[i]), -STATS_min / (pi * w * 50))
}
unset print
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/cap_pulled_off_force", 1000, 600)
  set logscale x
  set xrange [0.03:5]
  set xtics (0.03, 0.1, 0.3, 1, 3)
  set yrange [1.45:2.05]
  set xlabel "Maugis' parameter λ (left: stiff bone, right: soft bone)"
  set ylabel "Largest pull / ({/:Italic π w R_c})"
  set key bottom left at graph 0.01, 0.12
  set label "DMT" at 3.6, 2.02
  set label "JKR" at 3.6, 1.48
  plot 2 with lines linetype 3 dashtype 2 linecolor rgb grey notitle, 1.5 with lines linetype 3 dashtype 2 linecolor rgb grey notitle, \
    exact using "lambda":"dugdale" with lines linetype 1 title "Maugis: constant strength", \
    exact using "lambda":"exponential" with lines linetype 2 title "reference: the law adhesive", \
    $ours using "lambda":"pull" with points linetype 4 pointsize (1.3 * point) title "debond, {/:Italic E} = 10000 ... 200 MPa"
}
unset output
