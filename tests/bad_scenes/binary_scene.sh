# The program itself, a picture, and a text with a NUL byte.
debond files/good.png
printf 'set Title = a\0b\n' > input.prm
debond input.prm
