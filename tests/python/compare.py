"""Finished results compared by debond.compare with a measured curve of 11 and 22 N mm at 1 and 2 degrees: a run, a study and an
ensemble made by hand, whose curves are straight lines, so that all numbers follow from their slopes; the definitions of the
measures; and, with the program, the curve of a run against the measures in its summary.json.

    PYTHONPATH=python python3 tests/python/compare.py [DEBOND]
"""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile

import numpy

from _debond import CurveComparison
from debond.__main__ import main
from debond.compare import compare
from debond.errors import InputError

debond = os.path.abspath(sys.argv[1]) if sys.argv[1:] else None
scenes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "prm")
scratch = tempfile.TemporaryDirectory()
os.chdir(scratch.name)

HEAD = ("measured.csv: column 1 'angle [deg]', column 2 'torque [Nm]'; 2 rows, from 1 to 2 deg, torques up to 22 N mm\n")
RUN = HEAD + "run: 6.8 % in the mean, 9.1 % at most, at 2 deg (2 rows; e_mp 9.09 %, e_rel 1.5 %)\n"
RUN_IN_NM = """in_Nm.csv: column 1 'angle_deg', column 2 'torque_Nmm'; 2 rows, from 1 to 2 deg, torques up to 0.022 N mm
run: 68107 % in the mean, 90809 % at most, at 2 deg (2 rows; e_mp 9.08e+04 %, e_rel 15 %)
warning: the largest torque of the reference curve is 0.022 and that of the run 100 N mm: is it in N mm?
"""
STUDY = HEAD + """0 % in the mean, 0 % at most, at 1 deg: variant-002, Bone / Cells = 4, 4, 2; Interface / Seed = 1
6.8 % in the mean, 9.1 % at most, at 2 deg: variant-001, Bone / Cells = 3, 3, 2; Interface / Seed = 1
not compared: nothing has moved in the run: variant-004, Bone / Cells = 6, 6, 2; Interface / Seed = 1
1 of 4 variants have no curve
"""
BAND = "of 2 rows lie between the quantiles of 5 and 95 %\n"
MEANS = (f"6.8 % in the mean, 9.1 % at most, at 2 deg: mean of the ensemble, Bone / Cells = 3, 3, 2; 2 {BAND}"
         f"0 % in the mean, 0 % at most, at 1 deg: mean of the ensemble, Bone / Cells = 4, 4, 2; 0 {BAND}"
         f"6.8 % in the mean, 9.1 % at most, at 2 deg: mean of the ensemble, Bone / Cells = 5, 5, 2; 0 {BAND}")


def write(filename, text):
    os.makedirs(os.path.dirname(filename) or ".", exist_ok=True)
    with open(filename, "w", encoding="utf-8") as file:
        file.write(text)


def line(slope):
    """A torque of `slope` [N mm/deg] up to 10 degrees."""
    return f"angle_deg,torque_Nmm\n0,0\n10,{10 * slope}\n"


def expect(what, expected, got):
    assert got == expected, f"{what}: expected\n{expected}got\n{got}"


def expect_close(what, expected, got, tolerance=1e-12):
    assert numpy.allclose(got, expected, rtol=tolerance, atol=0, equal_nan=True), f"{what}: expected {expected}, got {got}"


def check_files():
    write("measured.csv", "angle [deg];torque [Nm]\n1;0,011\n2;0,022\n")
    write("in_Nm.csv", "angle_deg,torque_Nmm\n1,0.011\n2,0.022\n")
    # a run, whose curve.csv is finer than its torque.csv
    write("run/torque.csv", line(99))
    write("run/curve.csv", line(10))
    expect("run", RUN, compare("run", "measured.csv").text)
    expect("run", RUN_IN_NM, compare("run", "in_Nm.csv").text)
    # a machine of 10 N mm/deg, ahead by as much as the implant turns
    write("soft/torque.csv", "angle_deg,torque_Nmm,machine_angle_deg\n0,0,0\n10,100,20\n")
    write("soft/curve.csv", line(10))
    write("of_machine.csv", "angle [deg];torque [Nm]\n1;0,0055\n2;0,011\n")
    found = compare("soft", "of_machine.csv", over="machine_angle_deg").runs[""]
    expect_close("over the machine's angle", [1 / 11, 0.75 / 100, 2], [found.e_mp, found.e_rel, found.position_of_max])
    expect("over the angle of a rigid one", RUN, compare("run", "measured.csv", over="machine_angle_deg").text)
    write("study/study.csv", 'variant,Bone / Cells,Interface / Seed,T_max_Nmm\n1,"3, 3, 2",1,100\n2,"4, 4, 2",1,110\n'
          '3,"5, 5, 2",1,nan\n4,"6, 6, 2",1,0\n')
    write("study/variant-001/torque.csv", line(10))
    write("study/variant-002/torque.csv", line(11))
    write("study/variant-004/torque.csv", "angle_deg,torque_Nmm\n0,0\n0,0\n")
    found = compare("study", "measured.csv")
    expect("study", STUDY, found.text)
    expect("names of variants", ["variant-002", "variant-001", "variant-004"], list(found.runs))
    expect_close("variant-001", 1 / 11, found.runs["variant-001"].e_mp)
    expect_close("variant-001", 1.5 / 100, found.runs["variant-001"].e_rel)
    expect_close("variant-004", numpy.nan, found.runs["variant-004"].e_mp)
    write("complete/study.csv", "variant,T_max_Nmm\n1,100\n")
    write("complete/variant-001/torque.csv", line(10))
    expect("study of one", HEAD + "6.8 % in the mean, 9.1 % at most, at 2 deg: variant-001, \n",
           compare("complete", "measured.csv").text)
    write("study/ensemble.csv", "Bone / Cells,angle_deg,members,torque_mean_Nmm,torque_sd_Nmm,torque_p05_Nmm,torque_p50_Nmm,"
          "torque_p95_Nmm\n"
          '"3, 3, 2",0,9,0,0,0,0,0\n"3, 3, 2",10,9,100,0,90,100,115\n'
          '"4, 4, 2",0,9,0,0,0,0,0\n"4, 4, 2",10,9,110,0,112,115,200\n'
          '"5, 5, 2",0,9,0,0,0,0,0\n"5, 5, 2",10,9,100,0,90,100,105\n')
    found = compare("study", "measured.csv")
    expect("ensemble", STUDY + MEANS, found.text)
    expect_close("mean of an ensemble", 1.5 / 22, found.means["Bone / Cells = 3, 3, 2"].difference_mean)


def check_measures():
    """Against sums over the rows that count, for a run that turns backwards and rests at its first angle, too."""
    angles = numpy.array([0, 0, 0, 1, 2, 4])
    torques = numpy.array([3, 7, 5, 30, 40, 50])
    measured = numpy.array([[-1, 0, 0.5, 1.5, 2, 3, 4, 5], [9, 9, 20, 0.1, 44, 45, 60, 70]])
    # at 0.5, 1.5, 2, 3 and 4 degrees: the others are not turned to. At 1.5 there is less than a hundredth of 70 N mm: e_mp,
    # and e_mp alone, is without it
    difference, T_measured = numpy.array([2.5, 4, 0, 10, 34.9]), numpy.array([20, 44, 45, 60])
    for direction in (1, -1):
        signs = [[direction], [1]]
        found = CurveComparison(numpy.array([angles, torques]) * signs, measured * signs)
        expect("rows", 5, found.rows_used)
        expect_close("e_mp", numpy.mean(difference[:4] / T_measured), found.e_mp)
        expect_close("e_rel", numpy.mean(difference) / 50, found.e_rel)
        expect_close("differences", [numpy.mean(difference) / 70, 34.9 / 70], [found.difference_mean, found.difference_max])
        expect_close("where", 1.5 * direction, found.position_of_max)
        expect("remarks", [], found.remarks)
    # an angle that stays has the torque before the jump; ends are met but for rounding
    jump = numpy.array([[0.0, 1, 1, 2], [0, 10, 4, 6]])
    found = CurveComparison(jump, numpy.array([[1, 1.5, 2 + 1e-9, 2 + 1e-8], [10, 5, 6, 9]]))
    expect("rows at a jump", (3, 0), (found.rows_used, found.difference_max))


def check_failure():
    """Where a bond has failed there is next to no load, which is a measured value as others are: of curves of any shape the
    largest difference and the means are those of all rows that the run comes to."""
    generator = numpy.random.default_rng(1)
    for seed in range(20):
        x = numpy.linspace(0, 1, 101)
        run = numpy.cumsum(generator.standard_normal(101))
        failed = x > generator.uniform(0.02, 0.9)
        measured = numpy.where(failed, 1e-3 * generator.standard_normal(101), run + 0.1 * generator.standard_normal(101))
        for axes in (("angle_deg", "torque_Nmm"), ("chuck_uz_mm", "chuck_Fz_N")):
            used = slice(1 if axes[0] == "angle_deg" else 0, None)  # nothing has turned at 0
            found, difference = CurveComparison([x, run], [x, measured], *axes), abs(run - measured)[used]
            expect(f"rows of curve {seed} that fails", (len(difference), False),
                   (found.rows_used, any("are compared" in remark for remark in found.remarks)))
            expect_close(f"differences of curve {seed} that fails", [difference.max(), difference.mean(), difference.mean()],
                         [abs(measured).max() * found.difference_max, abs(measured).max() * found.difference_mean,
                          abs(run).max() * found.e_rel])
    # an instrument that records while the coin is pressed: these rows are not said to be beyond the run
    pressed = numpy.array([[0.0] * 90 + [1, 2], [0.0] * 90 + [10, 20]])
    expect("rows at rest", [], CurveComparison([[0, 2], [0, 20]], pressed).remarks)


def check_remarks():
    up = numpy.array([[0.0, 5, 10], [0, 50, 60]])
    one = numpy.array([[2.0, 4], [20, 40]])
    for what, computed, measured, words in (
            ("opposite sign", up, one * [[1], [-1]], "have the opposite sign"),
            ("radians", up, one / [[57.3], [1]], "ends at 0.06981 and the run at 10 deg: is it in deg?"),
            ("N um", up, one * [[1], [1000]], "is 4e+04 and that of the run 60 N mm: is it in N mm?"),
            ("N m", up, one / [[1], [1000]], "is 0.04 and that of the run 60 N mm: is it in N mm?"),
            ("unloading", up, numpy.array([[2.0, 4, 3], [20, 40, 30]]), "turn back: loading and unloading")):
        remarks = CurveComparison(computed, measured).remarks
        assert len(remarks) == 1 and words in remarks[0], f"{what}: expected {words}, got {remarks}"
    noisy = numpy.array([[2.0, 2.999, 2.96, 4], [20, 30, 30, 40]])
    expect("angles with noise", [], CurveComparison(up, noisy).remarks)
    for what, computed, measured, words in (
            ("turns back", numpy.array([[0.0, 2, 1], [0, 1, 2]]), one, "the run turns back"),
            ("rounding errors", numpy.array([[0.0, 1e-10, -1e-10], [0, 1, 2]]), one, "nothing has moved in the run"),
            ("elsewhere", up, one * [[-1], [1]], "the run goes from 0 to 10 deg, and the curve from -2 to -4 deg")):
        found = CurveComparison(computed, measured)
        expect(what, (0, words, "not compared: " + words), (found.rows_used, found.why_none, found.text()))


def check_program():
    """Texts and exit codes of the command line."""
    for arguments, code, expected in (
            (["run", "measured.csv"], 0, RUN),
            (["run", "measured.csv", "--columns", "angle, 2"], 0, RUN),
            (["--columns", "1 [deg], 2 [Nm]", "run", "measured.csv"], 0,
             RUN.replace("deg]'", "deg]' as [deg]").replace("Nm]'", "Nm]' as [Nm]")),
            (["run", "measured.csv", "--columns", "1"], 1, "--columns = '1': expected 2 columns, separated by commas\n"),
            (["nothing", "measured.csv"], 1,
             "debond: --compare nothing: there are no results in this directory, neither torque.csv nor reactions.csv nor study.csv\n"),
            (["run", "missing.csv"], 1, "--compare = 'missing.csv': this file cannot be read: No such file or directory\n"),
            (["run", "measured.csv", "--over", "radius"], 1, "debond: --over radius: expected angle_deg or machine_angle_deg\n"),
            ([], 1, ""), (["run"], 1, ""), (["run", "measured.csv", "--force"], 1, ""),
            (["run", "measured.csv", "--columns"], 1, "")):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            got = main(["compare", *arguments])
        expect(f"exit code of {arguments}", code, got)
        if expected:
            expect(str(arguments), expected, err.getvalue() if code else out.getvalue())
        else:
            is_right = out.getvalue() == "" and "expected DIR CURVE [--columns LIST]" in err.getvalue()
            assert is_right, f"{arguments}: {out.getvalue()}{err.getvalue()}"
    try:
        compare("run", "measured.csv", ["1", "2 [deg]"])
        raise AssertionError("a wrong unit has been read")
    except InputError as error:
        expect("entry", ("--columns", "1, 2 [deg]"), (error.entry, error.value))


def check_pull():
    """A curve that is pressed to -1 mm, pulled up to 2 mm by 10 N/mm and let go, and measured as 11 and 22 N at 1 and 2 mm: the
    differences are 1 and 2 N of 22 N. Its names are in summary.json."""
    write("pull/reactions.csv", "chuck_uz_mm,chuck_Fz_N\n0,0\n-1,-99\n-1,-10\n2,20\n0,0\n")
    write("pull/summary.json", '{"curve": {"over": "chuck_uz_mm", "load": "chuck_Fz_N"}}')
    write("pulled.csv", "way [mm],pull [N]\n1,11\n2,22\n")
    found = compare("pull", "pulled.csv")
    expect("pull", "pulled.csv: column 1 'way [mm]', column 2 'pull [N]'; 2 rows, from 1 to 2 mm, forces up to 22 N\n"
           "pull: 6.8 % in the mean, 9.1 % at most, at 2 mm (2 rows; e_mp 9.09 %, e_rel 7.5 %)\n", found.text)


def check_units():
    """A unit that is another one than the file says is asked for; not so a test that ends early, or twice the torque."""
    turns = numpy.linspace(0, 10, 41)
    write("unit/torque.csv", "angle_deg,torque_Nmm\n" + "".join(f"{turn},{10 * turn}\n" for turn in turns))
    for end, factor, unit, asks in ((10, 1, "N mm", 0), (10, 0.5, "N mm", 0), (1, 1, "N mm", 0), (10, 1, "N cm", 1), (10, 1e-3, "N cm", 1),
                                    (1, 0.1, "N mm", 1), (10, 1e-3, "lbf in", 1), (10, 1, "N m", 1)):
        write("unit.csv", f"angle [deg],torque [{unit}]\n" + "".join(f"{turn},{10 * turn * factor}\n" for turn in turns if turn <= end))
        text = compare("unit", "unit.csv").text
        expect(f"{factor} {unit} up to {end} degrees: {text}", asks, text.count("is its unit right?") + text.count("is it in N mm?"))


def check_run():
    """The program computes the same measures of the same curves."""
    curve = os.path.join(scenes, "paper", "data", "closed_form_b_data_set_1.csv")
    subprocess.run([debond, os.path.join(scenes, "coin_mode3_fast.prm"), "--set", "Output/Directory=" + os.path.abspath("coin"),
                    "--set", "Output/Reference curve=" + curve, "--set", "Output/Fields every=none"],
                   check=True, stdout=subprocess.DEVNULL, cwd=os.path.join(scenes, ".."))  # where included scenes are found
    with open("coin/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    found = compare("coin", curve).runs[""]
    for name, value in (("e_mp", found.e_mp), ("e_rel", found.e_rel), ("difference_max", found.difference_max),
                        ("difference_mean", found.difference_mean), ("reference_rows_used", found.rows_used),
                        ("difference_max_deg", found.position_of_max)):
        # the curve has twelve digits in its file
        expect_close(name, summary[name], value, 1e-9)


check_files()
check_measures()
check_failure()
check_remarks()
check_program()
check_pull()
check_units()
if debond:
    check_run()
print("curves are compared as they should be")
sys.exit(0)
