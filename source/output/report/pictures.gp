# Pictures of a report. Set before: file, x, y (columns), x_label, y_label, title_text, svg, png (files to write; "" for none),
# n_reference (rows of the data block $reference), published (words), maps, n_maps, map_file(k, q), largest (words: of the quantities).
set encoding utf8
set datafile separator comma
set datafile missing NaN
red = "#c03028"; dark = "#2c1e5c"; grey = "#555555"

do for [kind=1:2] {
  name = kind == 1 ? svg : png
  if (name ne "") {
    if (kind == 1) { set terminal svg size 900, 520 dynamic enhanced font "sans-serif,15" background "#ffffff" linewidth 1.2 }
    if (kind == 2) { set terminal pngcairo size 1350, 780 enhanced font "sans-serif,17" linewidth 2 }
    set output name
    set xlabel x_label
    set ylabel y_label
    set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
    set border linecolor rgb grey
    set key bottom right noenhanced
    set xrange [*:*] noextend
    set offsets graph 0, graph 0.02, graph 0.08, graph 0
    set datafile columnheaders
    stats file using y nooutput
    if (STATS_min > -1e-3 * STATS_max) { set yrange [0:*] }
    do for [i=1:words(published)] {
      value = real(word(published, i))
      symbol = word("T_{max} T_{∞} θ_{lin} θ_{max}", i)
      if (i <= 2) {
        set arrow i from graph 0, first value to graph 1, first value nohead dashtype 2 linecolor rgb dark back
        set label i sprintf("published {/:Italic %s} = %g N mm", symbol, value) at graph 0.98, first value right offset 0, 0.7 textcolor rgb dark
      } else {
        set arrow i from first value, graph 0 to first value, graph 1 nohead dashtype 2 linecolor rgb dark back
        set label i sprintf("{/:Italic %s} = %g°", symbol, value) at first value, graph 0.05 + 0.07 * (4 - i) left offset 0.5, 0 textcolor rgb dark
      }
    }
    if (n_reference > 0) {
      plot $reference using 1:2 with points pointtype 6 pointsize 0.6 linecolor rgb grey title "reference", \
           file using x:y with lines linewidth 2 linecolor rgb red title "debond"
    } else {
      plot file using x:y with lines linewidth 2 linecolor rgb red notitle
    }
    set output
    unset label
    unset arrow
  }
}

if (n_maps > 0) {
  reset
  set encoding utf8
  set datafile separator comma
  set datafile columnheaders
  set terminal svg size 200, 200 dynamic
  unset border; unset tics; unset key; unset colorbox
  set margins 0, 0, 0, 0
  set size ratio -1
  set palette defined (0 "#2c1e5c", 0.5 "#d04a62", 1 "#fbe9a0")
  do for [k=1:n_maps] {
    do for [q=1:3] {
      set output map_file(k, q)
      set cbrange [0:real(word(largest, q))]
      plot maps using 1:2:(column(3 * k + q - 1)) with image
      set output
    }
  }
}
