"""The frictional interface: points of the slave surface against the master surface, appendix A of the paper.

Shapes: m slave points. Units mm, N, MPa; sliding distances and gaps in mm, parameters xi of the master in [0, 1]^2.
"""
from types import SimpleNamespace

import numpy as np
import scipy.sparse as sparse

import towing

ROUNDING = 1e-13  # mm: bonded points that touch have smaller gaps and neither slide nor pull


def closest_points(surface, control_points, x, xi):
    """Parameters (m, 2) of the points of the surface closest to x (m, 3), and which x lie beyond its edge (m,).

    The control points (n, 3) are those of one surface, or (m, n, 3) of one for each x.
    Gauss-Newton iteration from xi (m, 2), damped by the distance beside, as the corners of a disk are singular; a
    parameter that would leave [0, 1] stays at its end. Steps along the edge are shortened more, as it is curved, and
    late steps, lest they go to and fro. Points beyond the edge are those that are not above their closest points,
    which need not be known well then.
    """
    size = np.ptp(control_points[..., 0], -1).max() / 2
    xi = np.clip(xi, 0.01, 0.99)  # from a corner itself no slope leads away
    for iteration in range(300):
        y, tangents = surface.point(control_points, xi)
        slope = np.einsum('mki,mi->mk', tangents, x - y)
        metric = np.einsum('mki,mli->mkl', tangents, tangents)
        normal = np.cross(tangents[:, 0], tangents[:, 1])
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        beside = np.linalg.norm(x - y - _dot(x - y, normal)[:, None] * normal, axis=1)
        beyond = beside > 1e-6 * size
        held = ((xi <= 0) & (slope < 0)) | ((xi >= 1) & (slope > 0))
        at_edge = held.any(1)
        metric[at_edge, 0, 1] = metric[at_edge, 1, 0] = 0
        distance = np.linalg.norm(x - y, axis=1)[:, None, None]
        metric = ((1 + at_edge[:, None, None] * distance / size) * metric
                  + (beside + 1e-14)[:, None, None] * size * np.eye(2))
        step = np.linalg.solve(metric, np.where(held, 0, slope)[..., None])[..., 0]
        step *= np.minimum(1, 0.2 / np.maximum(np.abs(step).max(1), 1e-300))[:, None]
        following = np.clip(xi + (step if iteration < 50 else step / 2), 0, 1)
        way = np.linalg.norm(np.einsum('mki,mk->mi', tangents, following - xi), axis=1)
        xi = following
        if (way < np.where(beyond, 2e-3 * beside, 1e-14 * size)).all():
            return xi, beyond
    raise ArithmeticError('a closest point was not found')


def face_quadrature(solid, count):
    """Points (m, 2) in the parameters of the contact face and the reference areas (m,) [mm2] that they stand for.

    Gauss points, `count` per direction and element.
    """
    n = solid.face.elements
    abscissae, weights = np.polynomial.legendre.leggauss(count)
    s = ((np.arange(n)[:, None] + (1 + abscissae) / 2) / n).ravel()
    w = np.tile(weights / (2 * n), n)
    xi = np.stack(np.meshgrid(s, s, indexing='ij'), -1).reshape(-1, 2)
    _, tangents = solid.face.point(solid.points[:solid.face.weights.size], xi)
    return xi, np.outer(w, w).ravel() * np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)


class Interface:
    """Slave points with their history: parameters xi of the interacting points, sliding distances g_s, states theta.

    For bonds that pull: which points have `touched` the master, and the largest gap kappa [mm] since then; or the place
    xi_bond of the master where they have bonded, the gap from there that bears, and its damage omega.
    Their tangential gaps are parts along the master's tangents: they move along with it.

    slave, master     solids.Solid
    towards           +1 or -1: sign of a_1 x a_2 of the master's surface that points to the slave
    law               one of those in joint.py, with a law of friction.py and both stiffnesses
    viscosity         MPa per (mm per unit of time)
    bonding           phi_0 as a function of reference positions x, y (m,)
    integrated        whether sliding points tow their partners, instead of pulling along the trial gap
    """

    def __init__(self, slave, master, towards, law, points_per_direction, bonding, viscosity=0., integrated=False):
        self.slave, self.master, self.towards, self.law, self.friction = slave, master, towards, law, law.friction
        self.normal_stiffness, self.tangential_stiffness = law.normal, law.tangential
        self.viscosity, self.integrated = viscosity, integrated
        xi, self.area = face_quadrature(slave, points_per_direction)  # tractions are nominal
        self.face_area = self.area  # of the points that shares and the mean bonding state are those of
        self.numbers, self.values, _ = slave.face.basis(xi)
        place = self.positions(slave.points[:slave.face.weights.size])
        self.bonded = np.broadcast_to(np.asarray(bonding(place[:, 0], place[:, 1]), float), self.area.shape)
        self.xi = np.full(xi.shape, 0.5)
        self.slid = np.zeros(len(xi))
        self.theta = np.full(len(xi), self.friction.initial_theta)
        self.kappa, self.touched = np.zeros(len(xi)), np.zeros(len(xi), bool)
        self.omega, self.xi_bond, self.bond_gap = np.zeros(len(xi)), np.full(xi.shape, 0.5), np.zeros((len(xi), 3))
        self.beyond = np.zeros(len(xi), bool)
        self.nearest = self.xi.copy()  # parameters of the closest points of those beyond the edge
        self.accepted = None  # control points of slave and master in the accepted state
        self.carried = np.zeros(len(xi), bool)  # in the accepted state
        self.pressure, self.normal_gap, self.shear = np.zeros(len(xi)), np.zeros(len(xi)), np.zeros((len(xi), 3))
        self.gap_parts = np.zeros((len(xi), 2))  # of the tangential gap, g^1 and g^2
        self.viscous = np.zeros((len(xi), 3))  # traction, MPa
        self.dissipation = self.viscous_work = self.adhesive_work = self.damage = 0.  # N mm

    def positions(self, slave_points):
        """Current positions (m, 3) of the slave points; slave_points are those of the slave's control points."""
        return np.einsum('ma,mai->mi', self.values, slave_points[self.numbers])

    def face(self, slave_points, master_points, which):
        """Give the points `which` (m,) the closest points of the master as partners, with no history of motion."""
        x = self.positions(slave_points)[which]
        if len(x):
            guess = np.where(self.beyond[which, None], self.nearest[which], np.clip(self.xi[which], 0, 1))
            xi, beyond = closest_points(self.master.face, master_points, x, guess)
            self.xi[which] = np.where(beyond[:, None], 0.5, xi)  # anywhere: they have no partner
            self.nearest[which], self.beyond[which] = xi, beyond
        self.accepted = slave_points, master_points

    def touch(self, within):
        """Points that are so near the master [mm] at the start have touched it."""
        place = self._place(self.accepted[1], self.xi)
        self.touched = ~self.beyond & (np.abs(_dot(place.normal, self.accepted_positions() - place.point)) <= within)
        self.xi_bond = self.xi.copy()

    def leave_out_those_beyond(self):
        """Bone that does not face the implant at the start is not bonded, and no part of the contact face."""
        self.bonded = np.where(self.beyond, 0, self.bonded)
        self.face_area = np.where(self.beyond, 0, self.area)

    def _entries(self, slave_points, master_points):
        """Numbers (k,) of points that come over the master from beyond its edge, and where, parameters (k, 2).

        A point has come if it is above the master now. It enters at the place of the edge that was closest to it in the
        accepted state.
        """
        numbers, xi = np.flatnonzero(self.beyond), self.nearest[self.beyond]
        if len(numbers):
            _, beyond = closest_points(self.master.face, master_points, self.positions(slave_points)[numbers], xi)
            numbers, xi = numbers[~beyond], xi[~beyond]
        if len(numbers):
            slave_before, master_before = self.accepted
            x = self.positions(slave_before)[numbers]
            fixed = (np.minimum(xi, 1 - xi)).argmin(1)  # the parameter that the edge keeps
            every = np.arange(len(numbers))

            def slope(along):
                """Of half the squared distance from the place of the edge, by its other parameter (k,)."""
                xi[every, 1 - fixed] = along
                y, tangents = self.master.face.point(master_before, xi)
                return _dot(tangents[every, 1 - fixed], y - x)

            # secants, from the neighbourhood
            last, along = xi[every, 1 - fixed].copy(), xi[every, 1 - fixed] + 1e-4 * np.sign(0.5 - xi[every, 1 - fixed])
            before, now = slope(last), slope(along)
            for _ in range(30):
                change = np.where(now == before, 0, -now * (along - last) / np.where(now == before, 1, now - before))
                last, before = along, now
                along = np.clip(along + change, 0, 1)
                now = slope(along)
                if (np.abs(change) < 1e-15).all():
                    break
        return numbers, xi

    def _place(self, master_points, xi):
        """The master at xi: functions, position, normal towards the slave, dual vectors a^1, a^2 (m, 2, 3)."""
        numbers, values, slopes = self.master.face.basis(xi)
        near = master_points[numbers]
        tangents = np.einsum('mak,mai->mki', slopes, near)
        normal = np.cross(tangents[:, 0], tangents[:, 1])
        normal *= self.towards / np.linalg.norm(normal, axis=1)[:, None]
        metric = np.einsum('mki,mli->mkl', tangents, tangents)
        return SimpleNamespace(numbers=numbers, values=values, slopes=slopes, normal=normal, tangents=tangents,
                               point=np.einsum('ma,mai->mi', values, near), dual=np.linalg.solve(metric, tangents))

    def accepted_positions(self):
        """Positions (m, 3) of the slave points in the accepted state."""
        return self.positions(self.accepted[0])

    def _beginning(self, start, x, friction, duration, turn):
        """How the points x (m, 3) begin a step at the place `start` of the master."""
        gap = np.einsum('mk,mki->mi', self.gap_parts, start.tangents)
        trial = x - start.point
        begin = SimpleNamespace(slid=self.slid, bonded=self.bonded, theta=self.theta, kappa=self.kappa,
                                omega=self.omega, bonds=self.law.bonds(self), normal_gap=self.normal_gap,
                                pressure=self.pressure, friction=friction, duration=duration, point=start.point,
                                trial=trial, gap=gap, motion=trial - gap, turn=turn)
        begin.before = np.where(self.carried, self._reach(begin, 0 * self.slid, self.normal_gap)[0], 0)
        return begin

    def _reach(self, begin, way, normal_gap):
        """Tangential gap of sliding points [mm], and its derivatives by their depth and by their way in this step.

        The gap bears L, that is mu p in friction, and the viscous traction.
        """
        if not begin.friction:
            return 0 * way, 0 * way, 0 * way
        reach, by_depth, by_way, resists = self.law.string(begin, way, normal_gap)
        viscous = resists * self.viscosity / begin.duration / self.tangential_stiffness if begin.duration else 0.
        return reach + viscous * way, by_depth, by_way + viscous

    def _pressure(self, begin, way, normal_gap):
        """p [MPa] and its derivatives by the normal gap and by the way, which spends nothing without friction."""
        return self.law.pressure(begin, way if begin.friction else 0 * way, normal_gap)

    def _hold(self, begin, x, master_points):
        """What holds the points x (m, 3) at the places where they have bonded."""
        held = self._place(master_points, self.xi_bond)
        held.gap, held.omega, held.omega_by_gap, held.stiffness, held.traction, held.by_gap = self.law.hold(
            begin, x - held.point, held.normal)
        return held

    def respond(self, slave_points, master_points, friction=True, duration=1., all_stick=False, turn=0.):
        """State at given control points of both surfaces, from the accepted history, which does not change.

        The partner of a sticking point stays. A sliding point's partner moves until the tangential traction is
        mu p plus the viscous one, Eqs. (29) and (30), with mu and g_s of Eq. (32) at the end of the step, which takes a
        time of `duration`: in the direction of the trial gap, or, if `integrated`, of that with which it is towed.
        The way of a point over the master turns by `turn` (m,) meanwhile, rad, anticlockwise about the normal.
        """
        x = self.positions(slave_points)
        come, entries = self._entries(slave_points, master_points)
        xi, beyond = self.xi.copy(), self.beyond.copy()
        xi[come], beyond[come] = entries, False
        start = self._place(master_points, xi)
        begin = self._beginning(start, x, friction, duration, np.broadcast_to(turn, self.area.shape))
        held = None
        if self.law.cohesive:
            held = self._hold(begin, x, master_points)
            begin.omega = held.omega  # at the end of the step
        normal_gap = _dot(start.normal, begin.trial)
        stretch = np.linalg.norm(begin.trial - normal_gap[:, None] * start.normal, axis=1)
        climbs = self.carried & self.law.climbs  # faces that part may stay closed, by the way of this step
        closed = (self.law.carried(begin, normal_gap) | climbs) & ~beyond
        sliding = closed & (stretch > self._reach(begin, 0 * stretch, normal_gap)[0] + ROUNDING * begin.bonds)
        if all_stick:
            sliding[:] = False

        inside = np.ones(len(x), bool)
        xi[sliding], inside[sliding] = self._slide(x[sliding], xi[sliding], master_points, _some(begin, sliding))
        state = self._place(master_points, np.clip(xi, 0, 1))
        state.held = held
        state.start, state.begin, state.xi, state.beyond, state.gap = start, begin, xi, beyond, x - state.point
        state.normal_gap = _dot(state.normal, state.gap)
        state.closed = closed & inside & (self.law.carried(begin, state.normal_gap) | climbs)
        state.sliding = sliding & state.closed
        tangential_gap = state.gap - state.normal_gap[:, None] * state.normal
        if self.integrated:
            place = _some(state, state.sliding)
            towed = self._tow(place, _some(begin, state.sliding))
            tangential_gap[state.sliding] = _in_space(towed.gap, place)  # as long as the string, to the last digit
            state.direction, _ = _direction(tangential_gap, state.normal)
            state.way = np.zeros(len(x))
            state.way[state.sliding] = towed.slid
        else:
            state.direction, state.trial_length = _direction(begin.trial, state.normal)
            state.way = np.linalg.norm(state.point - start.point, axis=1) * state.sliding
        state.spent = np.maximum(state.way, 0)
        if climbs.any():
            state.closed &= ~climbs | (self._pressure(begin, state.spent, state.normal_gap)[0] > 0)
            state.sliding &= state.closed
            state.way, state.spent = state.way * state.closed, state.spent * state.closed
        state.pressure, state.by_gap, state.pressure_by_way = (
            value * state.closed for value in self._pressure(begin, state.spent, state.normal_gap))
        state.shear = self.tangential_stiffness * tangential_gap * state.closed[:, None]
        state.traction = -state.pressure[:, None] * state.normal + state.shear
        state.reach, state.by_depth, state.by_way = self._reach(begin, state.spent, state.normal_gap)
        state.limit = np.zeros(len(x))
        if friction:
            state.limit = self.law.string(begin, state.spent, state.normal_gap)[0] * self.tangential_stiffness
        pressure = state.pressure - (_dot(held.traction, held.normal) if held else 0.)
        state.pulled = state.closed & (pressure < -ROUNDING * self.normal_stiffness) & (state.limit == 0)
        state.presses, state.apart = state.closed, ~state.closed
        state.slips = state.sliding
        if self.law.cohesive:  # what is held sticks or is pulled, and what is broken rubs or is apart
            holds = begin.bonds & (held.omega < 1)
            state.pulled = holds & (_dot(held.gap, held.normal) > ROUNDING)
            state.presses = holds & ~state.pulled | ~holds & state.closed & (state.normal_gap < -ROUNDING)
            state.slips = state.sliding & ~holds
            state.apart = ~state.presses & ~state.pulled
        return state

    def _slide(self, x, xi, master_points, begin):
        """Parameters of the partners of sliding points (k, 2), and whether they lie on the master (k,).

        Newton's method from xi for the gap that the law asks for, with the law's slope but without the curvature of the
        master; late steps are halved, as a coefficient that rises and then stays makes them go to and fro.
        """
        for iteration in range(100):
            place = self._place(master_points, xi)
            place.gap = x - place.point
            place.normal_gap = _dot(place.normal, place.gap)
            excess, move = (self._excess_of_towed if self.integrated else self._excess_of_trial)(place, begin)
            inside = ((xi >= 0) & (xi <= 1)).all(1)
            if np.abs(excess[inside]).max(initial=0.) < 1e-13:
                return xi, inside
            step = np.einsum('mki,mi->mk', place.dual, move)
            xi = np.where(inside[:, None], xi + (step if iteration < 30 else step / 2), xi)
        raise ArithmeticError('the partner of a sliding point was not found')

    def _excess_of_trial(self, place, begin):
        """Tangential gap beyond that in the direction of the trial gap, and how the partner should move (k, 3)."""
        tau, _ = _direction(begin.trial, place.normal)
        way = np.linalg.norm(place.point - begin.point, axis=1)
        reach, _, by_way = self._reach(begin, way, place.normal_gap)
        excess = place.gap - place.normal_gap[:, None] * place.normal - reach[:, None] * tau
        return excess, excess + ((1 / (1 + by_way) - 1) * _dot(excess, tau))[:, None] * tau

    def _excess_of_towed(self, place, begin):
        """Tangential gap beyond that with which the partner is towed, and how the partner should move (k, 3)."""
        towed = _in_space(self._tow(place, begin).gap, place)
        excess = place.gap - place.normal_gap[:, None] * place.normal - towed
        return excess, excess

    def _tow(self, place, begin, further=0., deeper=0.):
        """What becomes of points that tow their partners to a place of the master, see towing.tow.

        The motion and the depth there may be altered by `further`, complex, and `deeper`.
        """
        rest = np.zeros(len(begin.trial))
        normal_gap = place.normal_gap - deeper

        def string(slid):
            """Where the distance is negative the law goes on with its slope, if that is positive."""
            reach, _, slope = self._reach(begin, np.maximum(slid, 0), normal_gap)
            slope = np.where(slid < 0, np.maximum(slope, 0), slope)
            return reach + slope * np.minimum(slid, 0), slope

        return towing.tow(_in_plane(begin.gap, place), _in_plane(begin.motion, place) + further, begin.turn,
                          begin.before, self._reach(begin, rest, normal_gap)[0], string)

    def nodal_forces(self, state):
        """Forces on the control points of slave and master as they enter the residual, (., 3) each, Eq. (28)."""
        load = self.area[:, None] * state.traction
        on_slave = np.zeros((self.slave.face.weights.size, 3))
        on_master = np.zeros((self.master.face.weights.size, 3))
        np.add.at(on_slave, self.numbers, self.values[..., None] * load[:, None])
        np.add.at(on_master, state.numbers, -state.values[..., None] * load[:, None])
        if state.held:
            load = self.area[:, None] * state.held.traction
            np.add.at(on_slave, self.numbers, self.values[..., None] * load[:, None])
            np.add.at(on_master, state.held.numbers, -state.held.values[..., None] * load[:, None])
        return on_slave, on_master

    def tangent(self, state):
        """Sparse derivative of the nodal forces with respect to the control points of slave, then master.

        The gap at the end follows from the change of gap, `h`, at a fixed partner and that of the trial gap. The
        turning of the master's normal is left out: Newton's method converges linearly, the more quickly the smaller
        the strains.
        """
        slave, master = self.slave.face.weights.size, self.master.face.weights.size

        def interpolation(numbers, values, offset):
            rows = np.repeat(np.arange(len(values)), values.shape[1])
            matrix = sparse.csr_matrix((values.ravel(), (rows, numbers.ravel() + offset)),
                                       shape=(len(values), slave + master))
            return sparse.kron(matrix, sparse.identity(3), 'csr')

        end = interpolation(state.numbers, state.values, slave)
        x = interpolation(self.numbers, self.values, 0)
        h = x - end
        trial = x - interpolation(state.start.numbers, state.start.values, slave)

        by_gap, by_trial, way_by_gap, way_by_trial = self._gap_derivatives(state)
        gap = _blocks(by_gap) @ h + _blocks(by_trial) @ trial
        if state.held:
            h_held = x - interpolation(state.held.numbers, state.held.values, slave)
            gap = gap + _blocks(self._gap_by_omega(state)[:, :, None] * state.held.omega_by_gap[:, None, :]) @ h_held
        normal = state.normal[:, :, None] * state.normal[:, None, :]
        stiffness = (self.tangential_stiffness * np.eye(3)
                     + (-state.by_gap - self.tangential_stiffness)[:, None, None] * normal)
        result = h.T @ (_blocks((self.area * state.closed)[:, None, None] * stiffness) @ gap)
        if state.held:
            result = result + h_held.T @ (_blocks(self.area[:, None, None] * state.held.by_gap) @ h_held)
        if state.pressure_by_way.any():
            push = -(self.area * state.pressure_by_way)[:, None] * state.normal
            result = result + h.T @ (_blocks(push[:, :, None] * way_by_gap[:, None, :]) @ h
                                     + _blocks(push[:, :, None] * way_by_trial[:, None, :]) @ trial)
        for k in range(2):  # the force on the master moves with the partner
            slope = interpolation(state.numbers, state.slopes[:, :, k], slave)
            weight = (self.area * state.sliding)[:, None, None]
            moved = _blocks(weight * state.traction[:, :, None] * state.dual[:, k, None]) @ (h - gap)
            result = result - slope.T @ moved
        return result

    def _gap_derivatives(self, state):
        """d gap = A h + B d trial: the blocks A, B (m, 3, 3), and the same of the way, (m, 3)."""
        if self.integrated:
            return self._towed_derivatives(state)
        tau = state.direction
        normal = state.normal[:, :, None] * state.normal[:, None, :]
        along = tau[:, :, None] * tau[:, None, :]
        share = 1 / (1 + state.by_way)
        by_gap = normal - (state.by_depth * share)[:, None, None] * tau[:, :, None] * state.normal[:, None, :]
        by_trial = ((state.by_way * share)[:, None, None] * along
                    + (state.reach / state.trial_length)[:, None, None] * (np.eye(3) - normal - along))
        by_gap[~state.sliding] = 0
        by_trial[~state.sliding] = np.eye(3)
        share = share * state.sliding
        return by_gap, by_trial, (share * state.by_depth)[:, None] * state.normal, share[:, None] * tau

    def _gap_by_omega(self, state):
        """Derivative (m, 3) of the gap by the damage of the bond."""
        if not self.integrated:
            slope = self.law.by_omega(state.begin, state.normal_gap) / (1 + state.by_way) * state.begin.friction
            return (slope * state.sliding)[:, None] * state.direction
        result, step = np.zeros(state.gap.shape), 1e-6
        place, begin = _some(state, state.sliding), _some(state.begin, state.sliding)
        towed = self._tow(place, begin).gap
        begin.omega = begin.omega + step
        result[state.sliding] = _in_space((self._tow(place, begin).gap - towed) / step, place)
        return result

    def _towed_derivatives(self, state):
        """The same by differences of the towed gap; what else depends on the motion, as the turn does, is left out."""
        place, begin = _some(state, state.sliding), _some(state.begin, state.sliding)
        towed = self._tow(place, begin)
        step = 1e-6 * (np.abs(towed.gap) + np.linalg.norm(begin.trial, axis=1))

        def slope(**change):
            altered = self._tow(place, begin, **change)
            return _in_space((altered.gap - towed.gap) / step, place), ((altered.slid - towed.slid) / step)[:, None]

        by_gap, by_trial = np.zeros((2, len(state.gap), 3, 3))
        way_by_gap, way_by_trial = np.zeros((2, len(state.gap), 3))
        by_trial[:] = np.eye(3)
        first, second = _axes(place)
        along, across, deeper = slope(further=step), slope(further=1j * step), slope(deeper=step)
        by_trial[state.sliding] = (along[0][:, :, None] * first[:, None, :]
                                   + across[0][:, :, None] * second[:, None, :])
        by_gap[state.sliding] = (place.normal - deeper[0])[:, :, None] * place.normal[:, None, :]
        way_by_trial[state.sliding] = along[1] * first + across[1] * second
        way_by_gap[state.sliding] = -deeper[1] * place.normal
        return by_gap, by_trial, way_by_gap, way_by_trial

    def accept(self, state, slave_points, master_points, turn, carried):
        """Make the state the history; open points face the closest point of the master anew.

        turn (3, 3) is the rotation of the master's frame since the last state was accepted; carried (m, 3) by how much the
        chuck has moved the slave points over the master, were the solids rigid. Adds to the dissipation,
        traction times way on the master, to its viscous part, and to its adhesive part, in friction pressure times the
        integral of mu - mu_b over the sliding distance; tractions and pressures are the means of those at both ends of
        the step. What damages the bond is dissipated too, and what lifts the faces is not.
        """
        if (state.limit[state.closed] < 0).any():
            raise ArithmeticError('a coefficient of friction is negative')
        begin, way = state.begin, (state.point - state.start.point) * state.sliding[:, None]
        viscous = np.zeros(state.shear.shape)
        before, shear = self.pressure, self.shear @ turn.T
        spent = state.spent if begin.friction else 0 * state.spent
        damage = (self.area * self.law.damage(begin, spent, state.normal_gap))[state.closed].sum()
        if state.held:
            earlier = self.bond_gap @ turn.T
            lost = begin.bonds * self.bonded * self.law.initial * (state.held.omega - self.omega) / 2
            damage = (self.area * lost * _dot(state.held.gap, earlier)).sum()
            self.omega, self.bond_gap = state.held.omega, state.held.gap
        self.adhesive_work += damage
        if begin.friction:
            if begin.duration:
                resists = self.law.string(begin, state.spent, state.normal_gap)[3]
                viscous = (resists * self.viscosity / begin.duration * state.way)[:, None] * state.direction
            before_step = SimpleNamespace(pressure=before, limit=begin.before * self.tangential_stiffness)
            self.adhesive_work += (self.area * self.law.adhesive_work(begin, state.way, before_step, state)).sum()
            self.slid = self.slid + state.way
            self.theta = np.where(state.closed, self.friction.theta(begin, state.way), self.theta)
        rise = self.law.rise(self.slid)[0]
        lifted = rise - self.law.rise(begin.slid)[0]
        self.damage += damage
        self.dissipation += (self.area * (_dot(state.shear + shear, way) - (state.pressure + before) * lifted) / 2).sum()
        self.dissipation += damage
        self.viscous_work += (self.area * _dot(viscous + self.viscous @ turn.T, way) / 2).sum()
        self.xi, self.beyond, self.carried = state.xi, state.beyond, state.closed
        self.pressure, self.shear, self.viscous = state.pressure, state.shear, viscous
        self.normal_gap = np.where(state.pressure > 0, rise - state.pressure / self.normal_stiffness,
                                   np.where(state.closed, state.normal_gap, 0))
        self.kappa = np.where(state.closed, self.law.kappa(begin, state.normal_gap), self.kappa)
        torn = begin.bonds & ~state.closed & (not self.law.cohesive)  # only the edge of the master opens a bond
        self.dissipation += (self.area * self.law.stored(begin, 0 * spent, begin.normal_gap))[torn & (before < 0)].sum()
        self.bonded = np.where(torn | self.law.gone(self.kappa), 0, self.bonded)
        closes = ~self.touched & state.closed & (state.normal_gap < 0)
        self.touched = self.touched | closes
        if self.law.cohesive and closes.any():
            x = self.positions(slave_points)[closes]
            self.xi_bond[closes], _ = closest_points(self.master.face, master_points, x, self.xi[closes])
        gap = state.shear / self.tangential_stiffness
        gap[np.linalg.norm(gap, axis=1) <= ROUNDING] = 0  # rounding has no direction that a string could have
        self.gap_parts = np.einsum('mki,mi->mk', state.dual, gap)
        self.face(slave_points, master_points, ~state.closed)
        opens = state.opens = (before > 0) & ~state.closed
        if begin.friction and opens.any():
            place = self._place(master_points, self.xi)
            height = _dot(place.normal, self.positions(slave_points) - place.point)
            height[state.beyond | self.beyond] = state.normal_gap[state.beyond | self.beyond]
            height -= self.law.rise(self.slid)[0]
            rubbed = np.linalg.norm(state.point - begin.point, axis=1)[opens]
            lost = self._lost(before[opens], shear[opens], height[opens], _some(state.start, opens), _some(begin, opens),
                              rubbed, carried[opens])
            self.dissipation += (self.area[opens] * lost).sum()

    def _mean_coefficient(self, begin, way):
        """mu (k,) over the way [mm] of a step, by Gauss points."""
        abscissae, weights = np.polynomial.legendre.leggauss(15)
        mean = np.zeros(len(way))
        for part, weight in zip((1 + abscissae) / 2, weights / 2):
            there = SimpleNamespace(**{**vars(begin), 'duration': part * begin.duration})
            mean += weight * self.law.coefficient(there, part * way)
        return mean

    def _lost(self, pressure, shear, height, place, begin, rubbed, carried):
        """Dissipated per area (k,) [N/mm] by points that open, whose pressure and tangential traction (k, 3) before are given.

        While a point is lifted its pressure falls evenly to zero, in that part of the step in which it is closed; `height`
        is its normal gap at the end. `carried` is by how much the chuck moves it over the master, and the rest of its motion
        that of the solids, which are springs in series with the interface. Its tangential gap moves as long as it is shorter
        than the string mu p / eps_t, which gets shorter, and slides by what is longer, against the viscosity.

        What goes over the edge while it is pressed loses all that it has stored, and is rubbed from where it was to the
        place of the edge where it is in the end.
        """
        def along(vectors):
            return vectors - _dot(vectors, place.normal)[:, None] * place.normal

        gap = shear / self.tangential_stiffness
        depth = pressure / self.normal_stiffness
        of_solids = begin.trial - (gap - depth[:, None] * place.normal) - carried
        beyond = pressure * self._mean_coefficient(begin, rubbed) * rubbed - pressure * height / 2
        beyond += np.maximum(0, _dot(shear, gap + of_solids) / 2)

        risen = np.maximum(0, -_dot(of_solids, place.normal))
        little = 1e-4 * (self.law.coefficient(begin, 0 * depth) * pressure / self.tangential_stiffness) ** 2
        softer = np.maximum(0, (_dot(of_solids, gap) + little * risen / depth) / (_dot(gap, gap) + little))[:, None]
        closed = (depth + risen) / (depth + risen + np.maximum(height, 0))
        motion = closed[:, None] * along(carried) + along(of_solids) - softer * gap
        gap, stiffness = (1 + softer) * gap, self.tangential_stiffness / (1 + softer[:, 0])
        parts, lost = 4000, np.zeros(len(depth))
        now = SimpleNamespace(**{**vars(begin), 'duration': closed * begin.duration / parts})
        viscous = self.viscosity / now.duration / stiffness if begin.duration else 0.
        way = 0 * depth
        for part in range(parts):
            trial = gap + motion / parts
            length = np.linalg.norm(trial, axis=1)
            mu = self.law.coefficient(now, way)  # at the speed of the part before
            way = np.maximum(0, length - mu * pressure * (1 - (part + 1) / parts) / stiffness) / (1 + viscous)
            slip = (way / np.maximum(length, 1e-300))[:, None] * trial
            lost += stiffness * _dot(gap + trial - slip, slip) / 2
            gap = trial - slip
            now.theta, now.slid = self.friction.theta(now, way), now.slid + way
        lost += stiffness * _dot(gap, gap) / 2  # viscosity has held it
        return np.where(height < 0, beyond, lost)

    def energy(self, state):
        """Energy stored in the interface, N mm."""
        shear = (state.shear ** 2).sum(1) / self.tangential_stiffness / 2
        way = state.spent if state.begin.friction else 0 * state.spent
        stored = self.law.stored(state.begin, way, state.normal_gap) * state.closed + shear
        if state.held:
            stored = stored + _dot(state.held.traction, state.held.gap) / 2
        return (self.area * stored).sum()


def _dot(a, b):
    return (a * b).sum(1)


def _direction(trial, normal):
    """Unit vectors (m, 3) of the trial gaps in the tangent planes, and the lengths (m,) of these parts."""
    tangential = trial - _dot(trial, normal)[:, None] * normal
    length = np.maximum(np.linalg.norm(tangential, axis=1), 1e-300)
    return tangential / length[:, None], length


def _some(points, which):
    """The same of the points `which` alone: all arrays, but not what belongs to all points."""
    return SimpleNamespace(**{name: value[which] if isinstance(value, np.ndarray) else value
                              for name, value in vars(points).items()})


def _axes(place):
    """Two unit vectors (m, 3) each in the tangent planes; the normal is the third of them."""
    first = place.tangents[:, 0] / np.linalg.norm(place.tangents[:, 0], axis=1)[:, None]
    return first, np.cross(place.normal, first)


def _in_plane(vectors, place):
    """Tangential parts of vectors (m, 3) as complex numbers (m,)."""
    first, second = _axes(place)
    return _dot(vectors, first) + 1j * _dot(vectors, second)


def _in_space(numbers, place):
    """Vectors (m, 3) in the tangent planes from complex numbers (m,)."""
    first, second = _axes(place)
    return numbers.real[:, None] * first + numbers.imag[:, None] * second


def _blocks(matrices):
    """Block-diagonal sparse matrix of (m, 3, 3)."""
    count = len(matrices)
    return sparse.bsr_matrix((matrices, np.arange(count), np.arange(count + 1)), shape=(3 * count,) * 2).tocsr()
