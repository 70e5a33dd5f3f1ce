"""The string by which a sliding point tows its interacting point, `Slip direction = integrated`.

The gap between the two is a string of the length mu p / eps_t. A point moves over the master along an arc; its
interacting point rests as long as the gap is shorter than the string, which then pulls it along.

Vectors in the tangent plane are complex numbers, arrays of the shape (m,), one entry per point. Lengths in mm; angles
in rad, positive from the real to the imaginary axis.
"""
from types import SimpleNamespace

import numpy as np


def arc(chord, turn, fraction):
    """The part of an arc that lies behind a `fraction` of its length, and its derivative with respect to that.

    The arc leads over the `chord`, turns by `turn` and begins in the direction of the chord turned by -turn/2.
    """
    length = chord / np.sinc(turn / (2 * np.pi))
    behind = length * fraction * np.sinc(fraction * turn / (2 * np.pi)) * np.exp(0.5j * turn * (fraction - 1))
    return behind, length * np.exp(1j * turn * (fraction - 0.5))


def beginning(gap, chord, turn, before, held):
    """Fraction (m,) of the arc after which the gap stays longer than its string, 1 if it is not longer at the end.

    The string's length goes linearly from `before` to `held`. A gap that is as long as the string from the beginning,
    and does not get shorter compared with it, slides at once; so does one that is longer all the way.
    """
    string = gap, chord, turn, before, held
    value, slope = _excess(0., *string)
    at_once = (value >= -1e-12 * before ** 2) & (slope >= 0)
    later = ~at_once & (_excess(1., *string)[0] > 0)
    result = np.where(at_once, 0., 1.)
    if later.any():
        result[later] = _last_within(*(values[later] for values in string))
    return result


def _excess(fraction, gap, chord, turn, before, held):
    """Of the gap's squared length over that of the string, and its derivative with respect to the fraction."""
    behind, slope = arc(chord, turn, fraction)
    now, string = gap + behind, before + fraction * (held - before)
    return np.abs(now) ** 2 - string ** 2, 2 * (now.conj() * slope).real - 2 * string * (held - before)


def _last_within(*string):
    """The last fraction (m,) at which a gap is not longer than its string, though it is at the end; 0 if none is."""
    def excess(fraction):
        return _excess(fraction, *string)

    fractions = np.linspace(0, 1, 33)
    values, slopes = excess(fractions[:, None])
    low = np.where(values <= 0, fractions[:, None], 0).max(0)

    # between two of these fractions a gap may be within for a while
    dips = (slopes[:-1] < 0) & (slopes[1:] > 0) & (fractions[:-1, None] >= low)
    if dips.any():
        cell = np.where(dips, np.arange(32)[:, None], 0).max(0)
        left, right = fractions[cell], fractions[cell + 1]
        for _ in range(50):
            middle = (left + right) / 2
            falls = excess(middle)[1] < 0
            left, right = np.where(falls, middle, left), np.where(falls, right, middle)
        low = np.where(dips.any(0) & (excess(left)[0] <= 0), left, low)

    high = np.where((values > 0) & (fractions[:, None] > low), fractions[:, None], 1).min(0)
    high = np.where(excess(low)[0] <= 0, high, low)
    return zero(excess, low, high)


def pull(string, half, way, turn):
    """Tow along an arc of the length `way`, which turns by `turn`, with a string of constant length.

    half is exp(i alpha / 2) at the beginning, alpha being the angle from the arc's direction to the gap. Returns it at
    the end, and the distance that the interacting point has moved. With d alpha/ds = -turn/way - sin(alpha)/string
    the multiple r exp(i alpha / 2) fulfils a linear equation if d(ln r)/ds = cos(alpha) / (2 string), and cos(alpha)
    is the distance that the interacting point moves per way.
    """
    a, b = way / (2 * string), turn / 2  # the equation's matrix times the way is [[a, b], [-b, -a]]
    square = (a - b) * (a + b)
    root = np.sqrt(np.abs(square)) + 1e-300
    grown = np.where(square > 0, root, 0)  # the exponential of the matrix is that of `grown` times the following
    even = np.where(square > 0, (1 + np.exp(-2 * root)) / 2, np.cos(root))
    odd = np.where(square > 0, -np.expm1(-2 * root) / 2, np.sin(root)) / root
    real = even * half.real + odd * (a * half.real + b * half.imag)
    imag = even * half.imag - odd * (b * half.real + a * half.imag)
    factor = np.maximum(np.hypot(real, imag), 1e-300)
    return (real + 1j * imag) / factor, 2 * string * (grown + np.log(factor))


def tow(gap, chord, turn, before, held, string):
    """The `gap` (m,) at the end of a step, and the distance `slid`.

    The string that tows has the mean of its lengths at the beginning and the end of that. A gap without length opens
    along the arc.

    gap         at the beginning
    chord, turn of the arc along which the point moves over the master
    before      length of the string at the beginning
    held        its length at the end if the point does not slide
    string      function of the distance slid: length at the end, and its derivative
    """
    fraction = beginning(gap, chord, turn, before, held)
    behind, slope = arc(chord, turn, fraction)
    first = gap + behind
    way, left = (1 - fraction) * np.abs(slope), (1 - fraction) * turn
    direction = np.where(slope == 0, 1, slope) / np.where(slope == 0, 1, np.abs(slope))
    length = np.abs(first)
    apart = np.where(length > 0, first, direction)
    half = np.sqrt(apart / np.abs(apart) * direction.conj())

    def towed(slid):
        """The string's length at the end with its derivative, its mean length, and what it does."""
        last, slope = string(slid)
        mean = np.maximum((length + last) / 2, 1e-16 * way + 1e-300)  # a string without length follows the arc
        end, pulled = pull(mean, half, way, left)
        return last, slope, mean, end, pulled

    def balance(slid):
        """The distance slid and the growth of the gap over the distance pulled, and its derivative, nearly."""
        last, slope, mean, _, pulled = towed(slid)
        by_mean = (pull(mean * (1 + 1e-6), half, way, left)[1] - pulled) / (1e-6 * mean)
        return slid + last - length - pulled, 1 + slope * (1 - by_mean / 2)

    # nothing is pulled further than the way
    slid = zero(balance, -np.maximum(string(0 * way)[0] - length, 0) - way, length + way)
    last, _, _, end, _ = towed(slid)
    slides = fraction < 1
    return SimpleNamespace(gap=np.where(slides, last * direction * np.exp(1j * left) * end ** 2, first),
                           slid=np.where(slides, slid, 0))


def zero(function, low, high):
    """Where functions are 0 that are at most 0 at `low` and at least 0 at `high` (m,); they return slopes, too.

    Newton's method, and bisection where it would leave what is left of the interval.
    """
    x, size = (low + high) / 2, np.abs(low) + np.abs(high)
    for _ in range(100):
        value, slope = function(x)
        low, high = np.where(value <= 0, x, low), np.where(value >= 0, x, high)
        following = x - value / np.where(slope > 0, slope, 1e-300)
        following = np.where((following >= low) & (following <= high), following, (low + high) / 2)
        if (np.abs(following - x) <= 1e-14 * size).all():
            return following
        x = following
    return x
