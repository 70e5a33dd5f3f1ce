# Fig. 13 and Table 7: mean relative errors over the load step on three meshes. Needs output/paper/table_7
# (prm/paper/table_7.prm).
dir = "output/paper/table_7/"
array steps[6] = [100, 200, 500, 1000, 2000, 2500]
# Table 7, and e_rel at 0.01 degrees
array published[3] = ['100,2.233\n200,2.242\n500,2.239\n1000,2.240\n2000,2.241\n2500,2.241', \
  '100,2.195\n200,2.197\n500,2.191\n1000,2.190\n2000,2.190\n2500,2.190', \
  '100,2.186\n200,2.185\n500,2.177\n1000,2.176\n2000,2.176\n2500,2.176']
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture(dir . "fig_13", 1400, 640)
  set multiplot layout 1, 2
  set xlabel "Number of load steps"
  set logscale x
  set xrange [80:3200]
  do for [part=1:2] {
    quantity = part == 1 ? "e_rel" : "e_mp"
    set title (part == 1 ? "Fig. 13" : "Table 7")
    set ylabel (part == 1 ? "{/:Italic e}_{rel}, Eq. (50) [%]" : "{/:Italic e}_{mp}, Eq. (19) [%]")
    set yrange [(part == 1 ? 1 : 1.5):(part == 1 ? 2 : 2.5)]
    if (part == 1) { eval key_below(1, 2) } else { unset key }
    # the mesh varies fastest: every third row is the same mesh
    plot for [mesh=1:3] dir . "study.csv" using (steps[int(column("variant") - 1) / 3 + 1]):(100 * column(quantity)) \
      every 3::(mesh - 1) with linespoints pointtype 3 + 2 * mesh title word("coarse medium fine", mesh), \
      for [mesh=1:3] marks(part == 2 ? published[mesh] : word('1000,1.75 1000,1.71 1000,1.70', mesh)) with points \
      linestyle 1 pointtype 2 + 2 * mesh pointsize (1.2 * point) title mesh == 1 ? "published" : ""
  }
  unset multiplot
}
unset output
