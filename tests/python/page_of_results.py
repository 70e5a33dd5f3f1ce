"""page_of_results.py DEBOND SCRATCH: pages of runs, studies, ensembles and calibrations, against the files of results.

Ends with 1 and a message at the first thing that is wrong. Needs Jinja2; with Chromium it also moves the mouse over a curve.
"""

import base64
import csv
import html
import json
import math
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import zlib

here = os.path.dirname(os.path.abspath(__file__))
package = os.path.join(here, "..", "..", "python")
program = os.path.abspath(sys.argv[1])
scene = os.path.join(here, "page_of_results.prm")


def check(is_so, message):
    if not is_so:
        sys.exit(f"page_of_results: {message}")


def simulate(directory, *settings, code=0):
    """Runs the scene with other entries into a directory."""
    command = [program, scene]
    for setting in (*settings, f"Output/Directory={directory}"):
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == code, f"{' '.join(command)} ends with {done.returncode}: {done.stderr}")


def make(directory, code=0, limit=None):
    """Makes the page of a directory as users do; what it has said on standard error."""
    path = os.path.join(directory, "report.html")
    if limit is None and os.path.exists(path):
        os.remove(path)
    done = subprocess.run([sys.executable, "-m", "debond", "page", directory], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": package}, preexec_fn=limit and
                          (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))))
    check(done.returncode == code, f"the page of {directory} ends with {done.returncode}, not {code}: {done.stderr}")
    check(done.stdout == "" and done.stderr.count("\n") == (code > 0), f"page of {directory} says: {done.stdout}{done.stderr}")
    return done.stderr


def page(directory):
    make(directory)
    with open(os.path.join(directory, "report.html"), encoding="utf-8") as file:
        text = file.read()
    outside = re.sub(r'(src="data:|http://www.w3.org/2000/svg)[^"]*"', "", text)
    check(not re.search(r"https?:|<link|@import|<script [^>]*src|url\(", outside), f"{directory}: something is from elsewhere")
    check(len(text) < 3e6, f"{directory}: the page has {len(text)} bytes")
    check("nan" not in re.findall(r">([^<>]*)<", outside) and not re.search(r'(\bd|x|y)="[^"]*(nan|inf)', outside),
          f"{directory}: nan")
    return text


def words(text):
    """What a reader sees, with single blanks."""
    text = re.sub(r"(?s)<(script|style)>.*?</\1>", " ", text)
    text = re.sub(r"<sub>(.*?)</sub>", r"_\1", text)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", " ", text)))


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def curves(text):
    """The data that the script of the page reads."""
    return [json.loads(html.unescape(data)) for data in re.findall(r"data-curve='([^']*)'", text)]


def paths(text, kind):
    """Places of the paths of one kind in the coordinates of the area."""
    return [[tuple(map(float, place.split())) for place in re.split("[ML]", path.replace("h.01", ""))[1:]]
            for path in re.findall(rf'<path class="{kind}" [^>]*d="([^"]*)"><title>', text)]


def is_near(a, b, tolerance):
    return abs(float(a) - float(b)) <= tolerance


def curve_is_that_of(text, rows, x, y, which=0, sign=1):
    """Whether data and picture are these columns, of the curve with this number on the page; sign -1: with the other sign."""
    data, line = curves(text)[which], paths(text, "line")[which]
    rows = [{name: sign * float(row[name]) for name in (x, y)} for row in rows]
    series = next(one for one in data["series"] if one["name"] == "debond")
    check(len(series["x"]) == len(line) == len(rows),
          f"{len(rows)} rows, but {len(series['x'])} values and {len(line)} places")
    (left, right), (low, high) = data["x"], data["y"]
    for i, row in enumerate(rows):
        check(math.isclose(series["x"][i], float(row[x]), rel_tol=1e-6, abs_tol=1e-12) and
              math.isclose(series["y"][i], float(row[y]), rel_tol=1e-6),
              f"row {i} of {y} over {x}: {row[x]}, {row[y]}, but read out is {series['x'][i]}, {series['y'][i]}")
        at, up = line[i][0] / data["box"][2], 1 - line[i][1] / data["box"][3]
        check(is_near(left + at * (right - left), row[x], 1e-4 * (right - left)) and
              is_near(low + up * (high - low), row[y], 1e-4 * (high - low)),
              f"row {i} of {y} is drawn at another place: {line[i]}")


def pixels(image):
    """Width and lines of palette indices of a picture, its colours and how opaque they are."""
    data, at, chunks = base64.b64decode(image), 8, {}
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        check(struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + content), f"checksum of {kind}")
        chunks[kind], at = content, at + 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    raw = zlib.decompress(chunks[b"IDAT"])
    check(len(raw) == height * (width + 1), "size of a picture")
    return [raw[j * (width + 1) + 1:(j + 1) * (width + 1)] for j in range(height)], chunks[b"PLTE"], chunks[b"tRNS"]


def figures(text):
    """Quantity, caption, its lowest and highest value, picture of each map, and both ends of the colours."""
    found = []
    one = (r'(?s)src="data:image/png;base64,([^"]*)".*?<span>(.*?)</span> to <span>(.*?)</span>.*?'
           r'<figcaption>(.*?)</figcaption>')
    for heading, part in re.findall(r"(?s)<h3>(.*?)</h3>(.*?)(?=<h3>|<h2>)", text):
        ends = [float(end.split()[0]) for end in re.findall("<b>(.*?)</b>", part)]
        found += [(heading, caption, float(low), float(high.split()[0]), image, ends)
                  for image, low, high, caption in re.findall(one, part)]
    return found


def test_run(directory):
    text = page(directory)
    seen, rows = words(text), table(f"{directory}/torque.csv")
    with open(f"{directory}/summary.json") as file:
        summary = json.load(file)
    largest = summary["T_max_Nmm"] / (math.pi * 2.5**3)
    check(f"strength T/(A R) {largest:.4g} MPa a mean over the face" in seen and "energy to the peak" in seen, "usual reductions")
    curve_is_that_of(text, rows, "angle_deg", "torque_Nmm")
    check("<h1>A &lt;coin&gt; &amp; bone</h1>" in text and "<coin>" not in text, "a title with < and & is not escaped")
    for name, said in (("T_max_Nmm", "largest torque (T_max) {} N mm"),
                       ("initial_stiffness_Nmm_per_rad", "torsional stiffness {} N mm/rad"),
                       ("work_Nmm", "work of the chuck {} N mm"), ("E_bulk_Nmm", "bodies at the end {} N mm"),
                       ("E_interface_Nmm", "interface at the end {} N mm"), ("dissipation_Nmm", "dissipated {} N mm")):
        value = summary[name]
        said = said.format(f"{value:.4g}" if value < 1e4 else round(value))
        check(said in seen, f"the page does not say: {said}")
    check(seen.index("Energies") < seen.index("Contact face"), "energies are not beside the results")
    for remark in summary["remarks"] + summary["warnings"]:
        check(seen.count(remark) == 1, f"said {seen.count(remark)} times: {remark}")
    for said in ("finished", "reference Tₘₐₓ = 53.8 N mm", "reference T∞ = 36.8 N mm", "coin, radius 2.5 mm, height 3 mm",
                 "E = 113000 MPa", "size 12.5 × 12.5 × 5 mm", "0.0049 * min(t, 1)", "10 * max(t - 1, 0)", "Rotation angle [°]",
                 "Torque T [N mm]", "command", summary["provenance"]["commit"]):
        check(said in seen, f"the page does not say: {said}")
    largest = max(rows, key=lambda row: float(row["torque_Nmm"]))
    mark = paths(text, "marks")[0][0]
    data = curves(text)[0]
    check(is_near(data["x"][0] + mark[0] / data["box"][2] * (data["x"][1] - data["x"][0]), largest["angle_deg"], 1e-3),
          "the largest torque is marked at another angle")
    left, top = data["box"][:2]
    label = re.search(r'<g class="label" transform="translate\(([^ ]*) ([^ )]*)\)"[^>]*>'
                      r'(?:<path[^>]*>)?\s*<text [^>]*>largest torque<', text)
    check(label and is_near(label[1], left + mark[0], 0.1) and is_near(label[2], top + mark[1], 0.1), "a label is not at its mark")
    check(set(re.findall('<path class="level" stroke="([^"]*)"', text)) == {"#888888"} and "published" not in seen,
          "reference marks are not grey, or are called published")
    check('class="legend"><li' not in text.split("<h2>Results")[0].replace("\n", ""), "a legend of one curve")
    for term in re.findall(r'href="#(term-[^"]*)"', text):
        check(f'id="{term}"' in text, f"{term} is not in the glossary")
    check(page(directory) == text, "made anew it is another page")
    return text


def values_of_maps(directory):
    """{(quantity, event): values} of maps.csv."""
    found = {}
    for row in table(f"{directory}/maps.csv"):
        for name in ("pressure_MPa", "slip_mm", "phi", "mu", "state"):
            found.setdefault((name, row["event"]), []).append(float(row[name]))
    return found


def test_maps(directory, text):
    # columns, both colours of each, and what its range is
    names = {"Pressure [MPa]": ("pressure_MPa", "f7fbff", "084594", None), "Bonding state φ": ("phi", "440154", "fde725", (0, 1)),
             "Sliding distance gₛ [mm]": ("slip_mm", "ffffe5", "8c2d04", None)}
    values, drawn = values_of_maps(directory), figures(text)
    check(len(drawn) >= 5 and {one[0] for one in drawn} == set(names), f"{len(drawn)} maps")
    for heading, caption, low, high, image, ends in drawn:
        name, first, last, whole = names[heading]
        of_all = [value for (column, _), known in values.items() if column == name for value in known if value == value]
        whole = whole or (0 if name == "slip_mm" else min(of_all), max(of_all))
        check(all(math.isclose(a, b, rel_tol=6e-3) for a, b in zip(ends, whole)) and len(ends) == 2,
              f"{heading}: colours from and to {ends}, not {whole}")
        known = [value for value in values[name, caption.split(": ", 1)[1]] if value == value]
        check(math.isclose(low, min(known), rel_tol=6e-3, abs_tol=1e-12) and math.isclose(high, max(known), rel_tol=6e-3),
              f"{heading}, {caption}: from {low} to {high}, not from {min(known)} to {max(known)}")
        lines, colours, opaque = pixels(image)
        check(len(lines) == len(lines[0]) >= 96, f"{len(lines)} lines of {len(lines[0])} pixels")
        check(colours[:3].hex() == first and colours[3 * 254:3 * 255].hex() == last and opaque[:255] == b"\xff" * 255,
              f"colours of {heading}")
        n, least, most = len(lines), *whole
        dots = [value for line in lines for value in line if value < 255]
        for value, dot in ((min(known), min(dots)), (max(known), max(dots))):
            check(is_near(dot, 254 * (value - least) / (most - least), 8), f"{heading}, {caption}: colour {dot} of {value}")
        jumps = max(abs(line[i] - line[i - 1]) for line in lines[n // 4:3 * n // 4] for i in range(n // 4, 3 * n // 4))
        check(jumps < 100, f"{heading}, {caption}: colours jump by {jumps} of 254 from pixel to pixel")
        # sliding distances grow from the middle outwards
        if heading.startswith("Sliding") and caption.endswith(": end"):
            rim = lines[0][n // 2], lines[n // 2][0], lines[-1][n // 2], lines[n // 2][-1]
            for across in (lines[n // 2], [line[n // 2] for line in lines]):
                flat = sum(a == b for a, b in zip(across, across[1:]))
                check(flat < n // 4, f"{flat} of {n} pixels across the face are as those beside them")
            check(lines[n // 2][n // 2] < 25 and min(rim) > 200, "the sliding distance is not that of a rotation")
    places = sorted({float(row["x_mm"]) for row in table(f"{directory}/maps.csv")})
    for share, length in re.findall(r'<i style="width: (.*?)%"></i>(.*?) mm<', text):
        width = (places[-1] - places[0]) * len(places) / (len(places) - 1)
        check(is_near(float(share) / 100 * width, length, 1e-3 * width), f"{length} mm are {share} % of {width} mm")
    check(text.count('class="length"') == text.count("<figcaption>"), "a map without a scale")
    states = re.findall(r'(?s)src="data:image/png;base64,([^"]*)">\s*<div class="length">[^\n]*\s*<figcaption>(.*?)</figcaption>',
                        text.split("<h3>State</h3>")[1])
    for image, caption in states:
        lines, known = pixels(image)[0], values["state", caption.split(": ", 1)[1]]
        drawn_states = [value for line in lines[::-1] for value in line]
        check(all(a == b or b != b for a, b in zip(drawn_states, known)), f"states at {caption}")
        # all that the page shows of it has a colour: a disk in which no place of the grid ends at the rim
        n = len(lines)
        check(all(value < 255 for j, line in enumerate(lines) for i, value in enumerate(line)
                  if math.hypot(max(abs(i - (n - 1) / 2) - 0.5, 0), max(abs(j - (n - 1) / 2) - 0.5, 0)) < n / 2),
              f"states at {caption}: gaps at the rim")
    check({"sticks", "slides"} <= set(re.findall(r"</svg>(\w+)</li>", text)), "states have no names")
    check(len(re.findall('class="(cells)? ?round"', text)) == len(drawn) + len(states) > len(drawn), "a round face is not round")
    for (name, event), known in values.items():
        if name in ("state", "mu"):
            continue
        heading = next(heading for heading, about in names.items() if about[0] == name)
        known = [value for value in known if value == value]
        is_drawn = any((heading, event) == (one[0], one[1].split(": ", 1)[1]) for one in drawn)
        is_uniform = max(known) - min(known) <= 1e-3 * max(map(abs, known))
        check(not (is_drawn and is_uniform), f"{name} is drawn though it is the same everywhere: {event}")
    check(re.search(r"it is 1 everywhere", words(text)), "no words for a uniform bond")
    check("<h3>Friction coefficient" not in text and "μ is φ on another scale" in text, "a coefficient that is phi has maps")
    check("A cell of one colour is the area of a quadrature point." in text, "what cells are")


def test_small_map(directory):
    """y goes up, and gaps are transparent."""
    with open(f"{directory}/maps.csv", "w") as file:
        file.write("event,step,time,angle_deg,x_mm,y_mm,pressure_MPa,slip_mm,phi,mu\n")
        for y in (-3, -1, 1, 3):
            for x in (-1.5, -0.5, 0.5, 1.5):
                gap = x < -1 and y > 2
                file.write(f"end,3,2,10,{x},{y},{'nan' if gap else y + 4},{'nan' if gap else x + 1.5},{1.0002 if x < y else 1},0.5\n")
    with open(f"{directory}/parameters.prm") as file:
        scene_before = file.read()
    with open(f"{directory}/parameters.prm", "w") as file:
        file.write(scene_before.replace("= modified coulomb", "= rate and state"))
    text = page(directory)
    (*_, up, _), (*_, right, _) = figures(text)
    lines, n = pixels(up)[0], len(pixels(up)[0])
    check(lines[0][0] == 255 and pixels(up)[2][255] == 0, "a gap is filled")
    check(lines[0][n - 1] > 250 and lines[n - 1][0] < 5, "y does not go up")
    check(pixels(right)[0][n - 1][n - 1] > 250 and pixels(right)[0][n - 1][0] < 5, "x does not go right")
    check(' round"' not in text, "a rectangle is round")
    column = [line[n // 2] for line in lines]
    check(all(is_near(a - b, column[n // 2 - 1] - column[n // 2], 1) for a, b in zip(column[2:-2], column[3:-2])),
          f"what is linear between points is not linear in the picture: {column}")
    check("aspect-ratio: 2 / 4" in text, "the face has other proportions")
    check(re.search("Bonding state φ At .*? it is 1 everywhere", words(text)), "no words for phi")
    check(re.search("Friction coefficient μ At .*? it is 0.5 everywhere", words(text)), "no words for a coefficient that is not phi")
    # tension is red, no pressure white, and equal colours are equally far from it
    with open(f"{directory}/maps.csv") as file:
        rows = file.read().replace("end,3,2,10,0.5,-3,1,", "end,3,2,10,0.5,-3,-3.5,")
    with open(f"{directory}/maps.csv", "w") as file:
        file.write(rows)
    text = page(directory)
    heading, _, low, high, image, ends = figures(text)[0]
    colours = pixels(image)[1]
    red, white, blue = (colours[3 * k:3 * k + 3] for k in (0, round(254 * 3.5 / 10.5), 254))
    check((low, high) == tuple(ends) == (-3.5, 7) and min(white) > 250 and blue.hex() == "084594" and red[0] > red[2] + 100,
          f"colours of tension: {red.hex()}, {white.hex()}, {blue.hex()}")
    check("Red is tension." in text, "no words for tension")


def test_reference_and_comparison(directory):
    """The reference that a program left is drawn, and what differs is in a table."""
    rows = table(f"{directory}/torque.csv")
    with open(f"{directory}/reference.csv", "w") as file:
        file.write("angle_deg,torque_Nmm\n")
        file.writelines(f"{row['angle_deg']},{1.1 * float(row['torque_Nmm'])}\n" for row in rows[1:])
    with open(f"{directory}/summary.json") as file:
        summary = json.load(file)
    changed = {"entry": "Chuck / Rotation z / Value", "value": "<script>alert(1)</script>", "unit": "degrees"}
    summary.update(e_mp=0.1, e_rel=0.0912345, difference_mean=0.08, difference_max=0.1, difference_max_deg=0.4,
                   reference_rows_used=30, changed_entries=[changed], warnings=["twice", "twice", "</script><b>"],
                   remarks=["twice"], theta_full_deg=math.nan, W_adh_Nmm=math.inf)
    with open(f"{directory}/summary.json", "w") as file:
        json.dump(summary, file)
    text = page(directory)
    data = curves(text)[0]
    reference = next(one for one in data["series"] if one["name"] == "reference")
    check(len(reference["x"]) == len(rows) - 1, "rows of the reference")
    check(is_near(reference["y"][4], 1.1 * float(rows[5]["torque_Nmm"]), 1e-4), "values of the reference")
    check(len(paths(text, "points")[0]) == len(rows) - 1, "points of the reference")
    check("relative to T_max (e_rel) 9.123 %" in words(text) and "Comparison with the reference" in text, "no comparison")
    check("<script>alert" not in text and "&lt;script&gt;alert" in text, "values are not escaped")
    check("</script><b>" not in text, "warnings are not escaped")
    check(words(text).count("twice") == 1, "a warning comes twice")
    results = words(text).split("Results")[1].split("Contact face")[0]
    check("theta_full" not in results and "W_adh" not in results, "a number that is none is shown")


def test_others():
    simulate("failed", "Interface/Characteristic slip distance=1e-6", code=2)
    text = page("failed")
    with open("failed/summary.json") as file:
        reason = json.load(file)["reason"]
    check("not finished" in text and reason in words(text), "a run that failed does not say why")
    os.makedirs("pull", exist_ok=True)
    open("pull/torque.csv", "w").close()  # as an earlier run with another curve leaves it
    simulate("pull", "Chuck/Rotation z/Value=0", "Chuck/Translation x/Value=0.05 * max(t - 1, 0)")
    check(not os.path.exists("pull/torque.csv"), "the rows of an earlier run stay")
    text = page("pull")
    curve_is_that_of(text, table("pull/reactions.csv"), "chuck_ux_mm", "chuck_Fx_N")
    check("Force along x [N]" in text and "Displacement along x [mm]" in text, "axes of a pull")
    check("largest torque" not in text, "the noise of a torque is shown")
    test_push()
    test_machine()
    simulate("closed", "Model=foundation")
    text = page("closed")
    check("Contact face</h2>" not in text, "a closed form has maps")
    curve_is_that_of(text, table("closed/torque.csv"), "angle_deg", "torque_Nmm")
    simulate("pressed", "Chuck/Rotation z/Value=0", "Chuck/Press/Control=force",
             "Chuck/Press/Value=20 * min(t, 1)")
    check("force [N] = 20 * min(t, 1)" in words(page("pressed")), "load of a run under a force")
    # what an interruption leaves: rows only, the last of them in part
    os.makedirs("at_work", exist_ok=True)
    with open("run/torque.csv") as file, open("at_work/torque.csv", "w") as copy:
        copy.write(file.read()[:-30])
    text = page("at_work")
    check("not finished" in text and len(paths(text, "line")[0]) == len(table("run/torque.csv")) - 1, "a run at work")
    for rows in ("", "step,time,angle_deg,torque_Nmm\n", "step,time,angle_deg,torque_Nmm\n0,0,0,0\n", "a,b\n1,2\n",
                 "step,time,angle_deg,torque_Nmm\n0,0,0,0\n1,1,nan,inf\n2,2,1,-1e300\n"):
        with open("at_work/torque.csv", "w") as file:
            file.write(rows)
        page("at_work")


def test_push():
    """A push runs from left to right, and its events have places in mm."""
    simulate("push", "Chuck/Rotation z/Value=0", "Load steps/Times=0, 1", "Load steps/Steps=5")
    text, rows = page("push"), table("push/reactions.csv")
    curve_is_that_of(text, rows, "chuck_uz_mm", "chuck_Fz_N", sign=-1)
    seen, load = words(text), -float(rows[-1]["chuck_Fz_N"])
    check(load > 0 and curves(text)[0]["x"][0] >= -1e-6, "the curve of a push begins at the right")
    for said in ("Force along −z [N]", "Displacement along −z [mm]", f"largest force along −z {load:.4g} N at 0.0049 mm",
                 f"largest: {load:.4g} N at 0.0049 mm", "0.0049 mm: end"):
        check(said in seen, f"the page of a push does not say: {said}")


def test_machine():
    """Over the angle of a soft machine first, then over that of the implant; dashed to the row with more released energy."""
    simulate("machine", "Chuck/Rotation z/Stiffness=3000", "Interface/Characteristic slip distance=0.005", "Bone/Material=rigid",
             "Interface/Transition factor=0.3", "Implant/Material=rigid")
    text, rows = page("machine"), table("machine/torque.csv")
    for which, x in enumerate(("machine_angle_deg", "angle_deg")):
        curve_is_that_of(text, rows, x, "torque_Nmm", which)
        released = [float(row["released_energy_Nmm"]) for row in rows]
        jumps = [i for i in range(1, len(rows)) if released[i] > released[i - 1]]
        line = paths(text, "line")[which]
        check(len(jumps) == 1 and paths(text, "jump")[which] == [line[jumps[0] - 1], line[jumps[0]]], "a jump is not dashed")
        drawn = re.findall('<path class="line" [^>]*d="([^"]*)"><title>', text)[which]
        check([match.start() for match in re.finditer("M", drawn)] == [0, drawn.index(f"M{line[jumps[0]][0]:.2f} ")],
              "a jump is drawn, too")
    for said in ("Rotation angle of the machine [°]", "Rotation angle of the implant [°]", "Show over rotation angle of the implant"):
        check(said in words(text), f"the page of a soft machine does not say: {said}")
    check(text.count("<div hidden>") == 1, "both axes are seen at once")


def test_campaigns():
    simulate("study", "Interface/Characteristic slip distance={{0.02|1e-6|0.04}}", code=2)
    seen, text = words(page("study")), page("study")
    for said in ("A <coin> & bone: study of 3 variants", "2 of 3 variants are done", "variant 2, Characteristic slip distance = 1e-6",
                 "Characteristic slip distance = 0.04"):
        check(said in seen, f"the page of a study does not say: {said}")
    check(len(paths(text, "line")) == 2 and len(curves(text)[0]["series"]) == 2, "curves of a study")
    row = table("study/study.csv")[2]
    check(re.search(rf"3 0.04 {float(row['T_max_Nmm']):.4g} ", seen), "table of a study")
    simulate("ensemble", "Interface/Bonding/Pattern=random", "Interface/Bonding/Bonded fraction={{0.4|0.7}}",
             "Interface/Bonding/Seed={{1..3}}")
    seen, text = words(page("ensemble")), page("ensemble")
    for row in table("ensemble/ensemble_summary.csv"):
        fraction = row["Interface / Bonding / Bonded fraction"]
        check(f"{fraction} 3 0 {float(row['T_max_mean_Nmm']):.4g} " in seen, "statistics of an ensemble")
        check(f"mean, Bonded fraction = {fraction}" in seen, "groups of an ensemble")
    check(len(paths(text, "line")) == len(re.findall('<path class="band"[^>]*><title>', text)) == 2, "bands")
    check(curves(text)[0]["y"][0] == 0, "the axis does not begin at 0")
    simulate("factors", "Model=foundation", "Interface/Characteristic slip distance={{0.02|0.03}}", "Bone/Young modulus={{15000|16500}}",
             "Implant/Young modulus={{110000|120000}}", "Expert/Study/Factors varied at once=1")
    seen = words(page("factors"))
    for said in ("1 first values", "2 Bone / Young modulus = 16500", "3 Implant / Young modulus = 120000",
                 "4 Characteristic slip distance = 0.03"):
        check(said in seen, f"variants are not named by what differs: {said}")


def test_calibration():
    simulate("calibration", "Interface/Friction coefficient broken=<<mu_b: 0.3 in 0.1..1>>", "Task=calibrate",
             "Interface/Characteristic slip distance=<<a_s: 0.03 in 0.01..0.1>>", "Calibration/Angle offset=0.001",
             "Output/Reference curve=run/torque.csv")
    text = page("calibration")
    with open("calibration/calibration.json") as file:
        results = json.load(file)
    seen, one = words(text), results["unknowns"]["a_s"]
    for said in ("A <coin> & bone: calibration", "Output / Reference curve run/torque.csv",
                 f"a_s Interface / Characteristic slip distance {one['value']:.5g} {one['lower_95']:.5g} to {one['upper_95']:.5g} mm",
                 "Angle offset 0.001 deg given", f"{results['correlations']['a_s | mu_b']:.2g}"):
        check(said in seen, f"the page of a calibration does not say: {said}")
    fit = table("calibration/fit.csv")
    data, rest = curves(text)
    measured = next(one for one in data["series"] if one["name"] == "measured")
    check(all(math.isclose(y, float(row["torque_Nmm_measured"]), rel_tol=1e-6, abs_tol=1e-12)
              for y, row in zip(measured["y"], fit)) and len(measured["y"]) == len(fit), "measured points")
    check(all(is_near(y, float(row["torque_Nmm_measured"]) - float(row["torque_Nmm_fitted"]), 1e-6)
              for y, row in zip(rest["series"][0]["y"], fit)), "residuals")
    check('<path class="band"' in text and "rgba(" in text, "band, colours of correlations")
    # members as not all calibrations have them
    results["unknowns"]["mu_b"].update(told=False)
    results.update(noise=[{"curve": "torque_Nmm", "model": "AR(1)", "sd_over_largest": 0.0123,
                           "correlation_of_neighbours": 0.9, "rows": 100, "effective_rows": 12.5}],
                   cannot_be_told=["the same"], warnings=["the same", "another"],
                   taken_as_known=[{"entry": "Bone / Young modulus", "value": 18000, "unit": "MPa", "change": "10 %",
                                    "effect": {"mu_b": -1.25, "a_s": None}}])
    with open("calibration/calibration.json", "w") as file:
        json.dump(results, file)
    seen = words(page("calibration"))
    for said in (f"mu_b Interface / Friction coefficient broken {results['unknowns']['mu_b']['value']:.5g} cannot be told", "torque_Nmm AR(1) 1.23 % 0.9 100 12.5",
                 "Bone / Young modulus 18000 MPa 10 % -1.2 %"):
        check(said in seen, f"the page of a calibration does not say: {said}")
    check(seen.count("the same") == 1 and "another" in seen, "warnings of a calibration")


def test_refusals_and_disk():
    os.makedirs("nothing", exist_ok=True)
    check("there are no results in 'nothing'" in make("nothing", code=1), "no results")
    check("nowhere" in make("nowhere", code=1), "no directory")
    shutil.copytree("run", "broken", dirs_exist_ok=True)
    with open("broken/summary.json", "w") as file:
        file.write('{"converged": tr')
    check("summary.json cannot be read" in make("broken", code=1), "a file that is no JSON")
    before = page("run")
    said = make("run", code=2, limit=20000)
    check("cannot write run/report.html: File too large" in said, f"full disk: {said}")
    with open("run/report.html", encoding="utf-8") as file:
        check(file.read() == before, "a full disk has changed the page")
    check([name for name in os.listdir("run") if "report" in name] == ["report.html"], "a full disk has left a part of a page")
    os.remove("run/report.html")
    make("run", code=2, limit=20000)
    check(not [name for name in os.listdir("run") if "report" in name], "a full disk has left a part of a page")


def test_cost(directory):
    """Processor time of a page, and what it imports."""
    times = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        make(directory)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
    check(min(times) < 0.6, f"a page needs {min(times):.2f} s; 0.25 s are usual")
    script = ("import sys, debond.page; debond.page.write_page(sys.argv[1]); "
              "print([name for name in ('numpy', 'pandas', 'scipy', 'matplotlib', 'subprocess') if name in sys.modules])")
    done = subprocess.run([sys.executable, "-c", script, directory], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": package})
    check(done.stdout == "[]\n", f"a page imports {done.stdout}{done.stderr}")


BROWSER = """<p id="seen"></p><script>
addEventListener("load", () => {
  const figure = document.querySelector(".curve"), svg = figure.querySelector("svg"), area = svg.querySelector("svg");
  const box = svg.getBoundingClientRect(), data = JSON.parse(figure.dataset.curve), seen = [];
  const scale = box.width / svg.viewBox.baseVal.width;
  svg.setPointerCapture = () => {};
  const kinds = type => type == "wheel" ? WheelEvent : PointerEvent;
  const send = (type, u, kind = "mouse", more = {}) => svg.dispatchEvent(new (kinds(type))(type, {
    clientX: box.left + (data.box[0] + u * data.box[2]) * scale,
    clientY: box.top + (data.box[1] + 0.4 * data.box[3]) * scale, pointerType: kind, button: 0, cancelable: true, ...more }));
  const labels = () => [...svg.querySelectorAll(".label")].filter(one => one.getAttribute("visibility") != "hidden").length;
  const look = () => seen.push(figure.querySelector(".read").textContent, area.getAttribute("viewBox"));
  send("pointermove", 0.5); look();
  send("pointermove", 0.75, "touch"); look();
  const n_labels = labels();
  send("pointerdown", 0.2); send("pointermove", 0.4); send("pointerup", 0.4); look();
  const n_in_range = labels();
  send("dblclick", 0.5); look();
  send("wheel", 0.5, "mouse", { deltaY: -1 }); look();
  send("dblclick", 0.5);
  const finger = (type, u, pointerId) => send(type, u, "touch", { pointerId });
  finger("pointerdown", 0.4, 2); finger("pointerdown", 0.6, 3); finger("pointermove", 0.2, 2); finger("pointermove", 0.8, 3);
  finger("pointerup", 0.2, 2); finger("pointerup", 0.8, 3); look();
  finger("pointerdown", 0.5, 4); finger("pointerup", 0.5, 4); finger("pointerdown", 0.5, 5); look();
  seen.push(document.documentElement.scrollWidth > innerWidth,
            [...document.images].filter(i => !i.complete || !i.naturalWidth).length, n_labels, n_in_range, labels());
  document.getElementById("seen").textContent = JSON.stringify(seen);
});
</script>"""


def test_in_browser(directory):
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if not browser:
        return
    text = page(directory)
    with open("looked-at.html", "w", encoding="utf-8") as file:
        file.write(text + BROWSER)
    done = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=500,900",
                           "--virtual-time-budget=5000", "--dump-dom", f"file://{os.path.abspath('looked-at.html')}"],
                          capture_output=True, text=True)
    hover, all_seen, touch, _, _, zoomed, _, back, _, wheel, _, pinched, _, tapped, is_wide, n_broken, *n_labels = json.loads(
        html.unescape(re.search(r'<p id="seen">(.*?)</p>', done.stdout).group(1)))
    data, rows = curves(text)[0], table(f"{directory}/torque.csv")
    for said, u in ((hover, 0.5), (touch, 0.75)):
        angle, torque = map(float, re.match(r"debond: (.*)°, (.*) N mm$", said).groups())
        check(any(is_near(row["angle_deg"], angle, 1e-5) and is_near(row["torque_Nmm"], torque, 1e-2) for row in rows),
              f"read out: {said}")
        check(is_near(angle, data["x"][0] + u * (data["x"][1] - data["x"][0]), 0.15), f"read out elsewhere: {said}")
    x, _, width, _ = map(float, zoomed.split())
    check(is_near(x, 0.2 * data["box"][2], 0.5) and is_near(width, 0.2 * data["box"][2], 0.5), f"a range of {zoomed}")
    check([*map(float, back.split())] == [0, 0, *data["box"][2:]] == [*map(float, all_seen.split())], "a double click")
    check(is_near(wheel.split()[2], 0.8 * data["box"][2], 0.5), f"the wheel: {wheel}")
    x, _, width, _ = map(float, pinched.split())
    check(is_near(x, data["box"][2] / 3, 0.5) and is_near(width, data["box"][2] / 3, 0.5), f"two fingers: {pinched}")
    check(tapped == back, f"a double tap: {tapped}")
    check(0 < n_labels[1] < n_labels[0] == n_labels[2] == 5, f"labels at all, in a range and at all again: {n_labels}")
    check(not is_wide and n_broken == 0, "the page is wider than the window, or pictures are broken")


def main():
    shutil.rmtree(sys.argv[2], ignore_errors=True)  # of the program as it was before
    os.makedirs(sys.argv[2])
    os.chdir(sys.argv[2])
    simulate("run")
    text = test_run("run")
    test_maps("run", text)
    test_cost("run")
    test_in_browser("run")
    test_others()
    test_campaigns()
    test_calibration()
    test_refusals_and_disk()
    shutil.copytree("run", "changed", dirs_exist_ok=True)
    test_small_map("changed")
    test_reference_and_comparison("changed")
    print("pages are as they should be")


main()
