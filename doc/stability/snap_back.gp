# A brittle bond that snaps back, output/snap_back.png: left under a compliant machine, right under a soft implant. At the top of
# the project:
#
#   debond=build/release/debond
#   for scene in snap_back snap_back_viscous snap_back_path snap_back_bulk; do $debond prm/stability/$scene.prm; done
#   $debond prm/stability/snap_back.prm --set Model=foundation --set "Chuck/Rotation z/Stiffness=0" \
#     --set Output/Directory=output/snap_back_closed_form
#   $debond prm/stability/snap_back_bulk.prm --set "Load steps/Path following=none" --set Output/Directory=output/snap_back_bulk_jump
#   gnuplot doc/stability/snap_back.gp
load "doc/paper/style.gp"
set terminal pngcairo size 1500,620 enhanced font "Sans,14" linewidth 1.5
set output "output/snap_back.png"
set multiplot layout 1, 2
set ylabel "Torque [N mm]"
set key bottom right
results(name) = "output/" . name . "/torque.csv"
k = 3000 * pi / 180 # of the machine [N mm/deg]

set title "Rigid bodies, machine of 3000 N mm/rad"
set xlabel "Angle of the machine [deg]"
set xrange [0.7:1.6]
set yrange [27:52]
plot results("snap_back_closed_form") using (column("angle_deg") + column("torque_Nmm") / k):"torque_Nmm" with lines \
    linewidth 4 linecolor rgb "#bbbbbb" title "closed form", \
  results("snap_back") using "machine_angle_deg":"torque_Nmm" with linespoints pointtype 6 pointsize 0.6 \
    linecolor rgb "#c0392b" title "rotation control", \
  results("snap_back_viscous") using "machine_angle_deg":"torque_Nmm" with lines linewidth 2 \
    linecolor rgb "#2e8b57" title "viscosity 0.2", \
  results("snap_back_path") using "machine_angle_deg":"torque_Nmm" with points pointtype 7 pointsize 0.5 \
    linecolor rgb "#1f4e9c" title "path following"

set title "Soft implant, rigid machine"
set xlabel "Angle of the chuck [deg]"
set xrange [0.7:1.1]
plot results("snap_back_bulk_jump") using "angle_deg":"torque_Nmm" with linespoints pointtype 6 pointsize 0.6 \
    linecolor rgb "#c0392b" title "rotation control", \
  results("snap_back_bulk") using "angle_deg":"torque_Nmm" with linespoints pointtype 7 pointsize 0.5 \
    linecolor rgb "#1f4e9c" title "path following"
unset multiplot
