# What all pictures have in common. A script draws each of its pictures twice, as PNG for the pages and as SVG for papers:
#
#   do for [format in "png svg"] {
#     load "doc/style.gp"
#     eval picture("output/NAME", 1400, 560)  # without extension; size [pixels]
#     ...
#   }
#   unset output
#
# Maps are PNG only, format = "map": as SVG they are megabytes of cells. Letters grow with the width of the picture, so that they
# can be read where a page shows it 600 pixels wide. Each quantity has a colour map of its own, in every picture:
#
#   eval colours_of("mu")  # or "slip_mm", "pressure_MPa", ...: names of columns
reset
if (!exists("format")) { format = "png" }
picture(name, width, height) = sprintf("set terminal %s font 'DejaVu Sans,%g' size %d, %d enhanced; set output '%s.%s'", \
  format eq "svg" ? "svg linewidth 1.5 background 'white'" : format eq "map" ? "pngcairo" : "pngcairo linewidth 1.5", \
  width / 70., width, height, name, format eq "svg" ? "svg" : "png")
point = format eq "svg" ? 0.55 : 1 # points of an SVG are larger: pointsize (1.5 * point)
set pointsize point
set encoding utf8
set datafile separator comma
set datafile columnheaders
set datafile missing "nan"

# colours that those who see no red or no green tell apart (Okabe and Ito)
blue = 0x0072b2; orange = 0xe69f00; green = 0x009e73; red = 0xd55e00; purple = 0xcc79a7; sky = 0x56b4e9; grey = 0x999999
set for [i=1:6] linetype i linecolor rgb value(word("blue orange green red purple sky", i)) linewidth 2 pointtype 7
set linetype cycle 6
# from dark to light, or from light to dark, without a turn; as in doc/paraview/open_results.py
viridis = "0 '#440154', 1 '#46327e', 2 '#365c8d', 3 '#277f8e', 4 '#1fa187', 5 '#4ac16d', 6 '#a0da39', 7 '#fde725'"
browns = "0 '#ffffe5', 1 '#fff7bc', 2 '#fee391', 3 '#fec44f', 4 '#fe9929', 5 '#ec7014', 6 '#cc4c02', 7 '#8c2d04'"
blues = "0 '#f7fbff', 1 '#deebf7', 2 '#c6dbef', 3 '#9ecae1', 4 '#6baed6', 5 '#4292c6', 6 '#2171b5', 7 '#084594'"
colours_of(quantity) = sprintf("set palette defined (%s)", \
  quantity eq "slip_mm" ? browns : quantity eq "pressure_MPa" ? blues : viridis) # viridis: the bond, phi, phi_0 and mu
eval colours_of("phi")
# values printed in a paper: plot marks('X,Y\nX,Y') with points linestyle 1
marks(points) = "< printf '" . 'x,y\n' . points . '\n' . "'"
set style line 1 linecolor rgb "#000000" linewidth 1.5 pointtype 2 pointsize (1.6 * point)

set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set tics nomirror textcolor rgb "#000000"
set key enhanced Left reverse samplen 2 spacing 1.1
# a key of so many rows below all panels: eval key_below(2, -3); width as of "set key width", below 0 for texts with {} in them
key_below(rows, width) = sprintf("set key at screen 0.5, 0.012 bottom center maxrows %d width %g; set bmargin %g", \
  rows, width, 4 + 1.15 * rows)
angle_label = "Rotation angle {/:Italic θ} [°]"
torque_label = "Torque {/:Italic T} [N mm]"
