"""Runs the variants of a study on the processes of MPI, and writes a table of the measures of their curves.

    mpirun -np 4 /usr/bin/python3 -m mpi4py.futures doc/slurm/sweep.py prm/studies/ensemble.prm ensemble.csv
"""

import sys

import pandas
from mpi4py.futures import MPIPoolExecutor

import debond

if __name__ == "__main__":
    scene, table = sys.argv[1:]
    variants = debond.Scene(scene).variants()
    with MPIPoolExecutor() as executor:
        results = debond.run_many(variants, executor)
    rows = [{"variant": i, **(result.summary if isinstance(result, debond.Result) else {"failed": str(result)})}
            for i, result in enumerate(results, 1)]
    pandas.DataFrame(rows).to_csv(table, index=False)
