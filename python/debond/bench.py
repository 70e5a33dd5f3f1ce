"""Published tests as scenes: `python3 -m debond bench RIG.csv` runs the scene of a rig over the ranges of what is not known, and
writes a page: published, computed as a band, and whether that is a prediction.

A rig is a CSV file. Lines with # come first:

    # title: ...                                what was tested
    # source: ...                               the publication
    # read: ...                                 what of it was read: text, abstract, ...
    # scene: pin.prm                            beside the rig
    # taken: Implant/Radius [mm] = 2; abstract               from where
    # fitted: Interface/... [MPa] = 3; so that ... agrees
    # assumed: Bone/Young modulus [MPa] = 500 | 200 | 900; why        nominal, then others
    # numerical: Bone/Cells = 16, 4, 4 | 24, 6, 6; ...                the same for cells and steps
    # case push: Chuck/Press/Value [mm] = 0.2 * t; ...       entries of one of several tests; `scene` may be one
    # left out: ...

One entry at a time differs from its first value; {{NAME: a|b}} of studies varies entries together, here as NAME: a | b. Rows are
group, computed, kind, mean, from, and if known unit, n, sd, low, high. `computed` is a formula of members of summary.json, of
max_NAME, the largest magnitude in a column of the curve, of curve_largest, curve_at and curve_initial_stiffness, of numbers given
above (Implant_Radius) and pi; with cases each begins with CASE_. Kinds: predicted, fitted, consistent.
"""

import collections
import math
import os
import pathlib
import re

import _debond
import pandas
from scipy import stats

from . import study
from .errors import InputError, shortened
from .files import make_directory, say, write_json, write_whole
from .page import write_page
from .page_data import curve_file, read_json, short

Setting = collections.namedtuple("Setting", "kind entry unit value why")
NEEDED, COLUMNS = ("title", "source", "read", "scene"), ("group", "computed", "kind", "mean", "from")
OPTIONAL, KINDS = ("unit", "n", "sd", "low", "high"), ("predicted", "fitted", "consistent")
CHECKS = ("largest_energy_defect", "largest_reaction_defect", "error_estimate", "wall_seconds")
VARIED, FIXED = ("assumed", "numerical"), ("taken", "fitted")
SETTING = re.compile(r"([^=\[;]*[^=\[; ])\s*(?:\[([^\]]+)\])?\s*=\s*([^;]*[^; ])\s*;\s*(\S.*)")


class Rig:
    """A rig as it was read: texts of its header, settings, rows. Raises InputError."""

    def __init__(self, path):
        self.path, self.texts, self.settings, head = pathlib.Path(path), {}, [], 0
        for head, line in enumerate(self.path.read_text(encoding="utf-8").splitlines()):
            if not line.startswith("#"):
                break
            self._read(head + 1, *(part.strip() for part in line[1:].partition(":")[::2]))
        missing = [key for key in NEEDED if not self.texts.get(key)]
        if missing:
            raise InputError(f"{path}: expected a line '# {missing[0]}: ...' at the top")
        self.rows = pandas.read_csv(path, skiprows=head, dtype=str, keep_default_na=False, skipinitialspace=True)
        for name in [*COLUMNS, *self.rows]:
            if name not in self.rows or name not in COLUMNS + OPTIONAL:
                raise InputError(f"{path}:{head + 1}: column {name}: expected {', '.join(COLUMNS)}, and perhaps {', '.join(OPTIONAL)}")
        self.rows, self.first_line = self.rows.reindex(columns=[*COLUMNS, *OPTIONAL], fill_value=""), head + 2
        self.cases = list(dict.fromkeys(one.kind for one in self.settings if one.kind.startswith("case "))) or [""]
        for i, row in self.rows.iterrows():
            self._check(i, row)

    def _read(self, number, key, text):
        if key not in (*VARIED, *FIXED) and not key.startswith("case "):
            self.texts[key] = "\n".join(filter(None, (self.texts.get(key), text)))
            return
        match = SETTING.fullmatch(text)
        if not match:
            raise InputError(f"{self.path}:{number}: '{shortened(text)}': expected Section/Entry [unit] = value; where it is from, or why")
        self.settings.append(Setting(key, *(part or "" for part in match.groups())))

    def _check(self, i, row):
        if row["kind"] not in KINDS:
            self.refuse(i, "kind", f"expected {', '.join(KINDS)}")
        if not row["from"].strip():
            self.refuse(i, "from", "expected where the number was read, or the word assumed")
        # arithmetic alone: rigs come from others
        if not re.fullmatch(r"(?:[\w\s+*/()-]|(?<=\d)\.(?=\d))+", row["computed"]):
            self.refuse(i, "computed", "expected a formula of names, numbers, + - * / and brackets")
        for name in ("mean", *OPTIONAL[1:]):
            if row[name] and not re.fullmatch(r"-?\d+(\.\d+)?(e-?\d+)?", row[name]):
                self.refuse(i, name, "expected a number, or nothing")

    def refuse(self, i, column, why):
        raise InputError(f"{self.path}:{self.first_line + i}: {column} = '{shortened(self.rows.loc[i, column])}': {why}")

    def scene(self, case):
        named = [one.value for one in self.settings if one.kind == case and one.entry == "scene"]
        return os.path.normpath(self.path.parent / (named or [self.texts["scene"]])[-1])

    def given(self, case):
        """Settings of a case, the last of an entry alone."""
        return {name_of(one.entry): one for one in self.settings if one.kind in (*FIXED, *VARIED, case) and one.entry != "scene"}


def name_of(entry):
    return " / ".join(map(str.strip, entry.split("/")))


def plain(name):
    """Of an entry as formulas have it."""
    return re.sub(r"\W+", "_", name)


def run(rig, case, directory, options):
    """Runs a case; a row for each variant, with all that formulas may name. Raises RunError."""
    given = rig.given(case)
    changes = [f"{name}={'{{' + one.value + '}}' if one.kind in VARIED else one.value}" for name, one in given.items()]
    study.main(rig.scene(case), {**options, "--check": False, "--threads": 0, "--set": [
        *changes, f"Output/Directory={directory}", "Expert/Study/Factors varied at once=1", "Expert/Output/Console=quiet"]})
    table, more = pandas.read_csv(f"{directory}/study.csv"), []
    for number in table["variant"]:
        variant = f"{directory}/variant-{number:03d}"
        curve = {f"curve_{name}": value for name, value in (read_json(variant + "/summary.json").get("curve") or {}).items()}
        more.append({**pandas.read_csv(curve_file(variant)).abs().max().add_prefix("max_"), **curve})
    fixed = {name: float(one.value) for name, one in given.items() if re.fullmatch(r"[\d.]+(e-?\d+)?", one.value)}
    table = pandas.concat([table.assign(**fixed), pandas.DataFrame(more)], axis=1)
    return table.rename(columns=plain).add_prefix(case[5:] + "_" if case else "")


def computed(rig, table):
    """Of each row what it is in each variant."""
    values = []
    for i, row in rig.rows.iterrows():
        try:
            values.append(table.eval(row["computed"].strip(), engine="python") + 0 * table.iloc[:, 0])
        except (NameError, SyntaxError, TypeError, ValueError) as error:
            rig.refuse(i, "computed", f"cannot be computed: {error}")
    return pandas.DataFrame(values).reset_index(drop=True)


def published(row):
    """Ends of what the source leaves open: as given, else the 95 % interval of the mean, else half a unit of the last digit."""
    if row["low"] and row["high"]:
        return float(row["low"]), float(row["high"])
    mean, half = float(row["mean"]), 0.5 * 10.0 ** -len(row["mean"].partition(".")[2])
    if row["sd"] and int(row["n"] or 0) > 1:
        half = stats.t.ppf(0.975, int(row["n"]) - 1) * float(row["sd"]) / int(row["n"]) ** 0.5
    return mean - half, mean + half


def compared(rig, values):
    """The rows with the computed band and a verdict."""
    rows = rig.rows.assign(nominal=values[0], least=values.min(axis=1), most=values.max(axis=1)).to_dict("records")
    for row in rows:
        row["verdict"], row["published"] = "not published", None
        if row["mean"]:
            row["published"] = low, high = published(row)
            meets = low <= row["most"] and row["least"] <= high
            row["verdict"] = "missed" if not meets else row["kind"] + ", in a wide band" * (row["most"] > 2 * row["least"])
    return rows


def moved_by(setting, values, table):
    """The largest relative change of a result when this setting alone is not the first of its values; None if it never is."""
    column = next(name for name in table if name.endswith(plain(name_of(setting.entry))))
    alone = [i for i, value in enumerate(table[column]) if value != table[column][0]]
    return float((values[alone].div(values[0], axis=0) - 1).abs().max().max()) if alone else None


def main(path, options):
    """The command."""
    rig, out = Rig(path), options.pop("--out") or os.path.join("output", "bench", pathlib.Path(path).stem)
    make_directory(out)
    tables = [run(rig, case, os.path.join(out, case[5:] or "runs"), options) for case in rig.cases]
    if len(set(map(len, tables))) > 1:
        raise InputError(f"{path}: a case sets an entry that varies: expected the same variants in all cases")
    table = pandas.concat(tables, axis=1).assign(pi=math.pi)
    values = computed(rig, table)
    rows = compared(rig, values)
    settings = [{**one._asdict(), "moved": moved_by(one, values, table) if one.kind in VARIED else None} for one in rig.settings]
    known = {name_of(one.entry) for one in rig.settings}
    others = {entry.name: entry.value for case in rig.cases for entry in _debond.read_file(rig.scene(case))
              if entry.name not in known and re.search(r"\d", entry.value) and entry.name.partition(" ")[0] in ("Bone", "Implant", "Interface", "Chuck")}
    checks = {name: float(table.filter(regex=name + "$").max().max()) for name in CHECKS}
    write_json(os.path.join(out, "bench.json"), {**rig.texts, "rows": rows, "settings": settings, "others": others, "checks": checks,
                                                 "cases": [[case[5:] or "runs", rig.scene(case), len(table)] for case in rig.cases]})
    write_whole(os.path.join(out, "bench.csv"), pandas.DataFrame(rows).drop(columns="published").to_csv(index=False))
    write_page(out)
    for row in rows:
        say(f"{row['group']}: published {row['mean'] or '-'}, computed {short(row['nominal'])} ({short(row['least'])} to "
            f"{short(row['most'])}) {row['unit']}: {row['verdict']}")
    say(f"Open {out}/report.html in a browser")
