#!/usr/bin/env python3
"""Writes trabeculae.mhd and trabeculae.raw: a made-up sample of trabecular bone for trabeculae.prm.

It is not measured. Trabeculae are where a random sum of waves of about 1.2 mm is near zero: a net of plates and rods. Grey
values, 0 to 200, are the part of a voxel of 0.2 mm that is bone, in half percent, as a scanner of that resolution sees it.
The same numbers come out everywhere.
"""
import math
import os

n, edge, wave, thickness, n_waves = (63, 63, 26), 0.2, 1.2, 0.22, 40
samples = 3  # in each direction of a voxel


def random_numbers(seed):
    """Numbers between 0 and 1 (Park and Miller 1988)."""
    while True:
        seed = 16807 * seed % 2147483647
        yield seed / 2147483647


def make_waves():
    draw = random_numbers(2020)
    for _ in range(n_waves):
        z, angle, phase = 2 * next(draw) - 1, 2 * math.pi * next(draw), 2 * math.pi * next(draw)
        across, k = math.sqrt(1 - z * z), 2 * math.pi / wave
        yield k * across * math.cos(angle), k * across * math.sin(angle), k * z, phase


def axis_factors(count, k):
    """exp(i k x) at all samples along a direction."""
    return [complex(math.cos(k * x), math.sin(k * x))
            for x in ((i + 0.5) * edge / samples for i in range(count * samples))]


def main():
    along = [(axis_factors(n[0], a), axis_factors(n[1], b), axis_factors(n[2], c), complex(math.cos(p), math.sin(p)))
             for a, b, c, p in make_waves()]
    sigma = math.sqrt(n_waves / 2)
    counts = bytearray(n[0] * n[1] * n[2])
    for k in range(n[2] * samples):
        for j in range(n[1] * samples):
            row = [(x, y[j] * z[k] * p) for x, y, z, p in along]
            base = n[0] * (j // samples + n[1] * (k // samples))
            for i in range(n[0] * samples):
                if abs(sum((x[i] * f).real for x, f in row)) < thickness * sigma:
                    counts[base + i // samples] += 1
    grey = bytes(200 * c // samples**3 for c in counts)
    folder = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(folder, "trabeculae.raw"), "wb") as file:
        file.write(grey)
    with open(os.path.join(folder, "trabeculae.mhd"), "w") as file:
        file.write("ObjectType = Image\nComment = made up by make_trabeculae.py, not measured\nNDims = 3\n"
                   f"DimSize = {n[0]} {n[1]} {n[2]}\nElementSpacing = {edge} {edge} {edge}\n"
                   "ElementType = MET_UCHAR\nElementDataFile = trabeculae.raw\n")


main()
