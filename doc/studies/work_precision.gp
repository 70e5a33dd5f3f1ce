# Error against seconds, for doc/studies/work_precision.sh, which makes the tables. Variables codes:
# CSV file or "", methods: list of what is in it, CODE/METHOD, start: seconds of debond's start.
dir = "output/studies/"
table = dir . "work_precision.csv"
tiers = "crack prescribed_angles foundation rigid linear neo-hookean quadratic splines"
tier_colours = "grey orange green purple blue red sky black"
meshes = "none coarse lean medium fine very_fine equal_cells graded_to_the_rim"
black = 0x000000
colour(k) = value(word(tier_colours, k))
array symbol[8] = [3, 9, 15, 7, 5, 13, 11, 4]
spaced(word) = word eq "prescribed_angles" ? "prescribed angles" : word eq "very_fine" ? "very fine" : word eq "equal_cells" ? "equal cells" : \
  word eq "graded_to_the_rim" ? "graded to the rim" : word
seconds_label = "Seconds of the process, " . start . " of them debond's start"
short(tier) = tier eq "prescribed_angles" ? "prescribed" : tier # in the keys
mesh_name(m) = m == 1 ? "closed form" : m == 8 ? "graded" : spaced(word(meshes, m)) . (m < 7 ? " mesh" : "")
is(tier, mesh) = strcol("tier") eq spaced(tier) && strcol("mesh") eq spaced(mesh)
best(x) = x > 0 ? x : NaN

# "CalculiX/C3D8" of methods and its rows: code "CalculiX", label "C3D8 30 x 30 x 4 / 12 x 12 x 4", which ends with the cells of
# the bone and of the implant. Each choice of cells has a letter.
ours = dir . "work_precision_coulomb.csv"
# gnuplot cannot plot a file that is not there: this table stands in for it
others = codes eq "" ? ours : codes
code(m) = m[1:strstrt(m, "/") - 1]
method(m) = m[strstrt(m, "/") + 1:]
of(m) = codes eq "" ? 0 : strcol("code") eq code(m) && word(strcol("label"), 1) eq method(m)
cells(label) = label[strlen(word(label, 1)) + 2:]
all_cells = codes eq "" ? "" : system("awk -F, 'NR > 1 && $1 != \"debond\" { sub(/^[^ ]* /, \"\", $2); if (!seen[$2]++) printf \"%s;\", $2 }' " . codes)
letter(cells) = "abcdefghijklmnopqrstuvwxyz"[n_before(cells) + 1:n_before(cells) + 1]
n_before(cells) = count_of_semicolons(all_cells[1:strstrt(";" . all_cells, ";" . cells . ";")])
count_of_semicolons(text) = strstrt(text, ";") == 0 ? 0 : 1 + count_of_semicolons(text[strstrt(text, ";") + 1:])
surfaces = "nurbs bilinear"
array open_symbol[6] = [4, 6, 8, 10, 12, 14]
# entries of the key: the methods of the first code fill rows up to a multiple of 4
n_first = 0
do for [m in methods] { if (code(m) eq code(word(methods, 1))) { n_first = n_first + 1 } }
n_blank = (4 - n_first % 4) % 4
blank(k) = k > n_first && k <= n_first + n_blank
entry(k) = k <= n_first ? k : k - n_blank
code_colour(m) = code(m) eq "CalculiX" ? red : orange

do for [format in "png svg"] {
  # ---- the torque curve
  load "doc/style.gp"
  set logscale xy
  set format xy "10^{%L}"
  set mxtics 10
  set mytics 10
  eval picture(dir . "work_precision", 1300, 1000)
  set xlabel seconds_label
  set ylabel "Largest torque error / {/:Italic T}_{max}"
  set xrange [0.2:100]
  set yrange [1e-5:1]
  set bmargin 10.5
  set key at screen 0.5, 0.01 bottom center maxrows 5 samplen 1.5
  front = dir . "front_torque.csv"
  chosen = dir . "work_precision_accuracy.csv"
  # what the reference is known to
  floor_of_error = 1.2e-5
  set arrow 1 from graph 0, first floor_of_error to graph 1, first floor_of_error nohead dashtype 2 linecolor rgb "#888888"
  set label 2 "error of the reference" at graph 0.02, first floor_of_error * 1.25
  plot for [k=1:words(tiers)] for [m=1:words(meshes)] table using (is(word(tiers, k), word(meshes, m)) ? column("seconds") : NaN):"error_torque" \
      with points pointtype symbol[m] pointsize (1.5 * point) linecolor rgb (colour(k) + 0x60000000) notitle, \
    for [k=1:words(tiers)] NaN with points pointtype 7 pointsize (1.6 * point) linecolor rgb colour(k) title short(word(tiers, k)), \
    for [m=1:words(meshes)] NaN with points pointtype symbol[m] pointsize (1.6 * point) linecolor rgb "#444444" title mesh_name(m), \
    front using "seconds":"error_torque" with steps linewidth 1.5 linecolor rgb "#000000" title "best", \
    chosen using "seconds":"error_torque" with linespoints linewidth 3 pointtype 7 pointsize (2 * point) linecolor rgb red title "Accuracy", \
    for [below=0:1] chosen using ((column("accuracy") == 0.3) == below ? column("seconds") : NaN):"error_torque":(strcol("accuracy") . " %") \
      with labels offset 0.8, (below ? -0.9 : 0.7) left textcolor rgb red notitle, \
    for [far=0:1] front using ((column("seconds") < 0.7 && int($0) % 2) == far ? column("seconds") : NaN):"error_torque":(sprintf("%d", $0 + 1)) \
      with labels offset (far ? -2.6 : -0.6), -0.7 right notitle
  unset label
  unset arrow

  # ---- local values
  eval picture(dir . "work_precision_local", 1400, 900)
  set xlabel "Seconds of the process"
  set multiplot
  set tmargin 2
  set bmargin 9.5
  set yrange [1e-5:1]
  array what[2] = ["pressure", "slip"]
  array name[2] = ["pressure", "slip {/:Italic g}_s"]
  do for [i=1:2] {
    set origin (i - 1) / 2., 0
    set size 0.5, 1
    set ylabel "RMS error of " . name[i] . " / mean"
    set key at screen 0.5, 0.01 bottom center maxrows 5 samplen 1.5 width -2
    if (i == 2) { unset key }
    error = "error_" . what[i]
    plot for [k=1:words(tiers)] for [m=1:words(meshes)] table using (is(word(tiers, k), word(meshes, m)) ? column("seconds") : NaN):(best(column(error))) \
        with points pointtype symbol[m] pointsize (1.3 * point) linecolor rgb (colour(k) + 0x60000000) notitle, \
      for [k=2:words(tiers)] NaN with points pointtype 7 pointsize (1.5 * point) linecolor rgb colour(k) title short(word(tiers, k)), \
      for [m=1:words(meshes)] NaN with points pointtype symbol[m] pointsize (1.5 * point) linecolor rgb "#444444" title mesh_name(m), \
      dir . "front_" . what[i] . ".csv" using "seconds":error with steps linewidth 1.5 linecolor rgb "#000000" title "best"
  }
  unset multiplot

  # ---- constant friction, other codes
  load "doc/style.gp"
  set logscale xy
  set format xy "10^{%L}"
  set mxtics 10
  set mytics 10
  array surface_colour[2] = [blue, sky]
  eval picture(dir . "work_precision_codes", 1300, 1000)
  set xlabel seconds_label
  set ylabel "Largest torque error up to 1° / {/:Italic T}_{max}"
  set xrange [0.2:1000]
  set yrange [2e-5:0.2]
  set bmargin 9
  # columns of the key: debond, its meshes, the first of the other codes, the others
  set key at screen 0.5, 0.01 bottom center maxrows 4 samplen 1.5 width -3
  set style textbox opaque noborder fillcolor rgb "#ffffff"
  front = dir . "front_coulomb.csv"
  if (codes ne "") {
    do for [n=1:count_of_semicolons(all_cells)] {
      rest = all_cells
      do for [skipped=2:n] { rest = rest[strstrt(rest, ";") + 1:] }
      set label n letter(rest[1:strstrt(rest, ";") - 1]) . ": " . rest[1:strstrt(rest, ";") - 1] at graph 0.63, 0.04 + 0.042 * (count_of_semicolons(all_cells) - n) boxed
    }
    set label 100 "Cells: bone / implant" at graph 0.62, 0.04 + 0.042 * count_of_semicolons(all_cells) boxed
  }
  plot for [s=1:2] for [m=2:6] ours using (strcol("surface") eq word(surfaces, s) && is("linear", word(meshes, m)) ? column("seconds") : NaN):"error_torque" \
      with points pointtype symbol[m] pointsize (1.5 * point) linecolor rgb (surface_colour[s] + 0x40000000) notitle, \
    ours using (is("splines", "equal_cells") ? column("seconds") : NaN):"error_torque" \
      with points pointtype symbol[7] pointsize (1.5 * point) linecolor rgb 0x40000000 notitle, \
    front using "seconds":"error_torque" with steps linewidth 1.5 linecolor rgb "#000000" title "debond, best", \
    for [s=1:2] NaN with points pointtype 7 pointsize (1.6 * point) linecolor rgb surface_colour[s] title s == 1 ? "trilinear, NURBS" : "trilinear, bilinear", \
    NaN with points pointtype symbol[7] pointsize (1.6 * point) linecolor rgb black title "splines", \
    for [m=2:5] NaN with points pointtype symbol[m] pointsize (1.6 * point) linecolor rgb "#444444" title mesh_name(m), \
    for [k=1:words(methods)] others using (of(word(methods, k)) ? column("seconds") : NaN):"error_torque" \
      with points pointtype open_symbol[k] pointsize (2 * point) linewidth 1.5 linecolor rgb code_colour(word(methods, k)) notitle, \
    for [k=1:words(methods) + n_blank] keyentry with points pointtype (blank(k) ? -1 : open_symbol[entry(k)]) pointsize (2 * point) linewidth 1.5 \
      linecolor rgb (blank(k) ? 0xffffff : code_colour(word(methods, entry(k)))) title (blank(k) ? " " : code(word(methods, entry(k))) . " " . method(word(methods, entry(k)))), \
    for [k=1:words(methods)] others using (of(word(methods, k)) ? column("seconds") : NaN):"error_torque":(codes eq "" ? "" : letter(cells(strcol("label")))) \
      with labels offset (k % 2 ? -1.5 : 1.5), 0 textcolor rgb code_colour(word(methods, k)) noenhanced notitle
}
unset output
