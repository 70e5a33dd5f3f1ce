# The lateral force on a cap that slides without friction, output/stability/chatter.png. Called by doc/stability/stability.sh
# --draw, which makes the runs.
load "doc/paper/style.gp"
set output "output/stability/chatter.png"
set xlabel "Way of the cap [mm], two cells of the bone"
set ylabel "Lateral force [N], of 77 N that press"
set yrange [-0.015:0.02]
set key top right
results(name) = "output/stability/" . name . "/torque.csv"
plot results("bilinear") using "chuck_ux_mm":(column("time") < 1 ? NaN : column("chuck_Fx_N")) with linespoints \
    pointtype 7 pointsize 0.4 linecolor rgb "#c0392b" title "bilinear bone", \
  results("nurbs") using "chuck_ux_mm":(column("time") < 1 ? NaN : column("chuck_Fx_N")) with linespoints \
    pointtype 7 pointsize 0.4 linecolor rgb "#1f4e9c" title "NURBS"
