"""Relations that hold whatever the numbers are, on scenes by chance (scenes_by_chance.py): of each scene and of what the relation
makes of it all rows and measures are the same to 1e-9, in units, signs and axes as the relation says.

    relations.py N [JOBS [FIRST]]: the scenes FIRST (0) to FIRST + N - 1, in JOBS (1) processes
"""

import collections
import concurrent.futures
import math
import multiprocessing
import os
import re
import sys
import tempfile

import numpy

import _debond
import debond
from scenes_by_chance import Drawn, Mesh

TOLERANCE = 1e-9
UNITS = {"Bone/Young modulus": "MPa", "Implant/Young modulus": "MPa", "Interface/Interference": "mm"}  # expressions
COMPONENTS = [f"{kind} {axis}" for kind in ("Translation", "Rotation") for axis in "xyz"]
NOT_COMPARED = {"step", "newton_iterations", "warnings", "remarks", "curve"}
IDENTITY, MIRROR_X, MIRROR_Y = numpy.eye(3), numpy.diag([-1.0, 1, 1]), numpy.diag([1.0, -1, 1])
QUARTER = numpy.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


class Change:
    """Of units and axes of a scene and of its results: lengths times L, stresses times S, times times T, moved by P."""

    def __init__(self, L=1, S=1, T=1, P=IDENTITY):
        self.L, self.S, self.T, self.P, self.turn = L, S, T, P, numpy.linalg.det(P) * P
        self.handed = round(numpy.linalg.det(P))

    def factor(self, unit):
        """Of a quantity in this unit, as entries and columns write it."""
        text = re.sub(r"units? of ", "", unit).replace(" per ", "/").replace("_per_", "/").replace("N mm", "Nmm").replace("mm2", "mm*mm")
        force = self.S * self.L ** 2
        return eval(text or "1", {"mm": self.L, "m": self.L, "MPa": self.S, "N": force, "Nmm": force * self.L, "time": self.T, "rad": 1, "deg": 1,
                                  "degrees": 1})

    def expression(self, text, on_side):
        """In the new time and place what it was in the old ones."""
        old = {"t": f"(t / {self.T})"} if self.T != 1 else {}
        if self.L != 1 or self.handed < 0 or self.P[0, 0] != 1:
            for j, axis in enumerate("xyz"):
                i = abs(self.P[:, j]).argmax()
                old[axis] = f"({self.P[i, j]:g} * {'xyz'[i]} / {self.L})"
            old["r"], old["R"] = f"(r / {self.L})", f"(R / {self.L})"
        if on_side and "y" in old:  # the length around the side, and along the axis
            old["x"], old["y"] = f"({self.handed} * x / {self.L})", f"(y / {self.L})"
        return re.sub(r"\b[txyzrR]\b", lambda name: old.get(name[0], name[0]), text)

    def entries(self, scene):
        result = {}
        for name, text in scene.entries.items():
            expert = "Expert/" * name.startswith("Expert/")
            section, _, entry = name[len(expert):].rpartition("/")
            sign = 1
            if section[6:] in COMPONENTS:  # of the chuck
                k = COMPONENTS.index(section[6:])
                A = self.turn if k > 2 else self.P
                i = abs(A[:, k % 3]).argmax()
                section, sign = "Chuck/" + COMPONENTS[k - k % 3 + i], int(A[i, k % 3]) if entry == "Value" else 1
            unit = UNITS.get(name) or _debond.unit_of(name.replace("/", " / "))
            if entry == "Value":
                is_turn, is_load = "Rotation" in section, scene.entries.get(name[:-5] + "Control") in ("force", "moment")
                unit = ("N mm" if is_turn else "N") if is_load else ("deg" if is_turn else "mm")
            factor = sign * self.factor(unit)
            if entry in ("Value", "Interference", "Expression") or entry == "Young modulus" and "x" in text:
                text = self.expression(text, scene.on_side)
                text = text if factor == 1 else f"{factor} * ({text})"
            elif unit and factor != 1 and text not in ("auto", "none"):
                text = ", ".join(repr(factor * float(number)) for number in text.split(","))
            if self.P[0, 1] and text.count(",") == 2 and (entry == "Size" or entry == "Cells" and
                                                          scene.entries.get(section + "/Shape", "block") == "block"):
                x, y, z = text.split(",")
                text = f"{y}, {x}, {z}"
            if entry == "Point":
                text = ", ".join(map(repr, (self.P @ [float(x) for x in text.split(",")]).tolist()))
            result[f"{expert}{section}/{entry}"] = text
        return result

    def rows(self, rows):
        """What the rows of the changed scene should be."""
        result = {name: values * self.factor(self.unit(name)) for name, values in rows.items()}
        for name in ("angle_deg", "machine_angle_deg", "torque_Nmm"):
            result[name] = self.handed * result[name]
        for name, A in (("chuck_u{}_mm", self.P), ("chuck_F{}_N", self.P), ("chuck_r{}_deg", self.turn), ("chuck_M{}_Nmm", self.turn)):
            names = [name.format(axis) for axis in "xyz"]
            result.update(zip(names, A @ [result[one] for one in names]))
        return result

    def summary(self, summary):
        return {name: value * self.factor(self.unit(name)) * (self.handed if name.startswith("theta") or name == "T_inf_Nmm" else 1)
                for name, value in summary.items() if name not in NOT_COMPARED}

    @staticmethod
    def unit(name):
        found = re.search(r"_((Nmm|N|MPa|mm|deg)(_per_\w+)?)$|^(time|smallest_step)$", name)
        return "" if not found else found[1] or "time"


def equal_laws(scene):
    """Of other ways to say the same of the interface: name, entries, None where they go, and results that are another bond's."""
    law, friction, degree = (scene.entries.get(f"Interface/{name}") for name in ("Law", "Friction law", "Bonding/Bonding degree"))
    mu, broken, unbroken = (scene.entries.get(f"Interface/Friction coefficient{name}") for name in ("", " broken", " unbroken"))
    of_bond = {"phi_mean", "w_adh_N_per_m", "w_normal_N_per_m", "w_tangential_N_per_m"}

    def equal(name, ignored=frozenset(), **entries):
        entries = {name.replace("__", "/").replace("_", " "): value for name, value in entries.items()}
        return name, {f"Interface/{name}": value for name, value in entries.items()}, ignored

    if friction == "coulomb" and law != "mixed mode":
        yield equal("coulomb = modified coulomb", of_bond if law != "adhesive" else frozenset(), Friction_law="modified coulomb",
                    Friction_coefficient=None, Friction_coefficient_broken=mu, Friction_coefficient_unbroken=mu)
    if friction == "frictionless":
        yield equal("frictionless = coulomb of 0", {"warnings"}, Friction_law="coulomb", Friction_coefficient="0")
    if friction in ("modified coulomb", "table") and law == "friction":
        bond = float(degree or 1) * (float(unbroken) - float(broken))
        yield equal("half a bond of twice the coefficient", of_bond, Bonding__Bonding_degree="0.5",
                    Friction_coefficient_unbroken=repr(float(broken) + 2 * bond))
    if friction == "rate and state" and scene.entries["Interface/Rate and state/Initial state"] == "auto":
        D, V = (float(scene.entries[f"Interface/Rate and state/{name}"]) for name in ("Sliding distance", "Reference speed"))
        yield equal("initial state = steady state", Rate_and_state__Initial_state=repr(D / V))
    if law == "friction" and friction != "frictionless":
        yield equal("friction = dilatant of no height", Law="dilatant", Dilatant__Height="0", Dilatant__Length="0.05", Opening_breaks_bond=scene.entries.get("Interface/Opening breaks bond"))
    if law == "friction" and friction == "modified coulomb" and "Interface/Opening breaks bond" not in scene.entries:
        yield equal("friction = adhesive of no strength", Law="adhesive", Adhesive__Strength="0", Adhesive__Gap_at_strength="0.01")
    if law == "mixed mode" and scene.entries["Expert/Interface/Mixed mode/Exponent"] == "1":
        yield equal("benzeggagh-kenane = power law", Mixed_mode__Criterion={"power law": "benzeggagh-kenane"}.get(
            scene.entries["Interface/Mixed mode/Criterion"], "power law"))
    if scene.entries["Interface/Tangential stiffness"] == scene.entries["Interface/Normal stiffness"]:
        yield equal("tangential = normal stiffness", {"warnings"} if friction == "frictionless" else frozenset(), Tangential_stiffness="auto")


def split(scene):
    """Phases of several steps as two phases."""
    times, steps = ([float(x) for x in scene.entries[f"Load steps/{name}"].split(",")] for name in ("Times", "Steps"))
    new_times, new_steps = times[:1], []
    for begin, end, n in zip(times, times[1:], map(int, steps)):
        for first, last in ((0, n // 2), (n // 2, n)):
            if last > first:
                new_times.append(begin + last / n * (end - begin))
                new_steps.append(last - first)
    return {"Load steps/Times": ", ".join(map(repr, new_times)), "Load steps/Steps": ", ".join(map(str, new_steps))}


def related(scene):
    """Of each relation that is exact for the scene: its name, entries (None: those that it writes), files, what becomes of results,
    results that are not compared."""
    entries, files, none = scene.entries, scene.files, frozenset()
    changes = {"lengths x 2": Change(L=2), "moduli x 7": Change(S=7), "time x 10": Change(T=10)}
    is_random = entries.get("Interface/Bonding/Pattern") == "random"
    is_screw = scene.what[0] == "screw"
    if not is_random and not is_screw:
        mirrored = Change(P=scene.chance.choice((MIRROR_X, MIRROR_Y)))
        others = [name for name, text in mirrored.entries(scene).items() if text != entries.get(name)]
        changes["mirrored" if files or others != ["Chuck/Rotation z/Value"] else "turned the other way"] = mirrored
    if not is_random and (not is_screw or entries["Implant/Starts"] == "4"):
        changes["turned by 90 degrees"] = Change(P=QUARTER)
    for name, change in changes.items():
        yield name, change.entries(scene), {key: file.moved(change.P, change.L, change.T) for key, file in files.items()}, change, none
    yield "phases split", {**entries, **split(scene)}, files, Change(), {"warnings", "pressure_MPa"}  # of phases, as the balance of energy
    for name, new, ignored in equal_laws(scene):
        yield name, {key: value for key, value in {**entries, **new}.items() if value is not None}, files, Change(), ignored
    if "Chuck/Press/Value" in entries and "Chuck/Press/File" not in entries:
        pressed = {name.replace("Press", "Translation z"): text for name, text in entries.items()}
        yield ("pressed = moved along -z", {**pressed, "Chuck/Translation z/Value": f"-({entries['Chuck/Press/Value']})"}, files, Change(), none)
    if scene.what[0] == "file":
        yield "renumbered meshes", entries, {key: file.renumbered(scene.chance) if isinstance(file, Mesh) else file for key, file in files.items()}, Change(), none
    yield "parameters.prm", None, files, Change(), none


def kind_of(name):
    """Of a column or measure, what it can be compared with."""
    unit = Change.unit(name)
    is_moment = name.startswith("chuck_M") or name in ("torque_Nmm", "T_max_Nmm", "T_inf_Nmm")
    return "energy" if unit == "Nmm" and not is_moment else unit


def differences(expected, got, change, R, ignored):
    """{column or measure: by how much it differs from what the relation expects}, relative to its largest value, or to a hundredth of
    the largest one of its kind if that is more: what is 0 but for rounding has none of its own. R: size of the implant [mm]."""
    rows, summary = change.rows(expected.rows), change.summary(expected.summary)
    if len(rows["time"]) != len(got.rows["time"]):
        return {f"{len(got.rows['time'])} rows for {len(rows['time'])}": math.inf}
    largest = collections.defaultdict(float)
    for name, values in rows.items():
        largest[kind_of(name)] = max(largest[kind_of(name)], abs(values).max())
    R *= change.L
    largest["N"] = max(largest["N"], 4 * R ** 2 * largest["MPa"])  # pressures around a pin balance
    largest.update({"": 100.0, "Nmm": max(largest["Nmm"], R * largest["N"]), "N_per_m": 1e3 * largest["energy"] / R ** 2,
                    "Nmm_per_rad": max(largest["Nmm"], R * largest["N"])})
    result = {}

    def compare(name, wanted, found, amplified=1.0):
        difference = abs(found - wanted).max() / (max(abs(wanted).max(), 1e-2 * largest[kind_of(name)]) or 1.0)
        if not difference <= amplified * TOLERANCE:
            result[name] = difference

    for name in set(rows) - NOT_COMPARED - ignored:
        compare(name, rows[name], got.rows[name])
    # where the torque is noise, or as large elsewhere, rounding decides what is read off its curve
    torque = abs(rows["torque_Nmm"])
    elsewhere = torque[abs(rows["angle_deg"] - summary.get("theta_max_deg", 0)) > 1e-9 * largest["deg"]]
    is_flat = torque.max() < 1e-6 * largest["Nmm"] or (elsewhere > (1 - 1e-8) * torque.max()).any()
    turned = torque[1:][abs(numpy.diff(rows["angle_deg"])) > 1e-9 * largest["deg"]]  # a thread turns what is pressed, without torque
    is_loose = not turned.size or turned[0] < 1e-6 * largest["Nmm"]
    # the quotient of the first row that has turned has the rounding of the largest ones
    first = {"initial_stiffness_Nmm_per_rad": 1.0 if is_loose else max(1.0, torque.max() / turned[0])}
    for name in (set(summary) | set(got.summary)) - NOT_COMPARED - ignored:
        if is_flat and re.match("theta|E_fric|W_|w_adh|initial", name) or is_loose and name.startswith("initial"):
            continue
        if name in summary and name in got.summary:
            compare(name, numpy.array(summary[name]), got.summary[name], first.get(name, 1.0))
        else:
            result[f"{name} in one of them"] = math.inf
    # by their words: numbers, and functions of time that are quoted, change
    texts = [sorted(" ".join(re.findall("[a-z]{4,}", text)) for text in one.warnings) for one in (expected, got)]
    if texts[0] != texts[1] and "warnings" not in ignored:
        result[f"warnings {texts[0]} and {texts[1]}"] = math.inf
    return result


def run(entries, files, stem):
    """The result, or the error, of entries whose files are written; None: of what was run last, as its parameters.prm says it."""
    names = {}
    for key, file in files.items():
        names["{" + key + "}"] = name = f"{stem}.{key}.{file.suffix}"
        with open(name, "wb") as out:
            out.write(file.content())
    try:
        scene = debond.Scene(None, {"Accuracy": "none"} | {name: names.get(text, text) for name, text in entries.items()})
        return scene, scene.run()
    except (debond.SceneError, debond.RunError) as error:
        return None, error


def check(seed):
    """Of a scene: a line for each relation that does not hold, and the names of those that do."""
    drawn, wrong, held = Drawn(seed), [], []
    what = f"scene {seed} ({', '.join(drawn.what)})"
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        scene, base = run(drawn.entries, drawn.files, "base")
        for i, (name, entries, files, change, ignored) in enumerate(related(drawn) if scene else ()):
            result = run(entries, files, i)[1] if entries is not None else debond.Scene(text=scene.parameters).run()
            found = {str(result): math.inf} if isinstance(result, Exception) else differences(base, result, change, drawn.R, ignored)
            if found:
                worst = sorted(found.items(), key=lambda one: -one[1])[:5]
                wrong.append(f"{what}, {name}: " + ", ".join(f"{key} {value:.1e}" for key, value in worst))
            else:
                held.append(name)
        os.chdir("/")
    return wrong if scene else [f"{what}: {base}"], held


def main(n, jobs=1, first=0):
    held, n_wrong = collections.Counter(), 0
    with concurrent.futures.ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn")) as processes:
        for wrong, names in processes.map(check, range(first, first + n)):
            held.update(names)
            n_wrong += len(wrong)
            print("".join(line + "\n" for line in wrong), end="", flush=True)
    print("\n".join(f"{name}: {n} scenes" for name, n in sorted(held.items())), f"{n_wrong} do not hold", sep="\n")
    return n_wrong > 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
