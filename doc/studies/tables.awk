# Tables for doc/evidence/speed_and_accuracy.md from output/studies/work_precision.csv: splines, what each factor does on two meshes of
# trilinear cells, and the fastest choice for a wanted accuracy.
BEGIN { FS = "," }
NR == 1 { next }
{
  changed = ($1 != "linear") + ($4 != "tol. 1e-3") + ($5 != 5) + ($6 != "nurbs") + ($7 != "implant")
  mesh = $2 ", " $3
  what = $1 != "linear" ? "bodies " $1 : $4 != "tol. 1e-3" ? $4 : $5 != 5 ? $5 " x " $5 " points" : \
    $6 != "nurbs" ? $6 " surfaces" : $7 != "implant" ? "slave: " $7 : "usual choice"
  if ($1 == "splines") {
    split($16, part, "; ")
    splines[++n_splines] = sprintf("%s%s | %s | %.2g s | %.1e | %.1e | %.1e", part[2], part[1] == "splines" ? "" : ", Neo-Hookean", part[3], $8, $12, $14, $15)
  }
  else if ($2 != "none" && changed <= 1) {
    row = sprintf("%.2g s | %.1e | %.1e | %.1e", $8, $12, $14, $15)
    if (mesh == "medium, 4" || mesh == "fine, 8") {
      if (!(what in seen)) { order[++n] = what; seen[what] = 1 }
      cell[what, mesh] = row
    }
    if (changed == 0) meshes[++m] = sprintf("%s layers | %s | %s | %.2g s | %s", mesh, $11, sprintf("%.2g s", $9), $8, substr(row, index(row, "|") + 2))
  }
  for (k = 1; k <= 3; k++) {
    error = $(k == 1 ? 12 : 12 + k)
    if (error != "nan")
      for (t = 1; t <= 8; t++)
        if (error + 0 <= limit[t] && (!((k, t) in fastest) || $8 + 0 < fastest[k, t])) {
          fastest[k, t] = $8 + 0; choice[k, t] = sprintf("%.2g s: %s", $8, $16)
        }
  }
}
BEGIN { split("0.1 0.01 0.005 0.002 0.001 0.0005 0.0002 0.0001", limit, " ") }
END {
  print "| splines, bone / implant | steps | seconds | torque | pressure | g_s |\n| --- | --- | --- | --- | --- | --- |"
  for (i = 1; i <= n_splines; i++) print "| " splines[i] " |"
  print "\n| mesh | unknowns | before steps | all | torque | pressure | g_s |\n| --- | --- | --- | --- | --- | --- | --- |"
  for (i = 1; i <= m; i++) print "| " meshes[i] " |"
  print "\n| | medium, 4 layers | torque | pressure | g_s | fine, 8 layers | torque | pressure | g_s |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (i = 1; i <= n; i++)
    print "| " order[i] " | " ((order[i], "medium, 4") in cell ? cell[order[i], "medium, 4"] : "| | |") " | " \
      ((order[i], "fine, 8") in cell ? cell[order[i], "fine, 8"] : "| | |") " |"
  print "\n| error at most | torque curve | local pressure | local g_s |\n| --- | --- | --- | --- |"
  for (t = 1; t <= 8; t++) {
    line = "| " 100 * limit[t] " % |"
    for (k = 1; k <= 3; k++) line = line " " ((k, t) in choice ? choice[k, t] : "-") " |"
    print line
  }
}
