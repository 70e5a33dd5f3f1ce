#!/usr/bin/env python3
"""Torque curves of the finite elements against the closed form, every point of the contact face on its own.

    doc/paper/pointwise_torque.py STUDY ANGLE...    # the directory of a study, angles in degrees

If the state of a point does not depend on its neighbours, a point at the distance r from the axis with the initial bonding
phi_0 carries t = lambda (r theta - g_s) <= mu(g_s) p, whatever the pattern (closed form with a compliant foundation,
doc/explanation/closed_forms.md), and T = sum of r t dA over all points. Pressure p and stiffness lambda of
interface and bodies are those of the run, summary.json; phi_0 is phi at the first of the Profile angles, which must come before debonding begins.
"""
import csv
import json
import math
import sys


def read_scene(directory):
    """Numbers of Interface in the parameters that a run has used: {entry: value}."""
    entries = {}
    for line in open(directory + "/parameters.prm"):
        if line.strip().startswith("set ") and "=" in line:
            name, value = line.strip()[4:].split("=", 1)
            entries[name.strip()] = value.strip()
    return entries


def law(entries):
    """mu(g_s [mm], phi_0), Eqs. (11) and (13)."""
    mu_b, mu_ub = float(entries["Friction coefficient broken"]), float(entries["Friction coefficient unbroken"])
    a_s, b_s = float(entries["Characteristic slip distance"]), float(entries["Transition factor"])

    def mu(slip, phi_0):
        x = slip / a_s
        s = 1 if x < 1 else 0 if x > 1 + 2 * b_s else (1 - math.sin(math.pi / (2 * b_s) * (x - b_s - 1))) / 2
        return mu_b + phi_0 * s * (mu_ub - mu_b)

    return mu


def traction(distance, phi_0, mu, p, stiffness):
    """Tangential traction [MPa] of a point that the implant has carried over a distance [mm]."""
    if stiffness * distance <= mu(0, phi_0) * p:
        return stiffness * distance
    low, high = 0.0, distance  # of g_s
    for _ in range(50):
        slip = (low + high) / 2
        if distance - slip > mu(slip, phi_0) * p / stiffness:
            low = slip
        else:
            high = slip
    return mu(low, phi_0) * p


def compare(directory, angles):
    """Prints torques [N mm] at the angles [deg]: finite elements, closed form, difference."""
    with open(directory + "/profiles.csv") as file:
        rows = list(csv.DictReader(file))
    points = [(float(row["r_mm"]), float(row["area_mm2"]), float(row["phi"])) for row in rows
              if row["angle_deg"] == rows[0]["angle_deg"]]
    with open(directory + "/torque.csv") as file:
        torque = {round(float(row["angle_deg"]), 9): float(row["torque_Nmm"]) for row in csv.DictReader(file)}
    with open(directory + "/summary.json") as file:
        summary = json.load(file)
    mu = law(read_scene(directory))
    second_moment = sum(r * r * area for r, area, _ in points)
    stiffness = summary["initial_stiffness_Nmm_per_rad"] / second_moment  # MPa/mm
    for angle in angles:
        sum_of_points = sum(area * r * traction(r * math.radians(angle), phi_0, mu, summary["pressure_MPa"], stiffness)
                            for r, area, phi_0 in points)
        difference = 100 * (torque[angle] / sum_of_points - 1)
        print(f"{directory[-11:]}  {angle:5g} deg  {torque[angle]:8.3f}  {sum_of_points:8.3f}  {difference:+.2f} %")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[1] + "/study.csv") as file:
        variants = [int(row["variant"]) for row in csv.DictReader(file)]
    print("variant          angle  elements    points  difference")
    for variant in variants:
        compare(f"{sys.argv[1]}/variant-{variant:03d}", [float(angle) for angle in sys.argv[2:]])


if __name__ == "__main__":
    main()
