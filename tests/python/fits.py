"""Fits of made-up curves whose parameters are known: curves without noise give them back; 95 % intervals hold the true values as
often as they say, with white noise and with noise that hangs together; what curves cannot tell is named, and which test would;
curves of another model are said not to fit.

    fits.py [N]: N seeds for each kind of noise, 4 if it is not given; nightly there are 100
"""

import importlib
import os
import sys
import tempfile
import time
import warnings
from types import SimpleNamespace

import numpy
from scipy import signal, stats

import debond
from debond import intervals, noise, numerics
from debond.calibrate import why_it_does_not_fit
from debond.errors import RunError
from debond.experiment import Experiment

fits = importlib.import_module("debond.fit")  # the module, not the function
warnings.simplefilter("error")
SCENE = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
set Model = foundation
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 200
end
"""
I = "Interface/"
TRUTH = {I + "Friction coefficient unbroken": 0.58, I + "Characteristic slip distance": 0.022, I + "Transition factor": 0.74,
         I + "Normal stiffness": 585, I + "Tangential stiffness": 700}
FIVE = {I + "Friction coefficient unbroken": "<<mu_ub: 0.5 in 0.3..1.2>>", I + "Characteristic slip distance": "<<a_s: 0.01 in 0.004..0.1 log>>",
        I + "Transition factor": "<<b_s: 0.5 in 0.1..3>>", I + "Normal stiffness": "<<eps_n: 400 in 100..3000 log>>",
        I + "Tangential stiffness": "<<eps_t: 400 in 100..3000 log>>"}
TWO = {I + "Friction coefficient unbroken": "<<mu_ub: 0.5 in 0.3..1.2>>", I + "Characteristic slip distance": "<<a_s: 0.01 in 0.004..0.1 log>>",
       I + "Tangential stiffness": 700}
EXPERT = ("Noise columns", "Largest misfit", "Smallest share of rows", "Starts", "Measure", "Torque drift", "Force drift")  # of Calibration
failures = []
n_seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 4


def report(name, is_so, why=""):
    print(f"{name}: {'yes' if is_so else f'NO {why}'}", flush=True)
    if not is_so:
        failures.append(name)


def write(filename, columns):
    numpy.savetxt(filename, numpy.column_stack(list(columns.values())), "%.17g", ",", header=",".join(columns), comments="")


def measured(filename, entries=TRUTH, angle_offset=0.0, torque_offset=0.0, factor=1.0, more=0.0):
    """Writes what the scene with these entries predicts, seen through a rig, and returns it."""
    rows = debond.Scene(None, entries, text=SCENE).run().rows
    turned = rows["angle_deg"] > 0
    columns = {"angle_deg": rows["angle_deg"][turned] + angle_offset, "torque_Nmm": rows["torque_Nmm"][turned] * factor + torque_offset + more,
               "chuck_Fz_N": rows["chuck_Fz_N"][turned]}
    write(filename, columns)
    return columns


def name_of(entry, slash="/"):
    """The full name of an entry of Calibration."""
    return slash.join(["Expert"] * (entry in EXPERT) + ["Calibration", entry])


def scene_of(entries, filename, **more):
    calibration = {name_of(name): value for name, value in more.items()}
    return debond.Scene(None, {**entries, **calibration, "Output/Reference curve": filename}, text=SCENE)


def fit(entries, filename, **more):
    return debond.fit(scene_of(entries, filename, **more))


def best(entries, filename, **more):
    """Names and values of the best fit. Its intervals are looked at elsewhere, and made nightly."""
    if n_seeds >= 100:
        return fit(entries, filename, **more)
    problem = fits.problem_of(scene_of(entries, filename, **more))
    return SimpleNamespace(names=[unknown.name for unknown in problem.unknowns.list], values=fits.find_optima(problem)[0][0].values)


def check_values(name, found, expected):
    worst = max(abs(found.values[found.names.index(unknown)] - value) / max(1e-3, abs(value)) for unknown, value in expected.items())
    report(f"{name}: parameters of a curve without noise to 1e-4", worst < 1e-4, worst)


def check_noise_that_is_all_but_explained():
    """What derivatives explain of residuals is no noise, however little else there is, as where curves are exact."""
    generator = numpy.random.default_rng(1)
    derivatives, rest = generator.standard_normal((200, 5)), generator.standard_normal(200)
    explained = derivatives @ [1.0, -2.0, 0.5, 3.0, 1.5]
    for size in (1e-3, 1e-6, 1e-8, 1e-9, 1e-11):
        sd = noise.estimate(explained + size * rest, derivatives, [slice(0, 200)]).sd
        report(f"noise of {size:g} beside what is explained", abs(sd / size / rest.std(ddof=5) - 1) < 0.05, sd)


def check_exact_curves():
    five = {"mu_ub": 0.58, "a_s": 0.022, "b_s": 0.74, "eps_n": 585, "eps_t": 700}
    measured("clean.csv")
    check_values("five unknowns", best(FIVE, "clean.csv", Curves="torque_Nmm, chuck_Fz_N"), five)
    measured("rig.csv", angle_offset=0.2, torque_offset=1.5, more=numpy.linspace(0, 0.8, 200))
    tied = {I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>", I + "Friction coefficient unbroken": "<<1.45 * mu_b>>",
            I + "Characteristic slip distance": "<<a_s: 0.01 in 0.004..0.1 log>>", I + "Tangential stiffness": 700}
    rig = {"Angle offset": "<<angle: 0 in -1..1>>", "Torque offset": "<<torque: 0 in -5..5>>", "Torque drift": "<<drift: 0 in -5..5>>"}
    check_values("rig and tie", best(tied, "rig.csv", **rig), {"mu_b": 0.4, "a_s": 0.022, "angle": 0.2, "torque": 1.5, "drift": 0.8})
    measured("double.csv", {**TRUTH, "Chuck/Press/Value": "0.0098 * min(t, 1)"}, angle_offset=-0.1)
    two = {I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>", I + "Characteristic slip distance": "<<a_s: 0.01 in 0.004..0.1 log>>",
           I + "Tangential stiffness": 700, "Chuck/Press/Value": "{{0.0049||0.0098}} * min(t, 1)"}
    found = best(two, "{{clean.csv||double.csv}}", **{"Angle offset": "{{<<0 in -1..1>>||<<0 in -1..1>>}}"})
    check_values("two experiments, which share the friction and not the offset", found,
                 {"mu_b": 0.4, "a_s": 0.022, "Calibration / Angle offset (experiment 1)": 0, "Calibration / Angle offset (experiment 2)": -0.1})


def check_uneven_noise():
    clean = measured("clean.csv")
    odd = numpy.arange(200) % 2 == 1
    write("uneven.csv", {"angle_deg": clean["angle_deg"], "torque_Nmm": clean["torque_Nmm"] * numpy.where(odd, 1.5, 1),
                         "sd_Nmm": numpy.where(odd, 1e6, 0.01)})
    entries = {**TWO, "Output/Reference columns": "angle_deg, torque_Nmm"}
    check_values("every other row is wrong, and said to be uncertain", best(entries, "uneven.csv", **{"Noise columns": "sd_Nmm"}),
                 {"mu_ub": 0.58, "a_s": 0.022})
    for measure in ("e_mp", "e_rel", "least squares"):
        measured("outliers.csv", factor=numpy.where(numpy.arange(200) % 20 == 10, 1.2, 1))
        is_met = abs(best(TWO, "outliers.csv", Measure=measure).values[0] - 0.58) < 1e-3
        report(f"{measure} is {'' if measure == 'least squares' else 'not '}led astray by a few wrong rows",
               is_met == (measure != "least squares"))


def check_signs():
    """A test the other way round has the same slack; a file whose signs are turned has the offsets that stand in it."""
    unknowns = {**TWO, "Calibration/Slack": "<<slack: 0.3 in 0..2>>"}
    for direction in (1, -1):
        turned = SCENE.replace("10 * max", f"{10 * direction} * max")
        rows = debond.Scene(None, TRUTH, text=turned).run().rows
        used = rows["angle_deg"] != 0
        angle, torque = rows["angle_deg"][used], rows["torque_Nmm"][used]
        write("slack.csv", {"angle_deg": angle + direction * 0.7, "torque_Nmm": torque})
        problem = fits.problem_of(debond.Scene(None, {**unknowns, "Output/Reference curve": "slack.csv"}, text=turned))
        found = SimpleNamespace(names=problem.unknowns.names, values=fits.find_optima(problem)[0][0].values)
        check_values(f"slack, direction {direction}", found, {"mu_ub": 0.58, "a_s": 0.022, "slack": 0.7})
    share = numpy.arange(used.sum()) / (used.sum() - 1)
    write("minus.csv", {"phi": angle + 0.2, "M": torque + 1.5 + 0.8 * share})  # of the test that goes the other way
    rig = {"Angle offset": "<<angle: 0 in -1..1>>", "Torque offset": "<<torque: 0 in -5..5>>", "Torque drift": "<<drift: 0 in -5..5>>"}
    check_values("a minus before units: offsets are those of the file", best({**TWO, "Output/Reference columns": "1 [-deg], 2 [-N mm]"}, "minus.csv", **rig),
                 {"mu_ub": 0.58, "a_s": 0.022, "angle": 0.2, "torque": 1.5, "drift": 0.8})


PULL = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Bone
  set Material = rigid
  set Cells    = 4, 4, 1
end
subsection Implant
  set Material = rigid
  set Cells    = 2, 1
end
subsection Interface
  set Law = adhesive
  subsection Adhesive
    set Strength        = 3
    set Gap at strength = 0.02
  end
end
subsection Chuck
  subsection Translation z
    set Value = 0.1 * t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 60
end
"""


def fit_of_pull(entries={I + "Adhesive/Strength": "<<t0: 4 in 0.5..20>>"}, **more):
    return debond.fit(debond.Scene(None, {**entries, "Output/Reference curve": "pull.csv", "Output/Reference columns": "1 [mm], 2 [N]",
                                          "Expert/Calibration/Starts": 1, **more}, text=PULL))


def check_pulls():
    """A machine whose spring is in the scene and one whose compliance is in the fit are the same; and what instruments of
    displacement and force add is found, in either direction of the file."""
    law = I + "Adhesive/"
    two = {law + "Strength": "<<t0: 4 in 0.5..20>>", law + "Gap at strength": "<<g0: 0.03 in 0.001..0.2 log>>"}
    truth = {"t0": 3, "g0": 0.02}

    def found(entries, over="auto", columns="auto"):
        problem = fits.problem_of(debond.Scene(None, {**two, **entries, "Calibration/Over": over, "Output/Reference curve": "pull.csv",
                                                      "Output/Reference columns": columns, "Expert/Calibration/Starts": 4}, text=PULL))
        return SimpleNamespace(names=problem.unknowns.names, values=fits.find_optima(problem)[0][0].values)

    spring = {"Chuck/Translation z/Stiffness": 5e4}
    fine = {"Load steps/Steps": 1000}  # rows are joined by straight lines, which a spring moves
    rows = debond.Scene(None, {**spring, **fine}, text=PULL).run().rows
    write("pull.csv", {"machine_uz_mm": rows["machine_uz_mm"], "chuck_Fz_N": rows["chuck_Fz_N"]})
    check_values("pull over the machine's displacement, its spring in the scene", found({**spring, **fine}, "machine_uz_mm"), truth)
    check_values("the same, its spring in the fit", found({**fine, "Calibration/Displacement compliance": 1 / 5e4}, columns="1 [mm], 2 [N]"), truth)
    rows = debond.Scene(text=PULL).run().rows
    u, F, share = rows["chuck_uz_mm"], rows["chuck_Fz_N"], numpy.arange(61) / 60
    rig = {"Displacement offset": ("<<u_0: 0 in -0.02..0.02>>", -0.004), "Displacement slack": ("<<slack: 0.001 in 0..0.02>>", 0.003),
           "Displacement compliance": ("<<c: 1e-5 in 0..1e-4>>", 3e-5), "Force offset": ("<<F_0: 0 in -9..9>>", 2.5),
           "Force drift": ("<<drift: 0 in -9..9>>", -1.5)}
    for name, (text, value) in rig.items():
        for sign in (1, -1):
            turns = sign if "offset" in name or "drift" in name else 1  # what is seen of a machine that counts the other way
            more, part = {"Force offset": (0, turns * value), "Force drift": (0, turns * value * share)}.get(name, (turns * value, 0))
            write("pull.csv", {"u": sign * (u + (more * F if "compliance" in name else more)), "F": sign * (F + part)})
            check_values(f"{name} of a pull, sign {sign}", found({name_of(name): text}, columns=f"1 [{'-' * (sign < 0)}mm], 2 [{'-' * (sign < 0)}N]"),
                         {**truth, text[2:text.index(":")]: value})


def check_used_rows():
    """Fits say how many rows they use, and refuse to go on with few of them; what is too large is asked for its unit."""
    clean = measured("clean.csv")
    write("rad.csv", {"phi [rad]": clean["angle_deg"], "M [N mm]": clean["torque_Nmm"]})
    try:
        fits.problem_of(scene_of(TWO, "rad.csv"))
        report("degrees that the file calls radians are refused", False)
    except debond.SceneError as error:
        report("degrees that the file calls radians are refused", "only 3 of its 200 rows" in str(error) and "in the unit" in str(error), error)
    few = fits.problem_of(scene_of(TWO, "rad.csv", **{"Smallest share of rows": 0.01})).done[0].measured
    report("unless they are told to", few.counts == {"rows": 200, "used": 3, "outside_windows": 0, "at_rest_or_turns": 0, "beyond_scene": 197},
           few.counts)
    windows = fits.problem_of(scene_of(TWO, "clean.csv", Windows="0, 1.01")).done[0].measured
    report("rows outside of windows are none that are missing", windows.counts["outside_windows"] == 180 and windows.counts["used"] == 20,
           windows.counts)
    write("deg.csv", {"phi [deg]": clean["angle_deg"] / 57.3, "M [N mm]": clean["torque_Nmm"]})
    problem = fits.problem_of(scene_of(TWO, "deg.csv"))
    report("radians that the file calls degrees are asked for", any("is it in deg?" in text for text in problem.done[0].remarks))
    # what counts the other way; angles alone, where the torque is that of the scene
    for torques, choice in ((-1, "1 [-deg], 2 [-N cm]"), (1, "1 [-deg], 2 [N cm]")):
        write("other_way.csv", {"phi [deg]": -clean["angle_deg"], "M [N cm]": torques * clean["torque_Nmm"] / 10})
        try:
            fits.problem_of(scene_of(TWO, "other_way.csv"))
            said = ""
        except debond.SceneError as error:
            said = str(error)
        report(f"the other sign is said, {choice}", said.endswith(f"'set Reference columns = {choice}'") and "have the opposite sign" in said, said)
        again = fits.problem_of(debond.Scene(scene_of(TWO, "other_way.csv"), {"Output/Reference columns": choice}))
        report("and that choice reads the scene's curve", numpy.allclose(again.measured, clean["torque_Nmm"], 1e-12, 1e-12), again.measured)
    write("back.csv", {**clean, "angle_deg": numpy.minimum(clean["angle_deg"], 12 - clean["angle_deg"])})
    try:
        fits.problem_of(scene_of(TWO, "back.csv"))
        report("a curve that turns back, of a scene that does not, is refused before it is searched", False)
    except debond.SceneError as error:
        report("a curve that turns back, of a scene that does not, is refused before it is searched",
               "turns back 1 times, the scene 0 times" in str(error), error)
    turns = {"Chuck/Rotation z/Value": "10 * max(t - 1, 0) - 20 * max(t - 1.6, 0)", "Load steps/Steps": "1, 20"}
    report("of one that does it is not", fits.problem_of(debond.Scene(scene_of(TWO, "back.csv"), turns)).done[0].measured.branch.max() == 1)
    write("Nm.csv", {"phi [deg]": clean["angle_deg"], "M [N m]": clean["torque_Nmm"] / 10})  # N cm
    why = why_it_does_not_fit(fit(TWO, "Nm.csv"))
    report("N cm that the file calls N m are asked for", "N mm in the file" in why and "is its unit right?" in why, why)


def check_held_load():
    """A load that the scene holds may bring it less far than the test came: rows beyond are said."""
    held = PULL.replace("set Value = 0.1 * t", "set Control = force\n    set Value   = 20 * t")
    rows = debond.Scene(text=held).run().rows
    write("pull.csv", {"u": rows["chuck_uz_mm"], "F": rows["chuck_Fz_N"]})
    for load, n in ((20, 0), (10.1, 30)):
        found = debond.fit(debond.Scene(None, {I + "Adhesive/Gap at strength": "<<g0: 0.03 in 0.001..0.2 log>>", "Expert/Calibration/Starts": 1,
                                               "Chuck/Translation z/Value": f"{load} * t", "Output/Reference curve": "pull.csv",
                                               "Output/Reference columns": "1 [mm], 2 [N]"}, text=held))
        said = [text for text in found.warnings if "the load of the scene is reached" in text]
        report(f"rows beyond a load of {load} N are said", len(said) == (n > 0) and all(text.startswith(f"{n} of 61 rows") for text in said), found.warnings)


def check_failure():
    """A test in which the bond fails, of a scene in which it does not, fits by no measure: what is left of the load is data."""
    def tail(torque):
        return numpy.where(numpy.arange(len(torque)) > 60, 1e-3, 1) * torque

    clean = measured("clean.csv")
    write("failed.csv", {**clean, "torque_Nmm": tail(clean["torque_Nmm"])})
    for measure in ("e_mp", "e_rel", "least squares"):
        found = fit(TWO, "failed.csv", Measure=measure, Starts=1)
        curve = found.curves[0]
        e_rel = numpy.mean(abs(curve["torque_Nmm_fitted"] - curve["torque_Nmm_measured"])) / abs(curve["torque_Nmm_fitted"]).max()
        report(f"{measure}: e_rel of a fit is that of all rows", abs(found.e_rel / e_rel - 1) < 1e-9, (found.e_rel, e_rel))
        report(f"{measure}: a bond that fails in the test alone is not fitted", "no parameters of this scene fit" in why_it_does_not_fit(found))
        report(f"{measure}: intervals hold the best values", (found.lower <= found.values).all() and (found.values <= found.upper).all(),
               (found.lower, found.values, found.upper))


def check_edges():
    """Derivatives at the edge of what can be computed; fits by finite elements go on where the closed form says no."""
    measured("clean.csv")
    entries = {**TWO, I + "Characteristic slip distance": "<<a_s: 0.03 in 0.0001..0.1 log>>"}
    problem = fits.problem_of(scene_of(entries, "clean.csv"))
    lower, upper = 1e-4, 0.1  # the law softens too fast below some distance: there is no curve
    while upper / lower > 1 + 1e-9:
        middle = numpy.sqrt(lower * upper)
        lower, upper = (middle, upper) if problem.curves([numpy.array([0.58, middle])], True)[0] is None else (lower, middle)
    at, inside = (problem.derivatives(numpy.array([0.58, upper * factor]), True) for factor in (1, 1.001))
    report("derivatives at an edge are those beside it, to 1 %", (abs(at - inside) < 0.01 * abs(inside).max(axis=0)).all() and lower > 1e-4, lower)

    def says_no(experiment, values, by_closed_form=Experiment.by_closed_form):
        is_settled = experiment._centre is not None and (experiment._centre[0] != experiment.unknowns.starts).any()
        if values[1] < (least_settled if is_settled else least):
            raise RunError("no closed form")
        return by_closed_form(experiment, values)

    Experiment.by_closed_form, before, found = says_no, Experiment.by_closed_form, []
    least, least_settled = 0, 0.0222  # the edge moves over the best values once the stiffness is that of these
    moved = fit(entries, "clean.csv", Starts=4).values
    report("of an edge that moves the search comes back to it, to 1 %", abs(moved[1] / 0.0222 - 1) < 0.01, moved)
    for least in (0, 0.025, 1):  # nowhere, at the best values, everywhere
        least_settled = least
        found.append(fit({**entries, "Model": "finite elements"}, "clean.csv", Starts=4))
    Experiment.by_closed_form = before
    for one, where in zip(found[1:], ("at the best values", "everywhere")):
        report(f"finite elements find the same where there is no closed form {where}, to 1e-3", numpy.allclose(one.values, found[0].values, 1e-3)
               and one.problem.runs.n_failures > 0, (one.values, found[0].values))


def correlated(generator, n, rho):
    white = generator.standard_normal(n)
    white[1:] *= numpy.sqrt(1 - rho**2)
    return signal.lfilter([1], [1, -rho], white)


def check_noise():
    """Of the noise itself: against the whole covariance matrix, and against curves that were drawn."""
    n, parts = 60, [slice(0, 25), slice(25, 60)]
    spectra = numpy.exp(numpy.random.default_rng(2).standard_normal((1, n)))
    own = noise.Noise(parts, spectra / spectra.mean(), numpy.ones(1), numpy.array([2.0]), 50, False)
    covariance = numpy.zeros((n, n))
    for part in parts:
        m = part.stop - part.start
        waves = numpy.cos(numpy.pi * (numpy.arange(m)[:, None] + 0.5) * numpy.arange(m) / m) * numpy.sqrt(2 / m)
        waves[:, 0] = numpy.sqrt(1 / m)
        covariance[part, part] = waves @ (own.spectrum[part, None] * waves.T)
    rows = numpy.random.default_rng(1).standard_normal((n, 3))
    white, log = own.whitened(rows)
    report("whitened rows are those of the covariance", numpy.allclose(white.T @ white, rows.T @ numpy.linalg.solve(covariance, rows)))
    report("its determinant", abs(log - numpy.linalg.slogdet(covariance)[1]) < 1e-9)
    report("its product", numpy.allclose(own.covariance_times(rows), covariance @ rows))
    spread = numpy.cov(numpy.array([own.draw(numpy.random.default_rng(seed)) for seed in range(4000)]).T)
    report("noise that is drawn has this covariance", abs(spread - covariance).max() < 0.12 * covariance.max())
    sd = numpy.sqrt(rows[:, 0] @ covariance @ rows[:, 0])
    report("half width: Student's quantile times the standard deviation", abs(own.half_width(rows[:, 0], 0.95) / sd / stats.t.ppf(0.975, 50) - 1) < 1e-5)
    # of two kinds, one of ten times the standard deviation: a quarter of all draws, of which 90 % lie within
    two = noise.Noise([slice(0, n)], numpy.ones((2, n)), numpy.array([0.75, 0.25]), numpy.array([1.0, 100.0]), 1e6, False)
    drawn = numpy.quantile(abs(two.mixed_draws(numpy.random.default_rng(1), 20000)[:, 0]), 0.95)
    report("that of noise that is drawn of both, to 4 %", abs(drawn / two.half_width(numpy.eye(n)[0], 0.95) - 1) < 0.04, drawn)
    report("half width of two kinds", abs(two.half_width(numpy.eye(n)[0], 0.95) / (10 * stats.norm.isf(0.1)) - 1) < 1e-4)
    # five smooth columns take some of the noise with them, which REML knows
    place = numpy.linspace(0, 1, 500)
    columns = numpy.cos(numpy.pi * place[:, None] * numpy.arange(5))
    found = []
    for seed in range(60):
        drawn = correlated(numpy.random.default_rng(seed), 500, 0.9)
        residuals = drawn - columns @ numpy.linalg.lstsq(columns, drawn, rcond=None)[0]
        found.append(noise.estimate(residuals, columns, [slice(0, 500)]).correlation)
    # rather more than less: noise that hangs together longer has some weight, too
    report("correlation of noise, 0.9, from what a fit has left: 0.89 to 0.92", 0.89 < numpy.mean(found) < 0.92, numpy.mean(found))
    # rows whose neighbours err alike are worth no more than those of AR(1), which the page has
    worst = -numpy.inf
    for seed in range(60):
        generator = numpy.random.default_rng(seed)
        drawn = signal.lfilter([1], [1, *generator.uniform(-1, 0.2, 2) * 0.6], generator.standard_normal(300)) + generator.uniform(0, 2) * numpy.sin(
            generator.uniform(0.05, 0.5) * numpy.arange(300))
        one = noise.estimate(drawn, columns[:300], [slice(0, 300)])
        most = max(2, 300 * (1 - one.correlation) / (1 + one.correlation))
        worst = max(worst, 300 / one.rows_per_value / most)
    report("effective rows are at most n (1 - phi) / (1 + phi), to 2 %, or two", worst < 1.02, worst)


def check_intervals():
    """1 % of the largest torque; both kinds of noise."""
    truth, least = [0.58, 0.022, 0.74, 585, 700], 0.95 - 3.3 * numpy.sqrt(0.95 * 0.05 / n_seeds)
    rows = debond.Scene(None, {**TRUTH, "Load steps/Steps": "1, 2000"}, text=SCENE).run().rows
    turned = rows["angle_deg"] > 0
    angle, torque, force = (rows[name][turned] for name in ("angle_deg", "torque_Nmm", "chuck_Fz_N"))
    for rho in (0.0, 0.95):
        held, flags, in_band = numpy.zeros(5), 0, 0
        for seed in range(n_seeds):
            generator = numpy.random.default_rng(seed)
            write("noise.csv", {"angle_deg": angle, "torque_Nmm": torque + 0.01 * torque.max() * correlated(generator, 2000, rho),
                                "chuck_Fz_N": force * (1 + 0.01 * correlated(generator, 2000, rho))})
            found = fit(FIVE, "noise.csv", Curves="torque_Nmm, chuck_Fz_N", Starts=1)
            order = [found.names.index(name) for name in ("mu_ub", "a_s", "b_s", "eps_n", "eps_t")]
            held += (found.lower[order] <= truth) & (truth <= found.upper[order])
            flags += any(misfit.does_not_fit for misfit in found.misfits)
            curve = found.curves[0]
            in_band += curve["torque_Nmm_lower_95"][300] <= torque[300] <= curve["torque_Nmm_upper_95"][300]
        for name, share in zip(("mu_ub", "a_s", "b_s", "eps_n", "eps_t", "the band of the curve"), [*held / n_seeds, in_band / n_seeds]):
            report(f"correlation {rho}: {name} is held by its interval as often as chance allows", share >= least, share)
        report(f"correlation {rho}: a model that is right is hardly ever said not to fit", flags <= 0.01 * n_seeds, flags)


class LinearStandIn:
    """The problem of three unknowns and some rows, whose curve is the tangent at the true values: found in milliseconds."""

    TRUTH = {"mu_b": 0.4, "mu_ub": 0.58, "a_s": 0.022, "offset": 0.0}
    ENTRIES = {**TWO, I + "Friction coefficient broken": "<<mu_b: 0.4 in 0.1..0.8>>"}

    def __init__(self, n=500, **more):
        rows = debond.Scene(None, {**TRUTH, "Load steps/Steps": f"1, {n}"}, text=SCENE).run().rows
        torque = rows["torque_Nmm"][rows["angle_deg"] > 0]
        write("coverage.csv", {"angle_deg": rows["angle_deg"][rows["angle_deg"] > 0], "torque_Nmm": torque})
        self.problem = problem = fits.problem_of(scene_of(self.ENTRIES, "coverage.csv", **more))
        self.names, self.scale = problem.unknowns.names, 0.01 * torque.max()
        self.values = numpy.array([self.TRUTH[name] for name in self.names])
        problem.settle(self.values)
        self.right, slopes = problem.curves([self.values], True)[0], problem.derivatives(self.values, True)
        self.at, self.J = problem.unknowns.to_search(self.values), problem.weights[:, None] * slopes
        problem.derivatives = lambda values, closed, free=None, share=0: slopes if free is None else slopes[:, free]
        problem.curves = lambda places, closed: [self.right + slopes @ (problem.unknowns.to_search(one) - self.at) for one in places]

    def shares(self, draw, n_draws):
        """How often intervals hold the truth, of each unknown."""
        held = numpy.zeros(len(self.values))
        for seed in range(n_draws):
            self.problem.measured = self.right + self.scale * draw(numpy.random.default_rng(seed))
            told = intervals.tell(self.problem, self.problem.minimise(self.values, True), self.J)
            held += (told.lower <= self.at) & (self.at <= told.upper)
        return dict(zip(self.names, held / n_draws))


def check_coverage():
    """How often intervals hold the truth: white noise, AR(1) of 0.8, and a drift that hangs together over the whole test, in a fit
    with the offset that a drift makes; by a linear stand-in for the curve, and nightly by 2000 fits with the closed form."""
    nightly, n = n_seeds >= 100, 500
    kinds = {"white noise": lambda generator: generator.standard_normal(n), "AR(0.8)": lambda generator: correlated(generator, n, 0.8),
             "drift": lambda generator: generator.standard_normal(n) + 2 * correlated(generator, n, 1 - 1 / n)}
    for measure in ("least squares", "e_rel", "e_mp"):
        squares = measure == "least squares"
        # 160 draws have an upper limit, too: all are held by one in 3000
        n_draws = (2000 if squares else 600) if nightly else (160 if squares else 50)
        for kind, draw in kinds.items():
            if kind == "drift" and not (squares or nightly):
                continue
            more = {"Torque offset": "<<offset: 0 in -20..20>>"} if kind == "drift" else {}
            least, most = numpy.array(stats.binom.interval(0.999, n_draws, 0.95)) / n_draws if n_draws < 2000 else (0.93, 0.97)
            for name, share in LinearStandIn(Measure=measure, **more).shares(draw, n_draws).items():
                report(f"{measure}, {kind}: 95 % intervals of {name} hold the truth in {100 * least:.3g} to {100 * most:.3g} % of {n_draws} draws",
                       least <= share <= most, share)
    if not nightly:
        return
    # what the page says of other noise; a weak drift that the fit knows nothing of moves the plateau, and no residual shows it
    for kind, draw, rows, names, least, most in (
            ("a drift of 0.3 of the noise, no offset in the fit", lambda g: g.standard_normal(n) + 0.3 * correlated(g, n, 1 - 1 / n), n, ["mu_b"], 0.4, 0.6),
            ("AR(0.3), 60 rows", lambda g: correlated(g, 60, 0.3), 60, ["mu_ub", "a_s", "mu_b"], 0.87, 0.96),
            ("AR(0.95)", lambda g: correlated(g, n, 0.95), n, ["mu_ub", "a_s", "mu_b"], 0.95, 1),
            ("AR(0.98)", lambda g: correlated(g, n, 0.98), n, ["mu_ub", "a_s", "mu_b"], 0.96, 1)):
        shares = LinearStandIn(rows).shares(draw, 600)
        report(f"{kind}: intervals of {', '.join(names)} hold the truth in {100 * least:.3g} to {100 * most:.3g} % of 600 draws",
               all(least <= shares[name] <= most for name in names), shares)
    for kind, draw in kinds.items():
        one = LinearStandIn(**({"Torque offset": "<<offset: 0 in -20..20>>"} if kind == "drift" else {}))
        del one.problem.curves, one.problem.derivatives  # the curve itself
        held = numpy.zeros(len(one.values))
        for seed in range(2000):
            one.problem.measured = one.right + one.scale * draw(numpy.random.default_rng(seed))
            found = fits.Fit(one.problem, [one.problem.minimise(one.values, True)], True, 0)
            held += (found.lower <= one.values) & (one.values <= found.upper)
        for name, share in zip(one.names, held / 2000):
            report(f"{kind}: 95 % intervals of {name} hold the truth in 93 to 97 % of 2000 fits", 0.93 <= share <= 0.97, share)


def check_magnitudes():
    """The least sum of magnitudes of noise that is white and normal has pi/2 times the variance of least squares, with many rows."""
    stand_in, generator = LinearStandIn(Measure="e_rel"), numpy.random.default_rng(1)
    stand_in.problem.measured = stand_in.right + 3 * stand_in.scale * generator.standard_normal(500)
    widths = {}
    for measure in ("least squares", "e_rel"):
        stand_in.problem.measure = measure
        widths[measure] = intervals.tell(stand_in.problem, stand_in.problem.minimise(stand_in.values, True), stand_in.J).half_widths
    ratio = widths["e_rel"] / widths["least squares"]
    report("intervals of e_rel are sqrt(pi/2) times as wide, to 12 %", (abs(ratio / numpy.sqrt(numpy.pi / 2) - 1) < 0.12).all(), ratio)


def check_words():
    generator = numpy.random.default_rng(1)
    measured("noise.csv", more=0.02 * 53 * generator.standard_normal(200))
    right = fit(TWO, "noise.csv", Noise=0.02)
    report("no warning of a right fit", right.warnings == [], right.warnings)

    def says(found, words):
        return any(words in text for text in found.warnings)

    report("noise that is larger than stated is told", says(fit(TWO, "noise.csv", Noise=0.005), "the noise is more"))
    report("noise that is smaller than stated is told", says(fit(TWO, "noise.csv", Noise=0.08), "the noise is less"))
    bound = fit({**TWO, I + "Friction coefficient unbroken": "<<mu_ub: 0.5 in 0.3..0.55>>"}, "noise.csv")
    report("a bound that was hit is told", says(bound, "mu_ub ends at one of its bounds") and not says(bound, "a_s ends"))
    # a formula of its own, with drift and slack
    angle = numpy.linspace(0.05, 10, 200)
    turned = numpy.maximum(0, angle - 0.3)
    torque = 30 * numpy.tanh(3 * turned) + 20 * turned * numpy.exp(-turned) + 0.4 * angle
    write("other.csv", {"angle_deg": angle, "torque_Nmm": torque + 0.3 * generator.standard_normal(200)})
    other = fit(FIVE, "other.csv", **{"Largest misfit": 1})
    report("another model does not fit", says(other, "the model does not fit torque_Nmm"), other.warnings)
    rms = numpy.sqrt(numpy.mean((other.curves[0]["torque_Nmm_fitted"] - other.curves[0]["torque_Nmm_measured"])**2))
    far = other.misfits[0].smooth * torque.max()
    report("and how far: what the residuals are beyond the noise of 0.3 N mm, to 15 %", abs(far / numpy.sqrt(rms**2 - 0.3**2) - 1) < 0.15,
           (far, rms))


def check_exact_data():
    """Rows that a line between the steps of a run gives, within 0.1 % of the curve: noise on top makes no interval narrower, and
    what the fit leaves is not taken for more than it is."""
    clean = measured("clean.csv")
    angle = numpy.linspace(0.06, 9.9, 120)
    torque, unit = numpy.interp(angle, clean["angle_deg"], clean["torque_Nmm"]), numpy.random.default_rng(4).standard_normal(120)
    widths, found = [], None
    for noise_of_rows in (0, 1e-5, 1e-4, 1e-3, 1e-2):
        write("steps.csv", {"angle_deg": angle, "torque_Nmm": torque + noise_of_rows * torque.max() * unit})
        one = fit({**TWO, I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>"}, "steps.csv", Starts=1)
        widths.append(one.told.half_widths)
        found = found or one
    widths = numpy.array(widths)
    report("exact data give no wider intervals than slightly noisy ones, to 5 %", (widths[0] <= 1.05 * widths[1:]).all(), widths)
    misfit = found.misfits[0]
    report("nor a noise that is more than twice what the fit leaves", misfit.noise_over_largest < 2 * misfit.rms, misfit)
    # of rigid bodies they leave nothing but rounding, of which no width is a measure
    rows = debond.Scene(text=PULL).run().rows
    write("pull.csv", {"u": rows["chuck_uz_mm"], "F": rows["chuck_Fz_N"]})
    found = fit_of_pull()
    report("data that are exact to rounding are fitted without a warning", found.warnings == [] and abs(found.values[0] / 3 - 1) < 1e-6, found.warnings)
    one = SimpleNamespace(problem=found.problem, misfits=[SimpleNamespace(rms=rms, name=name) for name, rms in (("F", 0.0), ("M", 0.01))], warnings=[])
    fits.Fit._warn_of_noise(one)
    report("residuals beside none at all have a finite ratio", len(one.warnings) == 1 and "1e+04 times" in one.warnings[0], one.warnings)


def check_constant():
    """A sensor at its limit, or an implant that is not bonded."""
    write("constant.csv", {"angle_deg": numpy.linspace(0.05, 9.9032, 120), "torque_Nmm": numpy.full(120, 30.0)})
    scene = {"Expert/Closed form/Torsional stiffness": 300, "Expert/Closed form/Normal stiffness": 500, "Chuck/Press/Control": "force",
             "Chuck/Press/Value": "50 * min(t, 1)", I + "Friction coefficient broken": "<<mu_b: 0.45 in 0.1..1>>",
             I + "Friction coefficient unbroken": "<<mu_ub: 0.6 in 0.1..1.5>>", I + "Characteristic slip distance": "<<a_s: 0.03 in 0.002..0.2 log>>"}
    found = fit(scene, "constant.csv")
    report("a torque that is constant: what it does not tell is told", not found.is_told[found.names.index("a_s")] and found.warnings != [], found.warnings)


def check_words_of_search():
    generator = numpy.random.default_rng(1)
    measured("noise.csv", {**TRUTH, I + "Friction coefficient unbroken": 0.3}, more=0.02 * 40 * generator.standard_normal(200))

    def says(found, words):
        return any(words in text for text in found.warnings)

    lower = fit({**TWO, I + "Friction coefficient unbroken": "<<mu_ub: 0.5 in 0.1..1.2>>"}, "noise.csv")
    report("a bond that lowers friction is told", says(lower, "with the values that were found the bond lowers friction"), lower.warnings)
    measured("noise.csv", more=0.02 * 53 * generator.standard_normal(200))
    right = fit(TWO, "noise.csv")
    problem, away = right.problem, right.values * [1.2, 1]
    stalled = fits.Fit(problem, [fits.Optimum(away, problem.cost(problem.curves([away], True)[0]), True, "", problem.curves([away], True)[0])], True, 0)
    report("a search that stalls is told, one that ends where the squares are least is not",
           says(stalled, "the search for mu_ub stalled") and not says(right, "stalled"), stalled.warnings)
    both = fit({**TWO, I + "Transition factor": "<<b_s: 0.7 in 0.1..3>>"}, "noise.csv")
    report("a correlation above 0.99 is told, others are not",
           abs(both.told.correlations).min() < 0.99 < abs(both.told.correlations[1, 2]) and says(both, "a_s and b_s have a correlation of -0.99")
           and sum("correlation of" in text for text in both.warnings + right.warnings) == 1, (both.told.correlations, both.warnings))
    # a stiffness that is wrong, and not fitted, is missed by the few rows of the rise
    measured("rise.csv", {**TRUTH, I + "Tangential stiffness": 150}, more=0.005 * 53 * generator.standard_normal(200))
    rise = fit(TWO, "rise.csv")
    report("a rise that is off does not fit, and it is told by how much", rise.misfits[0].does_not_fit and says(rise, "rows in turn are off by"),
           (rise.misfits[0].local, rise.misfits[0].local_over_noise, rise.misfits[0].chance, rise.warnings))


def check_steps():
    """Exact data of a run with steps that are wide: intervals have no width. Where the direction of sliding changes steps of half the
    size give other values, by 0.4 %; where it does not they give the same ones, but for rounding."""
    wide = SCENE.replace("set Model = foundation", "").replace("Steps = 1, 200", "Steps = 1, 25") + """
subsection Bone
  set Cells = 4, 4, 1
end
subsection Implant
  set Cells = 4, 4
end
"""
    entries = {**TRUTH, I + "Friction coefficient unbroken": TWO[I + "Friction coefficient unbroken"], "Output/Reference curve": "wide.csv", "Expert/Calibration/Starts": 1}
    for sideways in (0.05, 0):
        scene = wide + f"""
subsection Chuck
  subsection Translation x
    set Value = {sideways} * sin(5 * max(t - 1, 0))
  end
end
"""
        rows = debond.Scene(None, TRUTH, text=scene).run().rows
        turned = rows["angle_deg"] > 0
        write("wide.csv", {"angle_deg": rows["angle_deg"][turned], "torque_Nmm": rows["torque_Nmm"][turned]})
        found = debond.fit(debond.Scene(None, entries, text=scene))
        said = any("steps of the load are too wide" in text for text in found.warnings)
        report(f"steps as wide as an interval are told, sideways {sideways} mm", said == (sideways > 0), found.warnings)
    halves = fits.problem_of(debond.Scene(None, entries, text=scene)).done[0].halved(())
    report("steps half as wide are twice as many", [len(ends) for ends in halves] == [2, 50], halves)
    halves = fits.problem_of(debond.Scene(None, {**entries, "Load steps/Steps": "auto"}, text=scene)).done[0].halved(())
    report("those of auto, too", [len(ends) for ends in halves] == [2, 2000], [len(ends) for ends in halves])
    again = debond.fit(debond.Scene(None, entries, text=scene))
    report("the same fit once more gives the same digits", (again.values == found.values).all() and (again.lower == found.lower).all(), again.values - found.values)


# Angles [deg] and torques [N mm] of prm/tutorial/implant.prm with interface stiffnesses of 1500 MPa/mm: a converged run, splines of 45 x 45 x 12
# and 9 x 9 cells, graded by 2, linear bodies, Tolerance = 2e-5.
CONVERGED = ((0.01, 23.8184), (0.02, 42.9003), (0.04, 47.2925), (0.06, 47.6199), (0.09, 47.697), (0.12, 47.7128), (0.15, 47.7191),
             (0.18, 47.7202), (0.21, 47.7212), (0.25, 47.7224), (0.29, 47.7229), (0.33, 47.7234), (0.37, 47.7235), (0.4, 47.7235),
             (1.297, 39.9318), (2.412, 33.0361), (3.686, 32.1616), (5.28, 31.9326), (6.873, 31.869), (8.466, 31.8439), (9.9, 31.8332))


def check_cells():
    """A fit to a converged curve whose noise is said to be 0.2 %: the cells of the first fit leave errors that are told, and found again
    with finer ones, which the fit takes; those of what it takes are small."""
    write("converged.csv", dict(zip(("angle_deg", "torque_Nmm"), numpy.transpose(CONVERGED))))
    scene = debond.Scene(os.path.dirname(os.path.abspath(__file__)) + "/../../prm/tutorial/implant.prm", {
        "Expert/Bone/Solver": "lattice",  # equal cells, which are not as good here as fitted ones
        I + "Normal stiffness": 1500, I + "Tangential stiffness": "<<eps_t: 1000 in 100..10000 log>>",
        I + "Friction coefficient unbroken": "<<mu_ub: 0.5 in 0.2..1>>", "Output/Reference curve": "converged.csv", "Expert/Calibration/Starts": 1,
        "Calibration/Noise": 0.002})
    problem, truth = fits.problem_of(scene), numpy.array([1500, 0.6])
    first = fits.Fit(problem, *fits.find_optima(problem), time.time())
    last = numerics.refined(first)
    told = problem.moved(first.optima[0], first.errors[0].of_curve) - first.values
    report("finer cells move a fit as it is told, to 30 %", (abs(told / (last.values - first.values) - 1) < 0.3).all(), (told, last.values, first.values))
    off = [abs(problem.unknowns.to_search(one.values) - problem.unknowns.to_search(truth)) / one.told.half_widths for one in (first, last)]
    report("they are taken where the error is more than a third of a half width", off[0].max() > 1 / 3 > off[1].max(), off)
    report("errors that are left are small, and known", [one.entry for one in last.errors] == ["Cells", "Steps"] and last.warnings == []
           and max(one.half_widths for one in last.errors) < numerics.LARGEST, (last.errors, last.warnings))
    row = last.taken_as_known[0]
    levels = "23, 23, 6 and 5, 5, 5", "35, 35, 9 and 8, 8, 8", "53, 53, 14 and 12, 12, 12"  # the second just suffices, or is just needed
    report("the table has cells first", (row["value"], row["change"][3:]) in zip(levels, levels[1:]) and 0 < abs(row["effect"]["mu_ub"]) < 0.05, row)
    for entry, value in (("Largest number of unknowns", "1000"), ("Largest minutes", "1e-4")):
        kept, problem.values["Expert / " + entry] = problem.values["Expert / " + entry], value
        said = numerics.refined(first).warnings[-1]
        report(f"that there are none because of {entry} is told", said.endswith("is beyond Expert / " + entry), said)
        problem.values["Expert / " + entry] = kept


def check_few_rows():
    """As many rows as unknowns, with a noise that is known: the intervals are those of the covariance of the rows."""
    clean = measured("clean.csv")
    rows = [3, 100]
    write("few.csv", {name: values[rows] for name, values in clean.items()})
    found = fit({**TWO, I + "Characteristic slip distance": 0.022, I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>"}, "few.csv",
                Noise=0.02)
    J, scale = found.problem.derivatives(found.values, True), 0.02 * found.problem.series[0].scale
    sd = numpy.sqrt(numpy.diag(numpy.linalg.inv(J.T @ J / scale**2)))
    report("two rows for two unknowns under known noise: intervals of +- 1.96 sd to 5 %",
           numpy.allclose(found.upper - found.lower, 2 * 1.96 * sd, rtol=0.05), (found.upper - found.lower) / sd)
    # noise that hangs together over much of a short curve
    flags, words = 0, 0
    for seed in range(min(20, 2 * n_seeds)):
        measured("short.csv", more=0.02 * 53 * correlated(numpy.random.default_rng(seed), 200, 0.8))
        short = fit(TWO, "short.csv", Starts=1)
        flags += short.misfits[0].does_not_fit
        words += any("cannot be told apart" in text for text in short.warnings)
    report("200 rows with a correlation of 0.8: a right model is not said not to fit", flags == 0, flags)


def check_band():
    """Unknowns that are told as a product only leave the band that the product leaves."""
    generator = numpy.random.default_rng(2)
    measured("noise.csv", more=0.02 * 53 * generator.standard_normal(200))
    widths = []
    for depth in ("0.0049", "<<depth: 0.005 in 0.002..0.02>>"):
        found = fit({I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>", I + "Friction coefficient unbroken": "<<1.45 * mu_b>>",
                     I + "Tangential stiffness": 700, "Chuck/Press/Value": f"{depth} * min(t, 1)"}, "noise.csv")
        curve = found.curves[0]
        widths.append(numpy.mean(curve["torque_Nmm_upper_95"] - curve["torque_Nmm_lower_95"]))
    report("the band of a product is that of one of its factors, to 2 %", abs(widths[1] / widths[0] - 1) < 0.02, widths)


def check_what_cannot_be_told():
    measured("clean.csv")
    products = {I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8 log>>", I + "Friction coefficient unbroken": "<<1.45 * mu_b>>",
                I + "Tangential stiffness": 700, "Chuck/Press/Value": "<<depth: 0.006 in 0.002..0.02 log>> * min(t, 1)"}
    found = fit(products, "clean.csv")
    report("torque alone tells a product", any("mu_b" in text and "depth" in text and "apart: they only appear as a product" in text for text in found.warnings),
           found.warnings)
    report("intervals without an end", not numpy.isfinite([*found.lower, *found.upper]).any() or numpy.isinf(found.upper).all(), found.upper)
    report("correlation of -1", abs(found.told.correlations[0, 1] + 1) < 1e-6)
    found = fit(products, "{{clean.csv||none}}", Curves="{{torque_Nmm||torque_Nmm, chuck_Fz_N}}")
    report("a force that is measured too would tell both", len(found.candidates) == 1 and numpy.isfinite(found.candidates[0][1]).all())
    generator = numpy.random.default_rng(6)
    for rho in (0, 0.995):
        measured("noise.csv", more=0.53 * correlated(generator, 200, rho))
        found = fit(TWO, "{{noise.csv||none}}", Starts=1)
        share = found.candidates[0][1] / found.told.half_widths
        report(f"correlation {rho}: the same test once more makes no interval wider, white ones narrower by sqrt(2)",
               (share <= 1).all() and (rho > 0 or abs(share * numpy.sqrt(2) - 1).max() < 0.03), share)
    hardly = fit({**TWO, "Implant/Young modulus": "<<E: 1e5 in 1e4..2e5>>"}, "clean.csv")
    report("what changes nothing is not told, and does not end at its bound",
           not hardly.is_told[hardly.names.index("E")] and not any("E ends" in text for text in hardly.warnings), hardly.warnings)


def check_known():
    """Friction appears as mu p: 1 % more load makes both coefficients 1 % smaller."""
    measured("clean.csv")
    both = {**TWO, I + "Friction coefficient broken": "<<mu_b: 0.3 in 0.1..0.8>>"}
    table = {row["entry"]: row["effect"] for row in fit(both, "clean.csv").taken_as_known}
    load = table["Chuck / Press / Value"]
    report("1 % more load makes both coefficients 1 % smaller", max(abs(load[name] + 1) for name in ("mu_b", "mu_ub")) < 0.02, load)
    # as it falls the torque turns a machine back that is so soft that its curve jumps
    rows = debond.Scene(None, TRUTH, text=SCENE).run().rows
    turned = rows["angle_deg"] > 0
    shown = numpy.maximum.accumulate(rows["angle_deg"][turned] + 0.1 * rows["torque_Nmm"][turned])
    first = numpy.r_[True, numpy.diff(shown) > 0]
    angle = numpy.linspace(0.1, 12, 200)
    write("soft.csv", {"angle_deg": angle, "torque_Nmm": numpy.interp(angle, shown[first], rows["torque_Nmm"][turned][first])})
    soft = {**both, "Interface/Bonding/Bonding degree": 0.8, I + "Friction coefficient unbroken": "<<mu_ub: 0.6 in 0.3..1.5>>"}
    result = fit(soft, "soft.csv", **{"Machine compliance": 0.1})
    table, found = {row["entry"]: row for row in result.taken_as_known}, dict(zip(result.names, result.values))
    load = table["Chuck / Press / Value"]["effect"]
    report("so it does where the curve jumps, to 5 %", max(abs(load[name] + 1) for name in ("mu_b", "mu_ub")) < 0.05, load)
    # phi mu_ub + (1 - phi) mu_b, phi from 0.8 on, is the same with 0.99 of what the bond adds to mu_ub
    degree = table["Interface / Bonding / Bonding degree"]
    adds = found["mu_ub"] - found["mu_b"]
    report("a bonding degree below 1 is in it", degree["change"] == "+1 %" and abs(degree["effect"]["mu_ub"] * found["mu_ub"] / adds + 1) < 0.05
           and abs(degree["effect"]["mu_b"]) < 0.02, degree)


def check_known_of_pulls():
    """An adhesive pulls t_0 x exp(1 - x) at the gap u = x g_0: what another g_0 and a force on top make of t_0 is in closed form."""
    rows = debond.Scene(text=PULL).run().rows
    u, F = rows["chuck_uz_mm"], rows["chuck_Fz_N"]
    write("pull.csv", {"u": u, "F": F + 0.1 * numpy.random.default_rng(1).standard_normal(len(F))})
    found = fit_of_pull()
    table = {row["entry"]: row["effect"]["t0"] for row in found.taken_as_known}
    pull, other = (u / gap * numpy.exp(1 - u / gap) for gap in (0.02, 0.0202))
    by_gap, by_force = pull @ other / (other @ other) - 1, -0.01 * pull.sum() / (pull @ pull)
    again = fit_of_pull(**{I + "Adhesive/Gap at strength": 0.0202}).values[0] / found.values[0] - 1
    report("a gap at strength 1 % off moves t_0 by -0.49 %, in the table, in a fit and in closed form, to 0.02 %",
           max(abs(100 * by_gap - table["Interface / Adhesive / Gap at strength"]), abs(100 * (by_gap - again))) < 0.02, (by_gap, again, table))
    report("1 % of the largest force: -1.42 %", abs(100 * by_force - table["Calibration / Force offset"]) < 0.02, (by_force, table))
    rows = {"Steps", "Implant / Radius", "Interface / Adhesive / Gap at strength", "Interface / Bonding / Bonding degree",
            *(name_of(name, " / ") for name in ("Displacement offset", "Displacement slack", "Displacement compliance", "Force offset", "Force drift"))}
    report("no row of what a pull does not read", set(table) == rows, set(table) ^ rows)
    mixed = {I + "Law": "mixed mode", I + "Mixed mode/Fracture energy I": "<<G: 0.06 in 0.02..0.2>>", I + "Viscosity": 1}
    table = {row["entry"] for row in fit_of_pull(mixed, **{"Expert/Calibration/Largest misfit": 1}).taken_as_known if "Interface / " in row["entry"]}
    rows = {I.replace("/", " / ") + name for name in ("Mixed mode / Normal strength", "Mixed mode / Stiffness", "Bonding / Bonding degree")}
    report("of mixed mode those of opening", table == rows, table ^ rows)


def check_posteriors():
    """Where the curve is nearly linear in the unknowns all ways to an interval agree."""
    generator = numpy.random.default_rng(3)
    measured("noise.csv", more=0.53 * correlated(generator, 200, 0.7))
    found = fit(TWO, "noise.csv")
    sd = found.told.half_widths / found.told.quantiles
    profile = found.profiles()
    worst = max(abs(profile[name]["chi_squared"] - ((found.problem.unknowns.to_search(profile[name]["unknowns"])[:, j]
                                                     - found.problem.unknowns.to_search(found.values)[j]) * 1.96 / found.told.half_widths[j]) ** 2).max() / 15.4
                for j, name in enumerate(found.names))
    report("profiles are parabolas, to 10 % of the largest", worst < 0.1, worst)
    drawn = numpy.log(found.bootstrap(200 if n_seeds >= 100 else 100)[:, 1])
    report("bootstrap: standard deviation of log a_s to 20 %", abs(numpy.std(drawn) / sd[1] - 1) < 0.2, numpy.std(drawn) / sd[1])
    try:
        samples = found.posterior(400 if n_seeds >= 100 else 200)
    except ImportError:
        return
    report("posterior: standard deviation of mu_ub, with the noise as it hangs together, at most that of least squares to 20 %",
           0.5 < numpy.std(samples[:, 0]) / sd[0] < 1.2, numpy.std(samples[:, 0]) / sd[0])


def check_ends():
    """Ends of intervals of a curve that is far from linear: where the sum of squares, the others at their best, has grown by
    t^2 C_jj/(J'J)^-1_jj with the J of that place; with that of the best fit it would be elsewhere."""
    generator = numpy.random.default_rng(5)
    measured("noise.csv", more=0.03 * 53 * correlated(generator, 200, 0.8))
    found = fit({name: FIVE[name] if "Transition" in name or name in TWO else value for name, value in TRUTH.items()}
                | {I + "Tangential stiffness": 700}, "noise.csv", Starts=1)
    problem, told, best = found.problem, found.told, found._best
    unknowns, roots = problem.unknowns, []
    lower, upper = unknowns.to_search(unknowns.lower), unknowns.to_search(unknowns.upper)
    for j in range(len(found.names)):
        for place in (told.lower, told.upper):
            if not lower[j] + 1e-6 < place[j] < upper[j] - 1e-6:
                continue
            start = unknowns.to_search(best.values)
            start[j] = place[j]
            end = problem.minimise(unknowns.from_search(start), True, numpy.delete(numpy.arange(len(start)), j))
            growth = 2 * (end.cost - best.cost)
            there = problem.weights[:, None] * problem.derivatives(end.values, True)
            roots.append([numpy.sqrt(growth / intervals._growth_at_end(problem, told, J, j)) for J in (there, told.derivatives)])
    roots = numpy.array(roots)
    report("ends are where the noise at that place says, to 6 %", len(roots) >= 3 and abs(roots[:, 0] - 1).max() < 0.06, roots)
    report("which is not where that at the best fit says", abs(roots[:, 1] - 1).max() > 0.12, roots)


def main():
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        check_noise_that_is_all_but_explained()
        check_exact_curves()
        check_uneven_noise()
        check_signs()
        check_pulls()
        check_used_rows()
        check_held_load()
        check_failure()
        check_edges()
        check_noise()
        check_words()
        check_exact_data()
        check_constant()
        check_words_of_search()
        check_steps()
        check_cells()
        check_few_rows()
        check_band()
        check_what_cannot_be_told()
        check_known()
        check_known_of_pulls()
        check_posteriors()
        check_ends()
        check_intervals()
        check_coverage()
        check_magnitudes()
    sys.exit(f"{len(failures)} checks failed: {failures}" if failures else 0)


main()
