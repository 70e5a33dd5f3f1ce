"""The module of Python under mpirun: each process by itself, or those of a communicator together. Numbers are those of the
direct solver in one process, which other tests compare with exact solutions and independent codes.
Usage: ranks.py MPIRUN.sh MPIRUN [one-and-three], where `import debond` finds the module and mpi4py is there. It starts itself
under mpirun, as `ranks.py CASE,...`, and prints what must be so. one-and-three: only what two processes by themselves do, in one
and in three."""

import json
import os
import subprocess
import sys

CASES = {}
COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Bone
  set Cells       = 8, 8, 2
  set Material    = linear
end
subsection Implant
  set Cells    = 4, 2
  set Material = linear
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 5 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 4
end
subsection Output
  set Report = false
end
subsection Expert
  subsection Bone
    set Solver = multigrid
  end
  subsection Load steps
    set Residual tolerance = 1e-10
  end
  subsection Output
    set Console = quiet
  end
end
"""
DIRECT = {"Expert/Bone/Solver": "direct"}
STIFFER = {"Interface/Normal stiffness": 1800}
LONGER = {"Load steps/Steps": [1, 9], **STIFFER}  # other numbers of sums over processes


def case(function):
    CASES[function.__name__] = function
    return function


def own_rank():
    return int(os.environ.get("OMPI_COMM_WORLD_RANK", os.environ.get("PMI_RANK", 0)))


def coin(entries=None, **more):
    import debond

    return debond.Scene(text=COIN, entries=entries, **more)


def forces(result):
    return [list(result.rows[name]) for name in ("force_N", "torque_Nmm")]


def refusal(call):
    """The message, but for what a file has in it."""
    import debond

    try:
        call()
    except (debond.SceneError, debond.RunError) as error:
        return f"{type(error).__name__}: {error}".split(" bytes, CRC")[0]
    return "NO error"


# ---- What each process does: it returns what is to be compared.


@case
def without_mpi4py():
    return forces(coin().run())


@case
def mpi4py_first():
    from mpi4py import MPI

    return [forces(coin().run()), forces(coin().run(comm=MPI.COMM_WORLD)), MPI.COMM_WORLD.size]


@case
def mpi4py_later():
    alone = forces(coin().run())
    from mpi4py import MPI

    return [alone, forces(coin().run(comm=MPI.COMM_WORLD)), MPI.COMM_WORLD.size]


@case
def other_scenes():
    return forces(coin(LONGER if own_rank() == 1 else None).run())


@case
def one_without_multigrid():
    from mpi4py import MPI

    return forces(coin(DIRECT if MPI.COMM_WORLD.rank == 0 else None).run())


@case
def unhappy():  # an error of Python in all of them ends them as it always does
    coin().run()
    raise ValueError("as it should be")


def of_pool(stiffness):
    return forces(coin({"Interface/Normal stiffness": stiffness}).run())


STIFFNESSES = [400, 585, 1800]


@case
def futures():
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as pool:
        return list(pool.map(of_pool, STIFFNESSES))


@case
def together():
    """Two teams of two with scenes of their own, driven in steps, while each process has a simulation of its own."""
    from mpi4py import MPI
    import debond

    group = MPI.COMM_WORLD.Split(MPI.COMM_WORLD.rank % 2)
    entries = LONGER if MPI.COMM_WORLD.rank % 2 else {}
    shared = debond.Simulation(coin(entries), drive={"Rotation z": 0}, comm=group)
    group.Free()  # the simulation has one of its own
    alone = debond.Simulation(coin(STIFFER))
    angle = 0
    while not shared.is_finished:
        shared.advance({"Rotation z": angle})
        if not alone.is_finished:
            alone.advance()
        angle += 0.2
    alone.run()
    return [forces(shared.result()), forces(alone.result()), shared.points()["slip_mm"].sum()]


@case
def refused():
    """One message on all processes, and none of them waits."""
    from mpi4py import MPI
    import debond

    comm, rank = MPI.COMM_WORLD, MPI.COMM_WORLD.rank
    first = rank == 0
    said = {
        "scenes": refusal(lambda: coin(None if first else LONGER).run(comm=comm)),
        "closed forms": refusal(lambda: coin({"Model": "foundation", "Interface/Friction coefficient unbroken":
                                              0.5 if first else 0.6}).run(comm=comm)),
        "laws": refusal(lambda: coin(law=(lambda s: 1 / (1 + s / (0.04 + 0.01 * rank)), 1)).run(comm=comm)),
        "an entry of one": refusal(lambda: coin({} if first else {"Bone/Cells": "four"}).run(comm=comm)),
        "solver": refusal(lambda: coin(DIRECT).run(comm=comm)),
        "what is driven": refusal(lambda: debond.Simulation(coin(), drive={"Rotation z": rank}, comm=comm)),
        "no number": refusal(lambda: debond.Simulation(coin(), drive={"Rotation z": 0 if first else "x"}, comm=comm)),
        "no scene": refusal(lambda: debond.Simulation(coin() if first else "coin.prm", comm=comm)),
        "no communicator": refusal(lambda: coin().run(comm=2)),
        "not in it": refusal(lambda: coin().run(comm=MPI.COMM_NULL)),
    }
    simulation = debond.Simulation(coin(), drive={"Rotation z": 0}, comm=comm)
    said["where to"] = refusal(lambda: simulation.advance({"Rotation z": rank}))
    said["run and advance"] = refusal(simulation.run if first else simulation.advance)
    said["no function"] = refusal(lambda: simulation.run(None if first else "row"))
    simulation.run()  # it is as it was

    # a law that is the same, in files of their own
    law = (lambda s: 1 / (1 + (s / 0.04) ** 2), 1)
    return [said, coin(law=law).run(comm=comm).rows["torque_Nmm"][-1], coin({**DIRECT}, law=law).run().rows["torque_Nmm"][-1]]


@case
def looking_on():
    """What on_row raises on one process ends the run of all, in the same row; it can go on."""
    from mpi4py import MPI
    import debond

    def stop(row):
        if row["step"] == 2 and MPI.COMM_WORLD.rank == 1:
            raise LookupError("enough")

    simulation = debond.Simulation(coin(), comm=MPI.COMM_WORLD)
    try:
        simulation.run(on_row=stop)
        said = "NO error"
    except (LookupError, debond.RunError) as error:
        said = f"{type(error).__name__}: {error}"
    step = simulation.row["step"]
    simulation.run()
    return [said, step, forces(simulation.result())]


@case
def into_directory():
    from mpi4py import MPI

    return coin().write("written", force=True, comm=MPI.COMM_WORLD)


@case
def full_disk():
    """What one process alone has met ends all."""
    from mpi4py import MPI

    os.makedirs("full/torque.csv.partial", exist_ok=True)
    coin().write("full", force=True, comm=MPI.COMM_WORLD)


@case
def too_late():
    from mpi4py import MPI
    import debond.scene

    MPI.Finalize()
    return [refusal(lambda: coin().run()), forces(coin(DIRECT).run())]


# ---- What must be so.


def check(what, is_so):
    print(f"{what}: {'yes' if is_so else 'NO'}", flush=True)


def same(a, b, tolerance=1e-7):
    import numpy

    return numpy.shape(a) == numpy.shape(b) and numpy.allclose(a, b, rtol=tolerance, atol=tolerance * numpy.abs(b).max())


def run(n, names, *options, n_lines=0):
    """What the cases, one after the other, return in each of n processes, of several as {name: returned}; what they have said if
    they do not end with 0 and so many lines."""
    names = names.split(",")
    files = [f"{name}.{rank}" for name in names for rank in range(n)]
    for file in files:
        if os.path.exists(file):
            os.remove(file)
    done = subprocess.run([sys.argv[1], sys.argv[2], str(n), sys.executable, *options, os.path.abspath(__file__), ",".join(names)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=400)
    if done.returncode != 0 or len(done.stdout.splitlines()) != n_lines:
        return done
    said = {name: [json.load(open(f"{name}.{rank}")) for rank in range(n) if os.path.exists(f"{name}.{rank}")] for name in names}
    return said if len(names) > 1 else said[names[0]]


def check_by_themselves(n, by_direct, more=()):
    """Each of n processes; returns what `more` cases give after those that import mpi4py first."""
    said = run(n, "without_mpi4py")
    check(f"  {n} without mpi4py", said == [said[0]] * n and same(said[0], by_direct))
    found = run(n, ",".join(["mpi4py_first", *more]), n_lines=len(more) > 0)  # a warning, of the first one
    for name, said in ("mpi4py_first", found["mpi4py_first"] if more else found), ("mpi4py_later", run(n, "mpi4py_later")):
        check(f"  {n}, {name}, then together", len(said) == n and all(
            same(alone, by_direct) and same(joined, by_direct) and size == n for alone, joined, size in said))
    return found


def check_all():
    by_direct = forces(coin(DIRECT).run())
    stiffer, longer = forces(coin({**STIFFER, **DIRECT}).run()), forces(coin({**LONGER, **DIRECT}).run())

    print("Each process by itself")
    of_two = check_by_themselves(2, by_direct, ("one_without_multigrid", "looking_on", "into_directory"))
    of_three = run(3, "other_scenes,refused")
    said = of_three["other_scenes"]
    check("  scenes of their own", same(said[0], by_direct) and same(said[1], longer) and same(said[2], by_direct))
    said = of_two["one_without_multigrid"]
    check("  and solvers", len(said) == 2 and all(same(of_one, by_direct) for of_one in said))
    said = run(3, "futures", "-m", "mpi4py.futures")
    check("  a pool of mpi4py.futures", len(said) == 1 and all(
        same(found, forces(coin({"Interface/Normal stiffness": stiffness, **DIRECT}).run()))
        for found, stiffness in zip(said[0], STIFFNESSES)))
    said = run(2, "unhappy")
    check("  an error of Python", said.returncode == 1 and "as it should be" in said.stdout and "MPI_" not in said.stdout)
    said = run(2, "too_late")
    check("  after MPI has ended", all("MPI has been finalised" in message and same(found, by_direct) for message, found in said))

    print("Together")
    said = run(4, "together")
    check("  teams beside each other", len(said) == 4 and said[0] == said[2] and said[1] == said[3])
    check("  and beside single ones", all(same(of_one[1], stiffer) for of_one in said))
    rows = []
    for entries in {}, LONGER:
        import debond

        simulation = debond.Simulation(coin({**entries, **DIRECT}), drive={"Rotation z": 0})
        for step in range(len(longer[0]) if entries else len(by_direct[0])):
            simulation.advance({"Rotation z": 0.2 * step})
        rows.append([forces(simulation.result()), simulation.points()["slip_mm"].sum()])
    check("  as driven in one process",
          all(same(said[k][0], rows[k][0]) and abs(said[k][2] / rows[k][1] - 1) < 1e-6 for k in (0, 1)))
    said = of_two["looking_on"]
    print("  on_row on rank 1:", *(f"\n    {of_one[0]}" for of_one in said))
    check("  in the same row, and can go on", all(of_one[1] == 2 and same(of_one[2], by_direct) for of_one in said))
    said = of_two["into_directory"]
    import numpy

    table = numpy.genfromtxt("written/torque.csv", delimiter=",", names=True)
    check("  into a directory", said == ["written"] * 2 and same([table["force_N"], table["torque_Nmm"]], by_direct)
          and json.load(open("written/summary.json"))["processes"] == 2)
    said = run(2, "full_disk")
    check("  a file that cannot be written ends all", said.returncode not in (0, None) and "cannot write 'full/torque.csv'" in said.stdout)

    print("Refused")
    said = of_three["refused"]
    for name, message in said[0][0].items():
        print(f"  {name}:\n    {message}")
    check("  in the same words on all", all(of_one[0] == said[0][0] for of_one in said))
    check("  but not laws that are the same", all(abs(of_one[1] / of_one[2] - 1) < 1e-7 for of_one in said))


if __name__ == "__main__":
    if sys.argv[3:] == ["one-and-three"]:
        for n_processes in 1, 3:
            check_by_themselves(n_processes, forces(coin(DIRECT).run()))
    elif len(sys.argv) == 3:
        check_all()
    else:
        for name_of_case in sys.argv[1].split(","):
            result = CASES[name_of_case]()
            with open(f"{name_of_case}.{own_rank()}", "w", encoding="utf-8") as file:
                json.dump(result, file)
