# What steps lose where friction turns, for doc/studies/step_error.py, which runs the scenes.
dir = "output/step_error/"
order = dir . "order.csv"
codes = dir . "codes.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/step_error", 1500, 640)
  set multiplot layout 1, 2
  set logscale xy
  set format y "10^{%T}"

  set title "At the ends of the steps"
  set xlabel "Steps in each phase"
  set ylabel "Largest error of the six reactions"
  set xrange [8:300]
  set yrange [1e-9:0.5]
  set key bottom left font ",12"
  cases = "'shear then twist, rigid' 'shear then twist' 'the same, bone as slave' 'a cap' 'pressed and turned at once' 'pressure to and fro' 'fretting' 'circle'"
  only(name) = strcol("case") eq name ? column("error") : NaN
  plot for [i=1:words(cases)] order using "steps":(only(word(cases, i))) with linespoints linetype i pointtype 3 + i title word(cases, i), \
    order using "steps":(only("the same, trial direction")) with linespoints dashtype 2 linecolor rgb grey pointtype 2 \
      title "shear then twist, {/:Italic Slip direction = trial}", \
    [10:200] 3e-3 * (10 / x)**2 with lines dashtype 3 linecolor rgb "#000000" title "second order"

  set title "The curve as it is drawn"
  set xlabel "Seconds of the run"
  set ylabel "Largest error of force and torque"
  set xrange [0.03:100]
  set yrange [1e-5:1]
  set key top right font ",12"
  code(name) = strcol("code") eq name ? column("error") : NaN
  plot codes using "seconds":(code("debond, adaptive")) with linespoints linetype 1 title "debond, adaptive", \
    codes using "seconds":(code("debond, integrated")) with linespoints linetype 2 title "debond, planned steps", \
    codes using "seconds":(code("debond, trial")) with linespoints linetype 4 title "debond, {/:Italic Slip direction = trial}", \
    codes using "seconds":(code("CalculiX")) with linespoints linetype 3 pointtype 6 title "CalculiX"
  unset multiplot
}
unset output
