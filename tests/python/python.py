"""The module of Python against the program, its own steps against expressions, a law as a function against Eq. (13); what
mistakes are answered with. Usage: python.py DEBOND, where `import debond` finds the module."""

import copy
import json
import math
import os
import pickle
import subprocess
import sys
import threading

import numpy

import debond

program = sys.argv[1]

COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n"
coin = COIN + """
subsection Bone
  set Cells    = 8, 8, 2
  set Material = linear
end
subsection Implant
  set Cells    = 4, 4
  set Material = linear
end
subsection Interface
  set Normal stiffness = 585
  set Tangential stiffness = 400
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
subsection Output
  set Fields every = none
end
subsection Expert
  subsection Interface
    set Quadrature points = 4
  end
end
"""


def check(what, is_so):
    print(f"{what}: {'yes' if is_so else 'NO'}", flush=True)


def mistake(call):
    try:
        call()
        print("  NO error")
    except (debond.SceneError, debond.RunError) as error:
        print(f"  {type(error).__name__}: {error}")
        return error


def same_as_summary(entries):
    """Whether run() has all measures of the summary.json that write() leaves, with these among them."""
    scene = debond.Scene(text=coin, entries={"Expert/Output/Console": "quiet", "Output/Report": False, **entries})
    with open(scene.write("summarised", force=True) + "/summary.json", encoding="utf-8") as file:
        written = json.load(file)
    mine = scene.run().summary
    return ({"W_adh_Nmm", "E_bulk_Nmm", "initial_stiffness_Nmm_per_rad", "w_adh_N_per_m"} <= set(mine)
            and all(value == written[name] for name, value in mine.items()))


def check_program():
    with open("coin.prm", "w", encoding="utf-8") as file:
        file.write(coin)
    subprocess.run([program, "coin.prm", "--set", "Output/Directory=of_program", "--force"], check=True, stdout=subprocess.DEVNULL)
    table = numpy.genfromtxt("of_program/torque.csv", delimiter=",", names=True)
    rows = debond.Scene("coin.prm").run().rows
    check("columns and numbers of torque.csv",
          set(rows) == set(table.dtype.names)
          and all(numpy.allclose(rows[name], table[name], rtol=1e-11, atol=0) for name in rows))
    check("the same from a text", numpy.array_equal(rows["torque_Nmm"], debond.Scene(text=coin).run().rows["torque_Nmm"]))
    directory = debond.Scene("coin.prm", {"Expert/Output/Console": "quiet"}).write("of_python", force=True)
    check("the same files in a directory", open("of_program/torque.csv").read() == open(directory + "/torque.csv").read()
          and os.path.exists(directory + "/report.html"))
    asked = {"Expert/Output/Friction energy from angle": 2, "Expert/Output/Observed bonding": 0.8, "Output/Reference curve": "of_program/torque.csv"}
    check("the measures of summary.json", same_as_summary({}) and same_as_summary({"Model": "foundation"}))
    check("and with what Output asks for", same_as_summary(asked) and same_as_summary({"Model": "foundation", **asked}))
    try:
        import pandas

        check("a frame of pandas", isinstance(debond.Scene("coin.prm").run().frame(), pandas.DataFrame))
    except ImportError:
        check("a frame of pandas", True)


def check_drive():
    rows = debond.Scene(text=coin).run().rows
    simulation = debond.Simulation(debond.Scene(text=coin), drive={"Translation z": 0, "Rotation z": 0})
    for time in rows["time"]:
        simulation.advance({"Translation z": -0.0049 * min(time, 1), "Rotation z": 5 * max(time - 1, 0)})
        if abs(time - 1.05) < 1e-9:  # a part sticks, a part slides
            early, share = simulation.points(), simulation.row["share_slip"]
    driven = simulation.result().rows
    check("driven by a script, the same curve",
          all(numpy.allclose(rows[name], driven[name], rtol=1e-9, atol=1e-9) for name in rows if name != "newton_iterations"))
    points = simulation.points()
    area, row, slides = points["area_mm2"], simulation.row, early["state"] == 2
    check("points of the face carry the force",
          abs(numpy.sum(points["pressure_MPa"] * area) / row["force_N"] - 1) < 1e-6)
    check("and the torque", abs(numpy.sum(points["traction_MPa"] * points["r_mm"] * area) / row["torque_Nmm"] - 1) < 1e-4)
    check("their phi is the mean of the row", abs(numpy.average(points["phi"], weights=area) - row["phi_mean"]) < 1e-12)
    check("their share that slides, too", abs(area[slides].sum() / area.sum() - share) < 1e-12 and 0.2 < share < 0.9)
    strength = early["mu"] * early["pressure_MPa"]
    check("they slide with mu p, and stick with less", numpy.allclose(early["traction_MPa"][slides], strength[slides])
          and (early["traction_MPa"][~slides] < strength[~slides]).all())
    check("their mu is that of phi, Eq. (12)", numpy.allclose(points["mu"], 0.4 + points["phi"] * (0.58 - 0.4), rtol=1e-12))
    check("r is the distance from the axis", numpy.allclose(numpy.hypot(points["x_mm"], points["y_mm"]), points["r_mm"]))
    check("they have slid by r theta at most, by the springs less",
          (points["slip_mm"] < points["r_mm"] * math.radians(row["angle_deg"])).all()
          and points["slip_mm"].max() > 0.9 * 2.5 * math.radians(row["angle_deg"]))

    # sides of the bone slide along themselves: each cross section carries the force
    n, width, depth = 60, 12.5, 5.0
    at = (numpy.arange(n) + 0.5) / n * width - width / 2
    x, y = (one.ravel() for one in numpy.meshgrid(at, at))
    stress = simulation.bulk("bone", numpy.column_stack([x, y, numpy.full(n * n, -depth / 2)]))["stress_MPa"]
    check("a cross section of the bone carries the force, to 1 %",
          abs(-stress[:, 2, 2].sum() * (width / n) ** 2 / row["force_N"] - 1) < 0.01)
    moved = simulation.bulk("implant", [[2.4, 0, 2.0], [0, 2.4, 2.0], [9, 9, 9]])["displacement_mm"]
    cosine, sine = math.cos(math.radians(5)), math.sin(math.radians(5))
    turned = 2.4 * numpy.array([[cosine - 1, sine], [-sine, cosine - 1]])
    check("the implant turns with the chuck, to 1 um", abs(moved[:2, :2] - turned).max() < 1e-3)
    check("and is not elsewhere", numpy.isnan(moved[2]).all())

    # a force that depends on what the run has answered
    force = {"Chuck/Press/Control": "force", "Load steps/Times": [0, 1], "Load steps/Steps": 20}
    simulation = debond.Simulation(debond.Scene(text=coin, entries=force), drive={"Press": 50, "Rotation z": 0})
    simulation.advance()
    while not simulation.is_finished:
        row = simulation.row
        simulation.advance({"Press": 50 + 0.5 * row["torque_Nmm"], "Rotation z": row["angle_deg"] + 0.2})
    rows = simulation.result().rows
    check("a force that follows the torque", numpy.allclose(rows["force_N"][1:], 50 + 0.5 * rows["torque_Nmm"][:-1], rtol=1e-6))


def check_law():
    a_s, b_s = 0.022, 0.74

    def phi(slip):  # Eq. (13)
        return 0.5 - 0.5 * numpy.sin(numpy.pi / 2 * numpy.clip((slip / a_s - 1) / b_s - 1, -1, 1))

    of_paper = {"Interface/Characteristic slip distance": a_s, "Interface/Transition factor": b_s}
    torque = [debond.Scene(**scene).run().rows["torque_Nmm"]
              for scene in (dict(text=coin, entries=of_paper), dict(text=coin, law=(phi, (1 + 2 * b_s) * a_s)))]
    check("a law as a function, Eq. (13) to 2e-4 of T_max", numpy.abs(torque[0] - torque[1]).max() < 2e-4 * torque[0].max())
    check("and not that of another distance",
          numpy.abs(torque[0] - debond.Scene(text=coin, law=(lambda s: phi(s / 1.01), 0.06)).run().rows["torque_Nmm"]).max()
          > 1e-3 * torque[0].max())


def check_more():
    seen = []
    scene = debond.Scene(text=coin, entries={"Interface/Friction coefficient unbroken": 0.58})
    result = scene.run(on_row=lambda row: seen.append(row["torque_Nmm"]))
    check("each row is shown", seen == list(result.rows["torque_Nmm"]))
    closed = debond.Scene(text=coin, entries={"Model": "foundation"}).run()
    check("closed forms", 1e-3 < abs(closed.rows["torque_Nmm"].max() / result.rows["torque_Nmm"].max() - 1) < 2e-2)

    too_much = {"Chuck/Rotation z/Control": "moment", "Chuck/Rotation z/Value": "60 * max(t - 1, 0)"}
    simulation = debond.Simulation(debond.Scene(text=coin, entries=too_much))
    try:
        simulation.run()
        check("a moment that friction cannot hold ends the run", False)
    except debond.RunError as error:
        check("a moment that friction cannot hold ends the run", "Path following" in str(error))
    held = simulation.result().rows["torque_Nmm"]
    check("the rows before stay", 0.9 * result.rows["torque_Nmm"].max() < held[-1] < 1.02 * result.rows["torque_Nmm"].max())

    class Enough(Exception):
        pass

    def stop(row):
        if row["step"] == 3:
            raise Enough

    simulation = debond.Simulation(debond.Scene(text=coin))
    try:
        simulation.run(on_row=stop)
    except Enough:
        pass
    check("what on_row raises ends the run, and it can go on", simulation.row["step"] == 3)
    simulation.run()
    check("to the same end", simulation.row["torque_Nmm"] == debond.Scene(text=coin).run().rows["torque_Nmm"][-1])

    simulation = debond.Simulation(debond.Scene(text=coin), drive={"Rotation z": 0})
    turn = [simulation.advance({"Rotation z": 0.1 * i}) or simulation.save() for i in range(12)]
    at_end, other = simulation.result().rows, debond.Simulation(debond.Scene(text=coin), drive={"Rotation z": 0})
    other.restore(turn[5])
    for i in range(6, 12):
        other.advance({"Rotation z": 0.1 * i})
    check("a state that was saved goes on to the last bit", all((other.result().rows[name] == at_end[name]).all()
                                                               for name in ("torque_Nmm", "phi_mean", "chuck_Fz_N")))

    # the interpreter takes the lock from nobody within a minute: who counts got it from a run that gave it back
    others, done, counted, interval = [], threading.Event(), 0, sys.getswitchinterval()
    sys.setswitchinterval(60)
    counter = threading.Thread(target=lambda: [others.append(1) or done.wait(1e-4) for _ in iter(done.is_set, True)])
    counter.start()
    for _ in range(100):
        simulation = debond.Simulation(debond.Scene(text=coin))
        before = len(others)
        simulation.run()
        counted += len(others) - before
        if counted > 5:
            break
    done.set()
    counter.join()
    sys.setswitchinterval(interval)
    check("other threads go on meanwhile", counted > 5)


def check_calibration():
    debond.Scene(text=coin, entries={"Expert/Output/Console": "quiet"}).write("measured", force=True)
    fit = debond.calibrate(debond.Scene(text="set Task = calibrate\n" + coin, entries={
        "Interface/Friction coefficient unbroken": "<<0.5 in 0.3..1.2>>",
        "Interface/Characteristic slip distance": "<<0.015 in 0.006..0.1 log>>",
        "Output/Reference curve": "measured/torque.csv", "Output/Reference columns": "angle_deg, torque_Nmm",
        "Output/Directory": "fit", "Expert/Calibration/Starts": 4}), force=True)
    found = [unknown["value"] for unknown in fit["unknowns"].values()]
    defaults = debond.Scene(text=coin).parameters
    truth = [float(next(line for line in defaults.splitlines() if f"set {name} " in line).split("=")[1].split("#")[0])
             for name in ("Friction coefficient unbroken", "Characteristic slip distance")]
    check("a curve gives its parameters back", numpy.allclose(found, truth, rtol=1e-4))


def check_defaults():
    entries = {"Model": "foundation", "Chuck/Press/Value": "0.0049 * min(t, 1)", "Chuck/Rotation z/Value": "10 * max(t - 1, 0)",
               "Bone/Size": "12, 12, 5", "Bone/Young modulus": 18000, "Implant/Radius": 2.5, "Implant/Height": 3,
               "Implant/Young modulus": 113000, "Interface/Normal stiffness": 585, "Interface/Bonding/Bonding degree": 1,
               "Interface/Friction coefficient broken": 0.4, "Interface/Friction coefficient unbroken": 0.58,
               "Interface/Characteristic slip distance": 0.022, "Interface/Tangential stiffness": "auto",
               "Interface/Transition factor": 0.74}
    result = debond.Scene(entries=entries).run()
    check("a scene of entries alone: T_max is 2/3 pi mu_ub p R^3",
          abs(result.summary["T_max_Nmm"] / (2 / 3 * math.pi * 0.58 * result.summary["pressure_MPa"] * 2.5**3) - 1) < 0.01)


def check_mistakes():
    print("Mistakes")
    error = mistake(lambda: debond.Scene(text=coin, entries={"Interface/Characteristic slip distence": 0.02}).run())
    error = mistake(lambda: debond.Scene(text=coin, entries={"Interface/Characteristic slip distance": -1}).run())
    check("  entry, value and place", (error.entry, error.value, error.place) == ("Interface / Characteristic slip distance", "-1", "entries"))
    mistake(lambda: debond.Scene("con.prm").run())
    mistake(lambda: debond.Simulation("coin.prm"))
    mistake(lambda: debond.Scene({"Interface/Characteristic slip distance": 0.02}))
    mistake(lambda: debond.Simulation(debond.Scene(text=coin)).advance({"Rotation z": 1}))
    mistake(lambda: debond.Simulation(debond.Scene(text=coin), drive={"Rotation": 0}))
    mistake(lambda: debond.Simulation(debond.Scene(text=coin), drive={"Rotation z": "fast"}))
    mistake(lambda: debond.Simulation(debond.Scene(text=coin, entries={"Load steps/Adaptive": True}), drive={"Rotation z": 0}))
    mistake(lambda: debond.Simulation(debond.Scene(text=coin)).row)
    mistake(lambda: debond.Simulation(debond.Scene(text=coin)).restore(b"no state"))
    mistake(lambda: debond.Scene(text=coin, law=(0.022, 0.74)))
    mistake(lambda: debond.Scene(text=coin, law=(lambda slip: 1 + slip, 0.1)))
    mistake(lambda: debond.Scene(text=coin, law=(lambda slip: 0.5, 0.1)))
    mistake(lambda: debond.Scene(text=coin, law=(lambda slip: 1 - slip if slip < 0.0875 else 1, 0.1)))
    # an unknown is for fits, whatever is asked for
    unknown = debond.Scene(text=coin, entries={"Task": "calibrate", "Interface/Friction coefficient broken": "<<0.4 in 0.1..1>>"})
    error = mistake(unknown.run)
    for ask in (lambda: unknown.write("unknown"), lambda: debond.Simulation(unknown), lambda: unknown.parameters, lambda: unknown.warnings):
        check("  the same", types_of(ask) == (debond.SceneError, str(error)))
    check("  the same of one of many", "debond.fit(scene)" in str(debond.run_many([unknown])[0]))


def types_of(call):
    """The class of what a call raises, and its text."""
    try:
        call()
    except Exception as error:
        return type(error), str(error)


def check_types():
    """Every function of the package answers an argument of a wrong type with one line that names it."""
    print("Wrong types")
    scene = debond.Scene(text=coin)
    for name, calls in {
            "scene": [lambda: debond.Scene(5), lambda: debond.fit(5), lambda: debond.calibrate(5), lambda: debond.fit_specimens(5, "a.csv")],
            "entries": [lambda: debond.Scene(None, "x"), lambda: debond.Scene(scene, [1])],
            "text": [lambda: debond.Scene(text=5)],
            "scenes": [lambda: debond.run_many("x", base=scene), lambda: debond.run_many(5), lambda: debond.run_many({"Bone/Cells": 4})],
            "jobs": [lambda: debond.run_many([], jobs="2"), lambda: debond.fit_specimens(scene, "a.csv", jobs=0)],
            "threads": [lambda: debond.fit(scene, threads="2"), lambda: debond.calibrate(scene, 0), lambda: debond.set_number_of_threads(1.5)],
            "executor": [lambda: debond.run_many([], 5), lambda: debond.fit(scene, executor=5), lambda: debond.calibrate(scene, executor=5)],
            "say": [lambda: debond.fit(scene, say=5), lambda: debond.fit_specimens(scene, "a.csv", say="x")],
            "evaluations": [lambda: debond.fit(scene, evaluations=5)],
            "table": [lambda: debond.fit_specimens(scene, 5)],
            "directory": [lambda: scene.write(5), lambda: debond.ensemble(5)],
            "values of the chuck": [lambda: debond.Simulation(scene, drive=5), lambda: debond.Simulation(scene).advance("x")],
            "law": [lambda: debond.sample_law(5, 1), lambda: debond.sample_law(lambda slip: 1, "1")]}.items():
        said = [types_of(call) for call in calls]
        check(f"  {name}", all(one and one[0] is debond.SceneError and one[1].startswith(name + ": ") and "expected " in one[1] and
                             "\n" not in one[1] for one in said))


def check_warnings():
    """Entries without an effect are said of a script and of a scene, not of a file that it includes."""
    print("Entries without effect")
    with open("base.prm", "w", encoding="utf-8") as file:
        file.write(coin + "subsection Interface\n  set Transition factor = 0.5\nend\n")
    with open("rubs_not.prm", "w", encoding="utf-8") as file:
        file.write("include base.prm\nsubsection Interface\n  set Friction law = frictionless\nend\n")
    without_effect = [text for text in debond.Scene("rubs_not.prm").warnings if "no effect" in text]
    check("  none of the included file", not without_effect)
    for scene in (debond.Scene("rubs_not.prm", {"Interface/Characteristic slip distance": 0.03}),
                  debond.Scene(text=coin + "subsection Interface\n  set Friction law = frictionless\n  "
                                           "set Characteristic slip distance = 0.03\nend\n")):
        without_effect = [text for text in scene.warnings if "Characteristic slip distance = 0.03 has no effect" in text]
        check("  one of its own", len(without_effect) == 1)


def check_copies():
    """Pickled scenes, a law among them, run as what they are copies of; they live without it."""
    print("Copies")
    law = debond.Scene(text=coin, entries={"Load steps/Steps": "1, 6"}, law=(lambda slip: max(0, 1 - slip / 0.05), 0.06))
    expected = law.run().rows["torque_Nmm"]
    copies = [pickle.loads(pickle.dumps(law)), copy.deepcopy(law), debond.Scene(law)]
    del law
    check("  of a scene with a law", all(numpy.array_equal(one.run().rows["torque_Nmm"], expected) for one in copies))
    once = debond.Scene(text=coin, entries={"Load steps/Steps": "1, 6"})
    alone = debond.Scene(once, {"Interface/Characteristic slip distance": 0.05}).run().rows["torque_Nmm"]
    many = debond.run_many([{"Interface/Characteristic slip distance": 0.05}], base=once)[0].rows["torque_Nmm"]
    again = debond.Scene(text=pickle.loads(pickle.dumps(once)).parameters,
                         entries={"Interface/Characteristic slip distance": 0.05}).run().rows["torque_Nmm"]
    check("  of a scene that is the base of others", numpy.array_equal(alone, many) and numpy.array_equal(alone, again))
    error = pickle.loads(pickle.dumps(debond.run_many([{"Bone/Cells": "x"}], base=once)[0]))
    check("  of a mistake", error.entry == "Bone / Cells" and "expected" in str(error))


def check_latin_1():
    """Scenes and what they include may be in Latin-1, as German editors of Windows write them; results are in UTF-8."""
    title = "B\xfcchse, 10 \xb5m"
    with open("latin_1.prm", "w", encoding="latin-1") as file:
        file.write("include latin_1_base.prm\nset Title = " + title + "  # \xfc\n")
    with open("latin_1_base.prm", "w", encoding="latin-1") as file:
        file.write(COIN + "# \xe4\nset Model = foundation\nsubsection Chuck\n subsection Press\n  set Value = 0.005\n end\n subsection Rotation z\n  set Value = 5 * t\n end\nend\n")
    scene = debond.Scene("latin_1.prm")
    for name, more in (("file", []), ("option", ["--set", "Title=" + title])):
        command = [text.encode("latin-1") for text in (program, "latin_1.prm", *more, "--set", "Output/Directory=latin_1")]
        done = subprocess.run(command, capture_output=True)
        with open("latin_1/parameters.prm", "rb") as file:
            check(f"a title in Latin-1, of the {name}", done.returncode == 0 and f"= {title}\n".encode() in file.read())
    check("the same from Python", f"= {title}\n" in scene.parameters and len(scene.run().rows["angle_deg"]) > 10)
    with open("latin_1_fit.prm", "w", encoding="latin-1") as file:
        file.write("include latin_1.prm\nset Task = calibrate\nsubsection Interface\n set Friction coefficient broken = <<0.3 in 0.1..0.8>>\nend\n"
                   "subsection Output\n set Reference curve = latin_1/torque.csv\n set Directory = latin_1_fit\nend\n")
    done = subprocess.run([program, "latin_1_fit.prm"], capture_output=True)
    check("a fit in Latin-1", done.returncode == 0 and done.stderr == b"" and os.path.exists("latin_1_fit/calibration.json"))


check_program()
check_warnings()
check_copies()
check_latin_1()
check_drive()
check_law()
check_more()
check_calibration()
check_defaults()
check_mistakes()
check_types()
