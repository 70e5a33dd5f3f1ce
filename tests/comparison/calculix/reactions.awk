# Rows "time,angle [deg],force [N],torque [N mm]", one for each step, from the
# reactions of the top nodes. The first file, CalculiX's input, gives their
# places and, in a comment before each step, time and angle; the second one,
# CalculiX's .dat, the reactions. Fails if a step is missing.

FNR == 1 { ++file }
file == 1 && /^\*NODE$/ { block = "node"; next }
file == 1 && /^\*NSET/ { block = "top"; next }
file == 1 && /^\*\* step/ { split($0, part, ":"); split(part[2], value, " ")
                            time[value[1]] = value[2]; angle[value[1]] = value[3]; n_steps = value[1]; next }
file == 1 && /^\*/ { block = ""; next }
file == 1 && block == "node" { split($0, value, /, */); X[value[1]] = value[2]; Y[value[1]] = value[3] }
file == 1 && block == "top" { ++n_top }
file == 2 && /^ forces/ { ++step; next }
file == 2 && NF == 4 && step {
  c = cos(angle[step] * atan2(0, -1) / 180); s = sin(angle[step] * atan2(0, -1) / 180)
  x = c * X[$1] - s * Y[$1]; y = s * X[$1] + c * Y[$1]
  torque[step] += x * $3 - y * $2; force[step] -= $4; ++n[step]
}
END {
  for (i = 1; i <= n_steps; ++i)
    {
      if (n[i] != n_top) exit 1
      printf "%.10g,%.10g,%.10g,%.10g\n", time[i], angle[i], force[i], torque[i]
    }
  if (step != n_steps) exit 1
}
