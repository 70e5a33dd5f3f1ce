# What all pictures have in common. A script draws each of its pictures twice, as PNG for the pages and as SVG for papers:
#
#   do for [format in "png svg"] {
#     load "doc/style.gp"
#     eval picture("output/NAME", 1400, 560)  # without extension; size [pixels]
#     ...
#   }
#   unset output
#
# Maps are PNG only, format = "map": as SVG they are megabytes of cells.
reset
if (!exists("format")) { format = "png" }
picture(name, width, height) = sprintf("set terminal %s size %d, %d enhanced; set output '%s.%s'", \
  format eq "svg" ? "svg font 'DejaVu Sans,15' linewidth 1.5 background 'white'" : \
  format eq "map" ? "pngcairo font 'DejaVu Sans,15'" : "pngcairo font 'DejaVu Sans,15' linewidth 1.5", \
  width, height, name, format eq "svg" ? "svg" : "png")
set encoding utf8
set datafile separator comma
set datafile columnheaders
set datafile missing "nan"

# colours that those who see no red or no green tell apart (Okabe and Ito)
blue = 0x0072b2; orange = 0xe69f00; green = 0x009e73; red = 0xd55e00; purple = 0xcc79a7; sky = 0x56b4e9; grey = 0x999999
set for [i=1:6] linetype i linecolor rgb value(word("blue orange green red purple sky", i)) linewidth 2 pointtype 7
set linetype cycle 6
# from dark to light without a turn, in print as on the screen (viridis)
set palette defined (0 "#440154", 1 "#46327e", 2 "#365c8d", 3 "#277f8e", 4 "#1fa187", 5 "#4ac16d", 6 "#a0da39", 7 "#fde725")
# values printed in a paper: plot marks('X,Y\nX,Y') with points linestyle 1
marks(points) = "< printf '" . 'x,y\n' . points . '\n' . "'"
set style line 1 linecolor rgb "#000000" linewidth 1.5 pointtype 2 pointsize 1.6

set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set tics nomirror textcolor rgb "#000000"
set key enhanced Left reverse samplen 2 spacing 1.1
angle_label = "Rotation angle {/:Italic θ} [°]"
torque_label = "Torque {/:Italic T} [N mm]"
