"""ensemble.py DEBOND SCRATCH: statistics of a study over random patterns, as the program has them made, against the files of
its variants; against numbers worked out by hand for curves that are made up.

Ends with 1 and a message at the first thing that is wrong. Needs NumPy; with pandas it looks at the frames, too.
"""

import csv
import json
import math
import os
import shutil
import subprocess
import sys

import numpy

import debond
from debond.ensemble import QUANTITIES, band_of, statistics_of, write_ensemble
from debond.errors import InputError

program, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page_of_results.prm")
FRACTION, SEED = "Interface / Bonding / Bonded fraction", "Interface / Bonding / Seed"
PERCENT = {"p05": 0.05, "p50": 0.5, "p95": 0.95}


def check(is_so, message):
    if not is_so:
        sys.exit(f"ensemble: {message}")


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def same(text, expected, scale=1.0):
    """Whether a field with 12 digits is this number; differences from equal numbers are rounding of their scale."""
    value = float(text)
    return abs(value - expected) <= 1e-10 * max(abs(expected), scale) or (math.isnan(value) and math.isnan(expected))


def quantile(values, share):
    """Type 7, by its definition: of n values in ascending order the k-th belongs to (k - 1) / (n - 1)."""
    values, place = sorted(values), share * (len(values) - 1)
    below = min(int(place), len(values) - 2)
    return values[below] + (place - below) * (values[below + 1] - values[below]) if len(values) > 1 else values[0]


def expected_of(values):
    """Mean, sd and quantiles by name."""
    if not values:
        return dict.fromkeys(("mean", "sd", *PERCENT), math.nan)
    n, mean = len(values), math.fsum(values) / len(values)
    sd = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (n - 1)) if n > 1 else math.nan
    return {"mean": mean, "sd": sd, **{name: quantile(values, share) for name, share in PERCENT.items()}}


def check_statistics():
    mean, sd, low, middle, high = statistics_of(numpy.array([[4.0], [1.0], [math.nan], [2.0], [math.inf], [3.0]]))[:, 0]
    found = numpy.array([mean, sd, low, middle, high])
    check(abs(found - [2.5, math.sqrt(5 / 3), 1.15, 2.5, 3.85]).max() < 1e-14, f"{found}")
    one, none = statistics_of(numpy.array([[7.0, math.nan]])).T
    check(one[0] == one[2] == one[4] == 7 and math.isnan(one[1]), f"one value: {one}")
    check(numpy.isnan(none).all(), f"no value: {none}")
    check(statistics_of(numpy.full((3, 1), 0.1))[1, 0] == 0, "equal values have no scatter")


def check_band():
    pressed = numpy.array([[0.0, 0.0, 1.0, 2.0, 3.0], [9.0, 0.0, 10.0, 20.0, 30.0]])  # the last row at an angle counts
    shorter = numpy.array([[2.0, 1.5, 0.0], [4.0, 3.0, 0.0]])  # the other way round
    back = numpy.array([[0.0, 1.0, 0.5], [0.0, 1.0, 2.0]])
    still = numpy.array([[0.0, 0.0], [0.0, 1.0]])
    angles, members, statistics, left_out = band_of([shorter, pressed, back, still])
    check(list(angles) == [0, 1, 2, 3] and list(members) == [2, 2, 2, 1] and left_out == 1, f"{angles}, {members}, {left_out}")
    check(numpy.allclose(statistics[0], [0, 6, 12, 30]) and numpy.allclose(statistics[2][1:3], [2.4, 4.8]), f"{statistics}")
    check(math.isnan(statistics[1][3]), "the scatter of one curve")
    down = band_of([numpy.array([[0.0, -1.0, -2.0], [0.0, -1.0, -3.0]])])
    check(list(down[0]) == [0, -1, -2] and list(down[2][0]) == [0, -1, -3], f"backwards: {down}")
    check(band_of([])[0].size == 0 and band_of([still])[3] == 0, "no curve")


def run_study():
    command = [program, scene]
    for setting in ("Interface/Bonding/Pattern=random", "Interface/Bonding/Seed={{1..5}}",
                    "Interface/Bonding/Bonded fraction={{0.3|0.70}}", "Output/Directory=study"):
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, f"{command}: {done.stdout}{done.stderr}")


def check_summary(directory, fractions, left_out=()):
    """ensemble_summary.csv from the summaries of variants."""
    study = [row for row in table(f"{directory}/study.csv")]
    for row, fraction in zip(table(f"{directory}/ensemble_summary.csv"), fractions):
        numbers = [row["variant"] for row in study if row[FRACTION] == fraction and row["variant"] not in left_out]
        check(row[FRACTION] == fraction and int(row["members"]) == len(numbers), f"{row}")
        summaries = []
        for number in numbers:
            with open(f"{directory}/variant-{int(number):03d}/summary.json", encoding="utf-8") as file:
                summaries.append(json.load(file))
        for name, unit in QUANTITIES:
            values = [one[name + unit] for one in summaries if one.get(name + unit) is not None]
            for kind, expected in expected_of(values).items():
                field = f"{name}_{kind}{unit}"
                scale = abs(max(values, default=1.0))
                check(same(row[field], expected, scale), f"{fraction}: {field} {row[field]}, {expected}")


def check_curves(directory):
    """ensemble.csv from the curves of variants, interpolated anew."""
    study, bands = table(f"{directory}/study.csv"), table(f"{directory}/ensemble.csv")
    for fraction in dict.fromkeys(row[FRACTION] for row in study):
        curves = []
        for row in study:
            if row[FRACTION] == fraction and row["converged"] == "true":
                rows = table(f"{directory}/variant-{int(row['variant']):03d}/torque.csv")
                # the last one at an angle
                curves.append(dict((float(one["angle_deg"]), float(one["torque_Nmm"])) for one in rows))
        band = [row for row in bands if row[FRACTION] == fraction]
        check([float(row["angle_deg"]) for row in band] == list(max(curves, key=len)), f"{fraction}: angles of the band")
        for row in band:
            values = [numpy.interp(float(row["angle_deg"]), list(curve), list(curve.values())) for curve in curves
                      if float(row["angle_deg"]) <= max(curve)]
            check(int(row["members"]) == len(values), f"{row}: {len(values)} curves")
            for kind, expected in expected_of(values).items():
                check(same(row[f"torque_{kind}_Nmm"], expected, abs(max(values))), f"{row}: {kind} {expected}")


def check_study():
    run_study()
    by_program = {name: table(f"study/{name}") for name in ("ensemble.csv", "ensemble_summary.csv")}
    check(write_ensemble("study") == [], "something is left out")
    for name, rows in by_program.items():
        again = table(f"study/{name}")
        check(len(rows) == len(again) and list(rows[0]) == list(again[0]), f"{name}: columns or number of rows")
        for a, b in zip(rows, again):
            scale = max(abs(float(text)) for key, text in a.items() if key.endswith(("_mean_Nmm", "_mean_Nmm_per_rad")))
            check(all(same(b[key], float(text), scale) for key, text in a.items()), f"{name}: the program {a}, Python {b}")
    check_summary("study", ("0.3", "0.70"))
    check_curves("study")
    # a variant that failed, one that turns back, one with fewer rows
    shutil.copytree("study", "some")
    rows = [dict(row) for row in table("some/study.csv")]
    rows[1].update(converged="false", reason="it did not")
    with open("some/study.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    with open("some/variant-003/torque.csv", encoding="utf-8") as file:
        lines = file.read().splitlines(True)
    with open("some/variant-003/torque.csv", "w", encoding="utf-8") as file:
        file.writelines(lines[:12] + lines[8:10])
    with open("some/variant-004/torque.csv", "w", encoding="utf-8") as file:
        file.writelines(lines[:20])
    done = subprocess.run([sys.executable, "-m", "debond", "ensemble", "some"], capture_output=True, text=True)
    words = f"ensemble.csv leaves out 1 of 4 members of {FRACTION} = 0.3: their rotation reverses"
    check(done.returncode == 0 and words in done.stdout, f"what is left out: {done}")
    first, second = table("some/ensemble_summary.csv")
    check((first["members"], first["failed"], second["failed"]) == ("4", "1", "0"), f"{first}")
    check_summary("some", ("0.3", "0.70"), left_out=("2",))
    members = [int(row["members"]) for row in table("some/ensemble.csv") if row[FRACTION] == "0.3"]
    check(members == [3] * 18 + [2] * (len(lines) - 20), f"curves that cover angles: {members}")


def check_frames_and_mistakes():
    try:
        import pandas  # noqa: F401

        found = debond.ensemble("study")
        check(list(found.summary[FRACTION]) == [0.3, 0.7], f"frames: {found.summary}")
        check(len(found.curves) == len(table("study/ensemble.csv")), "frames")
    except ImportError:
        print("no pandas: frames are left out")
    os.mkdir("other")
    with open("other/study.csv", "w", encoding="utf-8") as file:
        file.write("variant,Bone / Size,converged\n1,7,true\n")
    for directory, words in (("study/variant-001", "there is no study in this directory"),
                             ("other", f"this study varies Bone / Size, not {SEED}")):
        try:
            write_ensemble(directory)
            check(False, f"{directory} is not refused")
        except InputError as error:
            check(words in str(error), f"{directory}: {error}")
    os.remove("some/variant-005/summary.json")
    done = subprocess.run([sys.executable, "-m", "debond", "ensemble", "some"], capture_output=True, text=True)
    check(done.returncode == 1 and "variant-005/summary.json" in done.stderr and done.stderr.count("\n") == 1, f"{done}")
    try:
        import jinja2  # noqa: F401
    except ImportError:
        return print("no Jinja2: the page is left out")
    subprocess.run([sys.executable, "-m", "debond", "page", "study"], check=True)
    with open("study/report.html", encoding="utf-8") as file:
        text = file.read()
    check("Random patterns" in text and "5 to 95 %" in text, "the page of an ensemble")


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    check_statistics()
    check_band()
    check_study()
    check_frames_and_mistakes()


if __name__ == "__main__":
    main()
