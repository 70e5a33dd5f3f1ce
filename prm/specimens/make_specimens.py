"""Makes up the specimens of this directory: torque curves of the closed form with noise, and specimens.csv; peaks.csv.

    python3 prm/specimens/make_specimens.py [DIR] [N]     N specimens into DIR: 6, into the directory of this script

mu_ub scatters by 0.04 around 0.60 (machined) and 0.75 (etched); a_s by a factor of about 1.15 around 0.03 mm (both). The noise
has 1 % of the largest torque, and a correlation of 0.7 from row to row.

Peaks are 2/3 N R (0.4 + 0.35 phi_0) with N = 50 N, R = 2.5 mm and an error of 5 %; phi_0 scatters by 0.06 around 0.45 (machined)
and 0.6 (blasted).
"""

import os
import sys

import numpy

import debond

HERE = os.path.dirname(os.path.abspath(__file__))
MU_UB = {"machined": 0.60, "etched": 0.75}
PHI_0 = {"machined": 0.45, "blasted": 0.60}


def noise_of(generator, n):
    """Of variance 1, first order."""
    values = generator.standard_normal(n)
    for i in range(1, n):
        values[i] = 0.7 * values[i - 1] + numpy.sqrt(1 - 0.7**2) * values[i]
    return values


def main(directory, n):
    generator = numpy.random.default_rng(2026)
    with open(os.path.join(directory, "specimens.csv"), "w", encoding="utf-8") as table:
        table.write("# made up by make_specimens.py\nspecimen,group,curve,Implant/Radius [mm],Chuck/Press/Value\n")
        for i in range(n):
            group = list(MU_UB)[i % 2]
            name, radius, force = f"{group[0].upper()}{i // 2 + 1}", round(2.5 + 0.05 * generator.uniform(-1, 1), 2), 45 + 5 * (i % 3)
            mu_ub, a_s = MU_UB[group] + 0.04 * generator.standard_normal(), 0.03 * numpy.exp(0.15 * generator.standard_normal())
            entries = {"Implant/Radius": radius, "Chuck/Press/Value": f"{force} * min(t, 1)", "Task": "simulate",
                       "Interface/Friction coefficient unbroken": mu_ub, "Interface/Characteristic slip distance": a_s}
            rows = debond.Scene(os.path.join(HERE, "template.prm"), entries).run().rows
            angle, torque = (rows[column][rows["angle_deg"] > 0] for column in ("angle_deg", "torque_Nmm"))
            torque = torque + 0.01 * torque.max() * noise_of(generator, len(torque))
            numpy.savetxt(os.path.join(directory, name + ".csv"), numpy.column_stack([angle, torque]), "%.5g", ",",
                          header=f"made up: mu_ub = {mu_ub:.4f}, a_s = {a_s:.5f} mm\nangle_deg,torque_Nmm", comments="# ")
            table.write(f"{name},{group},{name}.csv,{radius:g},\"{force} * min(t, 1)\"\n")


def make_peaks(directory, n=15):
    """As German laboratories write them."""
    generator = numpy.random.default_rng(2026)
    with open(os.path.join(directory, "peaks.csv"), "w", encoding="utf-8") as table:
        table.write("# made up by make_specimens.py\nspecimen;group;Ausdrehmoment (Ncm)\n")
        for group, phi_0 in PHI_0.items():
            for i in range(n):
                torque = 2 / 3 * 50 * 2.5 * (0.4 + 0.35 * (phi_0 + 0.06 * generator.standard_normal()))
                text = f"{0.1 * torque * (1 + 0.05 * generator.standard_normal()):.2f}".replace(".", ",")
                table.write(f"{group[0].upper()}{i + 1};{group};{text}\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else HERE, int(sys.argv[2]) if len(sys.argv) > 2 else 6)
    make_peaks(sys.argv[1] if len(sys.argv) > 1 else HERE)
