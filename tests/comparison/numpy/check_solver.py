#!/usr/bin/python3
"""Checks of this solver that need no other program."""
import os
import sys
from types import SimpleNamespace

os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402
from scipy.optimize import brentq  # noqa: E402

import friction  # noqa: E402
import interface  # noqa: E402
import joint  # noqa: E402
import nurbs  # noqa: E402
import scene_file  # noqa: E402
import simulation  # noqa: E402
import solids  # noqa: E402
import towing  # noqa: E402

RADIUS, HEIGHT = 2.5, 3.
RANDOM = np.random.default_rng(1)


def small_solids(young=1000.):
    yield solids.bone_block([8., 8., 4.], (5, 2), 1.5, young, .3, 'neo-hookean')
    yield solids.coin(RADIUS, HEIGHT, (3, 2), 1., young, .3, 'neo-hookean')


def relative(a, b):
    return np.abs(a - b).max() / np.abs(b).max()


def derivatives_of_the_energy():
    """Forces against differences of the energy, and the tangent against differences of the forces."""
    worst, step = 0., 1e-5
    for solid in small_solids():
        u = 0.02 * RANDOM.standard_normal(solid.points.shape)
        direction = RANDOM.standard_normal(solid.points.shape)
        slope = (solid.energy(u + step * direction) - solid.energy(u - step * direction)) / (2 * step)
        worst = max(worst, relative(slope, (solid.forces(u) * direction).sum()))
        change = (solid.forces(u + step * direction) - solid.forces(u - step * direction)) / (2 * step)
        worst = max(worst, relative((solid.tangent(u) @ direction.ravel()).reshape(-1, 3), change))
    return worst


def rigid_motion():
    """Forces after a turn by two radians, relative to those of a strain of one."""
    components = [.1, -.2, .3, .8, -.5, 1.2]
    worst = 0.
    for solid in small_solids():
        turned = simulation.Simulation(solid, solid, None, 1., HEIGHT, 1.)
        turned.move_chuck(components)
        u = solid.points @ turned.rotation.T - solid.points
        worst = max(worst, np.abs(solid.forces(u)).max() / np.abs(solid.forces(solid.points)).max())
    return worst


def uniform_stress():
    """Forces inside the bone under a homogeneous deformation, relative to those on its surface."""
    bone = next(iter(small_solids()))
    f = bone.forces(bone.points @ (0.1 * RANDOM.standard_normal((3, 3))).T)
    low, high = bone.points.min(0), bone.points.max(0)
    inside = ((bone.points > low + 1e-9) & (bone.points < high - 1e-9)).all(1)
    return np.abs(f[inside]).max() / np.abs(f).max()


def points_on_a_disk():
    """Closest points of the disk to points above and beside it, against the circle; mm."""
    face, plane = nurbs.disk(RADIUS, 3)
    points = np.column_stack([plane, np.zeros(len(plane))])
    x = np.append(RANDOM.uniform(-4, 4, (1000, 2)), RANDOM.uniform(-.05, .05, (1000, 1)), axis=1)
    xi, beyond = interface.closest_points(face, points, x, np.full((1000, 2), .5))
    if (beyond != (np.hypot(x[:, 0], x[:, 1]) > RADIUS)).any():
        return np.inf
    return np.abs(face.point(points, xi)[0] - x * [1, 1, 0])[~beyond].max()


def closed_form_traction(law, r, depth, normal, tangential, angle):
    """Traction at radii r (m,) between rigid bodies: r angle = g_s + mu(g_s) p / eps_t, by bisection."""
    pressure = normal * depth
    history = SimpleNamespace(slid=0., bonded=1.)
    low, high = np.zeros_like(r), r * angle
    for _ in range(200):
        middle = (low + high) / 2
        mu, _ = law.coefficient(history, middle)
        far = middle + mu * pressure / tangential > r * angle
        low, high = np.where(far, low, middle), np.where(far, middle, high)
    sticks = tangential * r * angle <= law.coefficient(history, 0 * r)[0] * pressure
    return np.where(sticks, tangential * r * angle, law.coefficient(history, low)[0] * pressure)


def stiff_bodies():
    """Torque between almost rigid bodies against the closed form at the same points, relative to its maximum."""
    law = friction.ModifiedCoulomb(.58, .4, .022, .74)
    bone, coin = small_solids(young=1e9)
    contact = interface.Interface(coin, bone, +1, joint.Friction(law, (600., 400.)), 4, lambda x, y: 1.)
    solver = simulation.Simulation(bone, coin, contact, contact.area.sum(), HEIGHT, 1e-9)
    solver.start([0., 0., -.005, 0., 0., 0.])
    r = np.hypot(*contact.positions(coin.points[:25])[:, :2].T)
    here, exact = [], []
    for angle in np.radians(np.linspace(.05, 2, 40)):
        solver.step([0., 0., -.005, 0., 0., angle])
        here.append(solver.results()['torque_Nmm'])
        exact.append(contact.area @ (r * closed_form_traction(law, r, .005, 600., 400., angle)))
    return relative(np.array(here), np.array(exact))


def reactions_of_the_top():
    """Contact forces against reactions of the implant's top in a general motion, relative."""
    scene = scene_file.Scene(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'general_motion.prm'))
    solver = scene.simulation()
    solver.start(scene.components(0.))
    for time in scene.times[1:4]:
        solver.step(scene.components(time))
    return max(relative(a, b) for a, b in zip(solver.top_reactions(), solver.reactions()))


def towed_on_a_disk(radius, angle, gap, string):
    """The gap, complex, and the distance slid of a point at `radius` on a disk that turns by `angle`, by integration.

    The string keeps its length. The gap is shorter at the beginning, or as long and is pulled at once.
    """
    def held(turned):
        return gap + radius * (np.exp(1j * turned) - 1)

    begins = 0.
    if abs(gap) < string * (1 - 1e-9):
        turned = np.linspace(0, angle, 2001)
        within = np.flatnonzero(np.abs(held(turned)) <= string)[-1]
        if within == 2000:
            return held(angle), 0.
        begins = brentq(lambda t: np.abs(held(t)) - string, turned[within], turned[within + 1], xtol=1e-16)

    def motion(_, state):
        direction = 1j * np.exp(1j * (begins + np.sign(angle) * state[2])) * np.sign(angle)
        now = (state[0] + 1j * state[1]) / np.hypot(*state[:2])
        pulled = (direction * now.conjugate()).real
        change = direction - pulled * now
        return [radius * change.real, radius * change.imag, 1, radius * pulled]

    first = held(begins)
    end = solve_ivp(motion, (0, abs(angle - begins)), [first.real, first.imag, 0, 0], 'DOP853', rtol=1e-13, atol=1e-15)
    return complex(*end.y[:2, -1]), end.y[3, -1]


def towing_on_a_disk():
    """Points that tow on a turning disk, also nearer to its centre than strings are long; relative to the string."""
    worst = 0.
    for number in range(200):
        radius, angle, string = 10 ** RANDOM.uniform(-2, 0), RANDOM.uniform(-2, 2), 10 ** RANDOM.uniform(-2, -.5)
        along = np.pi / 2 * np.sign(angle) + RANDOM.uniform(-1.5, 1.5)
        gap = string * np.exp(1j * along) if number % 2 else string * RANDOM.uniform() * np.exp(1j * 3 * along)
        exact, slid = towed_on_a_disk(radius, angle, gap, string)
        lengths = np.full((2, 1), string)
        towed = towing.tow(np.array([gap]), np.array([radius * (np.exp(1j * angle) - 1)]), np.array([angle]), *lengths,
                           lambda d: (lengths[0], 0 * d))
        worst = max(worst, np.abs(towed.gap - exact)[0] / string, np.abs(towed.slid - slid)[0] / string)
    return worst


def towing_along_a_line():
    """Points that are towed almost straight against u_1 = u_0 exp(-way/string), u = tan(alpha/2); relative."""
    way, string = 10 ** RANDOM.uniform(-4, 0, 1000), 10 ** RANDOM.uniform(-4, 0, 1000)
    before = np.tan(RANDOM.uniform(-1.5, 1.5, 1000))
    after = before * np.exp(-way / string)
    exact = way + string * np.log((1 + after ** 2) / (1 + before ** 2))
    worst = 0.
    for turn in (0., 1e-16):
        half, pulled = towing.pull(string, np.exp(1j * np.arctan(before)), way, np.full(1000, turn))
        worst = max(worst, np.abs(half.imag / half.real - after).max(), (np.abs(pulled - exact) / (way + string)).max())
    return worst


STRENGTH, OPENING = 1.5, .004


def adhesive(share=.5):
    return joint.Adhesive(friction.ModifiedCoulomb(.58, .4, .022, .74), (600., 400.), STRENGTH, OPENING, share)


def mixed_mode(power_law=False):
    law = friction.ModifiedCoulomb(.58, .4, .022, .74)
    return joint.MixedMode(law, (600., 400.), (1.2, 2.), (.012, .04), 600., power_law, 1.6)


def history(count, **values):
    """Of points that have touched and did nothing else yet, with some arrays changed."""
    start = {'slid': 0., 'bonded': 1., 'kappa': 0., 'omega': 0., 'normal_gap': 0., 'bonds': True, **values}
    return SimpleNamespace(**{name: np.full(count, value) for name, value in start.items()})


def derivatives_of_laws():
    """Derivatives of p and L by the gap and the way against differences, at random histories; relative."""
    slid, bonded, kappa, gap, way = RANDOM.uniform(0, [[.04], [1], [.02], [.02], [.03]], (5, 2000))
    begin = history(2000, slid=slid, bonded=bonded, kappa=np.where(kappa < .005, 0, kappa))
    gap -= .002
    law = friction.ModifiedCoulomb(.58, .4, .022, .74)
    worst, step = 0., 1e-8
    for joint_law in (adhesive(0.), adhesive(.5), adhesive(1.), joint.Dilatant(law, (600., 400.), .003, .02)):
        for values, signs in ((joint_law.pressure, (1, 1)), (joint_law.string, (-1, 1))):
            result = values(begin, way, gap)
            for slope, sign, change in zip(result[1:], signs, ((0, step), (step, 0))):
                sides = [values(begin, way + k * change[0], gap + k * change[1])[0] for k in (-1, 0, 1)]
                smooth = np.abs(sides[0] - 2 * sides[1] + sides[2]) < 1e-4 * np.abs(sides[2] - sides[0])
                difference = (sides[2] - sides[0]) / (2 * step)
                worst = max(worst, (np.abs(sign * slope - difference) * smooth).max() / np.abs(slope).max())
    return worst


def adhesion():
    """The adhesive law against closed forms: strength, work, straight way back, cohesion; relative."""
    law, weights = adhesive(1.), np.polynomial.legendre.leggauss(40)
    begin = history(1)
    work = lost = worst = 0.
    path = OPENING * np.array([0, 1, 1.5, 0, -.2, 0, 1.5, 4, 0, 4, 40])
    for a, b in zip(path, path[1:]):
        gaps = a + (b - a) * (1 + weights[0]) / 2
        pull = np.array([-law.pressure(begin, np.zeros(1), np.full(1, gap))[0][0] for gap in gaps])
        work += weights[1] @ pull * (b - a) / 2
        end = np.full(1, b)
        if min(a, b) >= 0:
            exact = STRENGTH * gaps / OPENING * np.exp(1 - (gaps if b > begin.kappa else begin.kappa) / OPENING)
            worst = max(worst, relative(pull, exact))
        lost += law.damage(begin, np.zeros(1), end)[0]
        worst = max(worst, abs(work - lost - law.stored(begin, np.zeros(1), end)[0]) / (STRENGTH * OPENING))
        begin.kappa, begin.normal_gap = law.kappa(begin, end), end
    whole = np.e * STRENGTH * OPENING
    begin = history(1)
    peak = -law.pressure(begin, np.zeros(1), np.full(1, OPENING))[0][0]
    cohesion = 400 * law.string(begin, np.zeros(1), np.full(1, OPENING / 2))[0][0]
    none = law.string(begin, np.zeros(1), np.full(1, 1.7 * OPENING))[0][0]
    return max(worst, abs(lost / whole - 1), abs(peak / STRENGTH - 1), none,
               abs(cohesion / (.58 * STRENGTH * (1 - np.sqrt(np.e) / 2)) - 1))


def dissipation_of_bonds():
    """The most negative damage or limit of traction in random motions, relative to the work of adhesion; 0 if none is."""
    law, count = adhesive(1.), 3000
    begin, least = history(count, bonded=RANDOM.uniform(0, 1, count)), 0.
    for _ in range(60):
        way = RANDOM.uniform(0, .005, count) * RANDOM.integers(0, 2, count)
        gap = RANDOM.choice([.3, 1, 3]) * OPENING * RANDOM.uniform(-.2, 1, count)
        least = min(least, law.damage(begin, way, gap).min(), law.string(begin, way, gap)[0].min())
        begin.kappa, begin.normal_gap, begin.slid = law.kappa(begin, gap), gap, begin.slid + way
    return abs(least) / (np.e * STRENGTH * OPENING)


def stiff_bodies_bonded():
    """Almost rigid bodies, pulled by half the opening, then twisted: force and torque against those of the points.

    There r angle = g_s + L(g_s) / eps_t, by bisection; c = 1. Relative to the largest.
    """
    law = adhesive(1.)
    bone, coin = small_solids(young=1e9)
    contact = interface.Interface(coin, bone, +1, law, 4, lambda x, y: 1.)
    solver = simulation.Simulation(bone, coin, contact, contact.area.sum(), HEIGHT, 1e-9)
    solver.start(np.zeros(6))
    solver.step([0., 0., OPENING / 2, 0., 0., 0.])
    r = np.hypot(*contact.positions(coin.points[:25])[:, :2].T)
    here, exact = [], []
    for angle in np.radians(np.linspace(.05, 1.5, 30)):
        solver.step([0., 0., OPENING / 2, 0., 0., angle])
        here.append([solver.results()[name] for name in ('torque_Nmm', 'chuck_Fz_N')])
        low, high = np.zeros_like(r), r * angle
        for _ in range(60):
            slid = (low + high) / 2
            s = law.friction.bonding(slid)[0]
            limit = (.4 + .18 * s) * s * STRENGTH * (1 - np.sqrt(np.e) / 2)
            far = slid + limit / 400 > r * angle
            low, high = np.where(far, low, slid), np.where(far, slid, high)
        exact.append([contact.area @ (r * 400 * (r * angle - low)),
                      contact.area @ law.friction.bonding(low)[0] * STRENGTH * np.sqrt(np.e) / 2])
    here, exact = np.array(here), np.array(exact)
    return max(relative(here[:, k], exact[:, k]) for k in range(2))


def derivatives_of_mixed_mode():
    """Derivatives of omega and of the cohesive traction by the gap against differences, relative."""
    count, step, worst = 2000, 1e-8, 0.
    gap, normal = .02 * RANDOM.standard_normal((count, 3)), RANDOM.standard_normal((count, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    begin = history(count, bonded=RANDOM.uniform(0, 1, count), omega=RANDOM.uniform(0, 1, count))
    for law in (mixed_mode(), mixed_mode(True)):
        _, omega, by_gap, _, _, derivative = law.hold(begin, gap, normal)
        for k in range(3):
            change = step * np.eye(3)[k]
            sides = [law.hold(begin, gap + sign * change, normal) for sign in (-1, 1)]
            smooth = np.abs(sides[0][1] + sides[1][1] - 2 * omega) <= 1e-4 * np.abs(sides[0][1] - sides[1][1])
            for exact, number in ((by_gap[:, k], 1), (derivative[:, :, k], 4)):
                error = (sides[1][number] - sides[0][number]) / (2 * step) - exact
                worst = max(worst, np.abs(error[smooth]).max() / np.abs(exact).max())
    return worst


def energies_of_mixed_mode():
    """Work per area until the bond is broken, in several directions, against both criteria; relative."""
    abscissae, weights = np.polynomial.legendre.leggauss(40)
    worst = 0.
    for power_law in (False, True):
        law = mixed_mode(power_law)
        for angle in np.linspace(0, np.pi / 2, 13):
            direction = np.array([[0, np.sin(angle), np.cos(angle)]])
            first = 1 / np.hypot(*(direction[0, [2, 1]] / law.onset))
            last = brentq(lambda d, way=direction, law=law: law.broken(d * way[:, 2], d * way[:, 1])[0][0] - 1 + 1e-15,
                          first, 1, xtol=1e-16)
            work = np.zeros(3)
            for a, b in ((0, first), (first, last)):
                for distance, weight in zip(a + (b - a) * (1 + abscissae) / 2, weights * (b - a) / 2):
                    bears = law.hold(history(1), distance * direction, np.array([[0., 0., 1.]]))
                    work += weight * bears[4][0] * direction[0]
            share = work[1] / work.sum()
            if power_law:
                exact = ((1 - share) / .012) ** 1.6 + (share / .04) ** 1.6
                worst = max(worst, abs(work.sum() * exact ** (1 / 1.6) - 1))
            else:
                worst = max(worst, abs(work.sum() / (.012 + .028 * share ** 1.6) - 1))
            onset = first * law.initial * direction[0] / [1, 2., 1.2]
            worst = max(worst, abs(onset @ onset - 1))
    return worst


def damage_of_mixed_mode():
    """How far omega falls in random motions, also of what it was before; 0 if it does not."""
    count, worst = 2000, 0.
    begin, gap, normal = history(count), np.zeros((count, 3)), np.tile([0., 0., 1.], (count, 1))
    for _ in range(100):
        gap = gap + .003 * RANDOM.standard_normal((count, 3))
        omega = mixed_mode().hold(begin, gap, normal)[1]
        worst = max(worst, (begin.omega - omega).max(), omega.max() - 1)
        begin.omega = omega
    return worst


CHECKS = {derivatives_of_the_energy: 1e-7, rigid_motion: 1e-13, uniform_stress: 1e-12, points_on_a_disk: 1e-13,
          stiff_bodies: 1e-4, reactions_of_the_top: 1e-10, towing_on_a_disk: 1e-11, towing_along_a_line: 1e-13,
          derivatives_of_laws: 1e-5, adhesion: 1e-12, dissipation_of_bonds: 1e-15, stiff_bodies_bonded: 1e-4,
          derivatives_of_mixed_mode: 1e-5, energies_of_mixed_mode: 1e-12, damage_of_mixed_mode: 0.}


def main():
    failed = False
    for check, limit in CHECKS.items():
        value = check()
        bad = not value <= limit
        failed = failed or bad
        print('%-28s %8.1e (at most %g)%s' % (check.__name__, value, limit, '  FAILED' * bad))
    sys.exit(failed)


if __name__ == '__main__':
    main()
