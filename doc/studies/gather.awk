# Gathers study.csv files into one table that is easy to plot: a row for each variant with what was chosen, seconds and
# errors. Entries that a study does not vary have the value they have in prm/studies/work_precision_scene.prm; studies with
# splines or quadratic in their name are of such elements. Seconds are those of a process: -v start=SECONDS that it takes to start.
BEGIN {
  chosen["Model"] = "finite elements"
  chosen["Bone / Cells"] = "30, 30, 4"
  chosen["Expert / Bone / Layer grading"] = "1.5"
  chosen["Expert / Bone / Cells under implant"] = "0"
  chosen["Expert / Bone / Coarser below"] = "false"
  chosen["Bone / Material"] = "linear"
  chosen["Expert / Bone / Contact surface"] = "nurbs"
  chosen["Expert / Interface / Slave"] = "implant"
  chosen["Load steps / Steps"] = "1, 10, 10"
  chosen["Load steps / Adaptive"] = "true"
  chosen["Load steps / Tolerance"] = "1e-3"
  mesh_name[15] = "coarse"; mesh_name[20] = "lean"; mesh_name[30] = "medium"; mesh_name[60] = "fine"; mesh_name[120] = "very fine"
  print "tier,mesh,layers,steps,points,surface,slave,seconds,seconds_before_steps,seconds_stepping,unknowns," \
    "error_torque,error_torque_mean,error_pressure,error_slip,label"
}

# The fields of a line of a CSV file, of which some are "quoted, with commas".
function fields(line, field,    n, i, part, parts, pieces, k, m) {
  parts = split(line, part, "\"")
  n = 1; field[1] = ""
  for (i = 1; i <= parts; i++)
    if (i % 2 == 0) field[n] = field[n] part[i]
    else {
      m = split(part[i], pieces, ",")
      for (k = 1; k <= m; k++) {
        if (k > 1) field[++n] = ""
        field[n] = field[n] pieces[k]
      }
      if (m == 0 && i > 1 && i < parts) continue
    }
  return n
}

function value(name) { return name in number ? field[number[name]] : chosen[name] }

FNR == 1 {
  splines = FILENAME ~ /splines/
  quadratic = FILENAME ~ /quadratic/
  chosen["Expert / Interface / Quadrature points"] = splines ? 6 : 5
  delete number
  n = fields($0, field)
  for (i = 1; i <= n; i++) number[field[i]] = i
  next
}

{
  fields($0, field)
  if (value("converged") != "true") next
  closed = value("Model") != "finite elements"
  tier = closed ? value("Model") : splines ? "splines" : quadratic ? "quadratic" : value("Bone / Material")
  split(value("Bone / Cells"), cells, ", "); split(value("Implant / Cells"), implant_cells, ", ")
  mesh = closed ? "none" : !splines && !quadratic ? mesh_name[cells[1]] : value("Expert / Bone / Cells under implant") + 0 > 0 ? "graded to the rim" : "equal cells"
  layers = closed ? "none" : cells[3] (value("Expert / Bone / Layer grading") == 1 ? " equal" : "")
  if (value("Load steps / Adaptive") == "true" && !closed) steps = "tol. " value("Load steps / Tolerance")
  else {
    phases = split(value("Load steps / Steps"), count, ", ")
    steps = 0
    for (i = 2; i <= phases; i++) steps += count[i]
    steps = steps " steps"
  }
  points = value("Expert / Interface / Quadrature points")
  surface = value("Expert / Bone / Contact surface"); slave = value("Expert / Interface / Slave")
  # what differs from the usual choice
  label = tier
  if (tier == "prescribed angles") label = label (value("Closed form / Slip counts from angle") == 1.13 ? "; printed angles" : "; own angles")
  if (splines || quadratic) {
    label = label (value("Bone / Material") == "linear" ? "" : " " value("Bone / Material")) "; " cells[1] " x " cells[2] " x " cells[3] " / " \
      implant_cells[1] " x " implant_cells[1] " x " implant_cells[2] (mesh == "equal cells" ? "" : " " mesh) \
      (value("Expert / Bone / Coarser below") == "true" ? " coarser below" : "")
  } else if (!closed && tier != "rigid") label = label "; " mesh "; " layers " layers"
  label = label "; " steps
  if (!closed && !splines && !quadratic && points != 5) label = label "; " points "x" points " points"
  if (surface != "nurbs") label = label "; " surface
  if (slave != "implant") label = label "; slave: " slave
  shared = value("seconds_shared_set_up") # a run alone would spend it, too
  if (shared !~ /^[0-9]/) shared = 0 # it shares with no other variant
  shared += start
  printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s\n", tier, mesh, layers, steps, points, surface, slave,
    value("wall_seconds") + shared, value("seconds_before_steps") + shared, value("seconds_stepping"), value("unknowns"),
    value("difference_max"), value("difference_mean"), value("pressure_difference_rms"), value("slip_difference_rms"), label
}
