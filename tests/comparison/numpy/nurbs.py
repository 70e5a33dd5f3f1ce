"""Quadratic NURBS surfaces on uniform open knot vectors.

Shapes: m points, n control points in each direction, control point (i, j) has the number i * n + j, i along the first
parameter. Parameters lie in [0, 1] x [0, 1]. Lengths in mm.
"""
import numpy as np


class QuadraticSplines:
    """The quadratic B-splines of one direction: `elements` knot spans of equal length, elements + 2 functions."""

    def __init__(self, elements):
        self.elements = elements
        self.count = elements + 2
        self.knots = np.concatenate([[0, 0], np.linspace(0, 1, elements + 1), [1, 1]])

    def greville(self):
        """Abscissae (count,) at which control points represent the identity."""
        return 0.5 * (self.knots[1:-2] + self.knots[2:-1])

    def evaluate(self, parameter):
        """Number of the first function (m,), three values (m, 3) and derivatives (m, 3) at parameters (m,)."""
        element = np.clip((parameter * self.elements).astype(int), 0, self.elements - 1)
        u1, u2, u3, u4 = (self.knots[element + k] for k in range(1, 5))
        left, right = (u3 - parameter) / (u3 - u2), (parameter - u2) / (u3 - u2)  # the linear functions on [u2, u3]
        values = np.stack([(u3 - parameter) / (u3 - u1) * left,
                           (parameter - u1) / (u3 - u1) * left + (u4 - parameter) / (u4 - u2) * right,
                           (parameter - u2) / (u4 - u2) * right], -1)
        slopes = np.stack([-2 * left / (u3 - u1),
                           2 * left / (u3 - u1) - 2 * right / (u4 - u2),
                           2 * right / (u4 - u2)], -1)
        return element, values, slopes


class Surface:
    """A rational biquadratic surface of elements x elements knot spans; it knows its weights but not its points."""

    def __init__(self, elements, weights):
        self.splines = QuadraticSplines(elements)
        self.elements = elements
        self.weights = np.ravel(weights)

    def basis(self, xi):
        """Numbers (m, 9), values (m, 9) and derivatives (m, 9, 2) of the functions at xi (m, 2)."""
        first, n1, d1 = self.splines.evaluate(xi[:, 0])
        second, n2, d2 = self.splines.evaluate(xi[:, 1])
        k = np.arange(3)
        numbers = ((first[:, None, None] + k[:, None]) * self.splines.count
                   + second[:, None, None] + k).reshape(-1, 9)

        def weighted(a, b):
            return (a[:, :, None] * b[:, None, :]).reshape(-1, 9) * self.weights[numbers]

        values, along_1, along_2 = weighted(n1, n2), weighted(d1, n2), weighted(n1, d2)
        total = values.sum(1, keepdims=True)
        values = values / total
        slopes = np.stack([(s - values * s.sum(1, keepdims=True)) / total for s in (along_1, along_2)], -1)
        return numbers, values, slopes

    def point(self, control_points, xi):
        """Positions (m, 3) and tangents a_1, a_2 (m, 2, 3) at xi (m, 2).

        The control points (n n, 3) are those of one surface, or (m, n n, 3) of one for each xi.
        """
        numbers, values, slopes = self.basis(xi)
        near = np.take_along_axis(control_points, numbers[..., None], 1) if control_points.ndim == 3 \
            else control_points[numbers]
        return np.einsum('ma,mai->mi', values, near), np.einsum('mak,mai->mki', slopes, near)


def rectangle(size_x, size_y, elements):
    """The surface and the control points (n n, 2) of a rectangle around the origin; the map is affine."""
    surface = Surface(elements, np.ones((elements + 2) ** 2))
    s = surface.splines.greville() - 0.5
    x, y = np.meshgrid(size_x * s, size_y * s, indexing='ij')
    return surface, np.column_stack([x.ravel(), y.ravel()])


def disk(radius, elements):
    """The surface and the control points (n n, 2) of the exact disk: one rational patch, refined.

    The refined net is that of the splines which interpolate the homogeneous coordinates (w x, w y, w) of the single
    patch at the Greville abscissae; these are polynomials of degree 2, so that nothing changes.
    """
    q = 1 / np.sqrt(2)
    c, t = radius * q, radius / q
    points = np.array([[[-c, -c], [-t, 0], [-c, c]], [[0, -t], [0, 0], [0, t]], [[c, -c], [t, 0], [c, c]]])
    weights = np.array([[1, q, 1], [q, 1, q], [1, q, 1]])
    homogeneous = np.concatenate([points * weights[..., None], weights[..., None]], -1)

    splines = QuadraticSplines(elements)
    s = splines.greville()
    first, values, _ = splines.evaluate(s)
    collocation = np.zeros((splines.count, splines.count))
    for row, (start, three) in enumerate(zip(first, values)):
        collocation[row, start:start + 3] = three
    bernstein = np.stack([(1 - s) ** 2, 2 * s * (1 - s), s ** 2], 1)
    refine = np.linalg.solve(collocation, bernstein)
    net = np.einsum('ai,bj,ijk->abk', refine, refine, homogeneous)
    return Surface(elements, net[..., 2]), (net[..., :2] / net[..., 2:]).reshape(-1, 2)
