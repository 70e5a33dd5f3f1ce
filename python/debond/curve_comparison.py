"""How far a computed torque curve is from a measured one."""

from dataclasses import dataclass, field
from typing import List

import numpy


def torque_at(curve: numpy.ndarray, angles: numpy.ndarray, tolerance: float = 0.0) -> numpy.ndarray:
    """Torques [N mm] at `angles` [deg], linear between the points of a curve (2, points) whose angles do not fall; NaN beside
    them. Differences of angles up to `tolerance` from the ends are rounding errors."""
    (begin, torque), (end, next_torque) = curve[:, :-1], curve[:, 1:]
    torques = numpy.full(len(angles), numpy.nan)
    for row, angle in enumerate(angles):
        for last in curve[0, [0, -1]]:
            angle = last if abs(angle - last) <= tolerance else angle
        for i in numpy.flatnonzero((begin <= angle) & (angle <= end) & (begin != end))[:1]:
            part = (angle - begin[i]) / (end[i] - begin[i])
            torques[row] = next_torque[i] if angle == end[i] else torque[i] + part * (next_torque[i] - torque[i])
    return torques


def _rotation(angles):
    """How the angle [deg] runs over the rows of a curve: +1, -1, or 0 if nothing rotates; whether it turns back; and the
    tolerance [deg] up to which changes are rounding errors of a chuck that is free to turn."""
    tolerance = 1e-9 * max(1.0, numpy.ptp(angles))
    moved = angles[abs(angles - angles[0]) > tolerance]
    direction = numpy.sign(moved[0] - angles[0]) if moved.size else 0.0
    turned = direction * angles
    return direction, numpy.any(turned < numpy.maximum.accumulate(turned) - tolerance), tolerance


def _turns_back(angles):
    """By more than a twentieth of its range: angles are measured, too."""
    falls, rises = numpy.maximum.accumulate(angles) - angles, angles - numpy.minimum.accumulate(angles)
    return min(falls.max(), rises.max()) > 0.05 * numpy.ptp(angles)


@dataclass
class CurveComparison:
    """How far a computed curve is from a measured one, at the rows of the latter that the former covers and whose angles are
    positive, or negative if the implant turns backwards. Rows with less than a hundredth of the largest measured torque would
    dominate a relative error and are left out. Numbers are NaN if no row is left."""

    rows_used: int = 0  # of the measured curve
    e_mp: float = numpy.nan  # mean of |T - T_measured| / |T_measured|, Eq. (19) of the paper
    e_rel: float = numpy.nan  # mean of |T - T_measured| over the largest computed torque, Eq. (50)
    difference_mean: float = numpy.nan  # of |T - T_measured|, over the largest measured torque
    difference_max: float = numpy.nan
    angle_of_max_deg: float = numpy.nan  # where it is largest
    remarks: List[str] = field(default_factory=list)  # what may be wrong with the measured curve: its units, its sign
    why_none: str = ""  # no row is used

    def text(self) -> str:
        """"2.3 % in the mean, 6 % at most, at 0.9 deg", or why not."""
        if not self.rows_used:
            return "not compared: " + self.why_none
        mean, most = (f"{numpy.floor(percent + 0.5):.6g}" if percent >= 100 else f"{percent:.2g}"
                      for percent in (100 * self.difference_mean, 100 * self.difference_max))
        return f"{mean} % in the mean, {most} % at most, at {self.angle_of_max_deg:.3g} deg"


def compare_curves(computed: numpy.ndarray, measured: numpy.ndarray) -> CurveComparison:
    """Compares two curves, arrays (2, points) of angles [deg] and torques [N mm]."""
    direction, reverses, tolerance = _rotation(computed[0])
    if direction == 0 or reverses:
        return CurveComparison(why_none="the run turns back" if reverses else "nothing has rotated in the run")
    end, T_max, measured_end, T_largest = (numpy.fmax.reduce(abs(row)) for row in (*computed, *measured))
    T = torque_at(computed * [[direction], [1]], direction * measured[0], tolerance)
    used = (direction * measured[0] > 0) & (abs(measured[1]) > 0.01 * T_largest) & numpy.isfinite(T)
    T, (angles, T_measured) = T[used], measured[:, used]
    remarks = []
    if not 0.01 * T_max < T_largest < 100 * T_max:
        remarks.append(f"the largest torque of the reference curve is {T_largest:.4g} and that of the run {T_max:.4g} N mm: "
                       "is it in N mm?")
    if measured_end < 0.05 * end:
        remarks.append(f"the reference curve ends at {measured_end:.4g} and the run at {end:.4g} degrees: is it in degrees?")
    if T @ T_measured < 0:
        remarks.append("the torques of the reference curve have the opposite sign: a minus before the unit turns it, as in "
                       "Reference columns = 1 [deg], 2 [-N m]")
    if _turns_back(measured[0]):
        remarks.append("the angles of the reference curve turn back: loading and unloading, or two tests, are compared with "
                       "one curve")
    if not T.size:
        ends = (*computed[0, [0, -1]], *measured[0, [0, -1]])
        why = "the run turns from {:.4g} to {:.4g} deg, and the curve from {:.4g} to {:.4g} deg"
        return CurveComparison(remarks=remarks, why_none=why.format(*ends))
    difference = abs(T - T_measured)
    with numpy.errstate(divide="ignore"):  # a run without torques
        e_rel = difference.mean() / T_max
    return CurveComparison(T.size, (difference / abs(T_measured)).mean(), e_rel, difference.mean() / T_largest,
                           difference.max() / T_largest, angles[difference.argmax()], remarks)
