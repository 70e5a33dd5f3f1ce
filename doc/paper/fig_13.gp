# Fig. 13: mean relative error over the load step on three meshes. Needs output/paper/table_7 (prm/paper/table_7.prm).
load "doc/paper/style.gp"
dir = "output/paper/table_7/"
set output dir . "fig_13.png"
set xlabel "Number of load steps"
set ylabel "{/:Italic e}_{rel}, Eq. (50), against closed form (b)"
set logscale x
set xrange [80:3000]
set yrange [0.011:0.0135]
set key top right
array steps[6] = [100, 200, 500, 1000, 2000, 2500]
# the mesh varies fastest: every third row is the same mesh
plot for [mesh=1:3] dir . "study.csv" using (steps[int(column("variant") - 1) / 3 + 1]):"e_rel" every 3::(mesh - 1) \
  with linespoints pointtype 3 + 2 * mesh linewidth 2 title word("coarse medium fine", mesh)
