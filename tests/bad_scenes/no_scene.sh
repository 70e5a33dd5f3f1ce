# No scene on the command line.
debond
debond --check
