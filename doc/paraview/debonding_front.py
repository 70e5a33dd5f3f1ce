"""Pictures of the contact face side by side: one column per angle, one row per field and result directory.

    pvpython doc/paraview/debonding_front.py output/coin --field mu slip_mm --angles 1 2 5 10
    pvpython doc/paraview/debonding_front.py output/a output/b --labels disk random --output front.png

pvpython comes with ParaView (Debian: paraview, of 13 python3-paraview; 5.11, 5.13). Where there is no screen, the script draws
on that of xvfb-run (Debian: xvfb).

The face is seen from above, through the implant, with +x to the right and +y up, as it lay at the start; with --turned as it
lies at that angle. A field has the same colours in all columns and for all directories. The pictures are those of
interface.pvd, so angles are those at which the run wrote files: doc/howto/paraview.md says how to choose them. It holds what lies
between the quadrature points of the run: where the front shows corners, take more points.
"""

import argparse
import os
import sys

from open_results import (FIELDS, FONT, GREY, Mistake, check_fields, check_is_there, choose, even_choice, read_frames, read_title,
                          rgb, round_numbers, run_with_a_screen, scale_of, set_colours)


def read_arguments():
    parser = argparse.ArgumentParser(prog="debonding_front.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+", metavar="DIR", help="directory with results")
    parser.add_argument("--field", nargs="+", default=["mu"], metavar="FIELD",
                        help="one row each: " + ", ".join(FIELDS) + " (default: mu)")
    parser.add_argument("--angles", nargs="+", type=float, metavar="DEG",
                        help="columns [deg] (default: five of those that have files)")
    parser.add_argument("--times", nargs="+", type=float, metavar="T",
                        help="columns by time instead, for instance if nothing rotates")
    parser.add_argument("--range", nargs="+", default=[], metavar="FIELD=LOW:HIGH",
                        help="ends of colour scales (default: all that occurs; phi and phi_0: 0 to 1)")
    parser.add_argument("--labels", nargs="+", metavar="TEXT",
                        help="names of the directories in the picture (default: titles of their scenes)")
    parser.add_argument("--turned", action="store_true", help="show the face as displaced")
    parser.add_argument("--output", metavar="FILE.png", help="default: debonding_front.png in the first directory")
    parser.add_argument("--width", type=int, default=1800, help="of the picture [pixels]; the height follows")
    arguments = parser.parse_args()
    for directory in arguments.directories:
        if not os.path.isdir(directory):
            raise Mistake("%s: there is no such directory" % directory)
    check_fields("--field", arguments.field)
    if arguments.angles and arguments.times:
        raise Mistake("--angles and --times: only one of the two can choose the columns")
    if arguments.labels and len(arguments.labels) != len(arguments.directories):
        raise Mistake("--labels: %d texts for %d directories" % (len(arguments.labels), len(arguments.directories)))
    if not 200 <= arguments.width <= 16000:
        raise Mistake("--width %d: allowed are 200 to 16000 pixels" % arguments.width)
    if not arguments.output:
        arguments.output = os.path.join(arguments.directories[0], "debonding_front.png")
    if not arguments.output.endswith(".png"):
        raise Mistake("--output %s: the name has to end in .png" % arguments.output)
    if not os.path.isdir(os.path.dirname(arguments.output) or "."):
        raise Mistake("--output %s: there is no such directory" % arguments.output)
    arguments.range = dict(read_range(text) for text in arguments.range)
    return arguments


def read_range(text):
    try:
        field, ends = text.split("=")
        low, high = (float(end) for end in ends.split(":"))
    except ValueError:
        raise Mistake("--range %s: to be written as FIELD=LOW:HIGH, for instance mu=0.4:0.58" % text)
    if field not in FIELDS or field == "state" or not low < high:
        raise Mistake("--range %s: needs a field (not state) and two numbers, the lower one first" % text)
    return field, (low, high)


def choose_columns(arguments):
    """Labels of the columns, and for each directory its frames."""
    frames = [read_frames(directory) for directory in arguments.directories]
    nothing_rotates = all(frame.angle == 0 for frame in frames[0])
    if nothing_rotates and arguments.angles:
        raise Mistake("%s: nothing rotates; choose the columns by --times" % arguments.directories[0])
    by_time = bool(arguments.times) or nothing_rotates
    wanted = arguments.times or arguments.angles or even_choice(frames[0], by_time)
    chosen = [choose(f, wanted, by_time, d) for f, d in zip(frames, arguments.directories)]
    if nothing_rotates:
        labels = ["t = %.4g" % frame.time for frame in chosen[0]]
    else:
        labels = ["%.4g°" % frame.angle for frame in chosen[0]]
    return labels, chosen


# ------------------------------------------------------------------------------------------------------ the picture


class Picture:
    """All faces in one scene, side by side in a plane, seen by one camera: lengths are those of the face [mm]."""

    def __init__(self, arguments, labels, frames):
        self.arguments, self.labels, self.frames = arguments, labels, frames
        self.n_rows = len(arguments.field) * len(frames)
        self.readers = [[simple.XMLUnstructuredGridReader(FileName=[frame.name]) for frame in row] for row in frames]
        for reader in sum(self.readers, []):
            reader.UpdatePipeline()
        bounds = self.readers[0][0].GetDataInformation().GetBounds()
        self.face = max(bounds[1] - bounds[0], bounds[3] - bounds[2])
        self.pitch = 1.06 * self.face
        self.left = 0.26 * self.face if len(frames) > 1 else 0.03 * self.face
        self.right, self.top, self.bottom = 0.66 * self.face, 0.24 * self.face, 0.03 * self.face
        self.extent = (self.left + len(labels) * self.pitch + self.right, self.top + self.n_rows * self.pitch + self.bottom)
        self.pixels_per_mm = arguments.width / self.extent[0]
        self.size = [arguments.width, round(self.extent[1] * self.pixels_per_mm)]

    def centre(self, row, column):
        """Of a face, from the upper left corner of the picture."""
        return self.left + (column + 0.5) * self.pitch, -self.top - (row + 0.5) * self.pitch

    def font(self, share=0.13):
        return round(share * self.face * self.pixels_per_mm)

    def line_width(self):
        return max(1, 0.004 * self.face * self.pixels_per_mm)

    def draw(self):
        self.view = simple.CreateView("RenderView", ViewSize=self.size, UseColorPaletteForBackground=0,
                                      Background=[1, 1, 1], OrientationAxesVisibility=0,
                                      CameraParallelProjection=1, InteractionMode="2D")
        self.view.CameraFocalPoint = [self.extent[0] / 2, -self.extent[1] / 2, 0]
        self.view.CameraPosition = [self.extent[0] / 2, -self.extent[1] / 2, 100 * self.face]
        self.view.CameraViewUp = [0, 1, 0]
        self.view.CameraParallelScale = self.extent[1] / 2
        for column, label in enumerate(self.labels):
            self.draw_text(label, self.centre(0, column)[0], -0.6 * self.top)
        for f, field in enumerate(self.arguments.field):
            first_row = f * len(self.frames)
            colours = self.colour_function(field)
            for d, readers in enumerate(self.readers):
                for column, reader in enumerate(readers):
                    self.draw_face(reader, field, colours, self.centre(first_row + d, column))
                if len(self.frames) > 1:
                    self.draw_text(self.name_of(d), 0.5 * self.left, self.centre(first_row + d, 0)[1], 90)
            self.draw_colour_bar(colours, field, first_row)

    def save(self):
        simple.SaveScreenshot(self.arguments.output, self.view, ImageResolution=self.size, OverrideColorPalette="")

    def name_of(self, directory):
        if self.arguments.labels:
            return self.arguments.labels[directory]
        titles = [read_title(name) for name in self.arguments.directories]
        if titles[directory] and len(set(titles)) == len(titles):
            return titles[directory]
        return os.path.basename(os.path.normpath(self.arguments.directories[directory]))

    def draw_face(self, reader, field, colours, centre):
        # a filter of its own for every picture: ParaView shows each source only once in a view
        face = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"],
                                   ScaleFactor=int(self.arguments.turned))
        position = [centre[0], centre[1], 0]
        shown = simple.Show(face, self.view, Position=position)
        shown.ColorArrayName = ("POINTS", field)  # ColorBy() would change the scale
        shown.LookupTable = colours
        shown.InterpolateScalarsBeforeMapping = int(field != "state")
        shown.Ambient, shown.Diffuse, shown.Specular = 1, 0, 0  # colours as on the colour bar
        # elements do not share points: without joining them each would have a border
        border = simple.FeatureEdges(Input=simple.ExtractSurface(Input=simple.CleantoGrid(Input=face)),
                                     FeatureEdges=0, NonManifoldEdges=0, ManifoldEdges=0)
        line = simple.Show(border, self.view, Position=[centre[0], centre[1], self.face])
        line.ColorArrayName = [None, ""]
        line.AmbientColor = line.DiffuseColor = rgb(GREY)
        line.Ambient, line.Diffuse = 1, 0
        line.LineWidth = self.line_width()

    def draw_text(self, text, x, y, turned=0, to_the_right=False):
        """Straight into the renderer: ParaView's own texts can neither be centred nor turned."""
        actor = vtkTextActor()
        actor.SetInput(text)
        actor.GetPositionCoordinate().SetCoordinateSystemToWorld()
        actor.SetPosition(x, y)
        style = actor.GetTextProperty()
        style.SetFontSize(self.font(min(0.13, 1.7 / len(text))))  # long names: no longer than a face
        style.SetColor(0, 0, 0)
        style.SetOrientation(turned)
        style.SetVerticalJustificationToCentered()
        if not to_the_right:
            style.SetJustificationToCentered()
        if os.path.isfile(FONT):
            style.SetFontFamily(4)  # VTK_FONT_FILE
            style.SetFontFile(FONT)
        self.view.GetRenderer().AddActor(actor)

    # -------------------------------------------------------------------------------------------- colours

    def scale(self, field):
        """Both ends of the colours of a field: the same for all its pictures."""
        if field in self.arguments.range:
            return self.arguments.range[field]
        readers = sum(self.readers, [])
        for reader in readers:
            check_is_there(field, reader.PointData.keys())
        return scale_of(field, [reader.PointData[field].GetRange() for reader in readers])

    def colour_function(self, field):
        colours = simple.GetColorTransferFunction(field)
        set_colours(colours, field, None if field == "state" else self.scale(field), sum(self.readers, [])[0].PointData.keys())
        return colours

    def draw_colour_bar(self, colours, field, first_row):
        n = len(self.frames)
        x = self.extent[0] - self.right + 0.06 * self.face
        upper = self.centre(first_row, 0)[1] + 0.25 * self.face
        height = (1 if field == "state" else n) * self.pitch - 0.35 * self.face
        bar = simple.GetScalarBar(colours, self.view)
        bar.Visibility = 1
        bar.Title = bar.ComponentTitle = ""
        bar.WindowLocation = "Any Location"
        bar.Position = [x / self.extent[0], 1 + (upper - height) / self.extent[1]]
        bar.ScalarBarLength = height / self.extent[1]
        bar.ScalarBarThickness = round(0.09 * self.face * self.pixels_per_mm)
        bar.TextPosition = "Ticks left/bottom, annotations right/top" if field == "state" else \
            "Ticks right/top, annotations left/bottom"
        bar.DrawScalarBarOutline, bar.ScalarBarOutlineColor = 1, rgb(GREY)
        bar.ScalarBarOutlineThickness = round(self.line_width())
        bar.LabelFontSize, bar.LabelColor = self.font(0.11), [0, 0, 0]
        if os.path.isfile(FONT):
            bar.LabelFontFamily, bar.LabelFontFile = "File", FONT
        if field != "state":
            bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels = 1, round_numbers(*self.scale(field)), 0
            bar.AutomaticLabelFormat, bar.LabelFormat = 0, "%g"
        name = FIELDS[field][0] if os.path.isfile(FONT) else field
        self.draw_text(name, x, upper + 0.14 * self.face, to_the_right=True)


def main():
    arguments = read_arguments()
    labels, frames = choose_columns(arguments)
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        sys.exit(run_with_a_screen())
    global simple, vtkTextActor  # not at the top: it takes seconds, and mistakes are to be named at once
    import paraview

    paraview.compatibility.major, paraview.compatibility.minor = 5, 12  # names of later versions differ
    from paraview import simple
    from vtkmodules.vtkRenderingCore import vtkTextActor
    simple._DisableFirstRenderCameraReset()
    picture = Picture(arguments, labels, frames)
    picture.draw()
    picture.save()
    print("%s: %d x %d pixels" % (arguments.output, *picture.size))


if __name__ == "__main__":
    try:
        main()
    except Mistake as mistake:
        sys.exit("debonding_front.py: %s" % mistake)
