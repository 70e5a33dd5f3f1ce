#!/bin/sh
# program.sh MPIRUN.sh MPIRUN DEBOND: the program under mpirun, as a user starts it. Prints what must be so.
set -u
run=$1 mpirun=$2 debond=$3
scene=scene.prm
cat > $scene <<END
include $(cd "$(dirname "$0")" && pwd)/../coin.prm
subsection Bone
  set Cells    = 10, 10, 3
  set Material = linear
end
subsection Implant
  set Material = linear
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 1.2
  set Steps = 1, 4
end
subsection Output
  set Directory    = out
  set Fields every = 2
end
END

# what mpirun says itself is not compared
ranks() {
  n=$1
  shift
  "$run" "$mpirun" "$n" "$debond" "$@" > said 2>&1
}
said() { grep -a -o -e "$1" said | head -n 1; }

echo "two processes"
ranks 2 $scene || cat said
said "multigrid, for 2 processes"
ls out | grep -c "\.vtu$"
grep -c "Piece Source" out/bulk-0001.pvtu
grep -o "bulk-0002.pvtu" out/bulk.pvd
"$debond" $scene --set Output/Directory=alone > /dev/null
cut -d, -f1-6 out/torque.csv > rows-2
cut -d, -f1-6 alone/torque.csv > rows-1
numdiff -q -r 1e-7 -a 1e-9 -s ,'\n' rows-1 rows-2 && echo "the rows of one process"

echo "with an accuracy"
ranks 2 $scene --set "Accuracy=20 %" --set Output/Directory=accuracy || cat said
grep -c '"error_estimate": 0.05' accuracy/summary.json

echo "refused"
ranks 2 $scene --set "Expert/Bone/Solver=direct" --set Output/Directory=no || said "that solver is for one process, and here are 2"
ranks 5 $scene --set "Bone/Cells=2,2,1" --set Output/Directory=few || said "5 processes cannot share 4 cells"
ranks 2 $scene --set "Bone/Cells=four" --set Output/Directory=no || said "--set: Bone / Cells = 'four'"
ls no 2> /dev/null

ranks 2 $scene --set "Interface/Characteristic slip distance={{0.02|0.04}}" --set Output/Directory=no || said "are processes of one machine"

# a modulus that makes no sense in the cells of one process only
wrong='18000 + if(abs(y + 5.986) < 0.01, -1e5, 0) * abs(x)'
ranks 2 $scene --set "Bone/Young modulus=$wrong" --set Output/Directory=wrong-scene || said "expected 1e-6 to 1e12 MPa"
# what only the first process meets: another run at work, a file that cannot be written; and a network without memory in common
mkdir -p locked blocked/parameters.prm.partial
exec 9< locked
flock 9
for directory in locked blocked; do
  ranks 2 $scene --set Output/Directory=$directory || grep -a -o -e "another run of debond is at work" -e "cannot write" said
done
exec 9<&-
OMPI_MCA_btl=tcp,self OMPI_MCA_btl_tcp_if_include=lo ranks 2 $scene --set "Load steps/Steps=1,1" --set Output/Directory=tcp && echo "by TCP"

echo "a process that is killed"
"$run" "$mpirun" 2 "$debond" $scene --set "Load steps/Steps=1,40" --set "Expert/Output/Checkpoint minutes=1e-9" --set "Output/Fields every=none" --set Output/Directory=killed > said 2>&1 &
job=$!
while [ ! -e killed/checkpoint-2 ]; do sleep 0.1; done
kill -9 "$(pgrep -f "Output/Directory=killed" | tail -n 1)"
tenths=0
while kill -0 $job 2> /dev/null && [ $tenths -lt 100 ]; do
  sleep 0.1
  tenths=$((tenths + 1))
done
kill -0 $job 2> /dev/null || echo "ends the others within 10 s"
wait $job
ranks 3 --resume killed || cat said
said "Going on after step"
"$debond" $scene --set "Load steps/Steps=1,40" --set "Output/Fields every=none" --set Output/Directory=whole > /dev/null
tail -n 1 killed/torque.csv | cut -d, -f1-4 > last-1
tail -n 1 whole/torque.csv | cut -d, -f1-4 > last-2
numdiff -q -r 1e-6 -s ,'\n' last-1 last-2 && echo "goes on with three"
