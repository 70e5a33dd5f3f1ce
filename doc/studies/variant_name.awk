# The varied entries of a variant of a study, "Normal stiffness 585, Model foundation", for doc/plot_study.gp:
#   awk -v variant=2 -f doc/studies/variant_name.awk DIR/study.csv
# The columns of varied entries lie between the number of the variant and the first result.
function fields(line, field,    n, quoted, i, c) {
  n = 1; field[1] = ""
  for (i = 1; i <= length(line); ++i) {
    c = substr(line, i, 1)
    if (c == "\"") quoted = !quoted
    else if (c == "," && !quoted) field[++n] = ""
    else field[n] = field[n] c
  }
  return n
}
NR == 1 {
  varied = fields($0, entry)
  while (varied > 1 && entry[varied] != "T_max_Nmm") --varied
}
NR == variant + 1 {
  fields($0, value)
  for (i = 2; i < varied; ++i) {
    sub(/.* \/ /, "", entry[i])
    name = name (i > 2 ? ", " : "") entry[i] " " value[i]
  }
  if (length(name) > 80) name = substr(name, 1, 77) "..."
  print name
}
