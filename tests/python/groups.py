"""groups.py SCRATCH [DRAWS]: means of groups and their differences, strengths, and the command that reads tables.

Intervals against Welch and the paired test, which SciPy and a closed form give, and against statsmodels, if that is there; how often
they hold in draws (1000) whose truth is known: groups of unequal size and scatter, animals that repeat, within groups and across
them, values with errors of their own, and curves with noise that hangs together, for which a closed form stands in. Ends with 1
and a message at the first thing that is wrong. Needs NumPy and SciPy; with Jinja2 it looks at the page, too.
"""

import contextlib
import csv
import io
import math
import os
import shutil
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # matrices are small
import numpy
from scipy import signal, stats

from debond import pooling
from debond.__main__ import main as main_of_package
from debond.pooling import compare_groups, pool
from debond.reductions import STRENGTHS, reduced, sizes_of

scratch, draws = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1000


def check(is_so, message):
    if not is_so:
        sys.exit(f"groups: {message}")


def near(found, expected, message, tolerance=1e-9):
    check(numpy.allclose(found, expected, rtol=tolerance, atol=0), f"{message}: {found}, not {expected}")


def ends(row):
    return row["lower_95"], row["upper_95"]


def check_against_textbooks():
    rng = numpy.random.default_rng(3)
    a, b = rng.normal(10, 1, 5), rng.normal(12, 3, 9)
    (first, _), (row,) = compare_groups([*a, *b], ["a"] * 5 + ["b"] * 9)
    near(ends(first), stats.t.interval(0.95, 4, a.mean(), stats.sem(a)), "interval of a mean")
    # Welch: SciPy gives p, the interval that just touches 0 is that of this confidence
    near(row["difference"], b.mean() - a.mean(), "difference")
    v = a.var(ddof=1) / 5, b.var(ddof=1) / 9
    freedom = sum(v) ** 2 / (v[0] ** 2 / 4 + v[1] ** 2 / 8)
    test = stats.ttest_ind(b, a, equal_var=False)
    near(2 * stats.t.sf(abs(test.statistic), freedom), test.pvalue, "degrees of freedom of Welch")
    near(row["upper_95"] - row["difference"], stats.t.ppf(0.975, freedom) * sum(v) ** 0.5, "interval of Welch")
    # Fieller: at the ends of its interval the difference a - r b is as many standard errors from 0 as the test of Welch says
    near(row["ratio"], b.mean() / a.mean(), "ratio")
    check(row["ratio_lower_95"] < row["ratio"] < row["ratio_upper_95"], f"{row}")
    for r in (row["ratio_lower_95"], row["ratio_upper_95"]):
        near(stats.ttest_ind(b, r * a, equal_var=False).pvalue, 0.05, "interval of a ratio")
    # each animal with both: the paired test
    animals, both = numpy.repeat(range(7), 2), rng.normal(20, 3, 7)[:, None] + [0, 2] + rng.normal(0, [1, 2], (7, 2))
    d = both[:, 1] - both[:, 0]
    _, (row,) = compare_groups(both.ravel(), ["a", "b"] * 7, animals)
    near([row["difference"], *ends(row)], [d.mean(), *stats.t.interval(0.95, 6, d.mean(), stats.sem(d))], "pairs", 2e-4)
    # sides of an animal in one group: it is animals that scatter
    (mean, _), (row,) = compare_groups([*both.ravel(), *a], ["a"] * 14 + ["b"] * 5, [*animals, *[None] * 5])
    check((mean["animals"], mean["values"]) == (7, 14), f"{mean}")
    near(ends(mean), stats.t.interval(0.95, 6, both.mean(), stats.sem(both.mean(axis=1))), "animals that repeat")


def check_few():
    """What one animal, or values that are all the same, do not tell."""
    means, rows = compare_groups([1.0, 2.0, 3.0], ["a", "a", "b"])
    check(math.isnan(means[1]["sd"]) and means[1]["mean"] == 3 and rows == [], f"{means}, {rows}")
    check(compare_groups([1.0], ["a"])[1] == [], "one value")
    _, (row,) = compare_groups([2.0, 2.0, 4.0, 4.0], ["a", "a", "b", "b"])
    near([row["lower_95"], row["difference"], row["ratio_upper_95"]], 2, f"without scatter: {row}", 1e-4)
    _, (row,) = compare_groups([2.0, 2.0, 2.0, 4.0, 4.5, 5.5], list("aaabbb"))
    near(ends(row), numpy.array(stats.t.interval(0.95, 2, 14 / 3, stats.sem([4, 4.5, 5.5]))) - 2, "one group without scatter", 1e-6)
    _, (row,) = compare_groups([2.0, 4.0, 2.0, 4.0], ["a", "b", "a", "b"], [1, 1, 2, 2])
    check(abs(row["difference"] - 2) < 1e-6 and row["upper_95"] - 2 < 1e-2, f"pairs without scatter: {row}")
    _, (row,) = compare_groups([-1.0, 1.0, 4.0, 4.5], ["a", "a", "b", "b"])
    check(math.isnan(row["ratio"]), f"a ratio over a mean of 0: {row}")
    _, (row,) = compare_groups([0.1, 3.0, 4.0, 4.5], ["a", "a", "b", "b"])
    check(row["ratio"] > 0 and math.isnan(row["ratio_upper_95"]), f"a ratio over a mean that may be 0: {row}")
    _, rows = compare_groups(numpy.arange(6.0), list("aabbcc"))
    check([(row["group"], row["minus"]) for row in rows] == [("b", "a"), ("c", "a"), ("c", "b")], f"{rows}")


def check_against_statsmodels():
    """The restricted likelihood is largest where statsmodels finds it. Its groups all scatter alike, so there is one part for both."""
    try:
        from statsmodels.regression.mixed_linear_model import MixedLM
    except ImportError:
        return print("no statsmodels: left out")
    rng = numpy.random.default_rng(5)
    animals = numpy.repeat(range(12), 3)
    groups = numpy.tile([0, 1, 1], 12)
    y = 20 + rng.normal(0, 2, 12)[animals] + groups + rng.normal(0, 1, 36)
    keep = rng.permutation(36)[:25]
    y, groups, animals = y[keep], groups[keep], animals[keep]
    X = numpy.equal.outer(groups, [0, 1]).astype(float)
    found = MixedLM(y, X, animals).fit(reml=True)
    parts = numpy.array([numpy.eye(len(y)), numpy.equal.outer(animals, animals)], dtype=float)
    theta = numpy.array([found.scale, found.cov_re[0, 0]])
    at, slopes = pooling._restricted(theta**0.5, y, X, parts)
    near(numpy.abs(slopes).max() + 1, 1, "the restricted likelihood at what statsmodels finds is not largest", 2e-3)
    check(all(pooling._restricted((theta * factor) ** 0.5, y, X, parts)[0] > at for factor in ([1.1, 1], [1, 1.2], [0.9, 1], [1, 0.8])),
          "the restricted likelihood is larger beside what statsmodels finds")


def _groups_of(rng, counts, sds, animal_sd=(0, 0), sides=(1, 1), truth=(10, 12)):
    """Values of two groups whose animals have some sides each: a number, or a choice."""
    rows = []
    for k in (0, 1):
        for animal in range(counts[k]):
            own = rng.normal(0, animal_sd[k])
            rows += [(truth[k] + own + rng.normal(0, sds[k]), k, (k, animal)) for _ in range(rng.choice(sides))]
    return zip(*rows)


def _crossed(rng, n, sds, animal_sd, missing=0, sides=1, truth=(10, 12)):
    """The same of n animals with both, of which some values are missing."""
    rows = [(truth[k] + own + rng.normal(0, sds[k]), k, animal)
            for animal, own in enumerate(rng.normal(0, animal_sd, n)) for k in (0, 1) for _ in range(sides)]
    left = sorted(rng.permutation(len(rows))[missing:])
    rows = sorted((rows[i] for i in left), key=lambda row: row[1])
    return zip(*rows)


def _with_own_errors(rng, counts, sds, low, high, truth=(10, 12)):
    """Values that are known differently well."""
    groups = numpy.repeat([0, 1], counts)
    errors = numpy.exp(rng.uniform(math.log(low), math.log(high), len(groups)))
    return numpy.array(truth)[groups] + rng.normal(0, numpy.array(sds)[groups]) + rng.normal(0, errors), groups


def _of_curves(rng, counts, sds, truth=(10, 12)):
    """Torques that a closed form has fitted to curves whose noise hangs together over ten rows: T(theta) = T_0 + T_1 exp(-theta)."""
    groups = numpy.repeat([0, 1], counts)
    angles = numpy.linspace(0, 5, 120)
    shape = numpy.column_stack([1 + 0 * angles, numpy.exp(-angles)])
    values = numpy.array(truth)[groups] + rng.normal(0, numpy.array(sds)[groups])
    noise = signal.lfilter([1], [1, -0.9], rng.normal(0, 0.4, (len(groups), 220)))[:, 100:]
    curves = values[:, None] * shape[:, 1] + 5 + noise
    return numpy.linalg.lstsq(shape, curves.T, rcond=None)[0][1], groups


SCENARIOS = {
    "two groups of 6": (_groups_of, (6, 6), (1, 1)),
    "5 and 12, scatter 2 and 1": (_groups_of, (5, 12), (2, 1)),
    "12 and 4, scatter 1 and 3": (_groups_of, (12, 4), (1, 3)),
    "3 animals each, two sides": (_groups_of, (3, 3), (1, 1), (1, 1), [2]),
    "6 animals each, two sides, animals alike": (_groups_of, (6, 6), (1, 1), (0, 0), [2]),
    "4 and 6 animals, one to three sides, scatter 2 and 0.5": (_groups_of, (4, 6), (1, 0.5), (2, 0.5), [1, 2, 3]),
    "5 animals with both": (_crossed, 5, (1, 1), 2),
    "6 animals with both, scatter 1 and 2, two missing": (_crossed, 6, (1, 2), 1, 2),
    "4 animals with both, three of each": (_crossed, 4, (1, 1.5), 1.5, 0, 3),
    "10 animals with both, nine missing": (_crossed, 10, (1, 2), 1, 9),
    "own errors, by a factor of 5": (_with_own_errors, (5, 8), (1, 0.5), 0.2, 1),
    "own errors of all the scatter": (_with_own_errors, (4, 4), (0, 0), 0.5, 1),
    "curves with noise that hangs together": (_of_curves, (4, 7), (0.5, 1)),
}


def _shares(make, *arguments):
    """How many intervals hold what is true, of differences and of ratios that are told."""
    rng, held, told = numpy.random.default_rng(11), numpy.zeros(2), numpy.zeros(2)
    for _ in range(draws):
        _, (row,) = compare_groups(*map(list, make(rng, *arguments)))
        sign, ratio = (1, 1.2) if row["group"] == 1 else (-1, 1 / 1.2)
        held += [row["lower_95"] <= 2 * sign <= row["upper_95"], row["ratio_lower_95"] <= ratio <= row["ratio_upper_95"]]
        told += [True, row["ratio_lower_95"] <= row["ratio_upper_95"]]
    return held / told, told[1] / draws


def check_how_often():
    """93 to 97 % of intervals hold; a little fewer where the smallest group of 3 scatters most, as it is known of Welch's test."""
    for name, scenario in SCENARIOS.items():
        held, told = _shares(*scenario)
        print(f"{name}: {held}")
        check((0.93 <= held).all() and (held <= 0.97).all() and told > 0.99, f"{name}: {held} of {draws} intervals hold, {told} of ratios are told")
    held, _ = _shares(_groups_of, (3, 12), (2, 1))
    print(f"3 and 12, scatter 2 and 1: {held}")
    check((0.91 < held).all() and held[0] < 0.945, f"3 and 12: {held}")


def check_weights():
    """Why differences are not those of weighted means: with weights from four errors that differ much, intervals hold too rarely."""
    rng, held, groups = numpy.random.default_rng(11), numpy.zeros(2), numpy.repeat([0, 1], (4, 10))
    for _ in range(draws):
        errors = numpy.exp(rng.uniform(math.log(0.1), math.log(3), 14))
        y = rng.normal(0, numpy.array([1, 0.3])[groups]) + rng.normal(0, errors)
        errors *= (rng.chisquare(10, 14) / 10) ** 0.5  # as they are known
        a, b = (pool(y[groups == group], errors[groups == group]) for group in (0, 1))
        v = numpy.array([((one.upper - one.mean) / stats.t.ppf(0.975, one.n - 1)) ** 2 for one in (a, b)])
        half = stats.t.ppf(0.975, v.sum() ** 2 / (v**2 / (3, 9)).sum()) * v.sum() ** 0.5
        _, (row,) = compare_groups(y, groups)
        held += [abs(a.mean - b.mean) <= half, row["lower_95"] <= 0 <= row["upper_95"]]
    print(f"weighted and plain means: {held / draws}")
    check(held[0] < 0.92 * draws < 0.93 * draws < held[1], f"weighted and plain means: {held} of {draws}")


def check_reductions():
    """A stress of 3 MPa all over a side gives back 3; a disk, 2/3 of it; straight lines their slope and area."""
    d, L, A, R = 4.0, 8.0, math.pi * 9, 3.0
    force, torque = 3 * math.pi * d * L, 3 * math.pi * d * L * d / 2
    near(STRENGTHS["force", "diameter", "length"][1](force, d, L), 3, "F/(pi d L)")
    near(STRENGTHS["moment", "diameter", "length"][1](torque, d, L), 3, "2 T/(pi d^2 L)")
    near(STRENGTHS["moment", "area", "radius"][1](3 * 2 * math.pi * R**3 / 3, A, R), 2, "T/(A R)")
    near(STRENGTHS["force", "area"][1](3 * A, A), 3, "F/A")
    pin = {"Implant / Shape": "pin", "Implant / Radius": "2", "Implant / Height": "8", "Bone / Height": "5"}
    check(sizes_of(pin) == {"diameter": 4, "length": 5} and sizes_of({**pin, "Implant / Shape": "cup"}) == {}, f"{sizes_of(pin)}")
    ring = sizes_of({"Implant / Shape": "ring", "Implant / Radius": "3", "Implant / Inner radius": "1"})
    near([ring["area"], ring["radius"]], [8 * math.pi, 3], "a ring")
    x = [0.01 * i for i in range(101)]
    rows = reduced([-one for one in x] + [-2.0], [-50 * one for one in x] + [-1.0], "force", sizes_of(pin))
    check([row[2] for row in rows] == ["MPa", "N/mm", "N mm"], f"{rows}")
    near([row[1] for row in rows], [50 / (math.pi * 4 * 5), 50, 25], "a line in the other direction")
    rows = reduced(x, [20 * one for one in x], "moment", {})
    near([row[1] for row in rows], [20, math.radians(10)], "a line of a torque over degrees")
    check(reduced([], [], "force", {}) == reduced([0, 1], [0, 0], "force", {}) == [], "no load")


TABLE = """# made up
animal;side;surface;peak [N cm];d [mm];mark
1;L;machined;4,5;4;
1;R;etched;6,1;4;
2;L;machined;5,0;4;
2;R;etched;5,8;4;
3;L;machined;3,8;4;
3;R;etched;7,0;4;
4;L;machined;4,2;4;
4;R;etched;;4;
5;L;machined;9,9;4;several peaks: 2
"""


def command(*arguments, code=0):
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
        returned = main_of_package(["groups", *arguments])
    check(returned == code, f"{arguments} ends with {returned}: {out.getvalue()}{errors.getvalue()}")
    return out.getvalue() + errors.getvalue()


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def check_command():
    with open("peaks.csv", "w", encoding="utf-8") as file:
        file.write(TABLE)
    said = command("peaks.csv", "--value", "peak", "--by", "surface", "--animal=animal", "--out=found")
    for words in ("peak, machined: mean 4.375 N cm", "n = 4", "peak, etched minus machined: ", "3 animals are in more than one group",
                  "2 of 9 rows are left out, 1 without a value, 1 marked 'several peaks'"):
        check(words in said, f"'{words}' is not in {said}")
    machined, etched = rows_of("found/groups.csv")
    near(float(etched["mean"]), 6.3, "mean in the table")
    check((machined["values"], machined["animals"], machined["unit"]) == ("4", "4", "N cm"), f"{machined}")
    _, (expected,) = compare_groups([4.5, 6.1, 5, 5.8, 3.8, 7, 4.2], list("mememem"), [1, 1, 2, 2, 3, 3, 4])
    (row,) = rows_of("found/differences.csv")
    near([float(row[name]) for name in ("difference", "lower_95", "ratio_upper_95")],
         [expected[name] for name in ("difference", "lower_95", "ratio_upper_95")], "difference in the table")
    said = command("peaks.csv", "--value", "peak [N cm]", "--by", "surface, side", "--diameter", "d", "--length", "8")
    check(f"etched, R: mean {2 * 63 / (math.pi * 16 * 8):.4g} MPa" in said and "friction under the pressure" in said, f"strengths: {said}")
    check("as T/(A R), machined" in command("peaks.csv", "--value", "peak", "--by", "surface", "--area", "12", "--radius", "2"), "coins")
    try:
        import jinja2  # noqa: F401
    except ImportError:
        return print("no Jinja2: left out")
    with open("found/report.html", encoding="utf-8") as file:
        page = file.read()
    check("etched minus machined: " in page and page.count("<circle") == 7 and page.count("<path d=\"M") >= 2, "the page")


BAD = (
    (("--value", "peek"), "peaks.csv: line 2: --value 'peek': expected one of the columns 'animal, side, surface, peak [N cm], d [mm], mark'"),
    ((), "peaks.csv: line 2: expected --value with one of the columns"),
    (("--value", "surface"), "peaks.csv: line 3, column 'surface': read 'machined': expected a number, or nothing"),
    (("--value", "peak", "--by", "limb"), "--by 'limb': expected one of the columns"),
    (("--value", "peak", "--area", "3"), "expected a force with --diameter"),
    (("--value", "d [mm]", "--diameter", "3", "--length", "4"), "expected a force with --diameter"),
    (("--value", "peak", "--area", "d", "--radius", "2"), "--area 'd [mm]': expected mm2"),
    (("--value", "peak", "--diameter", "-3", "--length", "4"), "--diameter -3: expected a size above 0"),
)


def check_bad():
    for options, expected in BAD:
        said = command("peaks.csv", *(() if "--by" in options else ("--by", "surface")), *options, code=1)
        check(expected in said and said.count("\n") == 1, f"{options}: {said}")
    with open("commas.csv", "w", encoding="utf-8") as file:
        file.write("group,peak [N]\na,1,5\n")
    check("commas.csv: line 2: read 3 items: expected at most 2" in command("commas.csv", "--value", "peak", code=1), "commas of two kinds")
    with open("empty.csv", "w", encoding="utf-8") as file:
        file.write("group,peak\na,nan\n")
    check("peak: no row has a value and a group" in command("empty.csv", "--value", "peak", code=1), "an empty table")
    check("cannot be read" in command("none.csv", "--value", "peak", code=1), "no file")


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    check_against_textbooks()
    check_few()
    check_against_statsmodels()
    check_reductions()
    check_command()
    check_bad()
    check_how_often()
    check_weights()


if __name__ == "__main__":
    main()
