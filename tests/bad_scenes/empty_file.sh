# An empty file.
: > input.prm
debond input.prm
