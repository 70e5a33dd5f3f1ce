# Subsections within subsections without an end.
awk 'BEGIN { for (i = 0; i < 100000; ++i) print "subsection s" i }' > input.prm
debond input.prm
