# A part that has no value somewhere, within something else that would have one: in the motion, also with a table, in
# the pattern, in the modulus over place and over grey values, and in an unknown. int is another function in every
# language.
cp "$here/files/turn.prm" input.prm
printf 'time,rz_deg\n0,-1\n3,2\n' > input.csv
{
  printf 'NDims = 3\nDimSize = 2 2 2\nElementSpacing = 6.25 6.25 2.5\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n'
  printf '\001\002\003\000\001\002\003\004'
} > input.mha
for value in 'min(2, 10 * (t - 1.2)^0.5)' 'max(0, ln(t))' 'if((t - 1)^0.5 < 1, t, 2 * t)' '(t - 1)^0.5 ? t : 2 * t' \
  'if(t > 1, 1, (t - 1)^0.5)' 't + sign(1 / t)' 'if(t > 1, int(0.7), 0)'; do
  debond input.prm --set "Chuck/Rotation z/Value=$value"
done
debond input.prm --set "Chuck/Rotation z/File=input.csv" --set "Chuck/Rotation z/Value=max(0, sqrt(table)) * t"
debond input.prm --set Interface/Bonding/Pattern=expression --set "Interface/Bonding/Expression=min(1, (x / R)^0.5)"
debond input.prm --set "Bone/Young modulus=min(20000, max((x)^0.5 * 1000, 10))"
debond input.prm --set "Bone/Young modulus=if(z > -1, 18000, max(10, 6850 * (z + 2)^1.49))"
debond input.prm --set "Bone/Voxel file=input.mha" --set "Bone/Young modulus=min(20000, 6850 / grey)"
cp "$here/calibrate.prm" input.prm
debond input.prm --set "Interface/Friction coefficient broken=<<a: 0.3 in 0.1..0.5>>" \
  --set "Interface/Sliding threshold=<<max(0.01, sqrt(a - 1))>>"
debond input.prm --set "Interface/Friction coefficient broken=0.3" --set Calibration/Noise=1 \
  --set "Chuck/Rotation z/Value=max(t - 1, 0) + 0 * sqrt(2 - <<a: 0.3 in 0.1..2.5>>)"
