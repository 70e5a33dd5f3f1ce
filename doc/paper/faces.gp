# Contact faces side by side, seen from above, for fig_5_6.gp and fig_7_8.gp: points of a profiles.csv at an angle [°], and their
# number per element and direction.
face(file, angle, points) = sprintf("< awk -v angle=%s -v points=%d -f doc/paper/face.awk %s", angle, points, file)
set size ratio -1
unset grid
unset border
unset tics
set cbtics textcolor rgb "#000000"
unset key
set xrange [-2.51:2.51]
set yrange [-2.51:2.51]
# borders in the colour of their cells cover the seams that antialiasing shows
set pm3d map corners2color mean interpolate 4, 4 border retrace linewidth 1.5
set palette maxcolors 256
