#!/usr/bin/env python3
"""Torques of one pin at three interferences, made up for prm/bone/fit.prm by the closed forms of prm/bone/fit.prm's numbers: the
first is elastic, the others crush the bone. Noise: 0.5 % of the largest torque of each. Writes fit_1.csv to fit_3.csv beside itself.
"""
import math
import pathlib
import random

a, b, length, G, nu, eps = 1.9, 5.3, 4.4, 15000 / 2 / 1.31, 0.31, 900
mu, n, p_0, p_c, H = 0.37, 0.7, 0.8, 0.45, 300
C = 1 / eps + (b * b / a - a) / (2 * G * (1 / (1 - 2 * nu) + (b / a) ** 2))
chance = random.Random(3)
for number, interference in enumerate((0.0008, 0.0022, 0.0044), 1):
    p = interference / 2 / C
    if p > p_c:
        p = (H * interference / 2 + p_c) / (H * C + 1)
    face = 2 * math.pi * a * length * (a + interference / 2)  # over R + I/2, where the points are
    limit = mu * p_0 * (p / p_0) ** n
    rows = []
    for i in range(61):
        angle = 0.15 * i / 60
        stuck = math.radians(angle) * a / (1 / eps + a * (1 - (a / b) ** 2) / (2 * G))
        rows.append((angle, face * min(stuck, limit) + chance.gauss(0, 0.005 * face * limit)))
    text = "angle_deg,torque_Nmm\n" + "".join(f"{x:.4f},{T:.4f}\n" for x, T in rows)
    (pathlib.Path(__file__).parent / f"fit_{number}.csv").write_text(text, encoding="utf-8")
