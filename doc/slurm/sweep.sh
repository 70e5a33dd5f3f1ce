#!/bin/bash
# A study on a cluster: 32 processes take variants as they get free. The same command again goes on with what is missing.
# Submit it from the root of the repository. Where srun starts processes that do not know of each other: srun --mpi=pmix.
#   sbatch doc/slurm/sweep.sh prm/studies/ensemble.prm
#SBATCH --job-name=debond-sweep
#SBATCH --ntasks=32
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=02:00:00
#SBATCH --signal=TERM@120
# Two minutes before the time is over variants at work stop after their step, and study.csv is written.
srun build/release/debond "$1" --threads 1
