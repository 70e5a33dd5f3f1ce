#!/usr/bin/env python3
"""The gallery of the site: runs the scenes of prm, draws each in doc/gallery/NAME.png and writes doc/gallery/index.md.

    doc/gallery.py                  all scenes, one after the other: half an hour
    doc/gallery.py SCENE.prm ...    these
    doc/gallery.py --list           the page only, from the scenes and from doc/gallery/scenes.csv, with the seconds of the runs

A run that takes longer than --limit seconds is ended there; the page says how far it came. The program is that of the
variable DEBOND, or build/release/debond. Needs NumPy and Matplotlib.
"""

import argparse
import csv
import glob
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

# not doc, whose numbers.py would hide the module of this name, which NumPy needs
sys.path[0] = os.path.join(os.path.dirname(__file__), "..", "python")
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap  # noqa: E402
from PIL import Image  # noqa: E402

from debond.page_data import curve_file, rows_file  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
GALLERY = os.path.join(ROOT, "doc", "gallery")
FACTS = os.path.join(GALLERY, "scenes.csv")
FACT_NAMES = ["scene", "seconds", "ended", "curves", "map", "note"]
# what other scenes include or compare with, and the scene that a table of specimens fills in
NO_SCENES = re.compile(r"(_scenes?|_reference|/template|prm/coin)\.prm$")
FOLDERS = {  # in this order
    "prm": "First scenes", "prm/tutorial": "Tutorial", "prm/paper": "The paper", "prm/adhesion": "Bonds with strength in tension",
    "prm/shapes": "Shapes", "prm/cad": "Implants from CAD", "prm/bone": "Bone that gives way", "prm/bench": "Published tests",
    "prm/heterogeneous": "Bone that varies", "prm/calibrate": "Fits", "prm/studies": "Studies",
    "prm/stability": "Stability", "prm/verification": "Verification"}
VIRIDIS = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"]  # as in doc/style.gp
BLUES = ["#f7fbff", "#deebf7", "#c6dbef", "#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#084594"]
MAPS = {"phi": ("bonding state φ", VIRIDIS), "pressure_MPa": ("pressure, MPa", BLUES)}
BLUE, RED, GREY = "#0072b2", "#d55e00", "#999999"


def scenes():
    found = glob.glob(os.path.join(ROOT, "prm", "**", "*.prm"), recursive=True)
    # the main scene and its variants first
    names = sorted((os.path.relpath(path, ROOT) for path in found), key=lambda name: (not name.startswith("prm/coin_mode3"), name))
    return [name for name in names if not NO_SCENES.search(name)]


def lines_of(scene):
    with open(os.path.join(ROOT, scene), encoding="utf-8") as file:
        return file.read().splitlines()


def title_of(scene):
    for line in lines_of(scene):
        match = re.match(r"\s*set Title\s*=\s*(.*?)\s*(#.*)?$", line)
        if match:
            return match[1]
    return os.path.basename(scene)[:-len(".prm")].replace("_", " ").capitalize()


def sentences_of(scene, at_most=2, characters=300):
    """The first sentences of the comment that the scene begins with."""
    text = []
    for line in lines_of(scene):
        words = line[1:].strip()
        if not line.startswith("#") or re.match(r"(let|expect|(slow )?run [^ :]+|wrong|refused|failed):|--set ", words):
            break
        if re.match(r"#\s{3,}|#\s*[-*] ", line) and text or not words and text:
            break  # a table, a list or the next paragraph
        text.append(words)
    sentences = re.split(r"(?<=[.:])(?<!Eq\.)(?<!Eqs\.)(?<!Fig\.)(?<!Figs\.)(?<!al\.)(?<!e\.g\.)(?<!i\.e\.)\s+(?=[A-Z])", " ".join(text))
    told = ""
    for sentence in sentences[:at_most]:
        if told and len(told) + len(sentence) > characters:
            break
        told += " " + sentence
    told = re.sub(r"[:,;]$", ".", told.strip())
    if told and told[-1] not in ".!?":
        told += "."
    told = re.sub(r"`([^`']*)'", r"'\1'", told)
    told = re.sub(r"([*<>$\[\]])", r"\\\1", told)
    told = re.sub(r"\bdoc/([\w/]+\.md)", link_to_page, told)
    return re.sub(r"(?<![\w/`.])((?:prm|doc|tests|source)/[\w/.]*\w)", r"`\1`", told)


def link_to_page(match):
    """The title of a page that a scene names, as a link."""
    with open(os.path.join(ROOT, "doc", match[1]), encoding="utf-8") as file:
        return f"[{file.readline()[1:].strip()}](../{match[1]})"


def table_of(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = rows[0]
    return {name: [row[i] for row in rows[1:] if len(row) == len(names)] for i, name in enumerate(names)}


def numbers_of(values):
    return np.array([float(value or "nan") for value in values])


UNITS = re.compile(r"^(.*)_(mm|N|Nmm|deg|MPa|rad)$")
SYMBOLS = {"angle_deg": "angle, degrees", "torque_Nmm": "torque, N mm", "time": "time", "position": "position", "load": "load"}
for _axis in "xyz":
    SYMBOLS.update({f"chuck_u{_axis}_mm": f"$u_{_axis}$, mm", f"chuck_F{_axis}_N": f"$F_{_axis}$, N",
                    f"chuck_r{_axis}_deg": f"rotation about {_axis}, degrees", f"chuck_M{_axis}_Nmm": f"$M_{_axis}$, N mm"})


def label_of(name):
    match = UNITS.match(name)
    return SYMBOLS.get(name) or (f"{match[1].replace('_', ' ')}, {match[2].replace('Nmm', 'N mm')}" if match else name.replace("_", " "))


def curve_of(directory):
    """-> names of the axes, x, y: the torque over the angle or, without one, that motion of the chuck that does most of the work"""
    table = table_of(curve_file(directory))
    best = (0, "angle_deg", "torque_Nmm")
    pairs = [("angle_deg", "torque_Nmm", np.pi / 180)]
    pairs += [(f"chuck_u{axis}_mm", f"chuck_F{axis}_N", 1) for axis in "xyz"]
    pairs += [(f"chuck_r{axis}_deg", f"chuck_M{axis}_Nmm", np.pi / 180) for axis in "xy"]
    for x, y, factor in pairs:
        if x in table and y in table:
            q, force = numbers_of(table[x]), numbers_of(table[y])
            work = np.nansum(abs((force[1:] + force[:-1]) / 2 * np.diff(q))) * factor
            best = max(best, (work, x, y))
            if x == "angle_deg" and np.ptp(q) > 0 and np.nanmax(abs(force)) > 1e-6:
                break
    _, x, y = best
    if len(table[x]) < 2:
        raise ValueError("no curve in " + directory)
    return (x, y), numbers_of(table[x]), numbers_of(table[y])


def map_of(directory):
    """-> quantity, event, x, y and values: of phi at the end, or where it varies most; of pressure, where phi does not vary"""
    path = os.path.join(directory, "maps.csv")
    if not os.path.exists(path):
        return None
    table = table_of(path)
    events = list(dict.fromkeys(table["event"]))
    if not events:
        return None
    of_event = np.array(table["event"])
    x_name, y_name = list(table)[4:6]

    def values_of(name, event):
        return numbers_of(np.array(table[name])[of_event == event])

    def spread(event):
        phi = values_of("phi", event)
        phi = phi[np.isfinite(phi)]
        return np.percentile(phi, 98) - np.percentile(phi, 2) if len(phi) else 0
    event = events[-1]
    if spread(event) < 0.2:
        event = max(reversed(events), key=spread)
    quantity = "phi"
    if spread(event) < 0.2:
        quantity = "pressure_MPa"
        sizes = {name: np.max(np.nan_to_num(abs(values_of(quantity, name))), initial=0) for name in events}
        event = [name for name in events if sizes[name] >= 0.3 * max(sizes.values())][-1]
    x, y, values = (values_of(name, event) for name in (x_name, y_name, quantity))
    if not np.isfinite(values).any():
        return None
    xs, ys = np.unique(x), np.unique(y)
    grid = np.full((len(ys), len(xs)), np.nan)
    grid[np.searchsorted(ys, y), np.searchsorted(xs, x)] = values
    for lines in (grid, grid.T):  # points of long cells lie further apart than those of the map: lines between them are empty
        full = np.flatnonzero(np.isfinite(lines).any(axis=1))
        for i in range(full[0], full[-1]):
            if i not in full:
                lines[i] = lines[full[np.argmin(abs(full - i))]]
    return quantity, event, xs, ys, grid


def draw_map(axes, found):
    quantity, event, xs, ys, grid = found
    name, colours = MAPS[quantity]
    if quantity == "phi":
        low, high = 0, 1
    else:
        low, high = min(0, np.nanmin(grid)), max(0, np.nanmax(grid))  # tension is below zero
    axes.set_aspect("equal")
    mesh = axes.pcolormesh(xs, ys, grid, cmap=LinearSegmentedColormap.from_list(quantity, colours), vmin=low, vmax=high if high > low else low + 1,
                           shading="nearest", rasterized=True)
    bar = axes.figure.colorbar(mesh, ax=axes, fraction=0.05, pad=0.03)
    bar.ax.tick_params(labelsize=7)
    bar.locator = matplotlib.ticker.MaxNLocator(4)
    bar.update_ticks()
    axes.set_axis_off()
    axes.set_title(name, fontsize=8)


def with_map(directory, variants, program, limit):
    """Variants of a study have no maps: the last of them that can be is run once more, alone. -> its number and results"""
    for path in reversed(variants):
        summary = summary_of(path)
        if summary.get("dofs") and summary.get("wall_seconds", limit) < limit:
            alone = os.path.join(directory, "alone")
            subprocess.run([program, os.path.join(path, "parameters.prm"), "--set", f"Output/Directory={alone}",
                            "--set", "Output/Report=true"], cwd=ROOT,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=4 * limit)
            return int(path.rsplit("-", 1)[-1]), alone
    return 0, ""


def draw(scene, directory, variants, of_map=(0, "")):
    """-> what the curves and the map are"""
    fits = sorted(glob.glob(os.path.join(directory, "fit*.csv")))
    runs = variants or [directory]
    curves = []
    if not fits:
        for run in runs:
            try:
                curves.append(curve_of(run))
            except (OSError, ValueError, IndexError):
                continue
        if not curves:
            return None
    found = None
    found = map_of(of_map[1] or runs[-1]) if runs else None
    figure = plt.figure(figsize=(4.8, 2.0), dpi=100, layout="constrained")
    if found:
        axes, face = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.25, 1]})
        draw_map(face, found)
    else:
        axes = figure.subplots()
    plt.rc("font", size=8)
    if fits:
        for path in fits:
            table = table_of(path)
            names = list(table)
            x = numbers_of(table[names[0]])
            measured = next(name for name in names if name.endswith("_measured"))
            fitted = next(name for name in names if name.endswith("_fitted"))
            axes.plot(x, numbers_of(table[measured]), ".", color=GREY, markersize=2, rasterized=True)
            axes.plot(x, numbers_of(table[fitted]), color=RED, linewidth=1.2)
        axis_names = (names[0], measured[:-len("_measured")])
        told = f"{label_of(axis_names[1])} over {label_of(axis_names[0])}: fit (line) and the curve that it is for (points)"
    else:
        # of variants with different axes those that most have
        axis_names = max((curve[0] for curve in curves), key=[curve[0] for curve in curves].count)
        curves = [curve for curve in curves if curve[0] == axis_names]
        many = LinearSegmentedColormap.from_list("variants", VIRIDIS[:7])
        for i, (_, x, y) in enumerate(curves):
            colour = BLUE if len(curves) == 1 else many(i / (len(curves) - 1))
            # few rows are points on a line
            axes.plot(x, y, color=colour, linewidth=1.4 if len(curves) < 12 else 0.6, marker="." if len(x) < 8 else None)
        told = f"{label_of(axis_names[1])} over {label_of(axis_names[0])}".replace("$", "")
        if len(curves) > 1:
            told += f" of {len(curves)} variants"
    axes.set_xlabel(label_of(axis_names[0]), fontsize=8)
    axes.set_ylabel(label_of(axis_names[1]), fontsize=8)
    axes.tick_params(labelsize=7)
    axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5))
    axes.yaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5))
    axes.grid(color="#dddddd", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    path = os.path.join(GALLERY, picture_of(scene))
    figure.savefig(path)
    plt.close(figure)
    with Image.open(path) as picture:
        picture = picture.convert("RGB").quantize(96, dither=Image.Dither.NONE)
    picture.save(path, optimize=True)
    map_told = ""
    if found:
        event = re.sub(r"^.* and ", "", found[1])  # of several at once the last
        map_told = f"{MAPS[found[0]][0].replace(', MPa', '')}, {event}"
        if of_map[0]:
            map_told += f" (variant {of_map[0]})"
    return told, map_told


def picture_of(scene):
    return scene[len("prm/"):-len(".prm")].replace("/", "_") + ".png"


def summary_of(directory):
    try:
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def run(scene, program, limit):
    """-> the facts of the scene, whose picture is drawn"""
    directory = tempfile.mkdtemp(prefix="gallery_")
    results = os.path.join(directory, "results")
    start = time.monotonic()
    with open(os.path.join(directory, "log"), "w+", encoding="utf-8") as log:
        process = subprocess.Popen([program, scene, "--set", f"Output/Directory={results}"], cwd=ROOT, stdout=log,
                                   stderr=subprocess.STDOUT)
        ended = ""
        try:
            process.wait(limit)
        except subprocess.TimeoutExpired:
            ended = "limit"
            process.send_signal(signal.SIGTERM)  # it ends after the step at work
            try:
                process.wait(60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        seconds = time.monotonic() - start
        log.seek(0)
        said = log.read()
    if not ended and process.returncode:
        ended = f"exit code {process.returncode}"
    variants = sorted(glob.glob(os.path.join(results, "variant-*")))
    n_variants = len(variants)
    match = re.search(r"^(\d+) variants", said, re.M)
    if match:
        n_variants = int(match[1])
    note = ""
    if ended == "limit":
        done = [path for path in variants if summary_of(path) and "interrupt" not in summary_of(path).get("reason", "")]
        if n_variants and done:
            variants = done
            note = f"Drawn from {len(done)} of {n_variants} variants." if len(done) < n_variants else ""
        elif n_variants:
            variants = [path for path in variants if os.path.exists(rows_file(path))][:1]
            note = f"Drawn from a part of the first of {n_variants} variants."
        else:
            note = "Drawn from the first part of the run."
    elif ended:
        note = f"The run ends with {ended}."
    told = draw(scene, results, variants, with_map(directory, variants, program, limit))
    if told is None:
        note = {"limit": "Nothing is drawn: the first result takes longer."}.get(ended, "Nothing is drawn: the run has no curve.")
        told = ("", "")
    if ended and ended != "limit":
        print(said[-600:])
    shutil.rmtree(directory)
    return dict(zip(FACT_NAMES, [scene, f"{seconds:.2g}" if seconds < 100 else f"{seconds:.0f}", ended, *told, note]))


def read_facts():
    try:
        with open(FACTS, encoding="utf-8") as file:
            return {row["scene"]: row for row in csv.DictReader(file)}
    except FileNotFoundError:
        return {}


def write_facts(facts):
    with open(FACTS, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, FACT_NAMES, lineterminator="\n")
        writer.writeheader()
        writer.writerows(facts[scene] for scene in sorted(facts))


def anchor_of(heading):
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def write_page(facts):
    listed = [scene for scene in scenes() if scene in facts]
    folders = sorted({os.path.dirname(scene) for scene in listed},
                     key=lambda folder: (list(FOLDERS).index(folder) if folder in FOLDERS else len(FOLDERS), folder))
    lines = ["# Gallery", "",
             f"Here you find the scene that is nearest to your test: {len(listed)} scenes of the folder `prm`, each with the command that",
             "runs it, most with curve and contact face. `doc/gallery.py` runs them and writes this page.", "",
             "Seconds are those of a run on two cores that other programs shared. A longer run was ended after about the time that",
             "the page tells, and the picture shows as much as there was by then. Of maps, that of the bonding state is at the end of the",
             "run or, where it is uniform there, at an event before; where it never varies over the face, the pressure is shown.", ""]
    for folder in folders:
        of_folder = [scene for scene in listed if os.path.dirname(scene) == folder]
        heading = FOLDERS.get(folder, folder)
        lines.append(f"- [{heading}](#{anchor_of(heading)}): {len(of_folder)} in `{folder}`")
    for folder in folders:
        lines += ["", f"## {FOLDERS.get(folder, folder)}"]
        for scene in (scene for scene in listed if os.path.dirname(scene) == folder):
            fact = facts[scene]
            lines += ["", f"### {title_of(scene)}", ""]
            if sentences_of(scene):
                lines += [sentences_of(scene), ""]
            if fact["curves"]:
                lines += [f"![{'; '.join(filter(None, (fact['curves'], fact['map'])))}]({picture_of(scene)})", ""]
            seconds = f"More than {float(fact['seconds']):.0f} s." if fact["ended"] == "limit" else f"{fact['seconds']} s."
            shown = f"Map: {fact['map']}." if fact["map"] else ""
            lines += [" ".join(filter(None, (seconds, fact["note"], shown))), "",
                      "```text", f"build/release/debond {scene}", "```"]
    with open(os.path.join(GALLERY, "index.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE.prm")
    parser.add_argument("--list", action="store_true", help="write the page only")
    parser.add_argument("--limit", type=float, default=60, help="seconds of a run")
    arguments = parser.parse_args()
    os.makedirs(GALLERY, exist_ok=True)
    program = os.path.abspath(os.environ.get("DEBOND", os.path.join(ROOT, "build", "release", "debond")))
    facts = {scene: fact for scene, fact in read_facts().items() if scene in scenes()}
    if not arguments.list:
        for scene in arguments.scenes or scenes():
            facts[scene] = run(scene, program, arguments.limit)
            print(scene, facts[scene]["seconds"], facts[scene]["note"], flush=True)
            write_facts(facts)
    write_facts(facts)
    write_page(facts)
    for name in os.listdir(GALLERY):  # of scenes that are gone
        if name.endswith(".png") and name not in map(picture_of, facts):
            os.remove(os.path.join(GALLERY, name))


if __name__ == "__main__":
    main()
