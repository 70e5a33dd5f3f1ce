# The lateral force on a cap that slides without friction, output/stability/chatter.png. Called by doc/stability/stability.sh
# --draw, which makes the runs.
results(name) = "output/stability/" . name . "/reactions.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/stability/chatter", 1000, 600)
  set xlabel "Path of the cap, two cells of the bone [mm]"
  set ylabel "Lateral force, 77 N press [mN]"
  set yrange [-15:20]
  set key top right
  plot results("bilinear") using "chuck_ux_mm":(column("time") < 1 ? NaN : 1e3 * column("chuck_Fx_N")) with linespoints \
      pointsize (0.5 * point) linetype 4 title "bilinear bone", \
    results("nurbs") using "chuck_ux_mm":(column("time") < 1 ? NaN : 1e3 * column("chuck_Fx_N")) with linespoints \
      pointsize (0.5 * point) linetype 1 title "NURBS"
}
unset output
