# An expression that is infinite at a planned time which reading the scene does not look at: the rows before are kept,
# and the summary says that the run has not converged.
cp "$here/files/rigid.prm" input.prm
debond input.prm --set "Chuck/Rotation z/Value=1e-6 / (t - 0.5001)"
wc -l < results/torque.csv >> errors
grep -E '"(converged|reason)"' results/summary.json >> errors
