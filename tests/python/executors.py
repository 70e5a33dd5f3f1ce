"""Fits, specimens and studies by executors of concurrent.futures: threads, processes, those of mpi4py and Dask. Digits are
those of a fit without any; what goes wrong in a worker is said; a worker that dies ends a fit, and spoils no other specimen.

Ends with 1 and a message at the first thing that is wrong. Needs NumPy and SciPy; without mpi4py or Dask it leaves them out.
"""

import multiprocessing
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy

COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Bone
  set Cells    = 6, 6, 2
  set Material = linear
end
subsection Implant
  set Cells    = 3, 2
  set Material = linear
end
subsection Interface
  set Friction coefficient unbroken = <<mu_ub: 0.5 in 0.3..1.2>>
  set Characteristic slip distance = <<a_s: 0.03 in 0.004..0.1 log>>
  set Normal stiffness = 585
  set Tangential stiffness = 400
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = table
    set File = load.csv
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 12
end
subsection Output
  set Reference curve = measured.csv
end
subsection Expert
  subsection Calibration
    set Starts = 1
  end
end
"""
TRUTH = {"Interface/Friction coefficient unbroken": 0.58, "Interface/Characteristic slip distance": 0.022, "Output/Reference curve": "none"}


def check(is_so, message):
    if not is_so:
        sys.exit(f"executors: {message}")


def fit(executor=None):
    import debond

    found = debond.fit(debond.Scene(None, text=COIN), executor=executor)
    return [found.values.tolist(), found.lower.tolist(), found.upper.tolist(), found.problem.runs.n_runs]


def specimens(directory, executor=None):
    """Whole fits by an executor: one that works, and one that does not."""
    import debond

    found = debond.fit_specimens(debond.Scene(None, text=COIN), "specimens.csv", directory, executor=executor)
    check(list(found.failures) == ["B"] and "none.csv" in found.failures["B"], f"specimens: {found.failures}")
    with open(directory + "/parameters.csv", encoding="utf-8") as file:
        return file.read()


def failing(task):
    raise ZeroDivisionError("that is a mistake")


def dying(task):
    """A worker that dies, of the second specimen whenever it is tried."""
    if task == "dies":
        os._exit(9)
    return task


def check_fits(expected, expected_table):
    spawn, fork = (multiprocessing.get_context(kind) for kind in ("spawn", "fork"))
    elsewhere = {"initializer": os.chdir, "initargs": ("/",)}
    for name, executor in (("threads", ThreadPoolExecutor(2)),
                           ("processes that are spawned elsewhere", ProcessPoolExecutor(2, spawn, **elsewhere)),
                           ("forked processes", ProcessPoolExecutor(2, fork))):
        with executor:
            found = fit(executor)
            table = specimens("in " + name, executor)
        check(found == expected, f"{name}: {found}, without an executor {expected}")
        check(table == expected_table, f"{name}: specimens {table}, without an executor {expected_table}")
        print(f"{name}: the same digits", flush=True)


def check_mistakes():
    import debond
    from debond import executors, problem

    found = executors.results_of(dying, {"A": "lives", "B": "dies", "C": "lives too"}, n_jobs=2)
    check(found["A"] == "lives" and found["C"] == "lives too", f"a worker that dies spoils others: {found}")
    check(str(found["B"]) == executors.DIED, f"of a worker that dies: {found['B']!r}")
    for executor, n_jobs in ((None, 1), (ThreadPoolExecutor(1), 1)):
        found = executors.results_of(failing, {"A": 0}, executor, n_jobs)
        check(isinstance(found["A"], ZeroDivisionError), f"what a task raises is lost: {found}")

    class Dying(ProcessPoolExecutor):
        def map(self, function, tasks):
            return super().map(dying, ["lives", "dies"])

    with Dying(1, multiprocessing.get_context("spawn")) as executor:
        try:
            problem.Runs(executor).rows([1, 2])
            check(False, "a fit with a dead worker goes on")
        except debond.RunError as error:
            check("the executor failed: BrokenProcessPool" in str(error), f"of a dead worker: {error}")
    print("mistakes and deaths are said", flush=True)


def check_run_many():
    import debond

    text = COIN.replace("set Reference curve = measured.csv", "")
    good = debond.Scene(None, TRUTH, text=text)
    bad = debond.Scene(None, {**TRUTH, "Bone/Cells": "no"}, text=text)
    alone = good.run().rows["torque_Nmm"]
    entries = {"Model": "foundation", "Chuck/Rotation z/Value": "max(t - 1, 0)",
               "Chuck/Press/Value": "0.005 * min(t, 1)", "Implant/Radius": 2.5, "Interface/Friction law": "coulomb",
               "Interface/Friction coefficient": 0.4, "Interface/Tangential stiffness": "auto", "Closed form/Pressure": 3, "Expert/Closed form/Torsional stiffness": 300}
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as executor:
        for one in (None, executor):
            found = debond.run_many([good, bad, entries, {"No/Entry": 1}], one)
            check(numpy.array_equal(found[0].rows["torque_Nmm"], alone), "run_many: other digits than run()")
            check(isinstance(found[1], debond.SceneError) and found[1].entry == "Bone / Cells", f"run_many: {found[1]!r}")
            check(len(found[2].rows["torque_Nmm"]) > 10, "run_many: entries alone are a scene")
            check(isinstance(found[3], debond.SceneError), f"run_many: {found[3]!r}")
    print("many runs, and the mistakes of some", flush=True)


def check_mpi(expected):
    mpirun = shutil.which("mpirun")
    try:
        import mpi4py  # noqa: F401
    except ImportError:
        mpirun = None
    if not mpirun:
        return print("no mpi4py or mpirun: left out")
    # root of a container may use mpirun, and ranks may be more than processors
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "OMPI_MCA_mpi_yield_when_idle": "1"}
    command = [mpirun, "-n", "3", sys.executable, "-m", "mpi4py.futures", os.path.abspath(__file__), "--mpi", repr(expected)]
    done = subprocess.run(command, env={**os.environ, **allowed}, capture_output=True, text=True, timeout=300)
    check(done.returncode == 0 and "mpi4py: the same digits" in done.stdout, f"mpi4py: {done.stdout} {done.stderr}")
    print("mpi4py: the same digits", flush=True)


def under_mpi(expected):
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as executor:
        ranks = set(executor.map(rank, range(20)))
        found = [fit(executor), specimens("in mpi4py", executor)]
    check(0 not in ranks, f"ranks that worked: {ranks}")
    check(repr(found) == expected, f"mpi4py: {found}, alone {expected}")
    print("mpi4py: the same digits")


def rank(_):
    from mpi4py import MPI

    return MPI.COMM_WORLD.rank


def check_dask(expected):
    try:
        from dask.distributed import Client, LocalCluster
    except ImportError:
        return print("no dask.distributed: left out")
    with LocalCluster(2, threads_per_worker=1, dashboard_address=None, local_directory=os.getcwd()) as cluster:
        with Client(cluster) as client:
            found = [fit(client.get_executor()), specimens("in Dask", client.get_executor())]
    check(found == expected, f"Dask: {found}, without {expected}")
    print("Dask: the same digits", flush=True)


def main():
    import debond

    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        with open("load.csv", "w", encoding="utf-8") as file:
            file.write("time,chuck_rz_deg\n0,0\n1,0\n2,5\n")
        rows = debond.Scene(None, TRUTH, text=COIN).run().rows
        turned = rows["angle_deg"] > 0
        columns = numpy.column_stack([rows[name][turned] for name in ("angle_deg", "torque_Nmm")])
        numpy.savetxt("measured.csv", columns, "%.17g", ",", header="angle_deg,torque_Nmm", comments="")
        expected = fit()
        check(max(abs(numpy.array(expected[0]) / [0.58, 0.022] - 1)) < 1e-3, f"unknowns: {expected[0]}")
        with open("specimens.csv", "w", encoding="utf-8") as file:
            file.write("specimen,curve,Bone/Young modulus\nA,measured.csv,17000\nB,none.csv,16000\n")
        expected_table = specimens("alone")
        check_fits(expected, expected_table)
        check_mistakes()
        check_run_many()
        check_dask([expected, expected_table])
        check_mpi([expected, expected_table])
        os.chdir("/")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--mpi"]:
        under_mpi(sys.argv[2])
    else:
        main()
