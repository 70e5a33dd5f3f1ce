"""A folder of raw records of tests to failure, as machines leave them, one file a specimen: a table and a page.

    python3 -m debond records FOLDER --columns "displacement mm, force N" [--names "{animal}{limb}{side}[{kind}][-{trial}]"]
                              [--by FIELDS] [--back 0.5] [--out DIR]

Files need no header. --columns says what their columns are, in order, with units; "Weg [mm], Kraft [-N]" chooses by name and
"3 [mm], 2 [N]" by number, as measured.py does. --names splits the name of a file without its ending, or with a / its path: a
field is a number or letters, as few as fit; {animal:[A-Z]+[0-9]+} is what this regular expression says; what stands in brackets
may be missing, and is `none` then. DIR gets records.csv, with a row for each file, which groups.py reads, records.json with the
curves that report.html draws, and that page. What is wrong with a record is written into its row, under `mark`; none is left
out. peaks.csv has those without a mark as specimen_table.py reads them.
"""

import itertools
import json
import math
import os
import pathlib
import re

import _debond
import numpy
from scipy import ndimage, signal, stats

from .errors import InputError, shortened
from .files import csv_text, make_directory, say, write_whole
from .layout import value_of
from .measured import read_measured
from .page import write_page_if_possible
from .page_curve import thinned
from .units import unit_in, unit_text_in

#: Of the quantities of two columns: their names in the units of debond, those of VALUES in a table, mJ of the product of units.
KINDS = {("length", "force"): (("displacement_mm", "force_N"), ("peak_N", "displacement_at_peak_mm", "stiffness_N_per_mm",
                                "energy_mJ", "drop_rows", "slack_mm", "offset_N", "noise_N", "rows"), 1.0),
         ("angle", "moment"): (("angle_deg", "torque_Nmm"), ("peak_Nmm", "angle_at_peak_deg", "stiffness_Nmm_per_deg",
                               "energy_mJ", "drop_rows", "slack_deg", "offset_Nmm", "noise_Nmm", "rows"), math.radians(1))}
VALUES = ("peak", "at", "stiffness", "energy", "drop", "slack", "offset", "noise", "rows")
OWN = ("specimen", "file", "mark")
FIELD = r"[0-9]+|[^\W\d_]+?"   # a number, or letters
FEWEST, STUCK = 10, 5          # rows up to a peak; equal rows at a peak that are a limit of the sensor
CLEAR = 6.0                    # standard deviations of the noise that do not come by chance
COMPARABLE, RISE = 0.3, 0.1    # shares of the peak by which the load falls behind several, and rises between them
MOST_VALUES, MOST_GROUPS, MOST_POINTS = 6, 12, 60000  # of a field, and of all that the page tells apart; of its curves


def noise_of(load) -> float:
    """Standard deviation of what changes from row to row, from second differences: those of independent noise have six times
    its variance, those of a curve are small, and the median does not see a break. Where most rows are equal to the one before,
    that of rounding, step / sqrt(12)."""
    steps = numpy.abs(numpy.diff(load))
    if steps.any() and numpy.median(steps) == 0:
        return steps[steps > 0].min() / 12**0.5
    return numpy.median(numpy.abs(numpy.diff(load, 2))) / stats.norm.ppf(0.75) / 6**0.5


def _offset_of(load, noise):
    """The load where nothing pulls: where a line through the first rows begins, half of those before the load is clear of the
    noise and ten at least, since it may rise at once, or the median of the last ten, whichever is nearer to 0."""
    n = max(10, int(numpy.argmax(numpy.abs(load - numpy.median(load[:10])) > CLEAR * noise)) // 2)
    slope, middle = numpy.polyfit(numpy.arange(n) - (n - 1) / 2, load[:n], 1)
    return min(middle - (n - 1) / 2 * slope, numpy.median(load[-10:]), key=abs)


def _line(x, load, peak, noise):
    """Slope of the least-squares line through the rows between 40 and 80 % of the peak on the way up, and where it is zero;
    NaN with fewer than three. Means over a twelfth of the way, or more to know the load to 2 % of the peak, find these rows:
    chosen by their own noise, they would turn the line."""
    smooth = ndimage.uniform_filter1d(load, min(max(len(load) // 12, int((noise / 0.02 / peak) ** 2)) + 1, len(load)))
    end = int(numpy.argmax(smooth >= 0.8 * peak)) or len(load)
    rows = slice(int(numpy.max(numpy.flatnonzero(smooth[:end] < 0.4 * peak), initial=-1)) + 1, end)
    if end - rows.start < 3 or not numpy.ptp(x[rows]):
        return numpy.nan, numpy.nan
    line = stats.linregress(x[rows], load[rows])
    return line.slope, -line.intercept / line.slope if line.slope else numpy.nan


def evaluated(x, load, back: float = 0.5):
    """VALUES of a record and what is wrong with it. x, load: its columns, in mm and N or degrees and N mm; back: the share of
    the peak that is lost when it breaks.

    The peak is the largest load as recorded; all else is above the offset. Where the load goes further in the other direction,
    the peak is there, with its sign."""
    if len(load) < FEWEST:
        top = int(numpy.argmax(load))
        return {"peak": load[top], "at": x[top], "rows": len(load)}, [f"too few samples: {len(load)} rows"]
    noise = noise_of(load)
    offset = _offset_of(load, noise)
    sign = -1 if offset - load.min() > max(load.max() - offset, CLEAR * noise) else 1
    up = sign * (load - offset)
    top = int(numpy.argmax(up))
    peak, values = up[top], {"peak": load[top], "at": x[top], "offset": offset, "noise": noise, "rows": len(load)}
    if peak <= CLEAR * noise:
        return values, ["no peak: nothing beyond the noise"]
    slope, zero = _line(x[:top + 1], up[:top + 1], peak, noise)
    fallen = numpy.flatnonzero(up[top:] < (1 - back) * peak)
    # chance goes up and down; from a peak the load falls until it rises to the next one
    padded = numpy.pad(up, 1)
    tops, _ = signal.find_peaks(padded, prominence=max(RISE * peak, 2 * CLEAR * noise))
    n_falls = numpy.sum(padded[tops] - numpy.minimum.reduceat(padded, tops) >= COMPARABLE * peak)
    runs = [(value, len(list(run))) for value, run in itertools.groupby(up) if value > peak / 2]
    stuck, elsewhere = (max((n for value, n in runs if (value == peak) == is_top), default=0) for is_top in (True, False))
    is_alone = padded[[top, top + 2]].max() < peak / 2
    marks = {"negative: the peak is in the other direction": sign < 0,
             "single row: none beside the peak is half as high": is_alone,
             f"too few samples: {top + 1} rows up to the peak": not is_alone and (top + 1 < FEWEST or numpy.isnan(slope)),
             "does not rise with the first column": slope <= 0 < sign,
             f"sensor at its limit: {stuck} equal rows at the peak": stuck >= max(STUCK, 3 * elsewhere),
             f"several peaks: {n_falls}": n_falls > 1,
             "never comes back: the load stays near its peak": up[-3:].min() >= (1 - back) * peak}
    values.update(stiffness=sign * slope, energy=numpy.trapz(load[:top + 1] - offset, x[:top + 1]), slack=zero - x[0],
                  drop=int(fallen[0]) if len(fallen) else numpy.nan)
    return values, [mark for mark, is_so in marks.items() if is_so]


def _choice_of(text):
    """A key of KINDS, and the choice of columns for measured.py, of what --columns says."""
    units = [(unit_in(item).quantity, item if re.search(r"[\[(]", item) else f"{number} [{unit_text_in(item)}]")
             for number, item in enumerate(text.split(","), 1) if unit_in(item)]
    for kind in KINDS:
        chosen = [item for wanted in kind for quantity, item in units if quantity == wanted]
        if [quantity for quantity, _ in units if quantity in kind].count(kind[0]) == 1 and len(chosen) == 2:
            return kind, chosen
    raise InputError(f"--columns '{shortened(text)}': expected the columns of the files with units, one length and one force or "
                     'one angle and one torque, as "displacement mm, force N"')


def _fields_of(paths, pattern, taken):
    """{path: {field: text}}, None in the place of the fields of a name that does not fit; and the names of fields, none taken."""
    parts = re.findall(r"\{(\w+)(?::((?:[^{}]|\{[^{}]*\})*))?\}|(.)", pattern)
    text = "".join(f"(?P<{field}>{own or FIELD})" if field else {"[": "(?:", "]": ")?"}.get(other, re.escape(other)) for field, own, other in parts)
    try:
        names = re.compile(text).groupindex
    except re.error as error:
        raise InputError(f"--names '{shortened(pattern)}': {error}: expected fields as in " '"{animal}{limb}[-{trial}]"') from None
    if pattern and not names or set(names) & set(taken) or {"{", "}"} & {other for *_, other in parts}:
        raise InputError(f"--names '{shortened(pattern)}': expected names of fields in braces that are no columns of records.csv")
    plain = {path: os.path.splitext(path if "/" in pattern else os.path.basename(path))[0] for path in paths}
    found = {path: re.fullmatch(text, name) if names else None for path, name in plain.items()}
    if names and not any(found.values()):
        raise InputError(f"--names '{shortened(pattern)}': none of {len(paths)} files has such a name, the first is "
                         f"'{plain[paths[0]]}'; brackets hold what may be missing, as in {{animal}}{{limb}}[-{{trial}}]")
    return {path: match and {name: match[name] or "none" for name in names} for path, match in found.items()}, list(names)


def _groups_of(rows, names, by):
    """Fields that the page tells apart: those given, else those of few values as long as groups are few."""
    chosen = [name.strip() for name in by.split(",") if name.strip()]
    if set(chosen) - set(names):
        raise InputError(f"--by {by}: expected fields of --names, {', '.join(names) or 'which has none'}")
    for name in [] if chosen else names:
        n_groups = len({tuple(row[one] for one in [*chosen, name]) for row in rows})
        if 1 < len({row[name] for row in rows}) <= MOST_VALUES and n_groups <= MOST_GROUPS:
            chosen.append(name)
    return chosen


def _row(path, kind, choice, back):
    """VALUES, marks and columns of a file."""
    try:
        x, load = read_measured(path, KINDS[kind][0], choice, entry="record", columns_entry="--columns")
    except InputError as error:
        reason = str(error.why or error).replace(";", ",")  # separates marks
        return {}, [f"unreadable: {reason}"], ([], [])
    return *evaluated(x, load, back), (x, load)


def _paths_in(folder, directory):
    """All files in a folder and in those below it, 2 before 10, without hidden ones and without results; relative to it."""
    directory = pathlib.Path(directory).resolve()
    paths = [path.relative_to(folder) for path in pathlib.Path(folder).rglob("*")
             if path.is_file() and directory not in path.resolve().parents]
    paths = [path.as_posix() for path in paths if not any(part.startswith(".") for part in path.parts)]
    if not paths:
        raise InputError(f"{folder}: expected a folder with records, but there is no file in it")
    return sorted(paths, key=lambda path: re.sub("[0-9]+", lambda digits: digits[0].zfill(12), path))


def main(folder, options) -> None:
    """The command."""
    kind, choice = _choice_of(options["--columns"])
    back, (axes, columns, mJ) = value_of(options["--back"]), KINDS[kind]
    if back is None or not 0 < back < 1:
        raise InputError(f"--back {options['--back']}: expected the share of the peak that is lost at the break, between 0 and 1")
    directory = options["--out"] or os.path.join("output", os.path.basename(os.path.abspath(folder)))
    paths = _paths_in(folder, directory)
    fields, names = _fields_of(paths, options["--names"], OWN + columns)
    by = _groups_of(list(filter(None, fields.values())), names, options["--by"])
    stems, rows, curves = [os.path.splitext(os.path.basename(path))[0] for path in paths], [], []
    for path, stem in zip(paths, stems):
        values, marks, (x, load) = _row(os.path.join(folder, path), kind, choice, back)
        values["energy"] = mJ * values.get("energy", numpy.nan)
        marks += ["name: does not fit --names"] * (names != [] and not fields[path])
        rows.append([stem if stems.count(stem) == 1 else path, path, *(fields[path] or dict.fromkeys(names, "")).values(),
                     *(values.get(name, numpy.nan) for name in VALUES), "; ".join(marks)])
        some = thinned(x, load, max(30, MOST_POINTS // len(paths)))
        curves.append([[float(f"{column[i]:.6g}") for i in some] for column in (x, load)])
    if not any(x for x, _ in curves):
        raise InputError(f"{folder}: none of {len(paths)} files can be read: {paths[0]}: {rows[0][-1]}")
    make_directory(directory)
    write_whole(os.path.join(directory, "records.csv"), csv_text([*OWN[:2], *names, *columns, OWN[2]], rows, digits=10))
    animal, at = [name for name in names if name == "animal"], {name: i for i, name in enumerate(names, 2)}
    write_whole(os.path.join(directory, "peaks.csv"), csv_text(["specimen", *animal, "group", columns[0]], [
        [row[0], *(row[at[name]] for name in animal), ", ".join(row[at[name]] for name in by), row[2 + len(names)]]
        for row in rows if not row[-1]], digits=10))
    about = {"folder": folder, "axes": axes, "by": by, "curves": curves, "version": _debond.version, "provenance": _debond.provenance()}
    write_whole(os.path.join(directory, "records.json"), json.dumps(about))
    write_page_if_possible(directory)
    marked = [row for row in rows if row[-1]]
    say(f"{len(rows)} records, {len(marked)} of them marked; results are in {directory}/records.csv and report.html")
    say("\n".join(f"{row[0]}: {row[-1]}" for row in marked), end="\n" * bool(marked))
