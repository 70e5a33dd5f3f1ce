# Two variants of the method that go wrong, output/stability/slip_direction.png: left the direction of slip, right the friction
# coefficient. Called by doc/stability/stability.sh --draw, which makes the runs.
results(name) = "output/stability/" . name . "/torque.csv"
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/stability/slip_direction", 1400, 640)
  set linetype 10 linecolor rgb "#bbbbbb" linewidth 5
  set multiplot layout 1, 2
  set xlabel angle_label
  set ylabel torque_label

  set title "Direction of slip, by step"
  set xrange [0:10]
  set yrange [0:70]
  plot results("integrated") using "angle_deg":"torque_Nmm" with lines linetype 10 title "integrated, 0.1°", \
    results("previous_gap_fine") using "angle_deg":"torque_Nmm" with lines linetype 2 title "previous gap, 0.1°", \
    results("previous_gap") using "angle_deg":"torque_Nmm" with lines linetype 4 title "previous gap, 0.2°"

  set title "Friction coefficient, by step"
  set xrange [0.4:2.2]
  set xtics 0.4
  set yrange [36:66]
  plot results("implicit") using "angle_deg":"torque_Nmm" with lines linetype 10 title "implicit, 0.01°", \
    results("explicit_1000") using "angle_deg":"torque_Nmm" with lines linetype 1 title "explicit, 0.01°", \
    results("explicit_100") using "angle_deg":"torque_Nmm" with lines linetype 2 title "explicit, 0.1°", \
    results("explicit_50") using "angle_deg":"torque_Nmm" with lines linetype 4 title "explicit, 0.2°"
  unset multiplot
}
unset output
