"""Makes up the raw records of the folder `records`: pulls of small implants, crosshead [mm] and force [N], without a header.

    python3 prm/specimens/make_records.py [DIR]

Names: animal, limb (L, R), kind of the test (T tension, S shear), and the trial where the first failed. The force rises along a
line after some slack, with noise of +-0.3 N, and falls within three rows. 2LT has been stopped before the break.
"""

import os
import sys

import numpy

STIFFNESS, PEAK = {"T": 2.5, "S": 5.0}, {"T": 9.0, "S": 24.0}  # [N/mm, N]; peaks scatter by a quarter of it
NAMES = ("1LT", "1RS", "2LT", "2RS-2", "3LS", "3RT")


def main(directory):
    generator = numpy.random.default_rng(2026)
    os.makedirs(directory, exist_ok=True)
    for name in NAMES:
        kind = name[2]
        peak, slack = PEAK[kind] * (1 + 0.25 * generator.standard_normal()), generator.uniform(0.3, 1)
        x = numpy.arange(0, slack + peak / STIFFNESS[kind], 0.05)
        force = numpy.concatenate([numpy.maximum(0, STIFFNESS[kind] * (x - slack)), [0.6 * peak, 0.2 * peak], numpy.zeros(30)])
        rows = len(x) if name == "2LT" else len(force)
        x = 0.05 * numpy.arange(rows) + generator.uniform(-0.02, 0.02, rows)
        force = force[:rows] + generator.uniform(-0.3, 0.3, rows)
        numpy.savetxt(os.path.join(directory, name + ".txt"), numpy.column_stack([x, force]), "%.3f", "\t")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "records"))
