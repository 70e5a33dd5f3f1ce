# What does not go with --compare.
debond --compare
debond --compare input_results
debond --compare input_results curve.csv --force
debond scene.prm --columns '1 [deg], 2 [N m]'
debond --compare input_results curve.csv
