"""The paper's closed form (b), Eqs. (17), (18), (37), (49), computed apart from the program: writes the stand-ins for the
measured curves, prm/paper/data/closed_form_b_data_set_[12].csv, and prints the rows "Eq. (18)" of Table 5, Eqs. (20), (21).

    python3 doc/paper/closed_form_b.py [--print-only]

theta_slide = theta_fric = 1.33 degrees of data set 2 is not printed but inferred: doc/evidence/reproduction.md, section Contradictions.
"""

import math
import os
import sys

R, MU_B = 2.5, 0.40  # [mm], -
ANGLES = [0.02, 0.05] + [round(0.1 * i, 1) for i in range(101)]

# p [MPa] from T(10 degrees); a_s [mm]; theta_lin, theta_fric (end) and theta_slide (slide) [degrees]
SET_1 = dict(p=2.8113, mu_ub=0.58, a_s=0.022, b_s=0.74, lin=0.13, end=1.13, slide=1.13)
SET_2 = dict(p=3.3804, mu_ub=0.55, a_s=0.026, b_s=1.86, lin=0.11, end=1.33, slide=1.33)
BONDING = 0.73, 0.72  # observed on the implants


def mu(slip, c):
    s = min(max((slip / c["a_s"] - 1) / (2 * c["b_s"]), 0), 1)  # 0: bonded, 1: broken
    return MU_B + (c["mu_ub"] - MU_B) * (0.5 + 0.5 * math.cos(math.pi * s))


def integral(function, a, b, n=200):
    """By Simpson's rule."""
    values = [function(a + (b - a) * i / n) for i in range(n + 1)]
    return (b - a) / (3 * n) * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))


def torque(degrees, c):
    """Eq. (37) [N mm], the integral of r^2 times Eq. (18), between its kinks."""
    stick = R if degrees <= c["lin"] else R * c["lin"] / degrees
    slip_per_radius = 0. if degrees < c["slide"] else math.radians(degrees - c["slide"] + c["lin"])
    kinks = [length / slip_per_radius for length in (c["a_s"], c["a_s"] * (1 + 2 * c["b_s"])) if slip_per_radius > 0]
    ends = [stick] + sorted(r for r in kinks if stick < r < R) + [R]
    total = math.pi / 2 * stick**3 * c["mu_ub"] * c["p"] * min(1., degrees / c["lin"])
    for a, b in zip(ends, ends[1:]):
        total += 2 * math.pi * integral(lambda r: r * r * mu(r * slip_per_radius, c) * c["p"], a, b)
    return total


def energies(c, bonding):
    """T_max, T_inf [N mm]; E_deb, E_fric, W_adh [N mm]; w_adh, w*_adh [N/m]."""
    T = [torque(0.01 * i, c) for i in range(1001)]
    E_deb = (sum(T) - 0.5 * T[-1]) * math.radians(0.01)
    E_fric = T[-1] * math.radians(10 - c["end"])
    w = 1e3 * (E_deb - E_fric) / (math.pi * R**2)
    return max(T), T[-1], E_deb, E_fric, E_deb - E_fric, w / bonding, w


def write(number, c, remark):
    name = os.path.join(os.path.dirname(__file__), "../../prm/paper/data/closed_form_b_data_set_%d.csv" % number)
    with open(name, "w") as file:
        file.write("# NOT a measurement: the closed form of Immel et al. (2020), Eqs. (17), (18), (49), data set %d, made by\n"
                   "# doc/paper/closed_form_b.py with p = %.4f MPa (T(10 deg) = %.2f N mm), mu_b = %g, mu_ub = %g,\n"
                   "# a_s = %g um, b_s = %g, theta_lin = %g deg, theta_slide = %g deg, R = %g mm. %s\n"
                   "# A stand-in for the measured curve, which is not published as numbers.\n"
                   % (number, c["p"], torque(10, c), MU_B, c["mu_ub"], 1e3 * c["a_s"], c["b_s"], c["lin"], c["end"], R, remark))
        file.write("angle_deg,torque_Nmm\n")
        for angle in sorted(ANGLES + [c["lin"]]):
            file.write("%g,%.6f\n" % (angle, torque(angle, c)))


def main():
    if "--print-only" not in sys.argv:
        write(1, SET_1, "All entries are printed, but\n# their W_adh is 1.30 N mm; Table 5 has 1.4.")
        write(2, SET_2, "theta_slide is inferred from\n# Table 5, which it meets; Table 2 prints theta_max = 2.02 deg.")
    print("                                      T_max  T(10)  E_deb E_fric W_adh w_adh w*_adh")
    for name, c, bonding in (("1, both 1.13 degrees, as printed", SET_1, BONDING[0]),
                             ("1, the same, theta_slide = 1.5", dict(SET_1, slide=1.5), BONDING[0]),
                             ("2, both 2.02, as printed", dict(SET_2, p=3.3772, end=2.02, slide=2.02), BONDING[1]),
                             ("2, both 1.29", dict(SET_2, end=1.29, slide=1.29), BONDING[1]),
                             ("2, both 1.33, inferred", SET_2, BONDING[1]),
                             ("2, both 1.42", dict(SET_2, end=1.42, slide=1.42), BONDING[1])):
        print("%-36s %6.2f %6.2f %6.3f %6.3f %5.3f %5.1f %5.1f" % ((name,) + tuple(energies(c, bonding))))


main()
