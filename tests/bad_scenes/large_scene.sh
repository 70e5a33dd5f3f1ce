# A file that is much too long for a scene.
awk 'BEGIN { for (i = 0; i < 1200000; ++i) print "# nothing" }' > input.prm
debond input.prm
