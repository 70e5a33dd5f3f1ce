"""Pictures of both bodies: the mesh, or the von Mises stress on a cut at y = 0 at several angles.

    pvpython doc/paraview/bodies.py mesh output/coin --output mesh.png
    pvpython doc/paraview/bodies.py stress output/coin --angles 0.5 1.5 --output stress.png

Needs what debonding_front.py needs. Angles are those at which the run wrote files.
"""

import argparse
import os
import sys

from open_results import (BONE, FONT, GREY, IMPLANT, RIGHT, TOWARDS, UP, Mistake, choose, even_choice, pieces, read_frames, rgb,
                          round_numbers, run_with_a_screen, set_colours)

WIDTH = 17.  # of a picture of both bodies [mm]


def read_arguments():
    parser = argparse.ArgumentParser(prog="bodies.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["mesh", "stress"])
    parser.add_argument("directory", metavar="DIR", help="directory with results")
    parser.add_argument("--angles", nargs="+", type=float, metavar="DEG", help="of the stress [deg] (default: two with files)")
    parser.add_argument("--output", metavar="FILE.png", required=True)
    parser.add_argument("--width", type=int, default=1400, help="of the picture [pixels]")
    return parser.parse_args()


class Picture:
    """Columns of both bodies, seen obliquely from above."""

    def __init__(self, columns, width, height, focus, room=0.):
        """Height and focus along the vertical of the picture [mm]; @p room for a colour bar on the right, as part of a column."""
        self.extent = (columns + room) * WIDTH, height
        self.size = [width, round(width * self.extent[1] / self.extent[0])]
        self.view = simple.CreateView("RenderView", ViewSize=self.size, UseColorPaletteForBackground=0, Background=[1, 1, 1],
                                      OrientationAxesVisibility=0, CameraParallelProjection=1)
        # the first column is centred at the origin
        shift = 0.5 * self.extent[0] - 0.5 * WIDTH
        point = [shift * right + focus * up for right, up in zip(RIGHT, UP)]
        self.view.CameraFocalPoint = point
        self.view.CameraPosition = [p + 100 * t for p, t in zip(point, TOWARDS)]
        self.view.CameraViewUp = [0, 0, 1]
        self.view.CameraParallelScale = self.extent[1] / 2

    def show(self, source, column):
        return simple.Show(source, self.view, Position=[column * WIDTH * right for right in RIGHT])

    def show_edges(self, source, column, width):
        shown = self.show(source, column)
        shown.ColorArrayName = [None, ""]
        shown.AmbientColor = shown.DiffuseColor = rgb(GREY)
        shown.Ambient, shown.Diffuse, shown.LineWidth = 1, 0, width

    def show_surface(self, source, column, colour):
        shown = self.show(source, column)
        shown.ColorArrayName = [None, ""]
        shown.AmbientColor = shown.DiffuseColor = rgb(colour)
        shown.Ambient, shown.Diffuse, shown.Specular = 0.45, 0.6, 0

    def text(self, text, x, y):
        """x and y from the lower left corner as parts of the picture."""
        actor = vtkTextActor()
        actor.SetInput(text)
        actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        actor.SetPosition(x, y)
        style = actor.GetTextProperty()
        style.SetFontSize(round(0.021 * self.size[0]))
        style.SetColor(0, 0, 0)
        style.SetJustificationToCentered()
        if os.path.isfile(FONT):
            style.SetFontFamily(4)  # VTK_FONT_FILE
            style.SetFontFile(FONT)
        self.view.GetRenderer().AddActor(actor)

    def title(self, column, text):
        self.text(text, (column + 0.5) * WIDTH / self.extent[0], 0.915)

    def save(self, name):
        simple.SaveScreenshot(name, self.view, ImageResolution=self.size, OverrideColorPalette="")
        print("%s: %d x %d pixels" % (name, *self.size))


def read_bulk(frame):
    readers = [simple.XMLUnstructuredGridReader(FileName=[piece]) for piece in pieces(frame.bulk)]
    return readers[0] if len(readers) == 1 else simple.AppendDatasets(Input=readers)


def body(source, number):
    return simple.Threshold(Input=source, Scalars=["POINTS", "body"], LowerThreshold=number - 0.5,
                            UpperThreshold=number + 0.5, ThresholdMethod="Between")


def edges_of_cells(source):
    """Cells of the model are drawn in pieces. Those of one share points, those of others do not: the surface of each cell
    is closed, and what is sharp in it are its edges."""
    return simple.FeatureEdges(Input=simple.ExtractSurface(Input=source), BoundaryEdges=0, NonManifoldEdges=0, ManifoldEdges=0,
                               FeatureEdges=1, FeatureAngle=40)


def draw_mesh(arguments):
    frames = read_frames(arguments.directory)
    reader = read_bulk(frames[0])
    reader.UpdatePipeline()
    picture = Picture(2, arguments.width, 15.5, -1.2)
    bone, implant = body(reader, 0), body(reader, 1)
    # the implant by itself, its contact face towards the camera
    turned = simple.Transform(Input=implant)
    turned.Transform.Rotate = [-100, 0, 0]
    turned.Transform.Scale = [1.6, 1.6, 1.6]
    turned.Transform.Translate = [0, 0, -2]
    for source, column, colour in ((bone, 0, BONE), (implant, 0, IMPLANT), (turned, 1, IMPLANT)):
        picture.show_surface(simple.ExtractSurface(Input=source), column, colour)
        picture.show_edges(edges_of_cells(source), column, 1.5)
    picture.title(0, "Bone and implant")
    picture.title(1, "Implant, its contact face in front")
    picture.save(arguments.output)


def draw_stress(arguments):
    frames = read_frames(arguments.directory)
    angles = arguments.angles or even_choice(frames, False, 2)
    chosen = choose(frames, angles, False, arguments.directory)
    picture = Picture(len(chosen), arguments.width, 12, 0.2, 0.36)
    readers = [read_bulk(frame) for frame in chosen]
    cuts = [simple.Clip(Input=reader, ClipType="Plane", Invert=0) for reader in readers]
    for cut in cuts:
        cut.ClipType.Origin, cut.ClipType.Normal = [0, 1e-4, 0], [0, 1, 0]
        cut.UpdatePipeline()
    high = max(cut.PointData["von_Mises_MPa"].GetRange()[1] for cut in cuts)
    if high == 0:
        raise Mistake("%s: there is no stress anywhere, as in rigid bodies" % arguments.directory)
    colours = simple.GetColorTransferFunction("von_Mises_MPa")
    set_colours(colours, "von_Mises_MPa", (0, high))
    for column, (cut, frame) in enumerate(zip(cuts, chosen)):
        shown = picture.show(simple.ExtractSurface(Input=cut), column)
        shown.ColorArrayName, shown.LookupTable = ("POINTS", "von_Mises_MPa"), colours
        shown.InterpolateScalarsBeforeMapping = 1
        shown.Ambient, shown.Diffuse, shown.Specular = 1, 0, 0  # colours as on the colour bar
        picture.show_edges(simple.Outline(Input=body(cut, 0)), column, 1)
        picture.title(column, "%.4g°" % frame.angle)
    bar = simple.GetScalarBar(colours, picture.view)
    bar.Visibility, bar.Title, bar.ComponentTitle, bar.WindowLocation = 1, "", "", "Any Location"
    bar.Position, bar.ScalarBarLength = [1 - 0.27 * WIDTH / picture.extent[0], 0.15], 0.62
    bar.ScalarBarThickness, bar.LabelFontSize = round(0.015 * picture.size[0]), round(0.021 * picture.size[0])
    bar.LabelColor, bar.TextPosition = [0, 0, 0], "Ticks right/top, annotations left/bottom"
    bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels = 1, round_numbers(0, high), 0
    bar.AutomaticLabelFormat, bar.LabelFormat = 0, "%g"
    picture.text("von Mises\nstress [MPa]", 1 - 0.18 * WIDTH / picture.extent[0], 0.81)
    picture.save(arguments.output)


def main():
    arguments = read_arguments()
    read_frames(arguments.directory)  # or says what is wrong with it
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        sys.exit(run_with_a_screen())
    global simple, vtkTextActor  # not at the top: it takes seconds, and mistakes are to be named at once
    import paraview

    paraview.compatibility.major, paraview.compatibility.minor = 5, 12  # names of later versions differ
    from paraview import simple
    from vtkmodules.vtkRenderingCore import vtkTextActor
    simple._DisableFirstRenderCameraReset()
    {"mesh": draw_mesh, "stress": draw_stress}[arguments.what](arguments)


if __name__ == "__main__":
    try:
        main()
    except Mistake as mistake:
        sys.exit("bodies.py: %s" % mistake)
