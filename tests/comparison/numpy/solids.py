"""Elastic solids of hexahedra whose contact face is a NURBS surface (Corbett & Sauer 2014).

Points of a solid are numbered: control points of the contact face first, then the nodes of one layer after the other,
away from the contact face. Shapes: N points, e elements, g Gauss points of an element, a points of an element
(13 = 9 + 4 in the layer at the contact face, 8 elsewhere). Units mm, N, MPa, N mm.
"""
import numpy as np
import scipy.sparse as sparse

import nurbs

GAUSS_ABSCISSAE, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(2)


class Solid:
    """A solid in a frame of its own: points, elements, internal forces, their tangent, stored energy.

    face      nurbs.Surface of the contact face
    points    reference positions X (N, 3)
    layers    numbers of the nodes of each layer, arrays ((elements + 1)^2,)
    held      components of the displacement that are zero (N, 3)
    """

    def __init__(self, face, face_points, layers, young, poisson, material):
        """face_points (n n, 3); layers: list of positions ((elements + 1)^2, 3), numbered as control points are."""
        self.face = face
        self.points = np.vstack([face_points] + layers)
        ends = len(face_points) + np.cumsum([0] + [len(layer) for layer in layers])
        self.layers = [np.arange(a, b) for a, b in zip(ends, ends[1:])]
        self.held = np.zeros(self.points.shape, bool)
        self.shear = young / (2 * (1 + poisson))  # G, Lambda: Eq. (2)
        self.lame = 2 * self.shear * poisson / (1 - 2 * poisson)
        self.linear = material == 'linear'
        self._set_up_elements()
        if self.linear:
            self._stiffness = self._tangent(np.zeros(self.points.shape))

    # ---- elements

    def _set_up_elements(self):
        """Groups of elements: numbers of points (e, a), gradients of the functions (e, g, a, 3), volumes (e, g)."""
        n = self.face.elements
        i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n), indexing='ij'))
        corners = np.stack([i * (n + 1) + j, (i + 1) * (n + 1) + j, i * (n + 1) + j + 1, (i + 1) * (n + 1) + j + 1], 1)
        places = [(x, y, z) for z in GAUSS_ABSCISSAE for y in GAUSS_ABSCISSAE for x in GAUSS_ABSCISSAE]

        enriched, numbers = [], None
        for x, y, z in places:
            xi = np.stack([(i + (1 + x) / 2) / n, (j + (1 + y) / 2) / n], 1)
            numbers, values, slopes = self.face.basis(xi)
            face = np.concatenate([slopes / (2 * n) * (1 - z) / 2, -values[..., None] / 2], -1)
            opposite = np.broadcast_to(self._bilinear(x, y, z, +1), (n * n, 4, 3))
            enriched.append(np.concatenate([face, opposite], 1))
        self.groups = [self._group(np.hstack([numbers, self.layers[0][corners]]), np.stack(enriched, 1))]

        trilinear = np.stack([np.vstack([self._bilinear(*p, -1), self._bilinear(*p, +1)]) for p in places])
        for near, far in zip(self.layers, self.layers[1:]):
            numbers = np.hstack([near[corners], far[corners]])
            self.groups.append(self._group(numbers, np.broadcast_to(trilinear, (n * n,) + trilinear.shape)))

    @staticmethod
    def _bilinear(x, y, z, side):
        """Derivatives (4, 3) of the functions of the four nodes at z = side of [-1, 1]^3."""
        sx, sy = np.array([-1, 1, -1, 1]), np.array([-1, -1, 1, 1])
        fx, fy, fz = (1 + sx * x) / 2, (1 + sy * y) / 2, (1 + side * z) / 2
        return np.stack([sx / 2 * fy * fz, fx * sy / 2 * fz, fx * fy * side / 2], 1)

    def _group(self, numbers, derivatives):
        """derivatives (e, g, a, 3): with respect to the coordinates of the element, [-1, 1]^3."""
        jacobian = np.einsum('eai,egak->egik', self.points[numbers], derivatives)
        volume = np.linalg.det(jacobian)
        if not (np.sign(volume) == np.sign(volume.flat[0])).all():
            raise ValueError('an element is turned inside out')
        weights = np.einsum('i,j,k->ijk', GAUSS_WEIGHTS, GAUSS_WEIGHTS, GAUSS_WEIGHTS).ravel()
        gradients = np.einsum('egak,egki->egai', derivatives, np.linalg.inv(jacobian))
        return numbers, gradients, np.abs(volume) * weights

    # ---- material

    def _strain(self, displacement, group):
        """H = grad u, F^-T (e, g, 3, 3) and ln J (e, g), without cancellation for small strains."""
        numbers, gradients, _ = group
        h = np.einsum('eai,egaj->egij', displacement[numbers], gradients)
        inverse = np.linalg.inv(np.eye(3) + h).swapaxes(-1, -2)
        trace = np.trace(h, axis1=-2, axis2=-1)
        second = 0.5 * (trace ** 2 - (h * h.swapaxes(-1, -2)).sum((-1, -2)))
        return h, inverse, np.log1p(trace + second + np.linalg.det(h))

    def forces(self, displacement):
        """Internal forces (N, 3) at displacements (N, 3).

        P = G (F - F^-T) + Lambda ln J F^-T, Eq. (1), with F - F^-T = H + H^T F^-T; or the linear forces.
        """
        if self.linear:
            return (self._stiffness @ displacement.ravel()).reshape(-1, 3)
        result = np.zeros(self.points.shape)
        for group in self.groups:
            numbers, gradients, volume = group
            h, inverse, log_j = self._strain(displacement, group)
            stress = (self.shear * (h + h.swapaxes(-1, -2) @ inverse)
                      + self.lame * log_j[..., None, None] * inverse)
            np.add.at(result, numbers, np.einsum('egij,egaj,eg->eai', stress, gradients, volume))
        return result

    def energy(self, displacement):
        """Stored energy: the integral of W = G/2 (tr C - 3) - G ln J + Lambda/2 (ln J)^2, Eq. (1)."""
        if self.linear:
            return 0.5 * displacement.ravel() @ self._stiffness @ displacement.ravel()
        result = 0.
        for group in self.groups:
            h, _, log_j = self._strain(displacement, group)
            trace_c = 2 * np.trace(h, axis1=-2, axis2=-1) + (h ** 2).sum((-1, -2))  # tr C - 3
            density = self.shear * (trace_c / 2 - log_j) + self.lame / 2 * log_j ** 2
            result += (group[2] * density).sum()
        return result

    def tangent(self, displacement):
        """Sparse derivative (3N, 3N) of the internal forces."""
        return self._stiffness if self.linear else self._tangent(displacement)

    def _tangent(self, displacement):
        """Of Eq. (1): G D_aj D_bj delta_ik + (G - Lambda ln J) d_ak d_bi + Lambda d_ai d_bk, d_a = F^-T D_a."""
        rows, columns, entries = [], [], []
        for group in self.groups:
            numbers, gradients, volume = group
            _, inverse, log_j = self._strain(displacement, group)
            current = np.einsum('egij,egaj->egai', inverse, gradients)
            block = np.einsum('egai,egbk,eg->eaibk', current, current, self.lame * volume, optimize=True)
            block += np.einsum('egak,egbi,eg->eaibk', current, current, (self.shear - self.lame * log_j) * volume,
                               optimize=True)
            same = np.einsum('egaj,egbj,eg->eab', gradients, gradients, self.shear * volume, optimize=True)
            for k in range(3):
                block[:, :, k, :, k] += same
            unknowns = (3 * numbers[:, :, None] + np.arange(3)).reshape(len(numbers), -1)
            size = unknowns.shape[1]
            rows.append(np.repeat(unknowns, size, 1).ravel())
            columns.append(np.tile(unknowns, (1, size)).ravel())
            entries.append(block.ravel())
        place = (np.concatenate(rows), np.concatenate(columns))
        return sparse.csr_matrix((np.concatenate(entries), place), shape=(self.points.size,) * 2)


def _at_height(plane, z):
    return np.column_stack([plane, np.full(len(plane), z)])


def _depths(height, layers, grading):
    """Distances of the layers from the contact face, graded towards it."""
    return height * (np.arange(1, layers + 1) / layers) ** grading


def bone_block(size, cells, grading, young, poisson, material):
    """A block, top face at z = 0 around the origin, held at its bottom, and at its sides in the normal direction.

    size (x, y, z) in mm; cells across and along z.
    """
    across, deep = cells
    face, plane = nurbs.rectangle(size[0], size[1], across)
    s = np.linspace(-0.5, 0.5, across + 1)
    x, y = np.meshgrid(size[0] * s, size[1] * s, indexing='ij')
    nodes = np.column_stack([x.ravel(), y.ravel()])
    layers = [_at_height(nodes, -depth) for depth in _depths(size[2], deep, grading)]
    solid = Solid(face, _at_height(plane, 0.), layers, young, poisson, material)
    solid.held[solid.layers[-1]] = True
    for k in range(2):
        solid.held[:, k] |= np.abs(solid.points[:, k]) > size[k] / 2 * (1 - 1e-9)
    return solid


def coin(radius, height, cells, grading, young, poisson, material):
    """A coin, contact face at z = 0 around the origin, held at its top; cells across and along its axis.

    The contact face is an exact disk; the nodes above lie on the vertices of its elements, joined by straight lines.
    """
    across, high = cells
    face, plane = nurbs.disk(radius, across)
    s = np.linspace(0, 1, across + 1)
    vertices = np.stack(np.meshgrid(s, s, indexing='ij'), -1).reshape(-1, 2)
    nodes = face.point(_at_height(plane, 0.), vertices)[0][:, :2]
    layers = [_at_height(nodes, depth) for depth in _depths(height, high, grading)]
    solid = Solid(face, _at_height(plane, 0.), layers, young, poisson, material)
    solid.held[solid.layers[-1]] = True
    return solid
