# The points of one angle of a profiles.csv as rows of a grid over the contact face, which gnuplot draws as a surface without
# gaps: values between points are interpolated, and jump where the elements meet that the pattern of bonding differs in.
#   awk -v angle=1.15 -v points=5 -f doc/paper/face.awk DIR/profiles.csv
# points: Expert / Interface / Quadrature points of the scene. The file lists points element by element, the first parameter fastest
# in elements and in points.
BEGIN { FS = "," }
NR == 1 { print; next }
($1 - angle) ^ 2 < 1e-12 { row[n++] = $0 }
END {
  across = int(sqrt(n) + 0.5)
  if (n == 0 || across * across != n || across % points != 0) {
    print "face.awk: " n " points at " angle " degrees are no grid of " points " x " points " points per element" > "/dev/stderr"
    exit 1
  }
  elements = across / points
  for (j = 0; j < across; ++j) {
    for (i = 0; i < across; ++i)
      print row[points * points * (int(i / points) + elements * int(j / points)) + i % points + points * (j % points)]
    print ""
  }
}
