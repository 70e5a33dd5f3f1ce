# Operators and names of other languages. The last two are mistakes of another kind, and one after a number with e.
cp "$here/files/turn.prm" input.prm
for value in 't % 2' 'mod(t, 2)' 'if(t > 1 and t < 2, t, 1)' 'if(t < 1 or t > 2, t, 1)' 'sin(PI * t)' 'sin(Pi * t)' '2 * T' '|t - 1|' \
  'e^(-t)' '"2 * t"' '1e-2 * speed * t' 'R * speed * t'; do
  debond input.prm --set "Chuck/Rotation z/Value=$value"
done
