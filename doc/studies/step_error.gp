# What steps lose where friction turns, for doc/studies/step_error.py, which runs the scenes.
dir = "output/step_error/"
order = dir . "order.csv"
codes = dir . "codes.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/step_error", 1400, 1250)
  set multiplot
  set logscale xy
  set format y "10^{%T}"

  set origin 0, 0.5
  set size 0.53, 0.5
  set title "At the ends of the steps"
  set xlabel "Steps in each phase"
  set ylabel "Largest error of six reactions"
  set xrange [8:300]
  set yrange [1e-7:0.5]
  set key at screen 0.58, 0.94 top left maxcols 1
  cases = "'rigid bodies: shear then twist' 'shear then twist' 'the same with the bone as slave' 'a cap' 'pressed and turned at once' 'pressure to and fro' 'fretting' 'circle'"
  only(name) = strcol("case") eq name ? column("error") : NaN
  plot for [i=1:words(cases)] order using "steps":(only(word(cases, i))) with linespoints linetype 1 + (i - 1) % 6 dashtype 1 + (i > 6 ? 1 : 0) pointtype 3 + i title word(cases, i), \
    order using "steps":(only("trial")) with linespoints dashtype 2 linecolor rgb grey pointtype 2 \
      title "{/:Italic Slip direction = trial}", \
    [10:200] 3e-3 * (10 / x)**2 with lines dashtype 3 linecolor rgb "#000000" title "second order"

  set ylabel "Largest error of force, torque"
  set yrange [1e-5:1]
  set key at screen 0.5, 0.01 bottom center maxrows 1 width 1
  set bmargin 5.5
  code(name) = strcol("code") eq name ? column("error") : NaN
  do for [over in "steps seconds"] {
    set origin (over eq "steps" ? 0 : 0.5), 0
    set size 0.5, 0.5
    set title "Curve as drawn, over " . (over eq "steps" ? "steps" : "time")
    set xlabel (over eq "steps" ? "Steps in each phase" : "Seconds of the process")
    set xrange [over eq "steps" ? 4 : 0.4 : over eq "steps" ? 400 : 200]
    x(value) = over eq "steps" && strcol("code") eq "debond adaptive" ? 0.5 * value : value
    plot codes using (x(column(over))):(code("debond adaptive")) with linespoints linetype 1 title "adaptive", \
      codes using over:(code("debond integrated")) with linespoints linetype 2 title "planned steps", \
      codes using over:(code("debond trial")) with linespoints linetype 4 title "{/:Italic trial}", \
      codes using over:(code("CalculiX")) with linespoints linetype 3 pointtype 6 title "CalculiX"
    unset key
  }
  unset multiplot
}
unset output
