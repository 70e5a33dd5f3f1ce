"""Simulation.advance() is all or nothing: after whatever is raised the simulation is in its last row to the last bit, and goes
on as if this had not been tried. The reference is a run that has never tried anything."""

import os
import signal
import threading
import time

import numpy

import debond

coin = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Bone
  set Cells    = 8, 8, 2
  set Material = linear
end
subsection Implant
  set Cells    = 4, 4
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
  set Steps = 2, 40
end
"""


def check(what, is_so):
    print(f"{what}: {'yes' if is_so else 'NO'}", flush=True)


def state(simulation):
    """All that a script can see."""
    result = simulation.result()
    return {"row": simulation.row, "is_finished": simulation.is_finished, "warnings": result.warnings, "summary": result.summary,
            "rows": {name: list(values) for name, values in result.rows.items()},
            "points": {name: list(values) for name, values in simulation.points().items()}}



def same(a, b):
    """To the last bit; what is no number is the same as itself."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[name], b[name]) for name in a)
    if isinstance(a, list):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    return a == b or (a != a and b != b)


def fails(simulation, error, call):
    """Whether a call raises the error and leaves the simulation as it was."""
    before = state(simulation)
    try:
        call()
    except error:
        return same(before, state(simulation))
    return False


def check_moments():
    """45 N mm hold, 60 do not: the row is divided until its parts are too small, and some parts are accepted."""
    moment = {"Chuck/Rotation z/Control": "moment", "Expert/Load steps/Smallest step fraction": 1e-2}

    def run(moments):
        simulation = debond.Simulation(debond.Scene(text=coin, entries=moment), drive={"Rotation z": 0, "Translation z": 0})
        as_before = []
        for z in (0, -0.003, -0.0049):
            simulation.advance({"Translation z": z})
        for value in moments:
            if value > 50:
                as_before.append(fails(simulation, debond.RunError, lambda: simulation.advance({"Rotation z": value})))
            else:
                simulation.advance({"Rotation z": value})
        return simulation, as_before

    tried, as_before = run([30, 45, 60, 300, 46, 60, 40, 30])
    plain, _ = run([30, 45, 46, 40, 30])
    check("a moment that is refused leaves no trace", as_before == [True, True, True])
    check("  what follows is as without it", same(state(tried), state(plain)))
    tried.run()
    plain.run()
    check("  so is the rest, at the moment of the last row", same(state(tried), state(plain)) and 25 < tried.row["torque_Nmm"] < 35)


def check_angles():
    """Turns of more than 5 degrees are divided; another component has no value at 25/32 of the step, within the
    last part, where steps look between their ends and scenes do not."""
    entries = {"Chuck/Translation x/Value": "0 * log(abs(t - 1.24453125) - 1e-6)"}
    simulation, plain = (debond.Simulation(debond.Scene(text=coin, entries=entries), drive={"Rotation z": 0}) for _ in range(2))
    for each in (simulation, plain):
        for step in range(12):  # to 1.225
            each.advance({"Rotation z": 0 if step < 3 else 9 if step == 11 else 0.1 * (step - 2)})
    check("an expression without value leaves no trace", all(
        fails(simulation, debond.SceneError, lambda: simulation.advance({"Rotation z": angle})) for angle in (9, 20, 9.5)))
    check("  nor does a component that is not driven",
          fails(simulation, debond.SceneError, lambda: simulation.advance({"Rotation z": 10, "Rotation x": 1})))
    check("  nor a value that is none", fails(simulation, debond.SceneError, lambda: simulation.advance({"Rotation z": None})))
    check("  as if they had not been tried", same(state(simulation), state(plain)))


def check_callbacks():
    """What a row is shown to raises when the row is complete: it stays."""
    plain = debond.Simulation(debond.Scene(text=coin))
    plain.run()

    class Stop(Exception):
        pass

    simulation, seen = debond.Simulation(debond.Scene(text=coin)), []

    def stop(row):
        seen.append(row["step"])
        if row["step"] % 7 == 3:
            raise Stop

    stopped = []
    while not simulation.is_finished:
        try:
            simulation.run(on_row=stop)
        except Stop:
            stopped.append(simulation.row["step"])
    check("the row whose function raises stays", stopped == [step for step in seen if step % 7 == 3] and len(stopped) == 6)
    check("  each is shown once", seen == list(range(43)))
    check("  as in one run", same(state(simulation), state(plain)))

    def nested(row):
        if row["step"] == 5:
            check("an error of the next row, in a function", fails(simulation, debond.RunError, simulation.advance))
            raise Stop

    entries = {"Chuck/Rotation z/Control": "moment", "Chuck/Rotation z/Value": "30 * max(t - 1, 0) + 1e4 * max(t - 1.08, 0)"}
    simulation = debond.Simulation(debond.Scene(text=coin, entries=entries))
    try:
        simulation.run(on_row=nested)
    except Stop:
        check("  the row before stays", simulation.row["step"] == 5)


def check_signals():
    """Ctrl-C, and a handler of the script's own, at any moment."""
    plain = debond.Simulation(debond.Scene(text=coin))
    plain.run()

    class Alarm(Exception):
        pass

    def ring(*_):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    for name, error, number in (("Ctrl-C", KeyboardInterrupt, signal.SIGINT), ("a signal of the script", Alarm, signal.SIGALRM)):
        for by_row in (False, True):
            n = 0
            while n == 0:  # the first signal may come before the first row, or behind the last
                simulation = debond.Simulation(debond.Scene(text=coin))
                while not simulation.is_finished:
                    sender = threading.Timer(0.02, os.kill, (os.getpid(), number))
                    try:
                        try:
                            sender.start()
                            if by_row:
                                while not simulation.is_finished:
                                    simulation.advance()
                            else:
                                simulation.run()
                        finally:
                            sender.cancel()
                            sender.join()
                    except error:
                        n += 1
                    try:
                        time.sleep(0)  # one that has come too late
                    except error:
                        pass
            check(f"{name} in {'advance' if by_row else 'run'}(), and on: as in one run", same(state(simulation), state(plain)))
    signal.signal(signal.SIGALRM, before)


check_moments()
check_angles()
check_callbacks()
check_signals()
