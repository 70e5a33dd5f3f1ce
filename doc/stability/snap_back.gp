# A brittle bond that snaps back, output/stability/snap_back.png: left under a compliant machine, right under a soft implant. Called by
# doc/stability/stability.sh --draw, which makes the runs.
results(name) = "output/stability/" . name . "/torque.csv"
k = 3000 * pi / 180 # of the machine [N mm/deg]
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/stability/snap_back", 1400, 640)
  set linetype 10 linecolor rgb "#bbbbbb" linewidth 5
  set multiplot layout 1, 2
  set ylabel torque_label
  eval key_below(1, -1)
  set yrange [24:52]

  set title "Rigid bodies, machine of 3000 N mm/rad"
  set xlabel "Angle of the machine [°]"
  set xrange [0.7:1.6]
  set xtics 0.2
  plot results("snap_back_closed_form") using (column("angle_deg") + column("torque_Nmm") / k):"torque_Nmm" with lines \
      linetype 10 title "closed form", \
    results("snap_back") using "machine_angle_deg":"torque_Nmm" with linespoints linewidth 1 pointtype 6 pointsize (0.6 * point) linetype 4 \
      title "rotation control", \
    results("snap_back_viscous") using "machine_angle_deg":"torque_Nmm" with lines linetype 3 title "viscosity", \
    results("snap_back_path") using "machine_angle_deg":"torque_Nmm" with points pointsize (0.5 * point) linetype 1 title "path following"

  set title "Soft implant, rigid machine"
  set xlabel "Angle of the chuck [°]"
  set xrange [0.7:1.1]
  set xtics 0.1
  unset key
  plot results("snap_back_bulk_jump") using "angle_deg":"torque_Nmm" with linespoints linewidth 1 pointtype 6 pointsize (0.6 * point) linetype 4 \
      title "rotation control", \
    results("snap_back_bulk") using "angle_deg":"torque_Nmm" with linespoints linewidth 1 pointsize (0.5 * point) linetype 1 \
      title "path following"
  unset multiplot
}
unset output
