#include <debond/interface/towed_gap.h>

#include <algorithm>

// Vectors of the tangent plane are complex numbers here: a turn is a product,
// and the half-plane to the left of a vector belongs to positive angles.
namespace Debond
{
  namespace
  {
    using Vector = std::complex<double>;

    double
    dot(const Vector &a, const Vector &b)
    {
      return a.real() * b.real() + a.imag() * b.imag();
    }

    double
    cross(const Vector &a, const Vector &b)
    {
      return a.real() * b.imag() - a.imag() * b.real();
    }

    // std::abs() of complex numbers is slow, as it can do with any exponents
    double
    length_of(const Vector &a)
    {
      return std::sqrt(std::norm(a));
    }

    Vector
    perpendicular(const Vector &a)
    {
      return {-a.imag(), a.real()};
    }



    /** The way of the point in the step: an arc over the chord `motion'. */
    struct Path
    {
      const Arc   &arc;
      const Vector motion;
      const double chord_length, length;
      const Vector chord; ///< unit vector

      Path(const Eigen::Vector2d &motion, const Arc &arc)
        : arc(arc)
        , motion(motion[0], motion[1])
        , chord_length(length_of(this->motion))
        , length(chord_length / arc.chord_over_length)
        , chord(chord_length > 0. ? this->motion / chord_length : 1.)
      {}

      /** After a fraction of the way: the part of the chord that lies behind,
       *  turned into the direction from where the point came, and the direction
       *  in which it goes. */
      struct Here
      {
        Vector part, direction;
      };
      Here
      at(const double fraction) const
      {
        const Vector back = std::conj(arc.half_turn);
        if (fraction == 0.)
          return {0., chord * back};
        if (fraction == 1.)
          return {1., chord * arc.half_turn};
        if (arc.turn == 0.)
          return {fraction, chord};
        const Arc    behind(arc.turn * fraction);
        const Vector half = behind.half_turn * back;
        return {fraction * behind.chord_over_length / arc.chord_over_length *
                  half,
                chord * half * behind.half_turn};
      }

      /** Derivative of that part by the turn. */
      Vector
      part_by_turn(const double fraction) const
      {
        if (fraction == 0. || fraction == 1.)
          return 0.;
        const double f = fraction, t = arc.turn, h = 0.5 * t;
        // sin(f h) / sin(h) = f (1 + (1 - f^2) (t^2 / 24 + (7 - 3 f^2) t^4 /
        // 5760 + ...))
        const double ratio_by_turn =
          std::abs(t) < 0.02 ?
            f * (1. - f * f) *
              (t / 12. + (7. - 3. * f * f) * t * t * t / 1440.) :
            0.5 * (f * std::cos(f * h) - std::sin(f * h) / std::tan(h)) /
              std::sin(h);
        return ratio_by_turn * std::polar(1., h * (f - 1.)) +
               0.5 * (f - 1.) * perpendicular(at(f).part);
      }
      double
      length_by_turn() const
      {
        const double t = arc.turn, c = arc.chord_over_length;
        return -length / c *
               (std::abs(t) < 0.02 ? -t / 12. + t * t * t / 480. :
                                     (std::cos(0.5 * t) - c) / t);
      }
    };



    /** Where on the path sliding begins: where the gap becomes longer than its
     *  limit, which runs from @p old_limit by @p change [mm]. */
    struct Beginning
    {
      // fraction of the way, the part of the chord behind it, the gap there
      // [mm] and the direction in which the point goes
      double fraction = 0.;
      Vector part     = 0., gap, direction;
      double limit    = 0.; ///< [mm]
      double slope    = 0.; ///< of gap^2 - limit^2 by the fraction [mm^2]

      Beginning(const Path   &path,
                const Vector &old_gap,
                const double  old_limit,
                const double  change)
      {
        const auto excess = [&](const double at) {
          const auto   here = path.at(at);
          const Vector g    = old_gap + here.part * path.motion;
          const double l    = old_limit + at * change;
          fraction          = at;
          part              = here.part;
          direction         = here.direction;
          gap               = g;
          limit             = l;
          slope = 2. * (dot(g, here.direction) * path.length - l * change);
          return std::norm(g) - l * l;
        };
        // It slides at once, or at rounding, as it did when it came here.
        double f = excess(0.);
        if (f >= -1e-12 * old_limit * old_limit && slope >= 0.)
          return;
        // What holds at the end has not begun to slide at all. Else the gap
        // leaves the limit for good where it does: Newton's method, from the
        // beginning if that leads inside the way, as it does soon for what only
        // just holds, and bisection where it would leave the bracket.
        const double next   = slope > 0. ? std::min(1., -f / slope) : 1.;
        double       inside = 0., outside = 1.;
        if ((f = excess(1.)) <= 0.)
          return;
        if (next < 1.)
          f = excess(next);
        for (unsigned int i = 0; i < 100; ++i)
          {
            (f > 0. ? outside : inside) = fraction;
            double better               = fraction - f / slope;
            // as good as it gets where it is the place itself
            if (!(better >= inside && better <= outside))
              better = 0.5 * (inside + outside);
            const double moved = std::abs(better - fraction);
            f                  = excess(better);
            if (moved < 1e-12)
              break;
          }
        // It was longer from the beginning on, as viscosity makes it: there is
        // no root whose place could change.
        if (fraction < 2e-12)
          excess(0.);
      }
    };



    /**
     * How the angle alpha from the path's direction to the gap goes on. With u
     * = tan(alpha/2) = s/c its equation is one of Riccati, and linear in (c,
     * s):
     *
     *   2 c' = c/L - kappa s,   2 s' = kappa c - s/L,
     *
     * and cos(alpha) = L d ln(c^2 + s^2)/ds. So (c, s) is multiplied by
     * exp(M) = C + S M over a way, with M = [x, -k; k, -x], x = way / 2L, and k
     * = way kappa / 2: minus half of the angle by which the path turns.
     */
    struct Turning
    {
      Vector turned; ///< from the path's direction at the end to the gap
      double growth; ///< of ln(c^2 + s^2)
      /** Of the angle alpha at the end, and of the growth, with alpha at the
       *  beginning, x and k. */
      Eigen::Matrix<double, 2, 3> derivative;

      /** @p gap: unit vector at the beginning, from the path's direction. */
      Turning(const Vector &gap, const double x, const double k)
      {
        // half of the angle, without loss of digits
        Vector w = gap.real() >= 0. ? Vector(1. + gap.real(), gap.imag()) :
                                      Vector(gap.imag(), 1. - gap.real());
        w /= length_of(w);
        // C and S, and dS/dq, times e^-scale; dC/dq is S/2
        // exp(M) of a traceless 2 x 2 matrix, M^2 = q 1: hyperbolic where the
        // string turns towards the path faster than the path turns away, else
        // circular, and a series in between. e^-scale keeps long ways from
        // overflowing.
        const double q = x * x - k * k;
        double C = 1. + 0.5 * q + q * q / 24., S = 1. + q / 6. + q * q / 120.,
               S_q = 1. / 6. + q / 60., scale = 0.;
        if (std::abs(q) > 1e-4)
          {
            const double root = std::sqrt(std::abs(q));
            if (q > 0.)
              {
                const double fall = std::exp(-2. * root);
                scale             = root;
                C                 = 0.5 * (1. + fall);
                S                 = 0.5 * (1. - fall) / root;
              }
            else
              {
                C = std::cos(root);
                S = std::sin(root) / root;
              }
            S_q = 0.5 * (C - S) / q;
          }
        const auto M = [&](const Vector &v) {
          return Vector(x * v.real() - k * v.imag(),
                        k * v.real() - x * v.imag());
        };
        const Vector M_w = M(w), end = C * w + S * M_w;
        const double square = std::norm(end);
        growth              = 2. * scale + std::log(square);
        turned              = end * end / square;
        const Vector half   = 0.5 * perpendicular(w); // dw/dalpha
        const Vector by_q   = 0.5 * S * w + S_q * M_w;
        const Vector d[]{C * half + S * M(half),
                         2. * x * by_q + S * std::conj(w),
                         -2. * k * by_q + S * perpendicular(w)};
        for (unsigned int i = 0; i < 3; ++i)
          derivative.col(i) << 2. * cross(end, d[i]) / square,
            2. * dot(end, d[i]) / square;
      }
    };



    using Row = Eigen::Matrix<double, 1, 7>;

    /** The string when sliding begins, and the way that the point then has
     *  to go, with derivatives like those of TowedGap. */
    struct Start
    {
      // The columns of all rows are those of TowedGap::derivative: old gap (2),
      // motion (2), limit at the end, length of the gap at the end, turn of the
      // path.
      double way, length; ///< [mm]
      Vector unit;        ///< along the gap, from the path's direction
      Row    d_way, d_length;
      Row    d_angle; ///< of alpha
      Row    d_chord; ///< of the angle of the chord
      Row    d_fraction = Row::Zero();

      Start(const Path &path, const Beginning &beginning)
        : way((1. - beginning.fraction) * path.length)
        , length(length_of(beginning.gap))
      {
        // a string without length lies along the path
        const Vector gap =
          length > 0. ? beginning.gap / length : beginning.direction;
        unit           = gap * std::conj(beginning.direction);
        const auto row = [](const Vector &gap_part, const Vector &motion_part) {
          Row result;
          result << gap_part.real(), gap_part.imag(), motion_part.real(),
            motion_part.imag(), 0., 0., 0.;
          return result;
        };
        const double f = beginning.fraction;
        // of v . (old_gap + part * motion) at a fixed fraction
        // In complex numbers the gap where sliding begins is old_gap + part
        // motion, and its derivative along v that of both terms: conj(part)
        // turns v back.
        const Vector by_turn = path.part_by_turn(f) * path.motion;
        const auto   of_gap  = [&](const Vector &v) {
          Row result = row(v, v * std::conj(beginning.part));
          result[6]  = dot(v, by_turn);
          return result;
        };
        const double over_chord =
          path.chord_length > 0. ? 1. / path.chord_length : 0.;
        d_chord  = row(0., perpendicular(path.chord) * over_chord);
        d_way    = row(0., path.chord * (way * over_chord));
        d_way[6] = (1. - f) * path.length_by_turn();
        d_length.setZero();
        d_angle.setZero();
        if (length > 0.)
          {
            d_length = of_gap(gap);
            d_angle  = of_gap(perpendicular(gap) / length) - d_chord;
            d_angle[6] -= f - 0.5;
          }
        if (f == 0. || f == 1.)
          return;
        // where it begins moves, too
        d_fraction = -2. * length * d_length;
        d_fraction[4] += 2. * beginning.limit * f;
        d_fraction /= beginning.slope;
        d_way -= path.length * d_fraction;
        d_length += path.length * dot(gap, beginning.direction) * d_fraction;
        d_angle += (path.length * cross(gap, beginning.direction) / length -
                    path.arc.turn) *
                   d_fraction;
      }
    };
  } // namespace



  TowedGap::TowedGap(const Step &step)
  {
    // Three stages: the way without sliding, up to the place where the string
    // is as long as its limit; the turning of the string on the rest of the
    // way, with the mean of its lengths; and the distance slid, which is what
    // the string has been pulled by less what it has become longer.
    const Path      path(step.motion, step.arc);
    const Beginning beginning(path,
                              {step.old_gap[0], step.old_gap[1]},
                              step.old_limit,
                              step.held_limit - step.old_limit);
    const Start     start(path, beginning);
    // a string without length follows the path
    const double mean_length =
      std::max(0.5 * (start.length + step.length), 1e-12 * start.way);
    // nothing turns where nothing moves, whatever the length
    const double x = start.way > 0. ? 0.5 * start.way / mean_length : 0.;
    // kappa bends away from positive alpha
    const double  turn_left = (1. - beginning.fraction) * path.arc.turn;
    const Turning turning(start.unit, x, -0.5 * turn_left);
    const Vector  tau = path.at(1.).direction * turning.turned;
    direction         = {tau.real(), tau.imag()};
    distance = mean_length * turning.growth + start.length - step.length;

    // The same three stages backwards. L of the turning is half the length at
    // the beginning of sliding and half that at the end, column 5. Angles add
    // up: of the chord, of the gap to it, and half of the turn of the path.
    Row d_mean = 0.5 * start.d_length;
    d_mean[5] += 0.5;
    Eigen::Matrix<double, 3, 7> d;
    d << start.d_angle,
      (0.5 * start.d_way - x * d_mean) / (mean_length > 0. ? mean_length : 1.),
      0.5 * path.arc.turn * start.d_fraction;
    d(2, 6) -= 0.5 * (1. - beginning.fraction);
    const Eigen::Matrix<double, 2, 7> at_end = turning.derivative * d;
    Row                               d_tau  = start.d_chord + at_end.row(0);
    d_tau[6] += 0.5;
    derivative << -tau.imag() * d_tau, tau.real() * d_tau,
      turning.growth * d_mean + mean_length * at_end.row(1) + start.d_length;
    derivative(2, 5) -= 1.;
  }
} // namespace Debond
