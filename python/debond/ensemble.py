"""Statistics over the variants of a finished study that differ by chance only, in the seed of their random patterns.

Reads study.csv, and summary.json and the curve of each variant; writes ensemble.csv and ensemble_summary.csv, which
doc/reference/results.md describes.
"""

import io
import json
import os
from typing import Any, List, NamedTuple

import numpy

from .errors import InputError, path_of
from .files import csv_text, say, write_whole
from .measured import read_measured
from .page_data import CHANCE, curve_file, n_rows, read_table, varied_in

CURVE = ("angle_deg", "torque_Nmm")
#: Members of summary.json, NAME + UNIT: their statistics are called NAME_mean + UNIT and so on.
QUANTITIES = (("T_max", "_Nmm"), ("theta_max", "_deg"), ("theta_full", "_deg"), ("T_inf", "_Nmm"), ("E_deb", "_Nmm"),
              ("W_adh", "_Nmm"), ("w_adh", "_N_per_m"), ("D_adh", "_Nmm"), ("initial_stiffness", "_Nmm_per_rad"),
              ("largest_bonded_patch", "_mm2"))
STATISTICS = ("_mean", "_sd", "_p05", "_p50", "_p95")


class Ensemble(NamedTuple):
    """curves, summary: pandas frames of ensemble.csv and ensemble_summary.csv; notes: what had to be left out, for people."""

    curves: Any
    summary: Any
    notes: List[str]


def statistics_of(values: numpy.ndarray) -> numpy.ndarray:
    """Mean, standard deviation (n - 1) and quantiles of 5, 50 and 95 % of each column of values (n, columns), without what is
    not finite: an array (5, columns), NaN where too few are left. Quantiles are of type 7 of Hyndman and Fan, American
    Statistician 50 (1996) 361-365."""
    result = numpy.full((5, values.shape[1]), numpy.nan)
    for column, own in zip(result.T, values.T):
        own = numpy.sort(own[numpy.isfinite(own)])
        if len(own):
            apart = own - own[0]  # values that are equal have no scatter, not even by rounding
            column[:] = (own[0] + apart.mean(), apart.std(ddof=1) if len(own) > 1 else numpy.nan,
                         *numpy.quantile(own, (0.05, 0.5, 0.95)))
    return result


def _rounding_of(angles):
    return 1e-9 * max(1.0, numpy.ptp(angles))


def torques_at(curve, angles):
    """Torques at `angles`, linear between the rows of a curve (2, rows) whose angles rise; NaN beside it, but for rounding."""
    rounding = _rounding_of(angles)
    is_beside = (angles < curve[0, 0] - rounding) | (angles > curve[0, -1] + rounding)
    return numpy.where(is_beside, numpy.nan, numpy.interp(angles, *curve))


def ascending(curve):
    """A curve (2, rows) as one whose angles rise, with the last of rows that share an angle, but for rounding; without rows if
    nothing turns, None if it turns back."""
    turns_on = abs(numpy.diff(curve[0])) > _rounding_of(curve[0])
    result = curve[:, numpy.r_[turns_on, True]]
    steps = numpy.diff(result[0])
    if steps.size == 0:
        return numpy.empty((2, 0))
    return result if (steps > 0).all() else result[:, ::-1] if (steps < 0).all() else None


def band_of(curves):
    """Angles (n) of the curve with most rows, how many curves cover each (n), their statistics there (5, n), and how many of
    `curves`, arrays (2, rows), are left out since they turn back."""
    pairs = [(ascending(curve), curve[0, 0] > curve[0, -1]) for curve in curves]
    used = [pair for pair in pairs if pair[0] is not None and pair[0].size]
    if not used:
        return numpy.empty(0), numpy.empty(0, dtype=int), numpy.empty((5, 0)), sum(pair[0] is None for pair in pairs)
    longest, falls = max(used, key=lambda pair: pair[0].shape[1])  # the first of several
    angles = longest[0, ::-1] if falls else longest[0]
    torques = numpy.array([torques_at(curve, angles) for curve, _ in used])
    return angles, numpy.isfinite(torques).sum(axis=0), statistics_of(torques), sum(pair[0] is None for pair in pairs)


def _members(directory):
    """Names of the varied entries but the seed; of each group the members, {values: [(summary, curve), None if it failed]}."""
    table = read_table(os.path.join(directory, "study.csv"))
    if not n_rows(table):
        raise InputError(f"{directory}: there is no study in this directory, no study.csv with rows")
    if CHANCE not in table:
        raise InputError(f"{directory}/study.csv: this study varies {', '.join(varied_in(table)) or 'nothing'}, not {CHANCE}")
    entries, groups = [name for name in varied_in(table) if name != CHANCE], {}
    for i, number in enumerate(table["variant"]):
        member, place = None, os.path.join(directory, f"variant-{int(number):03d}")
        if table["converged"][i] == "true":
            with open(os.path.join(place, "summary.json"), encoding="utf-8") as file:
                member = json.load(file), read_measured(curve_file(place), CURVE)
        groups.setdefault(tuple(table[name][i] for name in entries), []).append(member)
    return entries, groups


def _tables(directory):
    """Header and rows of ensemble.csv, those of ensemble_summary.csv, and notes."""
    try:
        entries, groups = _members(directory)
    except (OSError, ValueError) as error:
        raise error if isinstance(error, InputError) else InputError(f"{directory}: {error}") from None
    names = [name + kind + unit for name, unit in QUANTITIES for kind in STATISTICS]
    curves = [*entries, "angle_deg", "members", *(f"torque{kind}_Nmm" for kind in STATISTICS)], []
    summary, notes = ([*entries, "members", "failed", *names], []), []
    for values, members in groups.items():
        done = [member for member in members if member]
        numbers = [[one.get(name + unit) for name, unit in QUANTITIES] for one, _ in done]  # None: not known
        table = statistics_of(numpy.array(numbers, dtype=float).reshape(len(done), len(QUANTITIES)))
        summary[1].append([*values, len(done), len(members) - len(done), *table.T.ravel().tolist()])
        angles, n, torques, n_left_out = band_of([curve for _, curve in done])
        curves[1].extend([*values, *row] for row in zip(angles.tolist(), n.tolist(), *torques.tolist()))
        if n_left_out:
            which = " of " * bool(values) + "; ".join(f"{name} = {text}" for name, text in zip(entries, values))
            notes.append(f"ensemble.csv leaves out {n_left_out} of {len(done)} members{which}: their rotation reverses, so "
                         "that an angle has more than one torque")
    return curves, summary, notes


def write_ensemble(directory) -> List[str]:
    """Writes ensemble.csv and ensemble_summary.csv into the directory of a finished study; returns what had to be left out, for
    people. Raises as ensemble(), and RunError if a file cannot be written."""
    curves, summary, notes = _tables(directory)
    for name, table in (("ensemble.csv", curves), ("ensemble_summary.csv", summary)):
        write_whole(os.path.join(directory, name), csv_text(*table, digits=12))
    return notes


def ensemble(directory) -> Ensemble:
    """Statistics over the members of each group of a finished study: variants that agree in all varied entries but the seed.
    Units are those in the names of columns. Writes nothing: write_ensemble() does. Raises InputError if there is no such study
    or a file of it cannot be read, ImportError without pandas."""
    import pandas

    *tables, notes = _tables(path_of(directory, "directory"))
    return Ensemble(*(pandas.read_csv(io.StringIO(csv_text(*table)), float_precision="round_trip") for table in tables), notes)


def main(directory, options):
    """The command."""
    for note in write_ensemble(directory):
        say(note)
    say(f"Statistics over all seeds are in {directory}/ensemble.csv and ensemble_summary.csv")
