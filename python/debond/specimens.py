"""Fits of many specimens with one template: the same scene with unknowns, a table with a row for each.

    import debond
    found = debond.fit_specimens("template.prm", "specimens.csv", jobs=2)
    found.parameters, found.pooled, found.failures

    python3 -m debond specimens TEMPLATE.prm TABLE [--out DIR] [--jobs N]

specimen_table.py says what the table holds, pooling.py what a mean over specimens is. DIR gets parameters.csv, pooled.csv,
differences.csv, specimens.json and report.html; DIR/NAME what a fit leaves. Those that are finished, with the same row, curve and template, are
kept. The command ends with 2 if a specimen failed or none tells an unknown, and with 1 if the table or the template is wrong.
"""

import math
import statistics
import sys
from typing import Dict

from .errors import InputError, RunError, path_of
from .executors import check_workers, results_of
from .files import make_directory, say
from .page import write_results
from .groups import DIFFERENCES
from .pooling import compare_groups, pool
from .peaks import fit_peaks, with_default_unknown
from .scene import Scene
from .specimen_fit import finished, fit_one, task_of
from .specimen_table import ALL, has_peaks, read_specimens

PARAMETERS = ("specimen", "group", "curve", "unknown", "value", "lower_95", "upper_95", "unit", "told", "at_bound",
              "logarithmic", "fits", "e_rel", "reason", "peak", "peak_sd", "peak_error", "peak_unit")
POOLED = ("unknown", "group", "specimens", "left_out", "mean", "lower_95", "upper_95", "sd_between", "unit", "scale", "tau",
          "plain_mean", "plain_sd")


class Specimens:
    """What fit_specimens() finds: parameters.csv, with a row for each specimen and unknown, and pooled.csv, with one for each
    unknown and group, and for all, and differences.csv of groups, as frames of pandas. failures: {specimen: why it failed}; directory: of the results."""

    def __init__(self, tables, failures: Dict[str, str], directory: str):
        self._tables, self.failures, self.directory = tables, failures, directory

    def _frame(self, name):
        import pandas

        columns, rows = self._tables[name]
        return pandas.DataFrame(rows, columns=columns)

    parameters = property(lambda self: self._frame("parameters"))
    pooled = property(lambda self: self._frame("pooled"))
    differences = property(lambda self: self._frame("differences"))


def _searched(row, name):
    return math.log(row[name]) if row["logarithmic"] else row[name]


def _used(rows):
    """Rows of values that are told, and have an error that weighs them."""
    return [row for row in rows if row["told"] and not row["at_bound"] and row["sd"]]


def _pooled_row(unknown, group, rows):
    """The mean of an unknown over the specimens of a group, from their rows of specimen.json. Those of one animal count as their mean."""
    used, first, of_animals = _used(rows), rows[0], {}
    for i, row in enumerate(used):
        of_animals.setdefault(row.get("animal") or i, []).append(row)
    mean = pool([sum(_searched(row, "value") for row in own) / len(own) for own in of_animals.values()],
                [math.hypot(*(row["sd"] for row in own)) / len(own) for own in of_animals.values()])
    plain = [row["value"] for row in used]
    # of peaks: what is common to all does not average out
    half = math.hypot(mean.upper - mean.mean, sum(row.get("common", 0) for row in used) / max(1, len(used)))
    places, sd = (mean.mean, mean.mean - half, mean.mean + half), mean.tau
    if first["logarithmic"]:
        places = tuple(map(math.exp, places))
        # of a logarithmic normal distribution
        sd = places[0] * math.exp(mean.tau**2 / 2) * math.sqrt(math.expm1(mean.tau**2))
    return dict(zip(POOLED, (unknown, group, len(used), len(rows) - len(used), *map(float, places), float(sd), first["unit"],
                             "logarithm" if first["logarithmic"] else "value", float(mean.tau), statistics.fmean(plain) if plain else math.nan,
                             statistics.stdev(plain) if len(plain) > 1 else math.nan)))


def _differences_of(unknown, pairs):
    """Rows of differences.csv, from pairs (group, row of specimen.json). Of what is searched by its logarithm there are ratios."""
    used = [(_searched(row, "value"), group or "no group", row.get("animal") or None) for group, row in pairs if _used([row])]
    rows, first = compare_groups(*zip(*used))[1] if used else [], pairs[0][1]
    for row in rows if first["logarithmic"] else []:
        for ratio, name in zip(DIFFERENCES[6:9], DIFFERENCES[3:6]):
            row[ratio], row[name] = math.exp(row[name]), math.nan
    return [{"unknown": unknown, "unit": first["unit"], **row} for row in rows]


def _tables(specimens, results):
    """Of each table columns and rows."""
    parameters, of_unknowns = [], {}
    unknown = dict.fromkeys(("value", "lower_95", "upper_95", "e_rel"), math.nan)
    nothing = {**dict.fromkeys(PARAMETERS, ""), **unknown, "fits": False}
    for specimen in specimens:
        result = results[specimen.name]
        about = {**nothing, **result, "specimen": specimen.name, "group": specimen.group, "curve": specimen.curve}
        for row in result.get("rows", [{}]):
            parameters.append({**about, **{name: value for name, value in row.items() if value is not None}})
            if row:
                of_unknowns.setdefault(row["unknown"], []).append((specimen.group, {**row, "animal": specimen.animal}))
    pooled, differences = [], []
    for name, pairs in of_unknowns.items():
        groups = list(dict.fromkeys(group for group, _ in pairs))
        for group in groups if len(groups) > 1 else []:
            pooled.append(_pooled_row(name, group, [row for own, row in pairs if own == group]))
        pooled.append(_pooled_row(name, ALL, [row for _, row in pairs]))
        differences += _differences_of(name, pairs)
    return {"parameters": (PARAMETERS, parameters), "pooled": (POOLED, pooled), "differences": (DIFFERENCES, differences)}


def fit_specimens(template, table, directory=None, *, executor=None, jobs: int = 1, say=lambda text: None) -> Specimens:
    """Fits every specimen of a table (specimen_table.py) with the unknowns of a template, a Scene or the name of a file, and
    writes all results into a directory, that of the template if none is given.

    executor: of concurrent.futures, which makes the fits: one of processes, mpi4py.futures.MPIPoolExecutor, or get_executor()
    of a client of Dask. jobs: processes, if there is none. say: a function that is told what is going on. Units are those of
    the entries. Raises InputError if template or table are wrong, RunError if results cannot be written. What is wrong with one
    specimen is in `failures`."""
    scene = template if isinstance(template, Scene) else Scene(template)
    check_workers(executor, jobs, "jobs", say)
    table = path_of(table, "table")
    entries = scene._entries
    if not any("<<" in entry.value for entry in entries) and has_peaks(table):
        entries = with_default_unknown(entries, say)
    specimens = read_specimens(table, entries)
    said = {entry.name: entry.value for entry in scene._entries}
    directory = path_of(directory or said.get("Output / Directory") or "output/specimens", "directory")
    make_directory(directory)
    peaks = None
    if specimens[0].peak is None:
        results = _fit_all(specimens, scene, table, directory, executor, jobs, say)
    else:
        results, peaks = fit_peaks(specimens, entries, directory, executor, jobs, say)
    results = {name: _said(result) for name, result in results.items()}
    failures, tables = {name: result["reason"] for name, result in results.items() if "reason" in result}, _tables(specimens, results)
    write_results(directory, "specimens", {"title": said.get("Title", ""), "table": table, "specimens": len(specimens), "failures": failures,
                                           "peaks": peaks}, tables)
    return Specimens(tables, failures, directory)


def _said(result):
    """Of what has failed {"reason"}; the others go on."""
    if isinstance(result, (InputError, RunError)):
        return {"reason": str(result)}
    return {"reason": f"{type(result).__name__}: {result}"} if isinstance(result, Exception) else result


def _fit_all(specimens, scene, table, directory, executor, n_jobs, say):
    """{name: result} of all specimens, in the order of the table."""
    tasks = {specimen.name: task_of(specimen, scene._entries, table, directory) for specimen in specimens}
    results = {name: finished(task) for name, task in tasks.items()}
    left = {name: task for name, task in tasks.items() if not results[name]}
    n_done = len(tasks) - len(left)
    say(f"{len(tasks)} specimen" + "s" * (len(tasks) != 1) + f", {n_done} of them done already" * (n_done > 0))

    results.update(results_of(fit_one, left, executor, n_jobs,
                              lambda name, result: say(f"{name}: {_said(result).get('reason', 'done')}")))
    return results


def main(template, table, options) -> int:
    """The command; returns the exit code."""
    found = fit_specimens(template, table, options["--out"] or None, jobs=options["--jobs"],
                          say=say)
    say(f"Results are in {found.directory}/parameters.csv, pooled.csv and report.html")
    for name, why in found.failures.items():
        say(f"{name} failed: {why}", sys.stderr)
    is_told = any(row["told"] for row in found._tables["parameters"][1])
    if not is_told:
        say("no specimen tells an unknown", sys.stderr)
    return 0 if is_told and not found.failures else 2
