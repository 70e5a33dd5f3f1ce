#!/usr/bin/python3
"""A coin on bone with a constant friction coefficient, solved by GetFEM.

The scene is that of ../coin.prm: pressed by 4.9 um, then twisted to 0.05, 0.1, 0.3 and 1 degree. Both bodies are
linear elastic. The interface is stated in GetFEM's weak form language and is the law that debond uses: pressure
p = eps <-g_n>, tangential traction eps (g_t - slip) projected on |t| <= mu p. What is left out is of second order in the
angle: a point of the implant meets the place of the bone that it faced at the start (small sliding), and the top turns by
the linearised rotation, which strains nothing in the small strain theory. Displacements are relative to that rigid
motion, so that they vanish on the top.

Units: mm, N, MPa, degrees. Prints rows of CSV, then "unknowns N" to the error channel.
"""

import argparse
import sys

import numpy as np

import getfem as gf

BONE_SIZE = (12.5, 12.5, 5.0)  # mm
HEIGHT = 3.0  # of the implant, mm
YOUNG_MODULUS = {"bone": 18000.0, "implant": 113000.0}  # MPa
POISSON_RATIO = 0.3
PENALTY = 585.0  # MPa/mm, normal and tangential
FRICTION = 0.58
DEPTH = 0.0049  # mm
ANGLES = (0.0, 0.05, 0.1, 0.3, 1.0)  # degrees; 0: pressed only
TOLERANCE = 1e-7  # of the residual, N; forces are of the order of 50 N
MOST_ITERATIONS = 40

CONTACT, HELD, SIDE_X, SIDE_Y = 1, 2, 3, 4  # regions of faces


def box(cells, degree):
    """The box [-1, 1] x [-1, 1] x [0, 1] in hexahedra with edges of this degree; returns mesh and points, 3 x n."""
    mesh = gf.Mesh("import", "structured", 'GT="GT_QK(3,%d)";ORG=[-1,-1,0];SIZES=[2,2,1];NSUBDIV=[%d,%d,%d]' %
                   ((degree,) + cells))
    return mesh, mesh.pts()


def set_region(mesh, number, direction, sign):
    """Makes a region of the outer faces whose normal points this way."""
    faces = mesh.outer_faces()
    mesh.set_region(number, faces[:, sign * mesh.normal_of_faces(faces)[direction] > 0.9])


def bone_mesh(cells, degree, grading):
    mesh, (x, y, z) = box(cells, degree)
    mesh.set_pts(np.array([BONE_SIZE[0] / 2 * x, BONE_SIZE[1] / 2 * y, -BONE_SIZE[2] * (1 - z) ** grading]))
    set_region(mesh, CONTACT, 2, 1)
    set_region(mesh, HELD, 2, -1)
    faces = mesh.outer_faces()
    for number, direction in ((SIDE_X, 0), (SIDE_Y, 1)):
        mesh.set_region(number, faces[:, abs(mesh.normal_of_faces(faces)[direction]) > 0.9])
    return mesh


def disk(xi, eta):
    """Maps [-1, 1]^2 onto the unit disk as one rational biquadratic patch does, debond's contact face."""
    def bernstein(t):
        return ((1 - t) ** 2 / 4, (1 - t * t) / 2, (1 + t) ** 2 / 4)

    r = np.sqrt(2)
    weights = ((1, 1 / r, 1), (1 / r, 1, 1 / r), (1, 1 / r, 1))
    x = ((-1 / r, 0, 1 / r), (-r, 0, r), (-1 / r, 0, 1 / r))
    parts = [weights[j][i] * bernstein(xi)[i] * bernstein(eta)[j] * np.array([1, x[j][i], x[i][j]])[:, np.newaxis]
             for i in range(3) for j in range(3)]
    weight, x, y = sum(parts)
    return x / weight, y / weight


def implant_mesh(cells, degree, grading, radius):
    """The coin with the nodes of debond's mesh: its edge is a polygon, or arcs of parabolas with degree 2."""
    mesh, (x, y, z) = box((cells[0], cells[0], cells[1]), degree)
    x, y = disk(x, y)
    mesh.set_pts(np.array([radius * x, radius * y, HEIGHT * z**grading]))
    set_region(mesh, CONTACT, 2, -1)
    set_region(mesh, HELD, 2, 1)
    return mesh


def add_body(model, name, mesh, degree):
    """Adds displacement and elasticity of a body. Returns the space of the displacement, without what is held."""
    space = gf.MeshFem(mesh, 3)
    space.set_fem(gf.Fem("FEM_QK(3,%d)" % degree))
    held = set(space.basic_dof_on_region(HELD))
    if name == "bone":
        for number, direction in ((SIDE_X, 0), (SIDE_Y, 1)):
            held.update(dof for dof in space.basic_dof_on_region(number) if dof % 3 == direction)
    free = gf.MeshFem("partial", space, np.array(sorted(set(range(space.nbdof())) - held)))

    E, nu = YOUNG_MODULUS[name], POISSON_RATIO
    model.add_fem_variable("u_" + name, free)
    model.add_initialized_data("lambda_" + name, E * nu / ((1 + nu) * (1 - 2 * nu)))
    model.add_initialized_data("shear_" + name, E / (2 * (1 + nu)))
    points = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,%d)" % (2 * degree + 1)))
    model.add_isotropic_linearized_elasticity_brick(points, "u_" + name, "lambda_" + name, "shear_" + name)
    return free


class Interface:
    """Penalty contact with Coulomb friction on the implant's face, which is the slave; knows how far each point slid."""

    def __init__(self, model, bone, implant, order):
        self.model = model
        self.points = gf.MeshIm(implant, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,%d)" % order))
        self.slip_data = gf.MeshImData(self.points, CONTACT, 3)
        model.add_im_data("slip", self.slip_data)
        model.add_initialized_data("gamma", 0)
        model.add_interpolate_transformation_from_expression("partner", implant, bone, "X")

        gap = "(u_implant + gamma*[-X(2); X(1); 0] - [0; 0; %g] - Interpolate(u_bone, partner))" % DEPTH
        pressure = "(%g*neg_part(%s(3)))" % (PENALTY, gap)
        sideways = "[%s(1); %s(2); 0]" % (gap, gap)
        friction = "Ball_projection(%g*(%s - slip), %g*%s)" % (PENALTY, sideways, FRICTION, pressure)
        self.traction = "([0; 0; %s] - %s)" % (pressure, friction)  # on the implant
        self.slip = "%s - %s/%g" % (sideways, friction, PENALTY)
        model.add_nonlinear_term(
            self.points, "-%s.(Test_u_implant - Interpolate(Test_u_bone, partner))" % self.traction, CONTACT)

    def integral(self, expression):
        return gf.asm_generic(self.points, 0, expression, CONTACT, self.model)

    def force(self):
        """Compression of the interface in N."""
        return self.integral("%s(3)" % self.traction)

    def torque(self):
        """What resists the rotation in N mm."""
        return self.integral("X(2)*%s(1) - X(1)*%s(2)" % (self.traction, self.traction))

    def accept(self):
        self.model.set_variable("slip", self.model.interpolation(self.slip, self.slip_data, CONTACT))


def solve(model):
    """Newton's method, without the line search of Model.solve, which stalls here. Returns the iterations."""
    for iteration in range(MOST_ITERATIONS):
        model.assembly("build_rhs")
        if np.linalg.norm(model.rhs()) <= TOLERANCE:
            return iteration
        model.assembly("build_matrix")
        change = gf.linsolve_mumps(model.tangent_matrix(), model.rhs())
        model.to_variables(model.from_variables() + change.flatten())
    sys.exit("coin.py: no convergence in %d iterations" % MOST_ITERATIONS)


def counts(n):
    """Reads "15,15,4" and the like."""
    def parse(text):
        numbers = tuple(int(number) for number in text.split(","))
        if len(numbers) != n or min(numbers) < 1:
            raise argparse.ArgumentTypeError("expected %d positive integers separated by commas, got '%s'" % (n, text))
        return numbers
    return parse


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bone", type=counts(3), default=(15, 15, 2), help="cells (default 15,15,2)")
    parser.add_argument("--implant", type=counts(2), default=(6, 2), help="cells across and along (default 6,2)")
    parser.add_argument("--degree", type=int, choices=(1, 2), default=1, help="of displacements and of the geometry")
    parser.add_argument("--grading", type=float, default=1.5, help="of the layers (default 1.5)")
    parser.add_argument("--radius", type=float, default=2.5, help="of the implant in mm (default 2.5)")
    parser.add_argument("--quadrature", type=int, default=7, help="order on the contact face (default 7: 4 x 4 points)")
    return parser.parse_args()


def main():
    options = arguments()
    gf.util_trace_level(0)
    bone = bone_mesh(options.bone, options.degree, options.grading)
    implant = implant_mesh(options.implant, options.degree, options.grading, options.radius)
    model = gf.Model("real")
    spaces = [add_body(model, "bone", bone, options.degree),  # the model does not keep them alive
              add_body(model, "implant", implant, options.degree)]
    interface = Interface(model, bone, implant, options.quadrature)

    print("angle_deg,torque_Nmm,force_N,newton_iterations")
    for angle in ANGLES:
        model.set_variable("gamma", np.radians(angle))
        iterations = solve(model)
        print("%g,%.6f,%.6f,%d" % (angle, interface.torque(), interface.force(), iterations), flush=True)
        interface.accept()
    print("unknowns %d" % sum(space.nbdof() for space in spaces), file=sys.stderr)


if __name__ == "__main__":
    main()
