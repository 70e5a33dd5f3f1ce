#include <debond/interface/towed_gap.h>

#include <cmath>
#include <complex>

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



    /** The way of the point in the step: an arc over the chord `motion'. */
    struct Path
    {
      const Arc &arc;
      Vector     motion, chord; ///< chord: its unit vector
      double     length;

      Path(const Vector &motion, const Arc &arc)
        : arc(arc)
        , motion(motion)
        , chord(1.)
        , length(length_of(motion))
      {
        if (length > 0.)
          chord = motion / length;
        length /= arc.chord_over_length;
      }

      /** The part of the chord that lies behind the point after a @p fraction
       * of its way, turned into the direction from where it came. */
      Vector
      part(const double fraction) const
      {
        if (arc.turn == 0. || fraction == 0. || fraction == 1.)
          return fraction;
        const Arc behind(arc.turn * fraction);
        return std::polar(fraction * behind.chord_over_length /
                            arc.chord_over_length,
                          0.5 * (behind.turn - arc.turn));
      }

      Vector
      direction(const double fraction) const
      {
        if (fraction == 0.)
          return chord * std::conj(arc.half_turn);
        if (fraction == 1.)
          return chord * arc.half_turn;
        return arc.turn == 0. ?
                 chord :
                 chord * std::polar(1., arc.turn * (fraction - 0.5));
      }
    };



    /** Where on the path sliding begins: where the gap becomes longer than its
     *  limit, which runs from @p old_limit by @p change [mm]. */
    struct Beginning
    {
      double fraction = 0.;
      Vector part     = 0., gap, direction;
      double slope    = 0.; ///< of gap^2 - limit^2 by the fraction [mm^2]

      Beginning(const Path   &path,
                const Vector &old_gap,
                const double  old_limit,
                const double  change)
      {
        const auto excess = [&](const double at) {
          fraction       = at;
          part           = path.part(at);
          gap            = old_gap + part * path.motion;
          direction      = path.direction(at);
          const double L = old_limit + at * change;
          slope = 2. * (dot(gap, direction) * path.length - L * change);
          return std::norm(gap) - L * L;
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
            if (!(better > inside && better < outside))
              better = 0.5 * (inside + outside);
            const double moved = std::abs(better - fraction);
            f                  = excess(better);
            if (moved < 1e-12)
              break;
          }
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
        // C and S, times e^-scale
        const double q = x * x - k * k;
        double       C = 1. + 0.5 * q, S = 1. + q / 6., scale = 0.;
        // dS/dq; dC/dq = S/2
        double S_q = 1. / 6. + q / 60.;
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
        else
          {
            C += q * q / 24.;
            S += q * q / 120.;
          }
        const auto M = [&](const Vector &v) {
          return Vector(x * v.real() - k * v.imag(),
                        k * v.real() - x * v.imag());
        };
        const Vector M_w = M(w), end = C * w + S * M_w;
        const double square = std::norm(end);
        growth              = 2. * scale + std::log(square);
        turned              = end * end / square;
        const Vector half   = Vector(0., 0.5) * w; // dw/dalpha
        const Vector by_q   = 0.5 * S * w + S_q * M_w;
        const Vector d[]{C * half + S * M(half),
                         2. * x * by_q + S * std::conj(w),
                         -2. * k * by_q + S * Vector(0., 1.) * w};
        for (unsigned int i = 0; i < 3; ++i)
          derivative.col(i) << 2. * cross(end, d[i]) / square,
            2. * dot(end, d[i]) / square;
      }
    };



    /** The string from where sliding begins to the end of the way, where it is
     *  @p L [mm] long. */
    struct Towing
    {
      const double start, way, k;
      const Vector gap; ///< at the beginning, from the path's direction

      Towing(const Path &path, const Beginning &beginning)
        : start(length_of(beginning.gap))
        , way((1. - beginning.fraction) * path.length)
        // kappa bends away from positive alpha
        , k(-0.5 * (1. - beginning.fraction) * path.arc.turn)
        , gap(start > 0. ?
                beginning.gap * std::conj(beginning.direction) / start :
                Vector(1.))
      {}

      double
      mean(const double L) const
      {
        return 0.5 * (start + L);
      }
      /** A string without length follows the path. */
      bool
      has_length(const double L) const
      {
        return mean(L) > 1e-12 * way;
      }
      Turning
      turning(const double L) const
      {
        return Turning(gap, 0.5 * way / mean(L), k);
      }
      /** How far the point slides, and the derivative by L. */
      std::pair<double, double>
      slid(const double L) const
      {
        if (!has_length(L))
          return {way + start - L, -1.};
        const Turning at_end = turning(L);
        return {mean(L) * at_end.growth + start - L,
                0.5 * at_end.growth -
                  0.25 * way / mean(L) * at_end.derivative(1, 1) - 1.};
      }
    };



    // L falls with the distance, where the bond breaks, by less than the
    // distance grows: there is one solution, which Newton's method finds, and
    // bisection where it leaves the bracket.
    double
    slid_distance(const TowedGap::Step &step, const Towing &towing)
    {
      const double eps      = step.tangential_penalty;
      const double farthest = towing.way + towing.start;
      double       low = -farthest, high = farthest, distance = towing.way;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const auto limit = step.friction.limit(step.pressure, distance);
          const auto [slid, by_L] = towing.slid(limit.value / eps);
          const double excess     = distance - slid;
          // where the limit is constant, here and there, that is it
          if (limit.slope == 0. &&
              step.friction.limit(step.pressure, slid).value == limit.value)
            return slid;
          (excess > 0. ? high : low) = distance;
          double next = distance - excess / (1. - by_L * limit.slope / eps);
          if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
          const double moved = std::abs(next - distance);
          distance           = next;
          if (moved <= 1e-15 * farthest)
            break;
        }
      return distance;
    }
  } // namespace



  TowedGap::TowedGap(const Step &step)
  {
    const PointFriction &friction = step.friction;
    const double         eps      = step.tangential_penalty;
    const Vector         old_gap(step.old_gap[0], step.old_gap[1]);
    const Path           path({step.motion[0], step.motion[1]}, friction.arc);
    // on the way to where sliding begins the limit is that of g_s^n
    const double    mu_old = friction.old_mu;
    const double    change = mu_old * step.pressure / eps - friction.old_limit;
    const Beginning beginning(path, old_gap, friction.old_limit, change);
    const Towing    towing(path, beginning);
    distance           = slid_distance(step, towing);
    const auto   limit = friction.limit(step.pressure, distance);
    const double L     = limit.value / eps;
    mean_length        = towing.mean(L);

    // What all depends on, as rows of derivatives by old_gap, motion, pressure:
    // first the gap where sliding begins, and where on the path that is.
    using Row        = Eigen::Matrix<double, 1, 5>;
    const auto along = [](const Vector &gap_part, const Vector &motion_part) {
      Row row;
      row << gap_part.real(), gap_part.imag(), motion_part.real(),
        motion_part.imag(), 0.;
      return row;
    };
    // of v . (old_gap + part * motion) at a fixed fraction
    const auto of_gap = [&](const Vector &v) {
      return along(v, v * std::conj(beginning.part));
    };
    const double f          = beginning.fraction;
    Row          d_fraction = Row::Zero();
    if (f > 0. && f < 1.)
      {
        d_fraction = -2. * of_gap(beginning.gap);
        d_fraction[4] +=
          2. * (friction.old_limit + f * change) * f * mu_old / eps;
        d_fraction /= beginning.slope;
      }
    const Vector chord = path.chord, turned_chord = chord * Vector(0., 1.);
    const double S = length_of(path.motion);
    const Row    d_angle_of_motion =
      S > 0. ? Row(along(0., turned_chord / S)) : Row(Row::Zero());
    const Row d_way =
      (1. - f) * path.length / (S > 0. ? S : 1.) * along(0., chord) -
      path.length * d_fraction;
    const Vector unit =
      towing.start > 0. ? beginning.gap / towing.start : chord;
    const Row d_start =
      towing.start > 0. ?
        Row(of_gap(unit) +
            path.length * dot(unit, beginning.direction) * d_fraction) :
        Row(Row::Zero());
    const Row d_alpha =
      towing.start > 0. ?
        Row((of_gap(unit * Vector(0., 1.)) +
             path.length * cross(unit, beginning.direction) * d_fraction) /
              towing.start -
            d_angle_of_motion - path.arc.turn * d_fraction) :
        Row(Row::Zero());
    Row d_L = Row::Zero(); // at a fixed distance
    d_L[4]  = limit.coefficient.mu / eps;

    const Vector end   = path.direction(1.);
    Vector       tau   = end;
    Row          d_tau = d_angle_of_motion, d_distance = d_way + d_start - d_L;
    double       slope = 1. + limit.slope / eps;
    if (towing.has_length(L))
      {
        const double  mean = towing.mean(L), x = 0.5 * towing.way / mean;
        const Turning turning                 = towing.turning(L);
        const Eigen::Matrix<double, 2, 3> &by = turning.derivative;
        tau                                   = end * turning.turned;
        // of x at a fixed L, and with it
        const Row    d_x    = (0.5 * d_way - 0.5 * x * d_start) / mean;
        const double x_L    = -0.5 * x / mean;
        const Row    d_k    = 0.5 * path.arc.turn * d_fraction;
        const double slid_L = 0.5 * turning.growth + mean * by(1, 1) * x_L;
        slope -= slid_L * limit.slope / eps;
        d_distance =
          0.5 * turning.growth * d_start +
          mean * (by(1, 0) * d_alpha + by(1, 1) * d_x + by(1, 2) * d_k) +
          d_start + (slid_L - 1.) * d_L;
        d_distance /= slope;
        const Row d_L_in_all = d_L + limit.slope / eps * d_distance;
        d_tau += by(0, 0) * d_alpha + by(0, 1) * (d_x + x_L * d_L_in_all) +
                 by(0, 2) * d_k;
      }
    else
      d_distance /= slope;
    direction = {tau.real(), tau.imag()};
    derivative << -tau.imag() * d_tau, tau.real() * d_tau, d_distance;
  }
} // namespace Debond
