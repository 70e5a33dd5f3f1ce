# The same with an expression that has no value at that time.
cp "$here/files/rigid.prm" input.prm
debond input.prm --set "Chuck/Rotation z/Value=if(abs(t - 0.5001) < 1e-6, log(-1), 0.01 * t)"
wc -l < results/torque.csv >> errors
grep -E '"(converged|reason)"' results/summary.json >> errors
