#!/bin/bash
# One large bone on 64 processes, on two nodes here. It leaves a checkpoint after every tenth step and when its time is
# over; submitted again, on any number of processes from two, it goes on from there. A run that is finished is left alone.
# Submit it from the root of the repository. Where srun starts processes that do not know of each other: srun --mpi=pmix.
#   sbatch doc/slurm/large.sh SCENE.prm DIRECTORY
#SBATCH --job-name=debond-large
#SBATCH --nodes=2
#SBATCH --ntasks=64
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=3500M
#SBATCH --time=12:00:00
#SBATCH --signal=TERM@300
scene=$1 directory=$2
if grep -qs '"converged": true' "$directory/summary.json"; then
  echo "$directory is finished"
elif compgen -G "$directory/checkpoint-?" > /dev/null; then
  srun build/release/debond --resume "$directory" --threads 1
else
  srun build/release/debond "$scene" --set "Output/Directory=$directory" --set "Expert/Output/Checkpoint every=10" --threads 1
fi
