# Bonds on half spaces from strength to toughness, output/bonds_on_half_spaces.png. Needs the results of prm/verification/kendall.prm
# and bonded_disk_torsion.prm: doc/verification/bonds_on_half_spaces.sh runs both.
reference = "prm/verification/data/bonds_on_half_space.csv"
load "doc/style.gp"
array t_0[6] = [5, 20, 40, 60, 100, 300]
array tau[5] = [5, 20, 40, 80, 200]
set print $pulled
print "strength_MPa,force_N"
do for [i=1:6] {
  stats sprintf("output/kendall/variant-%03d/reactions.csv", i) using (-column("force_N")) nooutput
  print sprintf("%g,%g", t_0[i], STATS_max)
}
unset print
brittle_force = 872.51
brittle_torque = 1216.62
do for [format in "png svg"] {
  load "doc/style.gp"
  eval picture("output/bonds_on_half_spaces", 1400, 640)
  set multiplot layout 1, 2
  set logscale xy
  set xrange [2:400]
  set yrange [0.04:1.5]
  set xtics (2, 5, 10, 20, 50, 100, 200)
  set ytics (0.05, 0.1, 0.2, 0.5, 1)
  eval key_below(2, -3)
  unset key

  set title "Pulled off (mode I)"
  set xlabel "Strength {/:Italic t}_0 [MPa]"
  set ylabel "Largest force / Kendall's"
  plot pi * 6.25 * x / brittle_force with lines dashtype 2 linecolor rgb grey title "strength", \
    1 with lines dashtype 3 linecolor rgb "#555555" title "toughness", \
    reference using "strength_MPa":"pull_off" with lines linecolor rgb blue title "reference, adhesive", \
    $pulled using "strength_MPa":(column("force_N") / brittle_force) with points pointtype 7 pointsize (1.3 * point) linecolor rgb blue title "debond, adhesive"

  set title "Twisted off (mode III)"
  eval key_below(2, -1)
  set xlabel "Shear strength {/:Italic τ} [MPa]"
  set ylabel "Largest torque / brittle bond's"
  plot 2 * pi / 3 * 15.625 * x / brittle_torque with lines dashtype 2 linecolor rgb grey title "strength", \
    1 with lines dashtype 3 linecolor rgb "#555555" title "toughness", \
    reference using "strength_MPa":"twist_adhesive" with lines linecolor rgb blue title "reference, adhesive", \
    reference using "strength_MPa":"twist_mixed_mode" with lines linecolor rgb red title "reference, mixed mode", \
    "output/bonded_disk_torsion/study.csv" using (tau[int(column("variant") - 1) % 5 + 1]):(column("T_max_Nmm") / brittle_torque) \
      every ::0::4 with points pointtype 7 pointsize (1.3 * point) linecolor rgb blue title "debond, adhesive", \
    "" using (tau[int(column("variant") - 1) % 5 + 1]):(column("T_max_Nmm") / brittle_torque) \
      every ::5::9 with points pointtype 7 pointsize (1.3 * point) linecolor rgb red title "debond, mixed mode"
  unset multiplot
}
unset output
