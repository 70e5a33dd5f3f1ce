# Newton iterations of the main scene in 101 steps over the stiffness of the interface, output/stability/penalty.png. Called by
# doc/stability/stability.sh --draw, which makes the runs.
data = "output/stability/penalty.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/stability/penalty", 1000, 600)
  set logscale x
  set format x "10^{%L}"
  set xlabel "Normal stiffness ε_n [MPa/mm]"
  set ylabel "Newton iterations in 101 steps"
  set yrange [0:]
  set xrange [3:1e6]
  unset key
  plot data using 1:"iterations" with linespoints pointtype 7
}
unset output
