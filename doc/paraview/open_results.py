"""Opens the results of a run in ParaView: both bodies, and beside them the contact face.

    pvpython doc/paraview/open_results.py output/coin      # writes output/coin/view.pvsm
    paraview --state=output/coin/view.pvsm                 # opens it
    pvpython doc/paraview/open_results.py output/coin --pictures pictures --angles 1 2 5

Without pvpython:

    DEBOND_RESULTS=output/coin paraview --script=doc/paraview/open_results.py

This file can also be a macro of ParaView (Macros / Import new macro): it then takes the place of the series that is selected
in the pipeline browser, bulk.pvd or interface.pvd.

Left: von Mises stress in both bodies as displaced, cut at y = 0. Right: the contact face from above, through the implant,
with +x to the right and +y up; arrows are the tangential traction on the slave. Colours are the same at all times, also of
fields that are not shown at first. Thin lines are the borders of trilinear cells. ParaView's time is the angle of rotation in
degrees; where the angle turns back, or stands still other than at 0, the number of the file; where nothing rotates, the time
of the scene. The series with these times are written into the directory, as bulk_view.pvd and interface_view.pvd.

pvpython comes with ParaView (Debian: paraview, of 13 python3-paraview; 5.11, 5.13). Where there is no screen, the script draws
on that of xvfb-run (Debian: xvfb).
"""

import argparse
import csv
import itertools
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

# Name on the colour bar, the ends of its scale where they do not depend on the data, and what it is.
FIELDS = {
    "mu": ("μ", None, None, "friction coefficient mu"),
    "phi": ("φ", 0, 1, "bonding state phi"),
    "phi_0": ("φ₀", 0, 1, "bonding degree phi_0"),
    "slip_mm": ("gₛ [mm]", 0, None, "sliding distance [mm]"),
    "pressure_MPa": ("p [MPa]", None, None, "pressure [MPa]"),
    "gap_mm": ("gₙ [mm]", None, None, "normal gap [mm]"),
    "state": ("state", 0, 3, "contact state"),
    "left_by_opening": ("d", 0, 1, "what opening (mixed mode: damage) has left of the bond"),
    "left_by_slip": ("s", 0, 1, "what slip has left of the bond"),
    "mode_deg": ("ψ [°]", 0, 90, "angle of the traction to the normal [deg]"),
}
FACES = ["phi", "mu", "pressure_MPa", "state"]  # what is opened
STATES = {"open": "#d8d8d8", "stick": "#fde725", "slip": "#6fb3bf", "pulled": "#b5367a"}  # the last with strength in tension only
ARROWS = 13  # of the traction across the implant
MOST_CELLS = 100000  # of a body whose cells have borders
# A colour map for each quantity, as in doc/style.gp. Pressure below zero is tension: white is zero then.
BOND = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"]
SLIP = ["#ffffe5", "#fff7bc", "#fee391", "#fec44f", "#fe9929", "#ec7014", "#cc4c02", "#8c2d04"]
PRESSURE = ["#f7fbff", "#deebf7", "#c6dbef", "#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#084594"]
TENSION = ["#fff5f0", "#fee0d2", "#fcbba1", "#fc9272", "#fb6a4a", "#ef3b2c", "#cb181d", "#99000d"]
STRESS = ["#0d0887", "#5302a3", "#8b0aa5", "#b83289", "#db5c68", "#f48849", "#febd2a", "#f0f921"]
PALETTES = {"slip_mm": SLIP, "pressure_MPa": PRESSURE, "gap_mm": PRESSURE, "von_Mises_MPa": STRESS}
GREY, BONE, IMPLANT = "#555555", "#e3d5b0", "#b9c4cf"
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # knows Greek; without it fields go by their plain names
# Oblique view of the bodies: towards the camera, to the right and up in the picture.
TOWARDS, RIGHT, UP = (0.30, -0.85, 0.43), (0.943, 0.333, 0), (-0.143, 0.405, 0.903)


class Mistake(Exception):
    """Something about the command line or the results that the user can put right."""


class Frame:
    """One file of interface.pvd, that of bulk.pvd, and their row of the run: angle [deg], torque [N mm], forces [N]."""

    def __init__(self, name, bulk, row):
        self.name, self.bulk = name, bulk
        self.time, self.angle, self.torque = (row[column] for column in ("time", "angle_deg", "torque_Nmm"))
        self.axial_force, self.shear_force = row["force_N"], math.hypot(row["chuck_Fx_N"], row["chuck_Fy_N"])

    def turns(self):
        return abs(self.angle) > 1e-9


def read_frames(directory):
    """Files of the series, in their order."""
    if not os.path.isdir(directory):
        raise Mistake("%s: there is no such directory" % directory)
    faces, bulks, table, forces = (os.path.join(directory, name)
                                   for name in ("interface.pvd", "bulk.pvd", "torque.csv", "reactions.csv"))
    if not os.path.isfile(faces):
        raise Mistake("%s: no interface.pvd there; it is written by finite elements with Output / Fields every above 0"
                      % directory)
    try:
        with open(forces if os.path.isfile(forces) else table) as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        files = [[(float(file.get("timestep")), os.path.join(directory, file.get("file")))
                  for file in xml.etree.ElementTree.parse(series).iter("DataSet")] for series in (faces, bulks)]
    except (OSError, KeyError, TypeError, ValueError, xml.etree.ElementTree.ParseError) as error:
        raise Mistake("%s: interface.pvd, bulk.pvd, or torque.csv or reactions.csv, cannot be read: %s" % (directory, error))
    if not rows or not files[0]:
        raise Mistake("%s: interface.pvd, torque.csv or reactions.csv holds nothing yet" % directory)
    frames, row = [], 0
    for (time, name), (_, bulk) in zip(*files):
        for file in (name, bulk):
            if not os.path.isfile(file):
                raise Mistake("%s: named in interface.pvd or bulk.pvd but not there" % file)
        # rows come in the order of the files: on a path of equilibrium the time may fall and pass a value again
        row = min(range(row, len(rows)), key=lambda k: abs(rows[k]["time"] - time))
        frames.append(Frame(name, bulk, rows[row]))
    return frames


def read_title(directory):
    """Of the scene, or an empty text."""
    try:
        with open(os.path.join(directory, "parameters.prm")) as file:
            return next((line.split("=", 1)[1].strip() for line in file if line.startswith("set Title")), "")
    except OSError:
        return ""


def even_choice(frames, by_time, number=5):
    """Angles (or times) that have files, at most @p number, the first and the last among them."""
    values = sorted({frame.time if by_time else round(frame.angle, 9) for frame in frames})
    number = min(number, len(values))
    return [values[round(i * (len(values) - 1) / max(1, number - 1))] for i in range(number)]


def choose(frames, wanted, by_time, directory):
    """The frame at each wanted angle or time; of several at one angle the last."""
    chosen = []
    for value in wanted:
        frame = min(reversed(frames), key=lambda f: abs((f.time if by_time else f.angle) - value))
        found = frame.time if by_time else frame.angle
        if abs(found - value) > 0.01 * abs(value) + 1e-6:
            there = ", ".join("%.4g" % v for v in sorted({f.time if by_time else f.angle for f in frames}))
            raise Mistake("%s: no file at %s %.4g; there are %s. A phase of Load steps / Times that ends there makes one "
                          "(doc/howto/paraview.md)" % (directory, "time" if by_time else "angle", value, there))
        chosen.append(frame)
    return chosen


def rgb(colour):
    return [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def round_numbers(low, high, most=6):
    """A few multiples of 1, 2 or 5 times a power of ten, at most so many."""
    step = 10 ** math.floor(math.log10(high - low))
    step = next(step * part for part in (0.1, 0.2, 0.5, 1, 2, 5) if (high - low) / (step * part) < most)
    numbers = range(math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6) + 1)
    return [min(max(step * i, low), high) for i in numbers]


def scale_of(field, ranges):
    """Both ends of the colours of a field whose values in each file lie in @p ranges."""
    low, high = FIELDS[field][1:3]
    low = min(r[0] for r in ranges) if low is None else low
    high = max(r[1] for r in ranges) if high is None else high
    if high - low <= 1e-5 * max(abs(low), abs(high)):  # one value everywhere, but for rounding
        room = 0.5 * abs(low) or 1
        low, high = low - room, high + room
    # values are single precision: 0.40000001 is 0.4
    return float("%.6g" % low), float("%.6g" % high)


def colour_points(field, low, high):
    """Values and their colours, from the lowest to the highest value."""
    def spread(low, high, palette):
        return [(low + (high - low) * i / (len(palette) - 1), colour) for i, colour in enumerate(palette)]
    if field == "pressure_MPa" and low < 0:
        largest = max(-low, high)  # equal colours on both sides are equally far from zero
        both = spread(-largest, 0, TENSION[::-1])[:-1] + spread(0, largest, PRESSURE)
        inner = [point for point in both if low < point[0] < high]
        return [(low, mixed(both, low))] + inner + [(high, mixed(both, high))]
    return spread(low, high, PALETTES.get(field, BOND))


def mixed(points, value):
    """The colour of a value between points."""
    for (a, first), (b, second) in zip(points, points[1:]):
        if value <= b:
            t = (value - a) / (b - a)
            return "#" + "".join("%02x" % round(255 * (p + (q - p) * t)) for p, q in zip(rgb(first), rgb(second)))
    return points[-1][1]


def set_colours(colours, field, scale, fields=()):
    """Of a ParaView colour function; @p fields are those that there are."""
    colours.AutomaticRescaleRangeMode = "Never"
    if field == "state":
        colours.InterpretValuesAsCategories = 1
        states = list(STATES.items())[:4 if "mode_deg" in fields else 3]
        colours.Annotations = sum(([str(i), " " + name] for i, (name, _) in enumerate(states)), [])
        colours.IndexedColors = sum((rgb(colour) for _, colour in states), [])
    else:
        colours.ColorSpace = "RGB"
        colours.RGBPoints = sum(([value] + rgb(colour) for value, colour in colour_points(field, *scale)), [])


def run_with_a_screen():
    """Runs this script again under xvfb-run: Debian's ParaView crashes without a screen."""
    if not shutil.which("xvfb-run"):
        raise Mistake("there is no screen to draw on, and no xvfb-run (Debian package xvfb) to make one")
    # a server that resets itself when pvpython closes its first connection may refuse the next one
    return subprocess.call(["xvfb-run", "-a", "-s", "-noreset", "pvpython"] + sys.argv)


# ------------------------------------------------------------------------------------------------------ what is opened


def moments(frames):
    """Pairs of ParaView's time and a frame, see above. Of the files at an angle of 0 the last one is shown."""
    turning = [frame.turns() for frame in frames]
    shown = frames[max(0, turning.index(True) - 1):] if any(turning) else frames
    times = [frame.angle if any(turning) else frame.time for frame in shown]
    if any(later <= time for time, later in zip(times, times[1:])):
        return list(enumerate(frames))
    return list(zip(times, shown))


def pieces(file):
    """The .vtu files of a file of the series."""
    if file.endswith(".vtu"):
        return [file]
    return [os.path.join(os.path.dirname(file), piece.get("Source")) for piece in xml.etree.ElementTree.parse(file).iter("Piece")]


def write_series(directory, name, files):
    """A list of files for ParaView's PVD reader; @p files are pairs of time and name. It names the pieces of several ranks
    themselves: ParaView 5.11 may crash on what it has read through a .pvtu file."""
    path = os.path.join(directory, name)
    with open(path, "w") as text:
        text.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n')
        for time, file in files:
            for part, piece in enumerate(pieces(file)):
                text.write('    <DataSet timestep="%.12g" part="%d" file="%s"/>\n' % (time, part, os.path.basename(piece)))
        text.write("  </Collection>\n</VTKFile>\n")
    return os.path.abspath(path)


class Body:
    """Smooth surface of one body, cut at y = 0, and the borders of its trilinear cells."""

    def __init__(self, both, number, name):
        body = simple.Threshold(registrationName=name, Input=both, Scalars=["POINTS", "body"], ThresholdMethod="Between",
                                LowerThreshold=number - 0.5, UpperThreshold=number + 0.5)
        body.UpdatePipeline()
        information = body.GetDataInformation()
        self.bounds = information.GetBounds()
        # cells do not share points: without joining them each would have a surface of its own
        joined = simple.CleantoGrid(registrationName=name + ", joined", Input=body)
        surface = self.surface(joined, name, 2)
        self.smooth = simple.GenerateSurfaceNormals(registrationName=name + ", smooth", Input=surface, FeatureAngle=40)
        self.borders = None
        if information.GetNumberOfCells() <= MOST_CELLS:
            self.borders = simple.FeatureEdges(
                registrationName=name + ", borders of cells", Input=self.surface(body, name + ", cells", 1),
                BoundaryEdges=0, NonManifoldEdges=0, FeatureAngle=40)

    def surface(self, source, name, level):
        cut = simple.Clip(registrationName=name + ", cut", Input=source, ClipType="Plane", Invert=0)
        cut.ClipType.Origin, cut.ClipType.Normal = [0, 1e-4, 0], [0, 1, 0]
        return simple.ExtractSurface(registrationName=name + ", surface", Input=cut, NonlinearSubdivisionLevel=level)


class Opened:
    """Sources and views of one directory."""

    def __init__(self, directory, fields):
        frames = read_frames(directory)
        self.moments, self.fields = moments(frames), fields
        self.largest_angle = max(abs(frame.angle) for frame in frames)
        self.read(directory)
        name = read_title(directory) or os.path.basename(os.path.abspath(directory))
        self.layout = simple.CreateLayout("debond: " + name[:30])
        self.views = [simple.CreateView("RenderView", UseColorPaletteForBackground=0, Background=[1, 1, 1],
                                        OrientationAxesVisibility=0, CameraParallelProjection=1)
                      for _ in range(1 + len(fields))]
        self.arrange()
        self.show_bodies(self.views[0])
        self.show_texts(self.views[0], name)
        for view, field in zip(self.views[1:], fields):
            self.show_face(view, field)
        for number, view in enumerate(self.views[2:]):
            simple.AddCameraLink(self.views[1], view, "contact face %d" % number)
        simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
        self.show(self.moments[-1][0])
        simple.SetActiveView(self.views[1])
        simple.SetActiveSource(self.face)

    def label(self, frame):
        if self.largest_angle > 1e-9:
            decimals = max(2, 2 - math.floor(math.log10(self.largest_angle)))
            # + 0 makes 0 of -0
            return "angle %.*f°   torque %.1f N mm" % (decimals, round(frame.angle, decimals) + 0, round(frame.torque, 1) + 0)
        return "time %.4g   axial force %.2f N   shear force %.2f N" % (
            frame.time, round(frame.axial_force, 2) + 0, frame.shear_force)

    # -------------------------------------------------------------------------------------------- sources

    def read(self, directory):
        bulk, interface = (
            simple.PVDReader(registrationName=name, FileName=write_series(directory, name + "_view.pvd", files))
            for name, files in (("bulk", [(time, frame.bulk) for time, frame in self.moments]),
                                ("interface", [(time, frame.name) for time, frame in self.moments])))
        self.read_ranges(bulk, interface)
        displaced = {"Vectors": ["POINTS", "displacement"], "ScaleFactor": 1}
        if any(frame.bulk.endswith(".pvtu") for _, frame in self.moments):
            bulk = simple.MergeBlocks(registrationName="pieces, joined", Input=bulk, MergePoints=0)
        both = simple.WarpByVector(registrationName="bodies, displaced", Input=bulk, **displaced)
        self.bodies = [Body(both, number, name) for number, name in enumerate(("bone", "implant"))]
        self.bounds = self.bodies[1].bounds
        self.face = self.near(simple.WarpByVector(registrationName="contact face, displaced", Input=interface, **displaced))
        joined = simple.CleantoGrid(registrationName="contact face, joined", Input=self.face)
        self.border = simple.FeatureEdges(
            registrationName="contact face, border", FeatureEdges=0, NonManifoldEdges=0, ManifoldEdges=0,
            Input=simple.ExtractSurface(registrationName="contact face, surface", Input=joined))
        if self.largest_traction > 0:
            self.arrows = self.make_arrows()

    def near(self, face):
        """What is seen of the face, which may be that of a bone much wider than the implant."""
        face.UpdatePipeline(self.moments[0][0])
        wide = face.GetDataInformation().GetBounds()
        low, high = self.bounds[0:4:2], self.bounds[1:4:2]
        room = 0.1 * max(b - a for a, b in zip(low, high))
        if all(a - room <= b for a, b in zip(low, wide[0:4:2])) and all(a + room >= b for a, b in zip(high, wide[1:4:2])):
            return face
        part = simple.Clip(registrationName="contact face, near the implant", Input=face, ClipType="Box")
        part.ClipType.Position = [a - room for a in low] + [wide[4] - room]
        part.ClipType.Length = [b - a + 2 * room for a, b in zip(low, high)] + [wide[5] - wide[4] + 2 * room]
        return part

    def read_ranges(self, *readers):
        """Colour scales that hold at all times, and the largest traction."""
        ranges = {}
        for time, _ in self.moments:
            for reader in readers:
                reader.UpdatePipeline(time)
                for array in reader.PointData:
                    ranges.setdefault(array.Name, []).append(array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0))
        for field in self.fields:
            check_is_there(field, ranges)
        self.scales = {field: scale_of(field, ranges[field]) for field in FIELDS if field in ranges}
        self.has_stress = max(high for _, high in ranges["von_Mises_MPa"]) > 0
        self.scales["von_Mises_MPa"] = 0, max(high for _, high in ranges["von_Mises_MPa"]) or 1
        self.largest_traction = max(high for _, high in ranges["traction_MPa"])
        for field, scale in self.scales.items():
            set_colours(simple.GetColorTransferFunction(field), field, scale, ranges)

    def make_arrows(self):
        """On a square grid, above the face. The largest traction of all times is half as long again as the grid is wide."""
        flat = simple.Transform(registrationName="contact face, flat", Input=self.face)
        flat.Transform.Scale = [1, 1, 0]
        x0, x1, y0, y1 = self.bounds[:4]
        spacing = (x1 - x0) / ARROWS
        low, x1, y1 = [x0 + spacing / 2, y0 + spacing / 2, 0], x1 - spacing / 2, y1 - spacing / 2
        grid = simple.Plane(registrationName="places of arrows", Origin=low, Point1=[x1, low[1], 0], Point2=[low[0], y1, 0],
                            XResolution=ARROWS - 1, YResolution=round((y1 - low[1]) / spacing))
        points = simple.ResampleWithDataset(registrationName="traction there", SourceDataArrays=flat, DestinationMesh=grid)
        traction = ["POINTS", "traction_MPa"]
        arrows = simple.Glyph(registrationName="tangential traction", Input=points, GlyphType="Arrow", GlyphMode="All Points",
                              OrientationArray=traction, ScaleArray=traction,
                              ScaleFactor=1.5 * spacing / self.largest_traction)
        arrows.GlyphType.TipLength, arrows.GlyphType.TipRadius, arrows.GlyphType.ShaftRadius = 0.4, 0.13, 0.035
        arrows.GlyphTransform.Translate = [-0.5, 0, 0]
        return arrows

    # -------------------------------------------------------------------------------------------- views

    def arrange(self):
        """Bodies on the left half; faces on the right half, four of them in two columns."""
        left = self.layout.SplitHorizontal(0, 0.5)
        places, n = [left], len(self.fields)
        if n == 4:
            right = self.layout.SplitHorizontal(left + 1, 0.5)
            columns = [self.layout.SplitVertical(column, 0.5) for column in (right, right + 1)]
            places += [upper + row for row in (0, 1) for upper in columns]
        else:
            rest = left + 1
            for i in range(n - 1):
                places.append(self.layout.SplitVertical(rest, 1 / (n - i)))
                rest = places[-1] + 1
            places.append(rest)
        for view, place in zip(self.views, places):
            self.layout.AssignView(place, view)

    def show_bodies(self, view):
        for body, colour in zip(self.bodies, (BONE, IMPLANT)):
            shown = simple.Show(body.smooth, view)
            if self.has_stress:
                self.colour_by(shown, "von_Mises_MPa")
            else:
                shown.ColorArrayName = [None, ""]
                shown.AmbientColor = shown.DiffuseColor = rgb(colour)
            shown.Ambient, shown.Diffuse, shown.Specular = 0.7, 0.35, 0
            if body.borders:
                self.show_lines(view, body.borders, 0.5)
        if self.has_stress:
            self.show_bar(view, "von_Mises_MPa").Title = "von Mises stress [MPa]"
        # what is seen of them, as they are cut in half
        boxes = [(b[:2], (max(b[2], 0), b[3]), b[4:]) for b in (body.bounds for body in self.bodies)]
        corners = [corner for box in boxes for corner in itertools.product(*box)]
        right, up = ([sum(a * b for a, b in zip(corner, axis)) for corner in corners] for axis in (RIGHT, UP))
        centre = [(min(right) + max(right)) / 2 * r + (min(up) + max(up)) / 2 * u for r, u in zip(RIGHT, UP)]
        # in half of a picture of 16 : 9
        height = max((max(up) - min(up)) / 0.72, (max(right) - min(right)) / 0.88 * 9 / 8)
        self.look(view, centre, TOWARDS, [0, 0, 1], height)

    def show_texts(self, view, name):
        self.show_text(view, simple.Text(registrationName="title", Text=name), min(26, 1500 // len(name)))
        texts = ["\n" + self.label(frame) for _, frame in self.moments]  # below the title
        self.show_text(view, simple.PythonAnnotation(
            registrationName="angle and torque", Input=self.face, ArrayAssociation="Point Data",
            Expression="%r[abs(numpy.array(t_steps) - t_value).argmin()]" % texts), 30)

    def show_face(self, view, field):
        shown = simple.Show(self.face, view)
        self.colour_by(shown, field)
        shown.Ambient, shown.Diffuse, shown.Specular = 1, 0, 0  # colours as on the colour bar
        self.show_lines(view, self.border)
        name = FIELDS[field][3]
        if self.largest_traction > 0 and field == ("state" if "state" in self.fields else self.fields[0]):
            arrows = simple.Show(self.arrows, view, Position=[0, 0, 1])
            colour = [0, 0, 0] if field == "state" or field in PALETTES else [1, 1, 1]
            arrows.ColorArrayName, arrows.AmbientColor, arrows.Ambient, arrows.Diffuse = [None, ""], colour, 1, 0
            name += "\narrows: up to %.3g MPa" % self.largest_traction
        self.show_text(view, simple.Text(registrationName="name of " + field, Text=name), 24)
        self.show_bar(view, field)
        x0, x1, y0, y1 = self.bounds[:4]
        view.InteractionMode = "2D"
        self.look(view, [(x0 + x1) / 2, (y0 + y1) / 2, 0], [0, 0, 1], [0, 1, 0], 1.55 * max(x1 - x0, y1 - y0))

    def look(self, view, point, towards, up, height):
        view.CameraFocalPoint, view.CameraPosition = point, [p + 100 * t for p, t in zip(point, towards)]
        view.CameraViewUp, view.CameraParallelScale = up, height / 2

    def colour_by(self, shown, field):
        shown.ColorArrayName, shown.LookupTable = ("POINTS", field), simple.GetColorTransferFunction(field)
        shown.InterpolateScalarsBeforeMapping = int(field != "state")

    def show_lines(self, view, source, opacity=1):
        line = simple.Show(source, view)
        line.ColorArrayName, line.AmbientColor, line.DiffuseColor = [None, ""], rgb(GREY), rgb(GREY)
        line.Ambient, line.Diffuse, line.LineWidth, line.Opacity = 1, 0, 2, opacity

    def show_text(self, view, source, size):
        shown = simple.Show(source, view)
        shown.WindowLocation, shown.FontSize, shown.Color = "Upper Center", size, [0, 0, 0]
        shown.Justification, shown.LineSpacing = "Center", 1.2

    def show_bar(self, view, field):
        bar = simple.GetScalarBar(simple.GetColorTransferFunction(field), view)
        bar.Visibility, bar.Title, bar.ComponentTitle, bar.Orientation = 1, "", "", "Horizontal"
        bar.WindowLocation, bar.ScalarBarLength, bar.ScalarBarThickness = "Lower Center", 0.6, 18
        bar.LabelFontSize, bar.TitleFontSize, bar.LabelColor, bar.TitleColor = 24, 24, [0, 0, 0], [0, 0, 0]
        bar.DrawScalarBarOutline, bar.ScalarBarOutlineColor = 1, rgb(GREY)
        if field != "state":
            bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels = 1, round_numbers(*self.scales[field], most=4), 0
            bar.AutomaticLabelFormat, bar.LabelFormat = 0, "%g"
        return bar

    def show(self, time):
        simple.GetAnimationScene().AnimationTime = time
        for view in self.views:
            view.ViewTime = time


# ------------------------------------------------------------------------------------------------- pvpython, ParaView


def check_fields(option, fields):
    for field in fields:
        if field not in FIELDS:
            raise Mistake("%s %s: there is no such field; allowed are %s" % (option, field, ", ".join(FIELDS)))


def check_is_there(field, known):
    if field not in known:
        raise Mistake("%s: these results do not have it: their law has no strength in tension" % field)


def read_arguments():
    parser = argparse.ArgumentParser(prog="open_results.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", metavar="DIR", help="directory with results")
    parser.add_argument("--state", metavar="FILE.pvsm", help="for ParaView (default: view.pvsm in DIR)")
    parser.add_argument("--pictures", metavar="DIR2", help="make a picture at each angle, view-NNNN.png in DIR2")
    parser.add_argument("--angles", nargs="+", type=float, metavar="DEG", help="only of the files at these angles [deg]")
    parser.add_argument("--fields", nargs="+", default=FACES, metavar="FIELD",
                        help="of the contact face, up to four: %s (default: %s)" % (", ".join(FIELDS), " ".join(FACES)))
    parser.add_argument("--width", type=int, default=1920, help="of a picture [pixels]; the height is 9/16 of it")
    arguments = parser.parse_args()
    check_fields("--fields", arguments.fields)
    if len(set(arguments.fields)) != len(arguments.fields) or len(arguments.fields) > 4:
        raise Mistake("--fields %s: allowed are up to four different ones" % " ".join(arguments.fields))
    if arguments.state and not arguments.state.endswith(".pvsm"):
        raise Mistake("--state %s: the name has to end in .pvsm" % arguments.state)
    if not 200 <= arguments.width <= 16000:
        raise Mistake("--width %d: allowed are 200 to 16000 pixels" % arguments.width)
    return arguments


def import_paraview():
    global simple  # not at the top: it takes seconds, and mistakes are to be named at once
    import paraview

    paraview.compatibility.major, paraview.compatibility.minor = 5, 12  # names of later versions differ
    from paraview import simple
    simple._DisableFirstRenderCameraReset()


def in_pvpython():
    arguments = read_arguments()
    frames = read_frames(arguments.directory)
    if arguments.angles:
        frames = choose(frames, arguments.angles, False, arguments.directory)
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        sys.exit(run_with_a_screen())
    import_paraview()
    opened = Opened(arguments.directory, arguments.fields)
    opened.layout.SetSize(1920, 1080)  # that of the window; pictures scale it, texts as well
    size = [arguments.width, round(arguments.width * 9 / 16)]
    state = arguments.state or os.path.join(arguments.directory, "view.pvsm")
    simple.SaveState(state)
    print("%s: to be opened by paraview --state=%s" % (state, state))
    if arguments.pictures:
        os.makedirs(arguments.pictures, exist_ok=True)
        for time, frame in opened.moments:
            if frame.name in [wanted.name for wanted in frames]:
                opened.show(time)
                number = re.search("[0-9]+", os.path.basename(frame.name))[0]
                picture = os.path.join(arguments.pictures, "view-%s.png" % number)
                simple.SaveScreenshot(picture, opened.layout, ImageResolution=size, OverrideColorPalette="",
                                      SeparatorWidth=0)
                print("%s: %s" % (picture, opened.label(frame)))


def in_paraview():
    import_paraview()
    directory = os.environ.get("DEBOND_RESULTS")
    if not directory:
        source = simple.GetActiveSource()
        names = source.GetProperty("FileName") if source else None
        if not names:
            raise Mistake("open the interface.pvd of a run, or set the environment variable DEBOND_RESULTS to its directory")
        directory = os.path.dirname(str(names[0]))
        simple.Delete(source)  # its times are others
    Opened(directory, FACES)
    simple.RenderAllViews()


if __name__ == "__main__":
    try:
        # ParaView gives its scripts no name
        is_command = os.path.basename(sys.argv[0]) == "open_results.py"
        in_pvpython() if is_command else in_paraview()
    except Mistake as mistake:
        if is_command:
            sys.exit("open_results.py: %s" % mistake)
        print("open_results.py: %s" % mistake, file=sys.stderr)  # to exit would end ParaView
