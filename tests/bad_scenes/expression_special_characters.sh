# Characters in expressions that look like operators and names, and some that are not seen.
cp "$here/files/turn.prm" input.prm
for value in '2 – t' '2 − t' '2×t' '2·t' '10° * t' 'if(t ≥ 1, t, 1)' 'if(t ≤ 1, t, 1)' 'sin(π * t)' '“2 * t”' '’t’' '2 * t' 't²' '2 * ŧ'; do
  debond input.prm --set "Chuck/Rotation z/Value=$value"
done
# in Latin-1
debond input.prm --set "Chuck/Rotation z/Value=10$(printf '\260') * t"
