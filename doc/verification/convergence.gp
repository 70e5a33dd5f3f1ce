# Convergence to exact solutions on half spaces, output/convergence.png. Needs the results of
# prm/verification/*_refinement.prm: doc/verification/convergence.sh runs them all.
study(name) = "output/" . name . "_refinement/study.csv"
unit = " MPa/mm"
array N[4] = [20, 30, 40, 60]
array stiffness[3] = ["10^4", "10^5", "10^6"]
array exact[3] = [49.022, 88.397, 98.799]
array stiffness_2[3] = ["10^5", "3·10^5", "10^6"]
array N_hertz[4] = [12, 16, 24, 32]
array eps_hertz[4] = [2.5e5, 5e5, 1e6, 2e6]
array N_sphere[3] = [16, 24, 32]
array eps_sphere[3] = [2.5e5, 1e6, 4e6]
digits(x) = x / 10**floor(log10(x) + 1e-9)
power(x) = (abs(digits(x) - 1) < 1e-6 ? "" : sprintf("%.3g·", digits(x))) . sprintf("10^{%d}", floor(log10(x) + 1e-9))
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/convergence", 1400, 1100)
  set multiplot layout 2, 2
  set logscale xy
  set xlabel "Cells across the bone, {/:Italic N}"
  set format y "10^{%L}"
  set key bottom left

  set xtics (20, 30, 40, 60)
  set title "Reissner-Sagoci: disk bonded by a layer"
  set ylabel "Relative error of the torque"
  set xrange [18:66]
  set yrange [1e-4:1]
  plot for [i=1:3] study("reissner_sagoci") using (N[int(column("variant") - 1) % 4 + 1]):(abs(column("T_max_Nmm") / exact[i] - 1)) \
      every ::(4 * i - 4)::(4 * i - 1) with linespoints title "ε_t = " . stiffness[i] . unit, \
    20 * x**-1.5 with lines dashtype 2 linecolor rgb grey title "slope -1.5"

  set title "Torsional partial slip, uniform pressure"
  set ylabel "Largest difference / {/:Italic T}_{max}"
  set yrange [1e-4:0.1]
  plot for [i=1:3] study("torsional_partial_slip") using (N[int(column("variant") - 1) % 4 + 1]):"difference_max" \
      every ::(4 * i - 4)::(4 * i - 1) with linespoints title "ε_t = " . stiffness_2[i] . unit

  set xtics (12, 16, 24, 32)
  set title "Hertz: sphere pressed in by 5 μm"
  set ylabel "Relative error of the force"
  set xrange [10:36]
  set yrange [1e-3:0.1]
  plot for [i=1:4] study("hertz") using (N_hertz[int(column("variant") - 1) % 4 + 1]):(abs(column("force_end_N") / (60 * (1 - 0.0344 * 5e5 / eps_hertz[i])) - 1)) \
      every ::(4 * i - 4)::(4 * i - 1) with linespoints title "ε = " . power(eps_hertz[i]) . unit, \
    8 * x**-2 with lines dashtype 2 linecolor rgb grey title "slope -2"

  set xtics (16, 24, 32)
  set title "Lubkin: torsion of a sphere"
  set ylabel "Largest difference / {/:Italic T}_{max}"
  set xrange [14:36]
  set yrange [1e-3:0.1]
  plot for [i=1:3] study("lubkin") using (N_sphere[int(column("variant") - 1) % 3 + 1]):"difference_max" \
      every ::(3 * i - 3)::(3 * i - 1) with linespoints title "ε = " . power(eps_sphere[i]) . unit
  unset multiplot
}
unset output
