"""specimens.py SOURCE SCRATCH: fits of many specimens, on those of prm/specimens, which are made up and known.

Values lie in their intervals and are those of single fits; means over specimens against a published analysis and against a
restricted likelihood that is written anew; a run that goes on, with the same digits; specimens that fail; wrong tables.
Ends with 1 and a message at the first thing that is wrong. Needs NumPy and SciPy; with openpyxl it reads a workbook, too.
"""

import contextlib
import csv
import importlib
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys

import numpy
from scipy import optimize, stats

import debond
from debond import specimens as module
from debond.__main__ import main as main_of_package
from debond.errors import InputError, RunError
from debond.page import write_page
from debond.pooling import pool
from debond.specimen_table import read_specimens

source, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
example = os.path.join(source, "prm", "specimens")
TEMPLATE = os.path.join(example, "template.prm")


def check(is_so, message):
    if not is_so:
        sys.exit(f"specimens: {message}")


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def command(*arguments, code=0):
    """What the command says, in this process: SciPy takes a second to start."""
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
        returned = main_of_package(["specimens", *arguments])
    check(returned == code, f"{arguments} ends with {returned}, not {code}: {out.getvalue()}{errors.getvalue()}")
    return out.getvalue(), errors.getvalue()


def command_as_users_start_it(*arguments):
    done = subprocess.run([sys.executable, "-m", "debond", "specimens", *arguments], capture_output=True, text=True)
    check(done.returncode == 0, f"{arguments} ends with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout, done.stderr


def check_pooling():
    # vaccine against tuberculosis: ill and well of those vaccinated, of the others (Colditz et al., JAMA 271 (1994) 698-702)
    a, b, c, d = numpy.array([
        (4, 119, 11, 128), (6, 300, 29, 274), (3, 228, 11, 209), (62, 13536, 248, 12619), (33, 5036, 47, 5761),
        (180, 1361, 372, 1079), (8, 2537, 10, 619), (505, 87886, 499, 87892), (29, 7470, 45, 7232), (17, 1699, 65, 1600),
        (186, 50448, 141, 27197), (5, 2493, 3, 2338), (27, 16886, 29, 17825)], dtype=float).T
    y, variance = numpy.log(a / (a + b) * (c + d) / c), 1 / a - 1 / (a + b) + 1 / c - 1 / (c + d)
    found = pool(y, numpy.sqrt(variance))
    # as metafor of R prints them (Viechtbauer, J. Stat. Software 36(3) (2010)): REML, and test="knha"
    for name, value, expected in (("tau^2", found.tau**2, 0.3132), ("mean", found.mean, -0.7145),
                                  ("lower end", found.lower, -1.1084), ("upper end", found.upper, -0.3206)):
        check(abs(value - expected) < 6e-5, f"BCG trials: {name} {value}, published {expected}")
    # the restricted likelihood itself, with whole matrices
    y, sd = numpy.array([0.61, 0.68, 0.55, 0.72, 0.64]), numpy.array([0.02, 0.05, 0.03, 0.01, 0.04])

    def minus_log(t):
        V, one = numpy.diag(sd**2 + t), numpy.ones((len(y), 1))
        P = numpy.linalg.inv(V) - numpy.linalg.inv(V) @ one @ one.T @ numpy.linalg.inv(V) / (one.T @ numpy.linalg.inv(V) @ one)
        return 0.5 * (numpy.linalg.slogdet(V)[1] + numpy.log(one.T @ numpy.linalg.inv(V) @ one)[0, 0] + y @ P @ y)

    t = optimize.minimize_scalar(minus_log, bounds=(0, 0.1), method="bounded", options={"xatol": 1e-12}).x
    check(abs(pool(y, sd).tau ** 2 / t - 1) < 1e-4, f"tau^2 {pool(y, sd).tau**2}, largest likelihood at {t}")
    # equal errors, by hand: S^2 = 0.01, tau^2 = S^2 - s^2, mean 0.3 +- t sqrt(S^2 / 3)
    even = pool([0.2, 0.3, 0.4], [0.05] * 3)
    check(abs(even.tau**2 - 0.0075) < 1e-12 and abs(even.mean - 0.3) < 1e-12, f"equal errors: {even}")
    check(abs(even.upper - even.mean - 4.302652729911275 * math.sqrt(0.01 / 3)) < 1e-9, f"equal errors, interval: {even}")
    # values that agree better than their errors say: no scatter, and no interval narrower than the errors say
    close = pool([1.0, 1.0, 1.0, 1.0], [0.1] * 4)
    check(close.tau == 0 and abs(close.upper - 1 - stats.t.ppf(0.975, 3) * 0.05) < 1e-12, f"values that agree: {close}")
    one = pool([2.0], [0.1])
    check(math.isnan(pool([], []).mean) and one.mean == 2 and math.isnan(one.upper), f"none, or one: {one}")


def check_what_is_pooled():
    """What is not told, or ends at a bound, has no error that could weigh it."""
    row = {"told": True, "at_bound": False, "logarithmic": True, "unit": "mm", "value": 2.0, "sd": 0.1}
    others = {"value": 8.0}, {"told": False}, {"at_bound": True}, {"sd": None}, {"sd": 0.0}
    rows = [row, *({**row, **other} for other in others)]
    unknown, group, n, left_out, mean, lower, upper, sd, unit, scale, tau, *plain = module._pooled_row("a", "g", rows).values()
    check((n, left_out, unit, scale) == (2, 4, "mm", "logarithm") and abs(mean - 4) < 1e-12, f"{n}, {left_out}, mean {mean}")
    check(abs(tau**2 - (math.log(4) ** 2 / 2 - 0.01)) < 1e-12, f"tau {tau}")
    check(abs(lower * upper - 16) < 1e-9, f"{lower} to {upper}")
    check(numpy.allclose(plain, [5, 18**0.5]), f"plain mean and SD: {plain}")
    # two specimens of an animal count as their mean, and know it better
    twins = [{**row, "animal": "1"}, {**row, "animal": "1", "value": 8.0}, {**row, "animal": "2", "value": 3.0, "sd": 0.2}]
    found, expected = module._pooled_row("a", "g", twins), pool([math.log(4), math.log(3)], [0.1 / 2**0.5, 0.2])
    check(found["specimens"] == 3 and numpy.allclose([found[name] for name in ("mean", "lower_95", "upper_95", "tau")], [*numpy.exp([expected.mean, expected.lower, expected.upper]), expected.tau]),
          f"animals: {found}, {expected}")
    # ratios of what is searched by its logarithm are those of geometric means
    pairs = [("a", row), ("a", {**row, "value": 4.0}), ("b", {**row, "value": 8.0}), ("b", {**row, "value": 16.0}), ("b", {**row, "told": False})]
    (row,) = module._differences_of("x", pairs)
    group, minus, *difference, ratio, lower, upper = (row[name] for name in module.DIFFERENCES[1:-1])
    half = stats.t.ppf(0.975, 2) * math.log(2) / 2**0.5
    check((group, minus) == ("b", "a") and all(map(math.isnan, difference)), f"{group} over {minus}: {difference}")
    check(numpy.allclose([ratio, lower, upper], [4, 4 * math.exp(-half), 4 * math.exp(half)]), f"{ratio}: {lower} to {upper}")
    drawn = 4 * numpy.exp(tau * numpy.random.default_rng(1).standard_normal(10**6))
    check(abs(sd / numpy.std(drawn) - 1) < 0.02, f"standard deviation {sd}, of values that were drawn {numpy.std(drawn)}")


def truth_of(curve):
    line = text_of(os.path.join(example, curve)).splitlines()[0]
    return dict(zip(("mu_ub", "a_s"), map(float, re.findall("= ([0-9.]+)", line))))


def check_example():
    out, _ = command_as_users_start_it(TEMPLATE, os.path.join(example, "specimens.csv"), "--out=all", "--jobs=2")
    check("all/parameters.csv" in out and out.count(": done") == 6, f"the command says {out}")
    rows = rows_of("all/parameters.csv")
    check(len(rows) == 12 and tuple(rows[0]) == module.PARAMETERS, f"rows: {rows}")
    held = sum(float(row["lower_95"]) <= truth_of(row["curve"])[row["unknown"]] <= float(row["upper_95"]) for row in rows)
    check(held >= 10, f"{held} of 12 intervals hold the true values")  # 9 or fewer once in 50, for independent ones
    check([row["unit"] for row in rows[:2]] == ["", "mm"], f"{rows[:2]}")
    check(all(row["told"] == row["fits"] == "true" for row in rows), f"{rows}")
    single = debond.fit(debond.Scene(TEMPLATE, {"Implant/Radius": 2.47, "Chuck/Press/Value": "45 * min(t, 1)",
                                                "Output/Reference curve": os.path.join(example, "M1.csv")}))
    for row, value, lower in zip(rows, single.values, single.lower):
        check(float(row["value"]) == value and float(row["lower_95"]) == lower, f"{row}, a single fit {value}, {lower}")
    for row in rows_of("all/pooled.csv"):
        own = [one for one in rows if one["unknown"] == row["unknown"] and row["group"] in ("all", one["group"])]
        search = math.log if row["scale"] == "logarithm" else float
        y = [search(float(one["value"])) for one in own]
        # intervals are those of Student's t, here nearly of the normal distribution
        sd = [(search(float(one["upper_95"])) - search(float(one["lower_95"]))) / 2 / 1.96 for one in own]
        expected = pool(y, sd)
        back = math.exp if row["scale"] == "logarithm" else float
        check(int(row["specimens"]) == len(own) == (6 if row["group"] == "all" else 3) and row["left_out"] == "0", f"{row}")
        check(abs(float(row["mean"]) / back(expected.mean) - 1) < 1e-3, f"{row}")
        check(abs(float(row["tau"]) / expected.tau - 1) < 2e-2, f"{row}")
        check((row["scale"] == "logarithm") == (row["unknown"] == "a_s"), f"{row}")
    means = {row["group"]: float(row["mean"]) for row in rows_of("all/pooled.csv") if row["unknown"] == "mu_ub"}
    check(means["etched"] > means["machined"], f"{means}")
    difference, ratio = rows_of("all/differences.csv")
    values = {group: [float(row["value"]) for row in rows if (row["unknown"], row["group"]) == ("mu_ub", group)] for group in means}
    check(abs(float(difference["difference"]) - numpy.mean(values["etched"]) + numpy.mean(values["machined"])) < 1e-12, f"{difference}")
    check((ratio["unknown"], ratio["difference"]) == ("a_s", "nan") and float(ratio["ratio"]) > 1, f"{ratio}")
    page = text_of("all/report.html")
    check(all(name in page for name in ("M1/report.html", "etched", "Hartung", "etched minus machined: ", "etched over machined: ")) and page.count("<figure") == 2, "the page")
    check(not re.search(r'(\bd|x|y|x1|cx)="[^"]*(nan|inf)', page), "the page has places that are no numbers")
    check("http" not in page.replace("http://www.w3.org", ""), "the page needs something from elsewhere")
    check(page.count('class="one"') == 12 and page.count('class="mean"') == 6, "lines of the picture")
    check(os.path.exists("all/M1/report.html") and "mu_ub = 0.6" in text_of("all/M1/fitted.prm"), "what a fit leaves")


def check_going_on():
    """The same command keeps what is finished; what has changed is fitted again, and nothing else."""
    before = {name: text_of(f"all/{name}") for name in ("parameters.csv", "pooled.csv", "E1/specimen.json")}
    shutil.rmtree("all/M2")
    stamp = os.stat("all/E1/specimen.json").st_mtime_ns
    out, _ = command(TEMPLATE, os.path.join(example, "specimens.csv"), "--out=all", "--jobs=1")
    check("6 specimens, 5 of them done already" in out and "M2: done" in out and "E1" not in out, f"going on: {out}")
    check(all(text_of(f"all/{name}") == text for name, text in before.items()), "going on gives other digits")
    check(os.stat("all/E1/specimen.json").st_mtime_ns == stamp, "what was finished is written again")
    # the curve of one, the row of another
    shutil.copytree(example, "copy")
    shutil.copytree("all", "kept")
    table, said = text_of("copy/specimens.csv"), []
    found = debond.fit_specimens("copy/template.prm", "copy/specimens.csv", "kept", say=said.append)
    check(said == ["6 specimens, 6 of them done already"], f"files that were moved: {said}")
    check(list(found.parameters["value"]) == [float(row["value"]) for row in rows_of("all/parameters.csv")], "from Python")
    said.clear()
    with open("copy/E2.csv", "a", encoding="utf-8") as file:
        file.write("10.0,40.0\n")
    with open("copy/specimens.csv", "w", encoding="utf-8") as file:
        file.write(table.replace("2.53", "2.52"))
    debond.fit_specimens("copy/template.prm", "copy/specimens.csv", "kept", say=said.append)
    check(said == ["6 specimens, 4 of them done already", "E2: done", "M3: done"], f"what has changed: {said}")


def check_failures():
    """Named with the reason; the others go on."""
    with open("copy/noise.csv", "w", encoding="utf-8") as file:
        file.write("angle_deg,torque_Nmm\n" + "".join(f"{0.1 * i},{(-1) ** i}\n" for i in range(1, 60)))
    with open("copy/some.csv", "w", encoding="utf-8") as file:
        file.write("Specimen;Curve;Implant / Radius [mm]\n"
                   "A;M1.csv;2,47\nB;missing.csv;\nC;noise.csv;2.5\nD;specimens.csv;2.5\n")
    _, said = command("copy/template.prm", "copy/some.csv", "--out", "some", "--jobs=1", code=2)
    with open("copy/animals.csv", "w", encoding="utf-8") as file:
        file.write("specimen,curve,Animal\nA,M1.csv,7\nB,M2.csv,\n")
    animals = [one.animal for one in read_specimens("copy/animals.csv", debond.Scene("copy/template.prm")._entries)]
    check(animals == ["7", ""], f"animals: {animals}")
    rows = rows_of("some/parameters.csv")
    check([row["specimen"] for row in rows] == ["A", "A", "B", "C", "D"], f"{rows}")
    for row, word in zip(rows[2:], ("missing.csv", "no parameters of this scene fit", "specimens.csv")):
        check(word in row["reason"] and row["unknown"] == "" and row["value"] == "nan", f"{row}")
    check("B failed: " in said and "C failed: " in said and "A failed" not in said, f"said: {said}")
    pooled = rows_of("some/pooled.csv")
    check([(row["group"], row["specimens"], row["tau"]) for row in pooled] == [("all", "1", "nan")] * 2, f"{pooled}")
    page = text_of("some/report.html")
    check("1 of 4 specimens are fitted" in page and "missing.csv" in page, "the page of what failed")
    check(state_of("some") == ("failed", "3 failed") and state_of("some/A") == ("", "finished"), f"{state_of('some')}, {state_of('some/A')}")
    check(state_of("some/C") == ("failed", "failed") and "no parameters of this scene fit" in text_of("some/C/report.html"), "page of a fit that failed")
    with open("some/specimens.json", encoding="utf-8") as file:
        check(set(json.load(file)["failures"]) == {"B", "C", "D"}, "specimens.json")


def state_of(directory):
    """How a page says that it has ended: the class of the mark that says so, and its word."""
    return re.search(r'class="state ?(\w*)">\s*([^<]*)<', text_of(os.path.join(directory, "report.html"))).groups()


def check_pages_of_what_went_wrong():
    """What does not fit, and what has found nothing, is no green page."""
    shutil.copytree("all", "misfit")
    rows = rows_of("misfit/parameters.csv")
    for row in rows[2:]:
        row["fits"] = "false"
    with open("misfit/parameters.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([module.PARAMETERS, *(row.values() for row in rows)])
    write_page("misfit")
    check(state_of("misfit") == ("failed", "5 do not fit") and "the model does not fit 5 of them" in text_of("misfit/report.html"), f"{state_of('misfit')}")
    check(state_of("all") == ("", "finished"), "the page of what fits")
    with open("misfit/M1/calibration.json", encoding="utf-8") as file:
        results = json.load(file)
    results["curves"][0]["fits"] = False
    with open("misfit/M1/calibration.json", "w", encoding="utf-8") as file:
        json.dump(results, file)
    write_page("misfit/M1")
    check(state_of("misfit/M1") == ("failed", "does not fit"), f"{state_of('misfit/M1')}")
    # a search that finds no curve at all: all runs fail
    calibrations, whole = importlib.import_module("debond.calibrate"), debond.calibrate
    scene = debond.Scene(TEMPLATE, {"Task": "calibrate", "Output/Reference curve": os.path.join(example, "M1.csv"), "Output/Directory": "nothing"})
    search = calibrations.fit_problem

    def fails(problem, say):
        raise RunError("no curve could be computed: <why>")

    try:
        calibrations.fit_problem = fails
        whole(scene)
        check(False, "a fit that has found nothing is none that failed")
    except RunError:
        check(state_of("nothing") == ("failed", "failed") and "no curve could be computed: &lt;why&gt;" in text_of("nothing/report.html"),
              "page of a fit that has found nothing")
    finally:
        calibrations.fit_problem = search


def check_closed_pipe():
    """`| head` ends no fit."""
    process = subprocess.Popen([sys.executable, "-m", "debond", "specimens", TEMPLATE, os.path.join(example, "specimens.csv"), "--out=piped", "--jobs=1"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    said = process.stderr.read()
    check(process.wait() == 0 and said == b"", f"a closed pipe: {process.returncode}, {said}")
    check(rows_of("piped/parameters.csv") == rows_of("all/parameters.csv"), "results with a closed pipe")


HEAD = "specimen,group,curve,Implant/Radius\n"
BAD = (
    ("", "this table is empty: expected a line of names, and a row for each specimen"),
    (HEAD, "there is no row below the names: expected one for each specimen"),
    ("specimen,group\nA,1\n", "line 1: read 'specimen', 'group': expected specimen, either curve or a peak"),
    ("specimen,curve,Implant/Radios\nA,a.csv,1\n",
     "line 1: column 'Implant/Radios': expected specimen, curve, group, or an entry of the scene, as Implant / Radius"),
    ("specimen,curve,Implant/Radius [m]\nA,a.csv,1\n",
     "line 1: column 'Implant/Radius [m]': expected the unit of the entry, mm"),
    ("specimen,curve,curve\nA,a.csv,1\n", "line 1: column 'curve': there are two of them, expected one"),
    ("specimen,curve,Output/Directory\nA,a.csv,x\n",
     "line 1: column 'Output/Directory': expected specimen, curve, group, or an entry"),
    (HEAD + "# a comment\nA,1,a.csv,-2\n",
     "line 3: Implant / Radius = '-2': expected a number from 1e-6 to 1e6 [mm]"),
    (HEAD + "A,1,a.csv,wide\n", "line 2: Implant / Radius = 'wide': expected a number from"),
    (HEAD + "A,1,a.csv,2,3\n", "line 2: read 5 items: expected at most 4, as many as there are names"),
    (HEAD + "../A,1,a.csv,2\n", "line 2, column 'specimen': read '../A': expected a name for a directory"),
    (HEAD + ",1,a.csv,2\n", "line 2, column 'specimen': read '': expected a name for a directory"),
    (HEAD + "Report.html,1,a.csv,2\n", "line 2, column 'specimen': read 'Report.html': expected a name for a directory"),
    (HEAD + "A,1,,2\n", "line 2, column 'curve': read '': expected the file of a measured curve"),
    (HEAD + "A,all,a.csv,2\n", "line 2, column 'group': read 'all': expected another name"),
    (HEAD + "A,1,a.csv,2\na,1,b.csv,2\n", "line 3, column 'specimen': read 'a': expected another name: line 2 has this one"),
)


def check_bad_tables():
    with open("copy/plain.prm", "w", encoding="utf-8") as file:
        file.write("set Title = without unknowns\n")
    for text, expected in BAD:
        with open("copy/bad.csv", "w", encoding="utf-8") as file:
            file.write(text)
        try:
            debond.fit_specimens("copy/template.prm", "copy/bad.csv", "bad")
            check(False, f"a table is not refused: {text!r}")
        except InputError as error:
            said = str(error)
            check(said.startswith("copy/bad.csv: ") and expected in said and "\n" not in said, f"{text!r}: {said}")
    check(not os.path.exists("bad"), "a table that is refused leaves a directory")
    _, said = command("copy/template.prm", "copy/none.csv", code=1)
    check(said == "copy/none.csv: this file cannot be read: No such file or directory\n", said)
    _, said = command("copy/plain.prm", "copy/specimens.csv", code=1)
    check(said.startswith("the template has no unknowns: ") and said.count("\n") == 1, said)
    command("copy/template.prm", code=1)
    command("copy/template.prm", "copy/specimens.csv", "--jobs", "0", code=1)


def check_workbook():
    try:
        import openpyxl
    except ImportError:
        return print("no openpyxl: left out")
    book = openpyxl.Workbook()
    for row in (("specimen", "curve", "Implant/Radius", "Chuck/Press/Value"), (1, "M1.csv", 2.47, "45 * min(t, 1)")):
        book.active.append(row)
    book.save("copy/one.xlsx")
    found = debond.fit_specimens("copy/template.prm", "copy/one.xlsx", "one")
    value = float(rows_of("all/parameters.csv")[0]["value"])
    check(not found.failures and found.parameters["value"][0] == value, f"workbook: {found.parameters}, {found.failures}")
    book.active.append(("B", "M1.csv", "no", ""))
    book.save("copy/one.xlsx")
    _, said = command("copy/template.prm", "copy/one.xlsx", code=1)
    check("one.xlsx: sheet 'Sheet', row 3: Implant / Radius = 'no': expected a number" in said, said)


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    check_pooling()
    check_what_is_pooled()
    check_example()
    check_going_on()
    check_failures()
    check_pages_of_what_went_wrong()
    check_closed_pipe()
    check_bad_tables()
    check_workbook()


if __name__ == "__main__":
    main()
