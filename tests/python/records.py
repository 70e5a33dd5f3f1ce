"""records.py SOURCE SCRATCH [SEEDS]: folders of raw records, made up with known peaks, stiffness, slack and energy.

Each seed (2 of them) makes 400 records as a tester of small implants writes them: crosshead and force with a tab between, no
header, noise of +-0.3 N, a break within five rows. Twelve are failures of all kinds; these are marked and no other. The truth
is the straight line with a rounded foot that the records are made of. Then columns, names and torques that are wrong or right.
Ends with 1 and a message at the first thing that is wrong. Needs NumPy and SciPy.
"""

import contextlib
import csv
import io
import math
import os
import re
import shutil
import sys
import time

import numpy

from debond.__main__ import main as main_of_package
from debond.page import write_page
from debond.records import evaluated
from debond.units import unit_in

source, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
SEEDS = range(int(sys.argv[3]) if len(sys.argv) > 3 else 2)
COLUMNS, NAMES = "displacement mm, force N", "{animal}{limb}{side}[{kind}][-{trial}]"
NOISE, JITTER, STEP = 0.3, 0.02, 0.03  # half widths of uniform noise [N, mm]; crosshead from row to row [mm]
FAILURES = 2 * ("no peak", "sensor at its limit", "several peaks", "negative", "never comes back") + ("too few samples", "unreadable")


def check(is_so, message):
    if not is_so:
        sys.exit(f"records: {message}")


def command(*arguments, code=0):
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
        returned = main_of_package(["records", *arguments])
    check(returned == code, f"{arguments} ends with {returned}, not {code}: {out.getvalue()}{errors.getvalue()}")
    return out.getvalue() + errors.getvalue()


def rows_of(directory):
    with open(os.path.join(directory, "records.csv"), encoding="utf-8", newline="") as file:
        return {row["specimen"]: row for row in csv.DictReader(file)}


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def write(path, text, encoding="utf-8"):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding=encoding, newline="") as file:
        file.write(text)


def load_at(x, k, foot):
    """A line of slope k from 0 on, with a parabola in its place from -foot to foot: with its tangents, and k foot^2 / 6 more
    energy."""
    return numpy.where(x > foot, k * x, numpy.where(x < -foot, 0, k * (x + foot) ** 2 / (4 * foot)))


def truth_of(draw, is_shear):
    """A record is made of these."""
    k = draw.uniform(4, 8) if is_shear else draw.uniform(2, 4)
    peak = float(f"{draw.uniform(10, 60) if is_shear else draw.uniform(2.5, 25):.3f}")
    preload = draw.uniform(0.1, 0.3) * peak * (draw.uniform() < 0.15)
    foot = 0.1 * peak / k
    slack = -preload / k if preload else draw.uniform(0.3, 2) + foot
    return {"k": k, "peak": peak, "preload": preload, "foot": foot, "slack": slack, "fall": int(draw.choice([1, 3, 5])),
            "tail": 12 if draw.uniform() < 0.1 else int(draw.integers(80, 200)), "n_cracked": int(0.08 * peak / k / STEP) * (draw.uniform() < 0.1)}


def record(draw, truth, failure=""):
    """Crosshead and force of a record, the force with three decimals, as its largest value is given."""
    k, peak, slack = truth["k"], truth["peak"], truth["slack"]
    n_up = math.ceil((slack + peak / k) / STEP) + 1
    x = numpy.linspace(slack + peak / k - (n_up - 1) * STEP, slack + peak / k, n_up)
    up = load_at(x - slack, k, truth["foot"])
    # rows from 88 to 96 % of the peak on with 8 % of it less, above those of the line
    up[int(numpy.argmax(up > 0.88 * peak)):][:truth["n_cracked"]] -= 0.08 * peak
    down = peak * (1 - numpy.arange(1, truth["fall"] + 1) / truth["fall"])
    parts = [up, down, numpy.zeros(truth["tail"])]
    if failure == "several peaks":
        parts[1:1] = [draw.uniform(0.1, 0.4) * peak + numpy.linspace(0, draw.uniform(0.4, 0.55) * peak, 60)]
    if failure == "never comes back":
        parts[1:] = [numpy.full(100, draw.uniform(0.6, 0.9) * peak)] if draw.uniform() < 0.5 else []
    force = numpy.concatenate(parts) * (failure != "no peak")
    x = numpy.append(x, x[-1] + STEP * numpy.arange(1, len(force) - n_up + 1)) + draw.uniform(-JITTER, JITTER, len(force))
    force += draw.uniform(-NOISE, NOISE, len(force))
    if failure != "no peak":
        force = numpy.minimum(force, peak - 0.001)
        force[n_up - 1] = peak
    if failure == "sensor at its limit":
        force = numpy.minimum(force, round(0.8 * peak, 3))
    if failure == "too few samples":
        x, force = x[n_up - 1::-n_up // 6][::-1], force[n_up - 1::-n_up // 6][::-1]
        x, force = numpy.append(x, x[-1] + 1), numpy.append(force, 0.1)
    return x, numpy.round(-force if failure == "negative" else force, 3)


def make_folder(folder, seed):
    """400 files, 12 of them failures, and the truth of each: {name: (truth, failure)}."""
    draw, made = numpy.random.default_rng(seed), {}
    planted = dict(zip(draw.choice(400, len(FAILURES), replace=False).tolist(), FAILURES))
    for i in range(400):
        is_shear, trial = bool(draw.integers(2)), int(draw.integers(1, 5))
        name = f"{1 + i // 4}{'LR'[i // 2 % 2]}{'LM'[i % 2]}{'S' * is_shear}" + f"-{trial}" * (trial > 2)
        truth, failure = truth_of(draw, is_shear), planted.get(i, "")
        x, force = record(draw, truth, failure)
        text = "".join(f"{a:.3f}\t{b:.3f}\n" for a, b in zip(x, force))
        write(f"{folder}/{name}.txt", "no data\n" if failure == "unreadable" else text)
        made[name] = truth, failure, force
    return made


def check_values(row, truth):
    """Of a record that did not fail; returns how many standard deviations stiffness and slack are off."""
    k, peak, s, s_x = truth["k"], truth["peak"], NOISE / 3**0.5, JITTER / 3**0.5
    value = {name: float(text) for name, text in row.items() if re.match("peak|disp|stiff|energy|drop|slack|offset|noise|rows", name)}
    check(value["peak_N"] == peak, f"{row}: the peak is {peak}")
    # a row of the fall is at least a tenth of the peak from the half; noise and offset can be 0.6 N
    check(abs(value["drop_rows"] - (truth["fall"] + 1) // 2) <= (0.1 * peak < 0.6), f"{row}: the load falls in {truth['fall']} rows")
    # the nearer to 0 of two numbers of ten values each, with a standard deviation of 0.1 N or less
    check(abs(value["offset_N"]) < 0.3, f"{row}: the offset is 0")
    check(0.6 * s < value["noise_N"] < 1.6 * s, f"{row}: the noise is {s}")
    length = peak / k + truth["slack"]
    check(abs(value["displacement_at_peak_mm"] - length) <= JITTER + 1e-3, f"{row}: the peak is at {length}")
    energy = (peak**2 - truth["preload"]**2) / (2 * k) + (0 if truth["preload"] else k * truth["foot"] ** 2 / 6)
    energy -= truth["n_cracked"] * 0.08 * peak * STEP
    check(abs(value["energy_mJ"] - energy) < 0.3 * length + 3 * peak * JITTER, f"{row}: the energy is {energy}")
    # least squares over the 40 % of the line, n rows of which have independent errors
    span, middle = 0.4 * peak / k, 0.6 * peak / k
    n, variance = span / STEP, s**2 + (k * s_x) ** 2
    sd_k = (variance / (n * span**2 / 12)) ** 0.5
    sd_slack = (variance / n / k**2 + (middle * sd_k / k) ** 2 + (0.09 / k) ** 2 + s_x**2) ** 0.5
    begin = length - math.ceil(length / STEP) * STEP  # of the first row, up to a step before 0
    return (value["stiffness_N_per_mm"] - k) / sd_k, (value["slack_mm"] - (truth["slack"] - begin)) / sd_slack


def check_seed(seed):
    made, began = make_folder(f"raw{seed}", seed), time.process_time()
    said = command(f"raw{seed}", "--columns", COLUMNS, "--names", NAMES, f"--out=out{seed}")
    seconds, rows = time.process_time() - began, rows_of(f"out{seed}")
    check(seconds < 10, f"400 records take {seconds} s")
    check("400 records, 12 of them marked" in said and len(rows) == 400, f"seed {seed}: {said}")
    off = []
    for name, (truth, failure, force) in made.items():
        row = rows[name]
        check(row["mark"].split(":")[0] == failure and ";" not in row["mark"], f"seed {seed}: {row}: planted: '{failure}'")
        if failure not in ("", "unreadable"):
            expected = force.min() if failure == "negative" else force.max()
            check(float(row["peak_N"]) == expected, f"{row}: the peak is {expected}")
        if not failure:
            off.append(check_values(row, truth))
        animal, limb, side, kind, trial = re.fullmatch(r"(\d+)(L|R)(L|M)(S?)(?:-(\d))?", name).groups()
        check([row[field] for field in ("animal", "limb", "side", "kind", "trial")] == [
            animal, limb, side, kind or "none", trial or "none"], f"{row}")
    return off


def check_records():
    """What is measured scatters as least squares do, by closed forms: no bias, and no more than that."""
    off = numpy.array([pair for seed in SEEDS for pair in check_seed(seed)])
    for name, z in zip(("stiffness", "slack"), off.T):
        check(abs(numpy.median(z)) < 0.2 and 0.85 < numpy.std(z) < 1.15 and max(abs(z)) < 5, f"{name}: off by {numpy.median(z)} +- "
              f"{numpy.std(z)} standard deviations, at most {max(abs(z))}")


def check_page():
    page = text_of("out0/report.html")
    check(page.count("<figure") == 8 and "limb L, side M, kind S" in page and "12 marked" in page, "groups of the page")
    # every file that is a table is drawn in some group, those with a mark in red
    colours = re.findall('class="line" stroke="#([0-9a-f]+)" d="M[^"]{30}', page)
    check(len(colours) == 399 and colours.count("c03028") == 11, "curves of the page")
    check(not re.search(r'd="[^"]*nan', page) and "http" not in page.replace("http://www.w3.org", ""), "places, or what is elsewhere")
    os.remove("out0/report.html")
    write_page("out0")
    check(text_of("out0/report.html") == page, "the page that is written again is another one")
    check(unit_in("peak_N").quantity == "force" and unit_in("peak_Nmm").quantity == "moment", "a table is read by the names of its columns")


def check_layouts():
    """The same record as others write it, and with what else lies in folders."""
    draw = numpy.random.default_rng(7)
    truth = {**truth_of(draw, True), "n_cracked": 0}
    rows = [(f"{a:.3f}", f"{b:.3f}") for a, b in zip(*record(draw, truth))]
    comma = [[text.replace(".", ",") for text in row] for row in rows]
    write("forms/day 1/A1.txt", "".join("\t".join(row) + "\n" for row in rows))
    write("forms/day 1/A2.csv", "Weg;Kraft\r\n" + "".join(";".join(row) + "\r\n" for row in comma), "utf-16")
    write("forms/day 2/A3.csv", "".join(",".join(row) + "\n" for row in rows))
    write("forms/day 2/A10.dat", "# made up\n" + "".join("  ".join(row) + "\n" for row in rows))
    write("forms/day 2/notes.txt", "nothing; of interest\n")
    write("forms/day 2/.hidden", "x")
    command("forms", "--columns", COLUMNS, "--names", "{day:.*}/{animal:A[0-9]+}", "--by", "day", "--out", "forms/results")
    for _ in range(2):  # results in the folder are none of its records
        found = rows_of("forms/results")
        check(list(found) == ["A1", "A2", "A3", "A10", "notes"], f"{list(found)}")
        command("forms", "--columns", COLUMNS, "--names", "{day:.*}/{animal:A[0-9]+}", "--by", "day", "--out", "forms/results")
    values = [[row[name] for name in row if name not in ("specimen", "file", "animal", "day")] for row in found.values()]
    check(all(one == values[0] for one in values[:4]) and float(found["A2"]["peak_N"]) == truth["peak"], f"{found}")
    marks = found["notes"]["mark"].split("; ")
    check([mark.split(":")[0] for mark in marks] == ["unreadable", "name"] and found["A10"]["day"] == "day 2", f"{found}")
    page = text_of("forms/results/report.html")
    check("day day 1: 2 records" in page and page.count("<figure") == 2, "the page of two days")
    # by number, the other sign, other units; and names that are taken twice
    shutil.copyfile("forms/day 1/A1.txt", "forms/day 2/A1.txt")
    command("forms", "--columns", "2 [-kN], 1 [um]", "--out", "turned")
    one = rows_of("turned")["day 2/A1.txt"]
    check(float(one["peak_N"]) == -1000 * truth["peak"] and one["mark"] == "negative: the peak is in the other direction", f"{one}")
    command("forms/day 1", "--columns", "time s, extension mm, load N", "--out", "three", code=1)
    write("three columns/1.txt", "".join(f"{0.1 * i:.1f}\t{a}\t{b}\n" for i, (a, b) in enumerate(rows)))
    command("three columns", "--columns", "time s, extension mm, load N")
    check(float(rows_of("output/three columns")["1"]["peak_N"]) == truth["peak"], "a column of time before the others")


def check_torques():
    """Energy in mJ, and friction that stays: the triangle to 2 N m at 10 degrees and 80 % of it behind."""
    torque = numpy.concatenate([numpy.linspace(0, 2, 101), numpy.full(50, 1.6)])
    write("torques/a.txt", "".join(f"{0.1 * i:.1f} {value:.4f}\n" for i, value in enumerate(torque)))
    for back, mark in (("0.5", "never comes back: the load stays near its peak"), ("0.1", "")):
        command("torques", "--columns", "angle deg, torque N m", "--back", back, "--out=torque")
        row = rows_of("torque")["a"]
        check(row["mark"] == mark and float(row["peak_Nmm"]) == 2000 and float(row["angle_at_peak_deg"]) == 10, f"{row}")
        check(abs(float(row["energy_mJ"]) / (1000 * math.radians(10)) - 1) < 1e-4, f"{row}: the energy is half of 2 N m times 10 degrees")
        check(abs(float(row["stiffness_Nmm_per_deg"]) / 200 - 1) < 1e-4 and abs(float(row["slack_deg"])) < 1e-3, f"{row}")


def check_marks():
    """Ties of a coarse sensor are no peaks of their own; stairs are; a single row is no peak. Noise of a normal distribution hides
    no weak peak, and is none. A sensor that is not zero changes the peak alone."""
    noise = 0.1 * numpy.random.default_rng(3).standard_normal(300)
    smooth = numpy.concatenate([numpy.linspace(0, 20, 200), numpy.zeros(50)])
    marks = {"ties": (numpy.round(smooth, 0), []), "stairs": (numpy.concatenate([smooth[:200], numpy.linspace(10, 14, 60), [0, 0, 0]]), ["several peaks: 2"]),
             "crack": (numpy.where(numpy.arange(250) == 150, smooth - 4, smooth), []),
             "one row": (numpy.where(numpy.arange(250) == 240, 90, smooth), ["single row: none beside the peak is half as high"]),
             "no way up": (smooth[195:], ["too few samples: 5 rows up to the peak"]), "flat": (numpy.zeros(100), ["no peak: nothing beyond the noise"])}
    marks.update({"noise": (noise, ["no peak: nothing beyond the noise"]), "twins": (numpy.append(smooth[:200], [19.9, 20, 0, 0, 0]), []),
                  "weak": (numpy.concatenate([numpy.linspace(0, 1.4, 100), numpy.zeros(200)]) + noise, [])})
    x = 0.1 * numpy.arange(250)
    first, shifted, turned = (evaluated(x, load)[0] for load in (smooth, smooth + 5, -smooth))
    for name, value in first.items():
        other = value + 5 * (name in ("peak", "offset"))
        check(abs(shifted[name] - other) < 1e-9 * abs(other) + 1e-9, f"with 5 N more {name} is {shifted[name]}, not {other}")
        other = value * (-1 if name in ("peak", "stiffness", "energy") else 1)
        check(abs(turned[name] - other) < 1e-9, f"in the other direction {name} is {turned[name]}, not {other}")
    for name, (load, expected) in marks.items():
        found = evaluated(0.1 * numpy.arange(len(load)), load)[1]
        check(found == expected, f"{name}: {found}, not {expected}")


def check_refusals():
    for words, arguments in {
            "--columns '': expected the columns": ["forms"],
            "--columns 'a mm, b mm, c N': expected the columns": ["forms", "--columns", "a mm, b mm, c N"],
            "--back 50: expected the share": ["forms", "--columns", COLUMNS, "--back", "50"],
            "nowhere: expected a folder": ["nowhere", "--columns", COLUMNS],
            " files has such a name, the first is 'A1'": ["forms", "--columns", COLUMNS, "--names", "{a}_{b}"],
            "--names '{a}{a}': redefinition": ["forms", "--columns", COLUMNS, "--names", "{a}{a}"],
            "--names '{a}{b': expected names of fields in braces": ["forms", "--columns", COLUMNS, "--names", "{a}{b"],
            "names of fields in braces that are no columns": ["forms", "--columns", COLUMNS, "--names", "{mark:.*}"],
            "--by side: expected fields of --names, a": ["forms", "--columns", COLUMNS, "--names", "{a:.*}", "--by", "side"]}.items():
        said = command(*arguments, code=1)
        check(words in said and said.count("\n") == 1, f"{arguments}: {said}")


shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)
os.chdir(scratch)
check_records()
check_page()
check_layouts()
check_torques()
check_marks()
check_refusals()
