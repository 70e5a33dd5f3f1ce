# Two variants of the method that go wrong, output/stability/slip_direction.png: left the direction of slip, right the friction
# coefficient. Called by doc/stability/stability.sh --draw, which makes the runs.
load "doc/paper/style.gp"
set terminal pngcairo size 1500,620 enhanced font "Sans,14" linewidth 1.5
set output "output/stability/slip_direction.png"
set multiplot layout 1, 2
set xlabel "Angle [deg]"
set ylabel "Torque [N mm]"
results(name) = "output/stability/" . name . "/torque.csv"

set title "Direction of slip"
set xrange [0:10]
set yrange [0:60]
plot results("trial") using "angle_deg":"torque_Nmm" with lines linewidth 4 linecolor rgb "#bbbbbb" \
    title "trial gap, steps of 0.1 deg", \
  results("previous_gap_fine") using "angle_deg":"torque_Nmm" with lines linecolor rgb "#e08e0b" \
    title "previous gap, steps of 0.01 deg", \
  results("previous_gap") using "angle_deg":"torque_Nmm" with lines linecolor rgb "#c0392b" \
    title "previous gap, steps of 0.1 deg"

set title "Friction coefficient"
set xrange [0.4:2.2]
set yrange [36:56]
plot results("implicit") using "angle_deg":"torque_Nmm" with lines linewidth 4 linecolor rgb "#bbbbbb" \
    title "implicit, steps of 0.01 deg", \
  results("explicit_1000") using "angle_deg":"torque_Nmm" with lines linecolor rgb "#1f4e9c" \
    title "explicit, steps of 0.01 deg", \
  results("explicit_100") using "angle_deg":"torque_Nmm" with lines linecolor rgb "#e08e0b" \
    title "explicit, steps of 0.1 deg", \
  results("explicit_50") using "angle_deg":"torque_Nmm" with lines linecolor rgb "#c0392b" \
    title "explicit, steps of 0.2 deg"
unset multiplot
