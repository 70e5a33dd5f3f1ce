# The friction coefficient over the radius, smooth between the points of a profiles.csv, for fig_5_6.gp: the sliding distance, which is
# nearly straight over the radius, is interpolated, and the law gives mu. Rows of one angle in the order of their radii:
#   awk -f doc/paper/over_radius.awk DIR/friction_law.csv ROWS
BEGIN { FS = ","; print "r_mm,mu" }
FNR == NR { if (FNR > 1) { law_slip[n] = $1; law_mu[n++] = $3 } next }
{
  if ($4 - r < 0.01) next # [mm]
  n_parts = int(($4 - r) / 0.01)
  for (i = 1; i <= n_parts; ++i) # from the axis, where nothing slides
    printf "%.6g,%.6g\n", r + i / n_parts * ($4 - r), mu(slip + i / n_parts * ($7 - slip))
  r = $4; slip = $7
}
function mu(g,    low, high, middle) {
  if (g >= law_slip[n - 1]) return law_mu[n - 1]
  low = 0; high = n - 1
  while (high - low > 1) {
    middle = int((low + high) / 2)
    if (law_slip[middle] <= g) low = middle; else high = middle
  }
  return law_mu[low] + (g - law_slip[low]) / (law_slip[high] - law_slip[low]) * (law_mu[high] - law_mu[low])
}
