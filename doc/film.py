#!/usr/bin/env python3
"""Film of the debonding front: phi on the contact face, and beside it the torque curve with a mark that moves along it.

    build/release/debond SCENE.prm --set "Expert/Output/Profile angles=$(doc/film.py --angles)"
    doc/film.py output/DIR --film front.webm --still front_film.png

The film has the angles of profiles.csv as its frames, 12 a second; doc/pictures.sh film makes that of the pages. Needs NumPy,
Matplotlib and, for the film, ffmpeg.
"""

import argparse
import csv
import os
import sys

sys.path.pop(0)  # doc/numbers.py would hide the module of this name, which NumPy needs
import numpy as np  # noqa: E402

FRAMES_PER_SECOND = 12
# seconds of the film, angle [deg]: slow where the front moves inwards
COURSE = ((0, 0), (3, 1), (13, 4), (18, 10), (20, 10))
COLOURS = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"]  # as in doc/style.gp


def angles_of_film(step=0.02):
    """Of all frames, multiples of a step [deg], each once."""
    seconds, angles = zip(*COURSE)
    times = np.arange(0, seconds[-1] * FRAMES_PER_SECOND + 1) / FRAMES_PER_SECOND
    return [step * n for n in np.unique(np.round(np.interp(times, seconds, angles) / step).astype(int)) if n > 0]


def frames_of_film(angles):
    """Numbers of the angles that the frames show."""
    seconds, course = zip(*COURSE)
    times = np.arange(0, seconds[-1] * FRAMES_PER_SECOND) / FRAMES_PER_SECOND
    return [int(np.argmin(abs(angles - angle))) for angle in np.interp(times, seconds, course)]


def read_table(name, columns):
    with open(name) as file:
        names = next(csv.reader(file))
        return np.loadtxt(file, delimiter=",", usecols=[names.index(column) for column in columns], unpack=True)


def read_faces(directory):
    """Angles, and for each x, y and phi as grids over the contact face: the file has points element by element."""
    angle, x, y, phi = read_table(os.path.join(directory, "profiles.csv"), ("angle_deg", "x_mm", "y_mm", "phi"))
    starts = np.flatnonzero(np.r_[True, np.diff(angle) != 0])
    across = round(np.sqrt(len(angle) / len(starts)))
    with open(os.path.join(directory, "parameters.prm")) as file:
        points = next(int(line.split("=")[1].split("#")[0]) for line in file if line.strip().startswith("set Quadrature points"))
    elements = across // points

    def grid(values):
        return values.reshape(-1, elements, elements, points, points).transpose(0, 1, 3, 2, 4).reshape(-1, across, across)
    return angle[starts], grid(x), grid(y), grid(phi)


class Picture:
    def __init__(self, directory):
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        from matplotlib.colors import LinearSegmentedColormap
        plt.rcParams.update({"font.size": 15, "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans"})
        self.angles, self.x, self.y, self.phi = read_faces(directory)
        self.curve = read_table(os.path.join(directory, "torque.csv"), ("angle_deg", "torque_Nmm"))
        self.figure = plt.figure(figsize=(10, 4.6), dpi=100)
        self.face = self.figure.add_axes((0.005, 0.03, 0.40, 0.84))
        colours = LinearSegmentedColormap.from_list("viridis of the pages", COLOURS, 512)
        self.surface = self.face.pcolormesh(self.x[0], self.y[0], self.phi[0], shading="gouraud", cmap=colours, vmin=0, vmax=1)
        radius = np.hypot(self.x[0], self.y[0]).max()
        self.face.add_artist(plt.Circle((0, 0), radius, fill=False, color="#555555", linewidth=2))
        self.face.set(aspect="equal", xlim=(-1.03 * radius, 1.03 * radius), ylim=(-1.03 * radius, 1.03 * radius))
        self.face.axis("off")
        bar = self.figure.colorbar(self.surface, cax=self.figure.add_axes((0.415, 0.12, 0.015, 0.62)), ticks=[0, 0.5, 1])
        bar.ax.set_yticklabels(["0 broken", "0.5", "1 bonded"], fontsize=13)
        bar.ax.set_title(r"$\varphi$", fontsize=16)
        plot = self.figure.add_axes((0.615, 0.165, 0.365, 0.705))
        plot.plot(*self.curve, color="#0072b2", linewidth=2.5)
        self.mark, = plot.plot([], [], "o", color="#d55e00", markersize=12)
        plot.set(xlim=(0, self.curve[0][-1]), ylim=(0, 1.12 * self.curve[1].max()),
                 xlabel=r"Rotation angle $\theta$ [°]", ylabel=r"Torque $T$ [N mm]")
        plot.grid(color="#dddddd")
        self.title = self.figure.text(0.205, 0.93, "", ha="center", va="center", fontsize=18)
        self.value = self.figure.text(0.80, 0.93, "", ha="center", va="center", fontsize=18)

    def show(self, number):
        angle = self.angles[number]
        torque = np.interp(angle, *self.curve)
        self.surface.set_array(self.phi[number].ravel())
        self.mark.set_data([angle], [torque])
        self.title.set_text(r"$\theta$ = %.2f°" % angle)
        self.value.set_text(r"$T$ = %.1f N mm" % torque)

    def save_film(self, name):
        from matplotlib.animation import FFMpegWriter
        options = ["-crf", "34", "-b:v", "0", "-pix_fmt", "yuv420p"]
        writer = FFMpegWriter(FRAMES_PER_SECOND, codec="libvpx-vp9" if name.endswith(".webm") else "libx264", extra_args=options)
        with writer.saving(self.figure, name, 100):
            for number in frames_of_film(self.angles):
                self.show(number)
                writer.grab_frame()

    def save_still(self, name, angle):
        self.show(int(np.argmin(abs(self.angles - angle))))
        self.figure.savefig(name, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", nargs="?", metavar="DIR", help="with profiles.csv and torque.csv")
    parser.add_argument("--angles", action="store_true", help="print the angles of the film [deg], for Expert / Output / Profile angles")
    parser.add_argument("--film", metavar="FILE.webm", help="or .mp4")
    parser.add_argument("--still", metavar="FILE.png")
    parser.add_argument("--at", type=float, default=2.5, metavar="DEG", help="angle of the still (default: 2.5)")
    arguments = parser.parse_args()
    if arguments.angles:
        print(", ".join("%g" % angle for angle in angles_of_film()))
        return
    if not arguments.directory or not os.path.isfile(os.path.join(arguments.directory, "profiles.csv")):
        sys.exit("film.py: needs a directory with profiles.csv: run a scene with Expert / Output / Profile angles")
    picture = Picture(arguments.directory)
    if arguments.still:
        picture.save_still(arguments.still, arguments.at)
    if arguments.film:
        picture.save_film(arguments.film)


if __name__ == "__main__":
    main()
