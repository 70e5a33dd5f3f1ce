"""Looks at what open_results.py makes of quarter.prm with elastic bodies: check_opened.py RESULTS PICTURES TEXT STATE

Pictures, the lines about them, and the state, which must open again and give the same picture."""

import csv
import glob
import math
import os
import sys

sys.dont_write_bytecode = True
source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../doc/paraview")
sys.path.insert(0, source)
from open_results import run_with_a_screen

if not os.environ.get("DISPLAY"):
    sys.exit(run_with_a_screen())
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

results, pictures, text, state = sys.argv[1:]
YELLOW, VIOLET, WHITE = (0xFD, 0xE7, 0x25), (0x44, 0x01, 0x54), (255, 255, 255)
R = 2.5  # mm
failed = False


def expect(what, found, expected, tolerance=0.):
    global failed
    if isinstance(expected, (tuple, list)):
        good = len(found) == len(expected) and all(abs(f - e) <= tolerance for f, e in zip(found, expected))
    else:
        good = found == expected
    print("%s: %s" % (what, "yes" if good else "NO, %s instead of %s" % (found, expected)))
    failed = failed or not good


class Picture:
    def __init__(self, name):
        reader = vtkPNGReader()
        reader.SetFileName(name)
        reader.Update()
        image = reader.GetOutput()
        self.width, self.height = image.GetDimensions()[:2]
        self.pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(self.height, self.width, -1)[:, :, :3].astype(int)

    def face(self, column, row, x, y):
        """Colour of a point [mm] of one of the four faces; row 0 is the upper one. The height of each is 1.55 diameters."""
        i = self.width * (0.5 + (column + 0.5) / 4) + x / (1.55 * 2 * R) * self.height / 2
        j = self.height * (0.75 - 0.5 * row) + y / (1.55 * 2 * R) * self.height / 2
        return tuple(self.pixels[round(j), round(i)])

    def share_near(self, colour, columns, rows):
        """Of a part of the picture, given by shares of its width and height, from the lower left corner."""
        part = self.pixels[round(rows[0] * self.height):round(rows[1] * self.height),
                           round(columns[0] * self.width):round(columns[1] * self.width)]
        return float((abs(part - colour).max(axis=2) <= 8).mean())

    def number_of_colours(self, columns):
        part = self.pixels[:, round(columns[0] * self.width):round(columns[1] * self.width)]
        return len(set(map(tuple, part[::4, ::4].reshape(-1, 3) // 16)))


def values_of_files(series, array):
    """Smallest and largest, straight from the files; of a vector its length."""
    low, high = math.inf, -math.inf
    for name in sorted(glob.glob(os.path.join(results, series + "-*.vtu")))[1:]:  # the first one has not been pressed yet
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(name)
        reader.Update()
        ends = reader.GetOutput().GetPointData().GetArray(array).GetRange(-1 if array == "traction_MPa" else 0)
        low, high = min(low, ends[0]), max(high, ends[1])
    return low, high


# ------------------------------------------------------------------------------------------------------ degrees, lines

with open(os.path.join(results, "torque.csv")) as file:
    rows = [row for row in csv.DictReader(file) if float(row["time"]) in (1, 1.1, 2)]
angles = [float(row["angle_deg"]) for row in rows]
expect("angles", angles, [0, 0.4, 4], 1e-9)
labels = ["angle %.2f°   torque %.1f N mm" % (angle, round(float(row["torque_Nmm"]), 1) + 0) for angle, row in zip(angles, rows)]
with open(text, encoding="utf-8") as file:
    lines = file.read().splitlines()
names = [line.split(": ", 1)[0] for line in lines[1:]]
expect("names", " ".join(map(os.path.basename, names)), "view-0001.png view-0002.png view-0003.png")
expect("lines", "\n".join(line.split(": ", 1)[1] for line in lines[1:]), "\n".join(labels))

# ------------------------------------------------------------------------------------------------------ pictures

at_rest, first, last = (Picture(os.path.join(pictures, "view-%04d.png" % i)) for i in (1, 2, 3))
expect("size", (last.width, last.height), (960, 540))
expect("corner", last.face(0, 0, -1.2 * R, 0), WHITE)
# phi: the quarter with x > 0 and y > 0 is bonded, at 0.4 degrees still all of it
for name, picture, x, y, colour in (("at rest, bonded", at_rest, 1.2, 1.2, YELLOW), ("at rest, left", at_rest, -1.2, 1.2, VIOLET),
                                    ("0.4 degrees, bonded", first, 1.2, 1.2, YELLOW), ("0.4 degrees, right and down", first, 1.2, -1.2, VIOLET),
                                    ("4 degrees, bond broken", last, 1.2, 1.2, VIOLET)):
    expect("phi, " + name, picture.face(0, 0, x, y), colour, 4)
    expect("mu, " + name, picture.face(1, 0, x, y), colour, 4)
# arrows are black and in the last face only, and there are none at rest
for name, picture, some in (("at rest", at_rest, False), ("at 4 degrees", last, True)):
    expect("arrows " + name, picture.share_near((0, 0, 0), (0.78, 0.97), (0.12, 0.4)) > 0.01, some)
expect("arrows on pressure", last.share_near((0, 0, 0), (0.53, 0.72), (0.12, 0.4)) > 0.01, False)
# bodies: some third of their half, in many colours
expect("bodies are seen", 0.2 < 1 - last.share_near(WHITE, (0, 0.5), (0.1, 0.85)) < 0.8, True)
expect("stress has colours", last.number_of_colours((0, 0.5)) > 40, True)

# ------------------------------------------------------------------------------------------------------ the state

simple.LoadState(state)
interface, bulk = simple.FindSource("interface"), simple.FindSource("bulk")
for source in (interface, bulk):
    source.UpdatePipelineInformation()
    expect("times are degrees", list(source.TimestepValues), angles, 1e-9)
for field, series, ends in (("phi", None, (0, 1)), ("phi_0", None, (0, 1)), ("mu", None, (0.4, 0.58)),
                            ("slip_mm", "interface", None), ("pressure_MPa", "interface", None), ("von_Mises_MPa", "bulk", None)):
    points = list(simple.GetColorTransferFunction(field).RGBPoints)
    low, high = ends or values_of_files(series, field)
    low = 0 if field == "von_Mises_MPa" else low
    expect("colours of " + field, (points[0], points[-4]), (low, high), 2e-5 * abs(high))
colours = simple.GetColorTransferFunction("state")
expect("categories", "%d %s" % (colours.InterpretValuesAsCategories, " ".join(a.strip() for a in colours.Annotations)),
       "1 0 open 1 stick 2 slip")
annotation = simple.FindSource("angle and torque")
for angle, label in zip(angles, labels):
    annotation.UpdatePipeline(angle)
    expect("annotation", servermanager.Fetch(annotation).GetRowData().GetAbstractArray(0).GetValue(0).strip(), label)

# tractions on the implant are against its rotation; the longest arrow is 1.5 times as long as they are apart
traction = simple.FindSource("traction there")
traction.UpdatePipeline(4.)
places = servermanager.Fetch(traction)
against = [y * t[0] - x * t[1] for (x, y, _), t in (
    (places.GetPoint(i), places.GetPointData().GetArray("traction_MPa").GetTuple3(i)) for i in range(places.GetNumberOfPoints()))
    if math.hypot(x, y) < 2.2]
expect("number of arrows", len(against) > 80, True)
expect("tractions resist", min(against) > -1e-6 and max(against) > 1, True)
expect("length of arrows", (simple.FindSource("tangential traction").ScaleFactor * values_of_files("interface", "traction_MPa")[1],),
       (1.5 * 2 * R / 13,), 1e-3)
# surfaces: normals at points for smooth shading
for name in ("bone, smooth", "implant, smooth"):
    surface = simple.FindSource(name)
    surface.UpdatePipeline(4.)
    expect(name, surface.PointData["Normals"] is not None and surface.GetDataInformation().GetNumberOfCells() > 0, True)

# the expressions of doc/howto/paraview.md sum points up to what the program says
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../doc/howto/paraview.md"), encoding="utf-8") as file:
    expressions = [line.strip().replace("%.6g", "%.9g") for line in file if line.startswith('"')]
points = simple.PVDReader(FileName=os.path.join(results, "points.pvd"))
annotation = simple.PythonAnnotation(Input=points, ArrayAssociation="Point Data")
sums = []
for row in rows:
    for annotation.Expression in expressions:
        annotation.UpdatePipeline(float(row["time"]))
        sums.append(float(servermanager.Fetch(annotation).GetRowData().GetAbstractArray(0).GetValue(0).split(" N")[0].split()[-1]))
expect("sums of points", sums, [float(row[name]) for row in rows for name in ("torque_Nmm", "chuck_Fx_N")], 1e-6 * float(rows[1]["torque_Nmm"]))

layout = list(simple.GetLayouts().values())[0]
layout.SetSize(1920, 1080)
simple.GetAnimationScene().AnimationTime = 4.
again = os.path.join(pictures, "again.png")
simple.SaveScreenshot(again, layout, ImageResolution=[960, 540], OverrideColorPalette="", SeparatorWidth=0)
different = float((abs(Picture(again).pixels - last.pixels).max(axis=2) > 8).mean())
expect("the same picture", different < 0.002, True)

# without taking views down, at which ParaView may fail
sys.stdout.flush()
os._exit(failed)
