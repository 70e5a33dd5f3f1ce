# Newton iterations of the main scene in 101 steps over the stiffness of the interface, output/stability/penalty.png. Called by
# doc/stability/stability.sh --draw, which makes the runs.
data = "output/stability/penalty.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/stability/penalty", 1000, 600)
  set logscale x
  set format x "10^{%L}"
  set xlabel "Penalty stiffness [MPa/mm]"
  set ylabel "Newton iterations in 101 steps"
  set yrange [0:]
  set xrange [3:1e6]
  set key top left
  plot data using 1:"extrapolate" with linespoints pointtype 7 title "extrapolate (default)", \
    data using 1:"rigid" with linespoints pointtype 6 title "rigid", \
    data using 1:"stick first" with linespoints pointtype 5 title "stick first", \
    data using 1:"none" with linespoints pointtype 8 title "none"
}
unset output
