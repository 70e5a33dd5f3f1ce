"""Implant and bone with the interface between them, moved by the rigid top face of the implant, the chuck.

The bone's displacements are those in space. The implant's are those in the frame of the chuck: a point X of the implant
is at C + u + Q (X - C + v), C = (0, 0, height), so that v = 0 on its top face. Units mm, N, MPa, N mm, radians.
"""
import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg
from scipy.spatial.transform import Rotation


class NotConverged(ArithmeticError):
    """Newton's method has found no equilibrium."""


class Simulation:
    """Two solids.Solid, the interface.Interface between them, and the state that was accepted last.

    contact_area    of the implant's face, mm2
    height          of the chuck's reference point C above z = 0
    tolerance       of the residual, relative to the contact forces (Euclidean norms over all unknowns)
    """

    def __init__(self, bone, implant, interface, contact_area, height, tolerance):
        self.bone, self.implant, self.interface = bone, implant, interface
        self.contact_area, self.tolerance = contact_area, tolerance
        self.centre = np.array([0., 0., height])
        self.bone_displacement = np.zeros(bone.points.shape)
        self.implant_displacement = np.zeros(implant.points.shape)
        self.free = np.flatnonzero(~np.vstack([bone.held, implant.held]).ravel())
        self.state = None
        self.iterations = 0
        self.work = 0.  # of the chuck, N mm

    # ---- kinematics

    def move_chuck(self, components):
        """components: translations x, y, z [mm], rotations x, y, z [rad]; Q = exp(skew(a)) R_z(gamma)."""
        self.components = np.array(components)
        self.translation = self.components[:3]
        tilt = Rotation.from_rotvec([components[3], components[4], 0.])
        self.rotation = (tilt * Rotation.from_rotvec([0., 0., components[5]])).as_matrix()

    def _axes(self):
        """Angular velocities (3, 3), in columns, that belong to unit rates of the three rotations."""
        x, y = self.components[3:5]
        angle = np.hypot(x, y)
        skew = np.array([[0, 0, y], [0, 0, -x], [-y, x, 0]])
        second = (angle - np.sin(angle)) / angle ** 3 if angle > 1e-3 else 1 / 6 - angle ** 2 / 120
        of_tilt = np.eye(3) + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * skew + second * skew @ skew
        return np.column_stack([of_tilt[:, :2], self.rotation[:, 2]])

    def _control_points(self):
        """Current control points of the contact faces of slave and master."""
        bone, implant = self.bone.face.weights.size, self.implant.face.weights.size
        local = self.implant.points[:implant] - self.centre + self.implant_displacement[:implant]
        on_implant = self.centre + self.translation + local @ self.rotation.T
        on_bone = (self.bone.points + self.bone_displacement)[:bone]
        return (on_implant, on_bone) if self.interface.slave is self.implant else (on_bone, on_implant)

    def _motion(self):
        """Sparse matrix: unknowns of bone and implant to the motion of the control points of slave, then master."""
        def of_face(solid, turn):
            return sparse.kron(sparse.eye(solid.face.weights.size, len(solid.points)), turn, 'csr')

        bone, implant = of_face(self.bone, np.eye(3)), of_face(self.implant, self.rotation)
        if self.interface.slave is self.implant:
            return sparse.bmat([[None, implant], [bone, None]], 'csr')
        return sparse.bmat([[bone, None], [None, implant]], 'csr')

    def _turn_of_ways(self):
        """Angles (m,) by which the ways of slave points over the master turn in a step, rad, as if bodies were rigid.

        The implant's centre goes straight, and it turns evenly. The bone rests; seen from the implant it moves. Ways
        begin at the accepted places of the points. Angles are about the z axis of the master's own frame, or its
        opposite, whichever points to the slave.
        """
        way, turn = self.translation - self.accepted_translation, self.rotation @ self.accepted_rotation.T
        spin = Rotation.from_matrix(turn).as_rotvec()
        arms = self.interface.accepted_positions() - self.centre - self.accepted_translation
        if self.interface.slave is self.implant:
            first, last = way + np.cross(spin, arms), way + np.cross(spin, arms @ turn.T)
        else:
            first = -(way + np.cross(spin, arms)) @ self.accepted_rotation
            last = -(way + np.cross(spin, arms - way)) @ self.rotation
        across, along = np.cross(first[:, :2], last[:, :2]), (first[:, :2] * last[:, :2]).sum(1)
        return self.interface.towards * np.arctan2(across, along)

    # ---- equilibrium

    def start(self, components, friction=True):
        """The first state: undeformed bodies where the chuck is, then equilibrium as in a step."""
        self.move_chuck(components)
        self.accepted_translation, self.accepted_rotation = self.translation, self.rotation
        self.interface.face(*self._control_points(), np.ones(len(self.interface.area), bool))
        if self.interface.slave is self.bone:
            self.interface.leave_out_those_beyond()
        self.interface.touch(1e-12 * np.sqrt(self.contact_area / np.pi))
        self._solve(friction, 0.)

    def step(self, components, friction=True, duration=1.):
        """Equilibrium with the chuck at `components`; counts the work of the chuck, with mean forces."""
        before, force = self.components, self._conjugate_forces()
        self.move_chuck(components)
        self._solve(friction, duration)
        self.work += (force + self._conjugate_forces()) @ (self.components - before) / 2

    def _solve(self, friction, duration):
        """Newton's method; the implant first moves along with the chuck as it is, then the state is accepted.

        The tangent of the solids is that of the state before, whose strains differ little.
        In the first iteration all closed points stick: points that begin to slide as the rigid implant would make them
        may change between sliding and sticking for ever.
        """
        motion, turn = self._motion(), self._turn_of_ways()
        bulk = sparse.block_diag([self.bone.tangent(self.bone_displacement),
                                  self.implant.tangent(self.implant_displacement)], 'csr')
        least = 1e-6 * self.interface.normal_stiffness * self.contact_area * self.centre[2]  # N, where all is open
        rounding = 1e-10 * least if self.interface.law.bonds(self.interface).any() else 0.  # of gaps of bonded points
        for self.iterations in range(60):
            first = self.iterations == 0
            self.state = self.interface.respond(*self._control_points(), friction, duration, all_stick=first,
                                                turn=turn)
            contact = np.concatenate(self.interface.nodal_forces(self.state)).ravel()
            internal = np.concatenate([self.bone.forces(self.bone_displacement).ravel(),
                                       self.implant.forces(self.implant_displacement).ravel()])
            residual = (internal + motion.T @ contact)[self.free]
            if not np.isfinite(residual).all():
                break
            if not first and np.linalg.norm(residual) <= max(self.tolerance * max(np.linalg.norm(contact), least), rounding):
                self._accept()
                return
            tangent = bulk + motion.T @ self.interface.tangent(self.state) @ motion
            change = np.zeros(len(internal))
            change[self.free] = -scipy.sparse.linalg.spsolve(tangent[self.free][:, self.free].tocsc(), residual)
            on_bone, on_implant = np.split(change.reshape(-1, 3), [len(self.bone.points)])
            self.bone_displacement = self.bone_displacement + on_bone
            self.implant_displacement = self.implant_displacement + on_implant
        raise NotConverged('no equilibrium after %d iterations' % self.iterations)

    def _accept(self):
        turn = self.rotation @ self.accepted_rotation.T if self.interface.master is self.implant else np.eye(3)
        before, turned = self.interface.accepted_positions(), self.rotation @ self.accepted_rotation.T
        arms = before - self.centre - self.accepted_translation
        carried = arms @ turned.T + self.centre + self.translation - before
        self.interface.accept(self.state, *self._control_points(), turn,
                              carried if self.interface.slave is self.implant else -carried)
        self.accepted_translation, self.accepted_rotation = self.translation, self.rotation

    # ---- results

    def reactions(self):
        """What the chuck exerts on the implant: force [N] and moment about C + u [N mm], (3,) each, in space.

        It balances the tractions of the interface, with the lever arms of the deformed implant.
        """
        state, slave = self.state, self.interface.slave is self.implant
        force = self.interface.area[:, None] * (state.traction if slave else -state.traction)
        place = state.point + state.gap if slave else state.point
        total, moment = force.sum(0), np.cross(place - self.centre - self.translation, force).sum(0)
        if state.held:
            force = self.interface.area[:, None] * (state.held.traction if slave else -state.held.traction)
            place = place if slave else state.held.point
            total, moment = total + force.sum(0), moment + np.cross(place - self.centre - self.translation, force).sum(0)
        return total, moment

    def top_reactions(self):
        """The same from the internal forces of the implant's top face.

        At equilibrium the forces are those of `reactions`, and the moments too if the implant is neo-hookean; a linear
        body balances moments with undeformed lever arms.
        """
        top = self.implant.layers[-1]
        forces = self.implant.forces(self.implant_displacement)[top] @ self.rotation.T
        arms = (self.implant.points[top] - self.centre) @ self.rotation.T
        return forces.sum(0), np.cross(arms, forces).sum(0)

    def _conjugate_forces(self):
        """Forces and moments (6,) that do work on the rates of the six components."""
        force, moment = self.reactions()
        return np.concatenate([force, self._axes().T @ moment])

    def results(self):
        """Reactions, shares of the contact face, mean bonding state and energies, by the names of torque.csv."""
        force, moment = self.reactions()
        state = self.state
        area = self.interface.face_area

        def share(which):
            return area[which].sum() / area.sum()

        bonding = self.interface.law.bond(self.interface)
        row = {'chuck_F%s_N' % axis: value for axis, value in zip('xyz', force)}
        row.update({'chuck_M%s_Nmm' % axis: value for axis, value in zip('xyz', moment)})
        row.update(torque_Nmm=moment @ self.rotation[:, 2], force_N=-force[2],
                   pressure_MPa=-force[2] / self.contact_area,
                   phi_mean=area @ bonding / area.sum(),
                   share_stick=share(state.presses & ~state.slips & ~state.pulled),
                   share_slip=share(state.presses & state.slips & ~state.pulled),
                   share_open=share(state.apart), share_pulled=share(state.pulled),
                   energy_bulk_Nmm=(self.bone.energy(self.bone_displacement)
                                    + self.implant.energy(self.implant_displacement)),
                   energy_interface_Nmm=self.interface.energy(state),
                   work_Nmm=self.work, dissipation_Nmm=self.interface.dissipation,
                   adhesive_work_Nmm=self.interface.adhesive_work, viscous_work_Nmm=self.interface.viscous_work,
                   damage_Nmm=self.interface.damage)
        return row
