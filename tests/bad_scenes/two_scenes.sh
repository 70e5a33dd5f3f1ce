# Two scenes at once.
debond a.prm b.prm
