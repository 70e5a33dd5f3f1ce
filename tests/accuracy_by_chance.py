#!/usr/bin/env python3
"""Accuracy on scenes that nobody has tuned it for: shapes, stiffnesses, laws, loads, patterns and materials by chance. What is
true of a scene is a run with more cells, half as many again in each direction for each of --levels (one level where the scene
takes more than a fortieth of --seconds; those around an axis with symmetry stay), and a tolerance twenty times smaller; it is
made once and kept in TRUTHS. Prints for each scene the largest errors of the curve, of its largest load and of its first slope
(in % of the largest load, or of themselves; of a slope that is next to nothing, of a tenth of the largest), the estimate,
seconds of both runs, and INACCURATE where an error is more than --accuracy, UNBOUNDED where it is more than the estimate. With
one level a third of the error or so is left in the truth. A scene that misses is known where TRUTHS has a reason for it, among
`misses`; fails if one does that is not. Scenes of which there is no truth are left out, unless --make asks for it.

    tests/accuracy_by_chance.py build/release/debond TRUTHS.json DIRECTORY --scenes 0..59 [--accuracy 0.01] [--levels 2] [--seconds 300]
"""
import argparse
import bisect
import csv
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import time

SHAPES = "coin", "coin", "pin", "cap", "ring", "block", "cup", "coin"


class Drawn:
    """A scene: entries, and what it is in words."""

    def __init__(self, seed):
        self.chance = random.Random(f"accuracy {seed}")
        self.entries = {"Title": f"scene {seed}"}
        self.shape = SHAPES[seed % len(SHAPES)]
        self.in_bore = self.shape in ("pin", "cup")
        self.R, self.eps, self.E = self.number(1.5, 4), self.log(300, 1e6), self.log(500, 20000)
        self.soft = 1 / (1 / self.eps + self.R / self.E)  # pressure per depth, roughly
        self.words = [self.shape, f"{self.eps:.3g} MPa/mm"]
        for part in (self.add_bodies, self.add_interface, self.add_load):
            part()

    def number(self, low, high):
        return float(f"{self.chance.uniform(low, high):.3g}")

    def log(self, low, high):
        return float(f"{math.exp(self.chance.uniform(math.log(low), math.log(high))):.3g}")

    def set(self, section, **entries):
        for name, value in entries.items():
            self.entries[f"{section}/{name.replace('_', ' ')}"] = value

    def of(self, name, default=0):
        return self.entries.get("Interface/" + name, default)

    def add_bodies(self):
        R, r = self.R, self.number
        implant = self.chance.choice((0, 3600, 113000))
        self.set("Bone", Young_modulus=self.E, Poisson_ratio=r(0.2, 0.4))
        self.set("Implant", Shape=self.shape, **({"Young_modulus": implant} if implant else {"Material": "rigid"}))
        self.words.append(f"bone {self.E:.3g} MPa, implant {implant or 'rigid'}")
        if self.shape == "pin":
            self.set("Bone", Shape="sleeve", Outer_radius=r(2, 4) * R, Ends=self.chance.choice(("free", "slide", "held")))
            self.set("Implant", Radius=R, Height=r(1, 3) * R)
        elif self.shape == "cup":
            self.set("Bone", Shape="cavity", Outer_radius=r(1.5, 2.5) * R, Ends="slide")
            self.set("Implant", Radius=R, Height=R)
        else:
            self.set("Bone", Size=f"{r(4, 6) * R:.3g}, {r(4, 6) * R:.3g}, {r(1.5, 3) * R:.3g}")
            if self.shape == "block":
                self.set("Implant", Size=f"{2 * R:.3g}, {r(1.5, 3) * R:.3g}, {r(0.8, 1.5) * R:.3g}")
            else:
                self.set("Implant", Radius=R, Height=r(0.8, 1.5) * R)
            if self.shape == "cap":
                self.set("Implant", Cap_radius=r(15, 40) * R)
            if self.shape == "ring":
                self.set("Implant", Inner_radius=r(0.3, 0.6) * R)

    def add_interface(self):
        r = self.number
        self.set("Interface", Normal_stiffness=self.eps, Tangential_stiffness=self.chance.choice((self.eps, r(0.4, 0.8) * self.eps)))
        law = self.chance.choice(("coulomb", "bond", "bond", "bond", "adhesive"))
        self.law = "coulomb" if law == "adhesive" and (self.in_bore or self.shape == "cap") else law
        self.words.append(self.law)
        if self.law == "coulomb":
            self.set("Interface", Friction_law="coulomb", Friction_coefficient=r(0.2, 0.6))
            return
        self.set("Interface", Friction_coefficient_broken=r(0.2, 0.5), Friction_coefficient_unbroken=r(0.55, 0.9),
                 Characteristic_slip_distance=r(0.004, 0.02) * self.R, Transition_factor=r(0.5, 1.5))
        self.set("Interface/Bonding", Bonding_degree=r(0.6, 1))
        if self.law == "adhesive":
            self.set("Interface", Law="adhesive")
            self.set("Interface/Adhesive", Strength=r(0.5, 3), Gap_at_strength=r(0.002, 0.004) * self.R)
        pattern = self.chance.choice(("homogeneous", "homogeneous", "disk", "expression", "random"))
        if self.in_bore or self.shape == "ring" or (self.shape == "block" and pattern == "disk"):
            return
        self.set("Interface/Bonding", Pattern=pattern)
        self.words.append(pattern)
        if pattern == "disk":
            self.set("Interface/Bonding", Bonded_fraction=r(0.3, 0.8))
        if pattern == "expression":
            self.set("Interface/Bonding", Expression="0.6 + 0.4 * sin(2 * x / R + y / R)")
        if pattern == "random":
            self.set("Interface/Bonding", Bonded_fraction=r(0.4, 0.8), Correlation_length=r(0.4, 0.8) * self.R, Seed=self.chance.randrange(1000))

    def soften(self, p):
        """Where the law would fall faster than the interface is stiff, and the bond break in a jump."""
        a_s, b_s = self.of("Characteristic slip distance"), self.of("Transition factor")
        if a_s:
            fall = math.pi / 4 * (self.of("Friction coefficient unbroken") - self.of("Friction coefficient broken")) * p / b_s
            self.set("Interface", Characteristic_slip_distance=max(a_s, float(f"{1.3 * fall / self.of('Tangential stiffness'):.3g}")))

    def add_load(self):
        """Pressed, or a press fit, then moved until all slides, and what bond there is breaks."""
        r = self.number
        self.set("Output", Fields_every="none", Report="false")
        self.set("Expert/Output", Console="quiet")
        p = (r(1e-4, 6e-4) if self.in_bore else r(2e-5, 2e-4)) * self.E
        mu = self.of("Friction coefficient", self.of("Friction coefficient unbroken"))
        way = r(4, 10) * mu * p / self.soft + 4 * self.of("Characteristic slip distance")
        turn = f"{way / self.R * 180 / math.pi:.3g}"
        if self.in_bore:
            load = self.chance.choice(("pulled", "turned")) if self.shape == "pin" else "turned"
            self.set("Interface", Interference=f"{2 * p / self.soft:.3g}")
            self.set("Load steps", Times="0, 1")
            self.set("Chuck/" + ("Translation z" if load == "pulled" else "Rotation z"), Value=f"{way if load == 'pulled' else turn} * t")
        elif self.law == "adhesive" and self.chance.random() < 0.5:
            load = "pulled"
            self.set("Load steps", Times="0, 1")
            self.set("Chuck/Translation z", Value=f"{8 * self.of('Adhesive/Gap at strength') + 4 * self.of('Adhesive/Strength') / self.soft:.3g} * t")
        else:
            load = self.chance.choice(("turned", "turned", "sheared", "turned under a force"))
            if load.endswith("force"):
                self.set("Chuck/Press", Control="force", Value=f"{p * math.pi * self.R ** 2:.4g} * min(t, 1)")
            else:
                depth = (0.6 * self.R) ** 2 / self.entries["Implant/Cap radius"] if self.shape == "cap" else p / self.soft
                self.set("Chuck/Press", Value=f"{depth:.4g} * min(t, 1)")
                if self.shape == "cap":
                    self.soften(self.eps * depth)
            self.set("Chuck/" + ("Translation x" if load == "sheared" else "Rotation z"),
                     Value=f"{way if load == 'sheared' else turn} * max(t - 1, 0)")
        self.words.append(load)


def load_at(x, y, position):
    """Of a curve, at a distance that only grows."""
    k = min(max(bisect.bisect_right(x, position), 1), len(x) - 1)
    width = x[k] - x[k - 1]
    return y[k - 1] + (y[k] - y[k - 1]) * ((position - x[k - 1]) / width if width else 0)


class Run:
    """What a scene came to. Raises RuntimeError if the program does, TimeoutExpired."""

    def __init__(self, debond, entries, directory, seconds):
        shutil.rmtree(directory, ignore_errors=True)
        with open(directory + ".prm", "w", encoding="utf-8") as file:
            for name, value in entries.items():
                *path, name = name.split("/")
                file.write("".join(f"subsection {part}\n" for part in path) + f"set {name} = {value}\n" + "end\n" * len(path))
        begin = time.time()
        done = subprocess.run([debond, directory + ".prm", "--set", "Output/Directory=" + directory], capture_output=True, text=True, timeout=seconds)
        if done.returncode:
            raise RuntimeError(done.stderr.strip().split("\n")[-1][:200])
        self.seconds, self.directory = time.time() - begin, directory
        with open(directory + "/summary.json", encoding="utf-8") as file:
            self.summary = json.load(file)
        curve = self.summary.get("curve")
        names = (curve["over"], curve["load"]) if curve else ("angle_deg", "torque_Nmm")
        self.x, self.y = self.columns("curve.csv", names)
        self.x = [abs(x) for x in self.x]
        self.first = next(x for x in self.x if x > 1e-12)  # where the program takes its stiffness

    def columns(self, name, names):
        with open(f"{self.directory}/{name}", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [[float(row[name]) for row in rows] for name in names]

    def entries(self):
        found, path = {}, []
        with open(self.directory + "/parameters.prm", encoding="utf-8") as file:
            for line in (line.split("#")[0].strip() for line in file):
                if line.startswith("subsection "):
                    path.append(line[len("subsection "):])
                elif line == "end":
                    path.pop()
                elif line.startswith("set "):
                    name, value = line[len("set "):].split("=", 1)
                    found["/".join([*path, name.strip()])] = value.strip()
        return found


def finer(cells, under, factor):
    """Numbers of cells times a factor; around a rim by fours, around an axis as they are, beside a block as many on both sides."""
    numbers = [int(n) for n in re.findall(r"\d+", cells)]
    step = 4 if "fitted" in cells else 1
    numbers = [n if under is None and i == 0 else math.ceil(factor * n / step) * step if i == 0 else math.ceil(factor * n) for i, n in enumerate(numbers)]
    if under:
        numbers[:2] = [n + (n - under) % 2 for n in numbers[:2]]
    return ("fitted " if "fitted" in cells else "") + ", ".join(map(str, numbers))


def truth_of(run, options, seed):
    levels = options.levels if run.seconds < options.seconds / 40 else 1
    chosen, factor, more = run.entries(), 1.5 ** levels, {}
    under = chosen["Expert/Bone/Cells under implant"]
    if under != "none":
        more["Expert/Bone/Cells under implant"] = math.ceil(factor * int(under))
    in_bore = chosen["Bone/Shape"] != "block"
    more["Bone/Cells"] = finer(chosen["Bone/Cells"], None if in_bore else more.get("Expert/Bone/Cells under implant", 0), factor)
    more["Implant/Cells"] = finer(chosen["Implant/Cells"], None if in_bore else 0, factor)
    true = Run(options.debond, {**{name: value for name, value in chosen.items() if value}, **more, "Accuracy": "none",
                                "Load steps/Tolerance": options.accuracy / 20}, f"{options.directory}/truth-{seed}", options.seconds)
    every = max(1, len(true.x) // 80)
    top = max(range(len(true.y)), key=lambda i: abs(true.y[i]))
    begin = next(i for i, x in enumerate(true.x) if abs(x) > 1e-12)
    rows = sorted({*range(0, len(true.x), every), *range(begin - 1, min(begin + 40, len(true.x))), top, len(true.x) - 1})
    x, y = ([float(f"{values[i]:.7g}") for i in rows] for values in (true.x, true.y))
    return {"x": x, "y": y, "cells": more["Bone/Cells"], "levels": levels, "seconds": round(true.seconds, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("debond", "truths", "directory"):
        parser.add_argument(name)
    parser.add_argument("--scenes", default="0..59")
    parser.add_argument("--make", action="store_true")
    for name, default in (("--accuracy", 0.01), ("--levels", 2), ("--seconds", 300)):
        parser.add_argument(name, type=type(default), default=default)
    options = parser.parse_args()
    os.makedirs(options.directory, exist_ok=True)
    stored = {"misses": {}, "truths": {}}
    if os.path.exists(options.truths):
        with open(options.truths, encoding="utf-8") as file:
            stored = json.load(file)
    truths, misses, new = stored["truths"], stored["misses"], []
    first, last = map(int, options.scenes.split(".."))
    n_accurate = n_bounded = n = 0
    for seed in range(first, last + 1):
        if str(seed) not in truths and not options.make:
            continue
        n, drawn = n + 1, Drawn(seed)
        text = f"{seed:3d} {', '.join(drawn.words)}: "
        try:
            run = Run(options.debond, {**drawn.entries, "Accuracy": options.accuracy}, f"{options.directory}/scene-{seed}", options.seconds)
            if str(seed) not in truths:
                truths[str(seed)] = truth_of(run, options, seed)
                with open(options.truths, "w", encoding="utf-8") as file:
                    json.dump(stored, file, indent=0, sort_keys=True)
        except (RuntimeError, KeyError, subprocess.TimeoutExpired) as failure:
            print(text + f"FAILED, {failure!r:.200}", flush=True)
            new.append(seed)
            continue
        true = truths[str(seed)]
        top = max(map(abs, true["y"]))
        slope, steepest = load_at(true["x"], true["y"], run.first) / run.first, max(abs(y / x) for x, y in zip(true["x"], true["y"]) if x > 1e-12)
        errors = (max(abs(load_at(run.x, run.y, x) - y) for x, y in zip(true["x"], true["y"])) / top, abs(max(map(abs, run.y)) / top - 1),
                  abs(load_at(run.x, run.y, run.first) / run.first - slope) / max(abs(slope), 0.1 * steepest))
        said = run.summary.get("error_estimate") or math.nan
        is_accurate, is_bounded = max(errors) <= options.accuracy, max(errors) <= said
        n_accurate, n_bounded = n_accurate + is_accurate, n_bounded + is_bounded
        if not (is_accurate and is_bounded):
            new.append(seed)
        print(text + "curve %.2f, load %.2f, slope %.2f, said %.2f %%; " % tuple(100 * one for one in (*errors, said))
              + "INACCURATE " * (not is_accurate) + "UNBOUNDED " * (not is_bounded) + misses.get(str(seed), "") + " "
              + f"{run.seconds:.1f} s, truth {true['levels']} finer, {true['seconds']} s" + "".join("; " + warning[:90] for warning in run.summary["warnings"]), flush=True)
    new = [seed for seed in new if str(seed) not in misses]
    print(f"of {n} scenes {n_accurate} are accurate, {n_bounded} bounded" + (f"; {new} miss, and are not known to" if new else ""))
    return bool(new)


if __name__ == "__main__":
    sys.exit(main())
