# Names of directories that were meant for a shell, for another system, or that are not those of one.
cp "$here/files/turn.prm" input.prm
for place in '"results"' "d'or" '“results”' '~/results' '$HOME/results' 'results\coin' / //. ; do
  debond input.prm --set "Output/Directory=$place"
done
