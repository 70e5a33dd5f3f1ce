# Writes each scene of a group to DIRECTORY/NAME.prm, or a script to NAME.sh, and what is expected of it to NAME.expected.
#   LC_ALL=C awk -v directory=DIRECTORY -f split.awk GROUP.scenes...
# A group is a text in which each scene has
#   === NAME.prm          or NAME.sh
#   the scene             or the script
#   --- exit code N       only --- behind a script
#   what the program says
# A comment with one # in the first line of a scene stands for the coin of tests/coin.prm.
# `=== NAME.prm, turned` is short for a scene that ends with the lines below.
BEGIN {
  turned = "\nsubsection Chuck\n  subsection Rotation z\n    set Value = t\n  end\nend"
}
/^=== / {
  close(file)
  name = $2
  is_turned = sub(/,$/, "", name)
  file = directory "/" name
  is_first = name ~ /\.prm$/
  next
}
is_first && /^#[^#]/ {
  $0 = "include files/coin.prm"
}
/^---/ {
  if (is_turned) print turned > file
  close(file)
  sub(/\.[^.]*$/, ".expected", file)
  printf "%s", (NF > 1 ? substr($0, 5) "\n" : "") > file
  next
}
{
  is_first = 0
  print > file
}
