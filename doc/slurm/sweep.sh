#!/bin/bash
# A study on a cluster: the variants are dealt out among 32 processes, and a table of what comes of them is written at the end.
# Submit it from the root of the repository. Where srun starts processes that do not know of each other: srun --mpi=pmix.
#   sbatch doc/slurm/sweep.sh prm/studies/ensemble.prm ensemble.csv
#SBATCH --job-name=debond-sweep
#SBATCH --ntasks=32
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=02:00:00
export PYTHONPATH=build/release/python OPENBLAS_NUM_THREADS=1
srun /usr/bin/python3 -m mpi4py.futures doc/slurm/sweep.py "$1" "$2"
