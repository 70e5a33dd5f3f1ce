# Newton iterations of the main scene in 101 steps over the stiffness of the interface, output/stability/penalty.png. Called by
# doc/stability/stability.sh --draw, which makes the runs.
load "doc/paper/style.gp"
set output "output/stability/penalty.png"
set logscale x
set format x "%.0f"
set xlabel "Penalty stiffness [MPa/mm]"
set ylabel "Newton iterations in 101 steps"
set yrange [0:]
set xrange [3:1e6]
set rmargin 6
set key top left
data = "output/stability/penalty.csv"
plot data using 1:"extrapolate" with linespoints pointtype 7 linecolor rgb "#1f4e9c" title "extrapolate (default)", \
  data using 1:"rigid" with linespoints pointtype 6 linecolor rgb "#c0392b" title "rigid", \
  data using 1:"stick first" with linespoints pointtype 5 linecolor rgb "#2e8b57" title "stick first", \
  data using 1:"none" with linespoints pointtype 4 linecolor rgb "#e08e0b" title "none"
