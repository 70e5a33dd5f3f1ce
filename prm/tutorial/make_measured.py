#!/usr/bin/env python3
"""Writes measured.csv, the made-up measurement of doc/tutorial/fit.md. From the top of the project:

  python3 prm/tutorial/make_measured.py build/release/debond

A run of debond itself: the implant of implant.prm with other values of the interface (`true`), so that the model is right. The
torque meter shows the angle of the machine, which is 0.06 degrees when the implant begins to turn, and 0.0005 N m without a
load. Noise is normal, 0.25 N mm of the torque, and independent from row to row.
"""
import csv
import math
import subprocess
import sys

true = {
    "Interface/Friction coefficient broken": 0.34,
    "Interface/Friction coefficient unbroken": 0.56,
    "Interface/Characteristic slip distance": 0.045,  # mm
    "Interface/Transition factor": 1.2,
    "Interface/Tangential stiffness": 350,  # MPa/mm
}
compliance, angle_offset, torque_offset = 0.002, 0.06, 0.5  # deg/(N mm), deg, N mm
speed, seconds, noise = 0.02, 500, 0.25  # deg/s, s, N mm


def random_numbers(seed):
    """Normal numbers, from numbers between 0 and 1 (Park and Miller 1988)."""
    while True:
        draws = []
        for _ in range(2):
            seed = 16807 * seed % 2147483647
            draws.append(seed / 2147483647)
        yield math.sqrt(-2 * math.log(draws[0])) * math.cos(2 * math.pi * draws[1])


def main():
    directory = "output/tutorial/made_up"
    entries = {**true, "Output/Directory": directory, "Output/Fields every": 0, "Expert/Output/Console": "quiet",
               "Chuck/Rotation z/Value": "11 * max(t - 1, 0)", "Load steps/Tolerance": 1e-4}
    sets = [text for entry, value in entries.items() for text in ("--set", f"{entry}={value}")]
    subprocess.run([sys.argv[1], "prm/tutorial/implant.prm", "--force", *sets], check=True)
    with open(directory + "/curve.csv") as file:
        curve = [(float(row["angle_deg"]) + angle_offset + compliance * float(row["torque_Nmm"]), float(row["torque_Nmm"]))
                 for row in csv.DictReader(file) if float(row["time"]) >= 1]

    draw = random_numbers(2020)
    comma = lambda value, digits: f"{value:.{digits}f}".replace(".", ",")
    with open("prm/tutorial/measured.csv", "w") as file:
        print("# Made up, not measured: a run of debond with implant.prm and white noise, prm/tutorial/make_measured.py", "Sample;A7", "Speed [deg/s];0,02", "",
              "Time;Angle;Torque;Axial force", "s;deg;N m;N", sep="\n", file=file)
        i = 0
        for second in range(seconds + 1):
            angle = speed * second
            while i + 2 < len(curve) and curve[i + 1][0] < angle:
                i += 1
            (a, torque_a), (b, torque_b) = curve[i:i + 2]
            torque = torque_a + (torque_b - torque_a) * (angle - a) / (b - a) if angle > a else 0.
            shown = torque + torque_offset + noise * next(draw)
            print(comma(second, 0), comma(angle, 2), comma(shown / 1000, 5), comma(39.2 + 0.1 * next(draw), 1), sep=";", file=file)


main()
