"""Finished results compared with a measured curve.

    from debond.compare import compare
    print(compare("output/run", "measured.csv", "2 [deg], 3 [N m]").text)
"""

import glob
import os
from dataclasses import dataclass, field
from typing import Dict

import numpy

from _debond import CurveComparison

from .ensemble import torques_at
from .errors import InputError, path_of
from .files import say
from .measured import read_measured, read_measured_and_say
from .measurement import unit_doubt
from .page_data import (MACHINES, curve_file, curve_columns, machine_compliance, read_json, read_table, rows_of, split_unit,
                        unique, varied_in)


@dataclass
class Comparisons:
    """What compare() finds. runs: of a run under "", of the variants of a study under "variant-001" ..., the closest first.
    means: of the mean curves of an ensemble, by what is varied. text: all of it, for people."""

    runs: Dict[str, CurveComparison] = field(default_factory=dict)
    means: Dict[str, CurveComparison] = field(default_factory=dict)
    text: str = ""


LOADS = {"N mm": "torques", "N": "forces"}


def _axes(directory):
    """Columns of the curve that results are about; of a study that of the first variant that has a summary."""
    places = [directory, *sorted(glob.glob(glob.escape(directory) + "/variant-*"))]
    return curve_columns(next(filter(None, (read_json(place + "/summary.json") for place in places)), {}))


def _remarks(computed, measured, axes, comparison):
    """What may be wrong with the measured file: what the comparison says, and a unit that is off by less than it asks for."""
    places = computed[0]  # the run may go on
    there = abs(computed[1][(places >= measured[0].min()) & (places <= measured[0].max())]).max(initial=0)
    doubt = unit_doubt(axes[1], split_unit(axes[1])[1], abs(measured[1]).max(), there, "run", 5) if comparison.rows_used and there else ""
    asked = any("is it in N" in text for text in comparison.remarks)
    return ["warning: " + text for text in [*comparison.remarks, *[doubt] * bool(doubt and not asked)]]


def _table(filename):
    """Rows {column: text} of a table of a study or an ensemble, each behind what is varied: "Bone / Size = 8; ..."."""
    table = read_table(filename)
    return [("; ".join(f"{name} = {row[name]}" for name in varied_in(table)), row) for row in rows_of(table)]


def _computed(directory, axes, over):
    """The curve of a run over its own position, or over that of its machine, which is ahead where it is soft."""
    curve = curve_file(directory)
    positions, loads = read_measured(curve, axes)
    if over != axes[0]:
        positions += machine_compliance(directory, axes[0]) * read_measured(curve, (axes[0], MACHINES[axes[0]][1]))[1]
    return numpy.array([positions, loads])


def _compare_variants(directory, axes, over, measured, found):
    """Lines on the variants of a study."""
    rows, variants = _table(directory + "/study.csv"), []
    for varied, row in rows:
        name = "variant-" + row["variant"].zfill(3)
        curve = curve_file(directory + "/" + name)
        if os.path.exists(curve):
            computed = _computed(directory + "/" + name, axes, over)
            variants.append((name, varied, CurveComparison(computed, measured, *axes), computed))
    # what is not a number comes last
    variants.sort(key=lambda variant: numpy.nan_to_num(variant[2].difference_mean, nan=numpy.inf))
    found.runs.update((name, comparison) for name, _, comparison, _ in variants)
    lines = [remark for _, _, closest, computed in variants[:1] for remark in _remarks(computed, measured, axes, closest)]
    lines += [f"{comparison.text()}: {name}, {varied}" for name, varied, comparison, _ in variants]
    n_without = len(rows) - len(variants)
    return lines + [f"{n_without} of {len(rows)} variants have no curve"] * (n_without > 0)


def _compare_band(directory, measured, found):
    """Lines on the mean curve of each group of an ensemble, and how much of the measured one lies between its quantiles."""
    bands, lines = {}, []
    for varied, row in _table(directory + "/ensemble.csv"):
        bands.setdefault(varied, []).append(
            [float(row[name]) for name in ("angle_deg", "torque_mean_Nmm", "torque_p05_Nmm", "torque_p95_Nmm")])
    for varied, rows in bands.items():
        angles, mean, *quantiles = numpy.array(rows).T
        low, high = (torques_at(numpy.array([angles, quantile]), measured[0]) for quantile in quantiles)
        n, n_inside = numpy.isfinite(low + high).sum(), ((low <= measured[1]) & (measured[1] <= high)).sum()
        found.means[varied] = CurveComparison(numpy.array([angles, mean]), measured)
        lines.append(f"{found.means[varied].text()}: mean of the ensemble{varied and ', ' + varied}; {n_inside} of {n} rows "
                     "lie between the quantiles of 5 and 95 %")
    return lines


def compare(directory, curve, columns=(), over="") -> Comparisons:
    """Compares the curves in `directory`, of a run, a study or an ensemble, with the measured one in the file `curve`. columns:
    of that file, as of read_measured(). over: machine_angle_deg or machine_uz_mm compares with what the soft machine of a run
    shows; means of ensembles are not compared then. Raises InputError."""
    directory, curve, found = path_of(directory, "directory"), path_of(curve, "curve"), Comparisons()
    axes = _axes(directory)
    over, places = over or axes[0], unique([axes[0], MACHINES.get(axes[0], axes)[0]])
    if over not in places:
        raise InputError(f"debond: --over {over}: expected {' or '.join(places)}")
    measured, said, _ = read_measured_and_say(curve, (over, axes[1]), columns, "--compare", "--columns")
    own, is_study = curve_file(directory), os.path.exists(directory + "/study.csv")
    if not is_study and not os.path.exists(own):
        raise InputError(f"debond: --compare {directory}: there are no results in this directory, neither torque.csv nor "
                         "reactions.csv nor study.csv")
    positions, loads = measured
    units = [split_unit(name)[1].replace("°", "deg") for name in axes]
    lines = [f"{curve}: {said}; {len(positions)} rows, from {positions.min():.4g} to {positions.max():.4g} {units[0]}, "
             f"{LOADS[units[1]]} up to {abs(loads).max():.4g} {units[1]}"]
    if is_study:
        lines += _compare_variants(directory, axes, over, measured, found)
        if over == axes[0] and os.path.exists(directory + "/ensemble.csv"):
            lines += _compare_band(directory, measured, found)
    else:
        computed = _computed(directory, axes, over)
        run = found.runs[""] = CurveComparison(computed, measured, *axes)
        numbers = f" ({run.rows_used} rows; e_mp {100 * run.e_mp:.3g} %, e_rel {100 * run.e_rel:.3g} %)"
        lines += [f"{directory}: {run.text()}{numbers if run.rows_used else ''}"] + _remarks(computed, measured, axes, run)
    found.text = "\n".join(lines) + "\n"
    return found


def main(directory, curve, options):
    """The command; 2 if there was nothing to compare."""
    found = compare(directory, curve, options["--columns"], options["--over"])
    say(found.text, end="")
    return 0 if any(one.rows_used for one in found.runs.values()) else 2
