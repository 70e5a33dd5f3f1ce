# Convergence to exact solutions on half spaces, output/convergence.png. Needs the results of
# prm/verification/*_refinement.prm: doc/verification/convergence.sh runs them all.
load "doc/paper/style.gp"
set terminal pngcairo size 1400,1100
set output "output/convergence.png"
set multiplot layout 2, 2
set logscale xy
set xlabel "Cells across the bone, {/:Italic N}"
set ylabel "Relative error of the torque"
set format y "10^{%L}"
set key bottom left
set xtics (12, 16, 20, 24, 30, 40, 60)
study(name) = "output/" . name . "_refinement/study.csv"
array N[4] = [20, 30, 40, 60]
array stiffness[3] = ["10^4", "10^5", "10^6"]
array exact[3] = [49.022, 88.397, 98.799]

set title "Reissner-Sagoci: disk bonded by a layer of ε_t [MPa/mm]"
set xrange [18:66]
set yrange [1e-3:1]
plot for [i=1:3] study("reissner_sagoci") using (N[int(column("variant") - 1) % 4 + 1]):(abs(column("T_max_Nmm") / exact[i] - 1)) \
    every ::(4 * i - 4)::(4 * i - 1) with linespoints linewidth 2 title stiffness[i], \
  20 * x**-1.5 with lines dashtype 2 linecolor rgb "#888888" title "slope -1.5"

set title "Torsional partial slip under uniform pressure"
set ylabel "Largest difference / {/:Italic T}_{max}"
array stiffness_2[3] = ["10^5", "3 10^5", "10^6"]
set yrange [3e-4:0.1]
plot for [i=1:3] study("torsional_partial_slip") using (N[int(column("variant") - 1) % 4 + 1]):"difference_max" \
    every ::(4 * i - 4)::(4 * i - 1) with linespoints linewidth 2 title "ε_t = " . stiffness_2[i]

set title "Hertz: force at 5 μm, less the first-order effect of the interface"
set ylabel "Relative error of the force"
array N_hertz[4] = [12, 16, 24, 32]
array eps[4] = [2.5e5, 5e5, 1e6, 2e6]
set xrange [10:36]
set yrange [3e-3:0.1]
plot for [i=1:4] study("hertz") using (N_hertz[int(column("variant") - 1) % 4 + 1]):(abs(column("force_end_N") / (60 * (1 - 0.0344 * 5e5 / eps[i])) - 1)) \
    every ::(4 * i - 4)::(4 * i - 1) with linespoints linewidth 2 title sprintf("ε = %g", eps[i]), \
  8 * x**-2 with lines dashtype 2 linecolor rgb "#888888" title "slope -2"

set title "Lubkin: torsion of a sphere"
set ylabel "Largest difference / {/:Italic T}_{max}"
array N_sphere[3] = [16, 24, 32]
array eps_2[3] = [2.5e5, 1e6, 4e6]
set xrange [14:36]
set yrange [5e-3:0.15]
plot for [i=1:3] study("lubkin") using (N_sphere[int(column("variant") - 1) % 3 + 1]):"difference_max" \
    every ::(3 * i - 3)::(3 * i - 1) with linespoints linewidth 2 title sprintf("ε = %g", eps_2[i])
unset multiplot
