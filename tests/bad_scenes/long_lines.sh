# Texts that are much too long: the message is not.
long=$(printf '%05000d' 0 | tr 0 9)
printf 'set %s\n' "$long" > input_1.prm
printf 'set %s = 1\n' "$long" > input_2.prm
printf 'subsection Bone\nset Young modulus = 1e%s\nend\n' "$long" > input_3.prm
printf 'subsection Bone\nset Young modulus = {{%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s%s|2..%s}}\nend\n' \
  $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long $long > input_4.prm
printf 'subsection Chuck\nsubsection Rotation z\nset Value = t + %s%s%s x\nend\nend\n' $long $long $long > input_5.prm
debond input_1.prm
debond input_2.prm
debond input_3.prm
debond input_4.prm
debond input_5.prm
