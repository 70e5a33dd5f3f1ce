#include <debond/interface/slip_problem.h>
#include <debond/interface/towed_gap.h>

#include <Sacado.hpp>
#include <cmath>

namespace Debond
{
  namespace
  {
    // The formulas are written once, for numbers and for those that carry their
    // derivatives along.
    template <typename Number>
    struct Plane
    {
      Number x, y;
    };

    template <typename Number>
    Plane<Number>
    turned(const Plane<Number> &a, const Number &cosine, const Number &sine)
    {
      return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y};
    }

    template <typename Number>
    Plane<Number>
    turned(const Plane<Number> &a, const Number &angle)
    {
      using std::cos, std::sin;
      return turned<Number>(a, cos(angle), sin(angle));
    }

    /** sin t / t */
    template <typename Number>
    Number
    sinc(const Number &t)
    {
      using std::sin;
      const Number small = 1. - t * t / 6.;
      return t * t < 1e-10 ? small : Number(sin(t) / t);
    }



    /** The way of the point in the step: an arc over the chord `motion', along
     *  which its direction turns by `turn'. */
    template <typename Number>
    struct Path
    {
      Plane<Number> old_gap, motion, chord; ///< chord: its unit vector
      Number        length;
      double        turn;

      Path(const Plane<Number> &old_gap,
           const Plane<Number> &motion,
           const double         turn)
        : old_gap(old_gap)
        , motion(motion)
        , chord{1., 0.}
        , length(0.)
        , turn(turn)
      {
        using std::sqrt;
        const Number square = motion.x * motion.x + motion.y * motion.y;
        if (square > 1e-40)
          {
            const Number S = sqrt(square);
            chord          = {motion.x / S, motion.y / S};
            length         = S / sinc(0.5 * turn);
          }
      }

      /** The gap after the @p fraction of the way, if the anchor stays. */
      Plane<Number>
      gap(const Number &fraction) const
      {
        const Number        half  = 0.5 * turn * fraction;
        const Number        part  = fraction * sinc(half) / sinc(0.5 * turn);
        const Plane<Number> moved = turned<Number>(motion, half - 0.5 * turn);
        return {old_gap.x + part * moved.x, old_gap.y + part * moved.y};
      }

      Plane<Number>
      direction(const Number &fraction) const
      {
        return turned<Number>(chord, turn * (fraction - 0.5));
      }
    };



    /** The string from where sliding begins. */
    template <typename Number>
    struct Towing
    {
      Plane<Number> end_direction; ///< of the path
      Number        way, start;    ///< what is left of it, and L there [mm]
      /** cos(alpha/2) and sin(alpha/2) there, of any common length. */
      Number c, s;
      double turn; ///< in the rest of the way

      Towing(const Path<Number> &path,
             const Number       &fraction,
             const double        share)
        : end_direction(path.direction(1.))
        , way((1. - fraction) * path.length)
        , start(0.)
        , c(1.)
        , s(0.)
        , turn((1. - share) * path.turn)
      {
        using std::sqrt;
        const Plane<Number> g = path.gap(fraction),
                            e = path.direction(fraction);
        const Number square   = g.x * g.x + g.y * g.y;
        if (!(square > 1e-40))
          return;
        start               = sqrt(square);
        const Number along  = (g.x * e.x + g.y * e.y) / start,
                     across = (e.x * g.y - e.y * g.x) / start;
        c                   = along >= 0. ? Number(1. + along) : across;
        s                   = along >= 0. ? across : Number(1. - along);
      }

      /** At the end of the way, with a string of the length @p L there. With
       *  u = tan(alpha/2) = s/c the equation of alpha is one of Riccati, which
       *  is linear in (c, s):
       *
       *    2 c' = c/L - kappa s,   2 s' = kappa c - s/L,
       *
       *  and cos(alpha) = L d ln(c^2 + s^2)/ds. */
      struct End
      {
        Plane<Number> direction;
        Number        slid; ///< the integral of cos(alpha) [mm]
      };
      End
      end(const Number &L) const
      {
        using std::cos, std::exp, std::log, std::sin, std::sqrt;
        const Number mean = 0.5 * (start + L);
        // a string without length follows the path
        if (!(mean > 1e-12 * way))
          return {end_direction, way};
        // kappa bends away from positive alpha
        const Number x = 0.5 * way / mean;
        const double k = -0.5 * turn;
        // exp([x, -k; k, -x]) = C + S [x, -k; k, -x], times e^-scale
        const Number q = x * x - k * k;
        Number       C = 1. + 0.5 * q, S = 1. + q / 6., scale = 0.;
        if (q > 1e-6)
          {
            scale             = sqrt(q);
            const Number fall = exp(-2. * scale);
            C                 = 0.5 * (1. + fall);
            S                 = 0.5 * (1. - fall) / scale;
          }
        else if (q < -1e-6)
          {
            const Number w = sqrt(-q);
            C              = cos(w);
            S              = sin(w) / w;
          }
        const Number c_1    = (C + S * x) * c - S * k * s,
                     s_1    = S * k * c + (C - S * x) * s;
        const Number square = c_1 * c_1 + s_1 * s_1;
        End          result;
        result.slid      = mean * (2. * scale + log(square / (c * c + s * s)));
        result.direction = turned<Number>(end_direction,
                                          (c_1 * c_1 - s_1 * s_1) / square,
                                          2. * c_1 * s_1 / square);
        return result;
      }

      /** What the slid @p distance is more than it should be [mm]. */
      Number
      excess(const Number &distance, const Number &L) const
      {
        return distance + (L - start) - end(L).slid;
      }
    };



    /** By how much the gap is longer than the string, both squared. */
    template <typename Number>
    Number
    overstretch(const Path<Number> &path,
                const Number       &fraction,
                const double        old_length,
                const Number       &change)
    {
      const Plane<Number> g = path.gap(fraction);
      const Number        L = old_length + fraction * change;
      return g.x * g.x + g.y * g.y - L * L;
    }



    /** Where an equation holds, and the slope of its residual there. */
    struct Root
    {
      double at, slope;
    };

    /** The fraction of the way after which sliding begins. */
    Root
    start_of_sliding(const Path<double> &path,
                     const double        old_length,
                     const double        change)
    {
      using One = Sacado::Fad::SFad<double, 1>;
      const Path<One> varied({path.old_gap.x, path.old_gap.y},
                             {path.motion.x, path.motion.y},
                             path.turn);
      const auto      at = [&](const double fraction) {
        return overstretch<One>(varied,
                                One(1, 0, fraction),
                                old_length,
                                change);
      };
      const One first = at(0.), last = at(1.);
      // what holds at the end has not begun to slide at all
      if (last.val() <= 0.)
        return {1., last.dx(0)};
      // it slides at once; or at rounding, as it did when it came here
      const double rounding = 1e-12 * old_length * old_length;
      if (first.val() >= -rounding && first.dx(0) >= 0.)
        return {0., first.dx(0)};
      // Once inside, the gap leaves the limit for good: Newton's method from
      // outside, and bisection where it would leave the bracket.
      double inside = 0., outside = 1., fraction = 1.;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const One f                       = at(fraction);
          (f.val() > 0. ? outside : inside) = fraction;
          double next                       = fraction - f.val() / f.dx(0);
          if (!(next > inside && next < outside))
            next = 0.5 * (inside + outside);
          if (std::abs(next - fraction) < 1e-15)
            break;
          fraction = next;
        }
      return {fraction, at(fraction).dx(0)};
    }



    /** The distance that the point slides. */
    Root
    slid_distance(const TowedGap::Step &step, const Towing<double> &towing)
    {
      using One = Sacado::Fad::SFad<double, 1>;
      Towing<One> varied(Path<One>({0., 0.}, {0., 0.}, 0.), 1., 1.);
      varied.way       = towing.way;
      varied.start     = towing.start;
      varied.c         = towing.c;
      varied.s         = towing.s;
      varied.turn      = towing.turn;
      const double eps = step.tangential_penalty;
      const auto   at  = [&](const double distance) {
        const auto limit = step.friction.limit(step.pressure, distance);
        One        L(limit.value / eps);
        L.resize(1);
        L.fastAccessDx(0) = limit.slope / eps;
        return varied.excess(One(1, 0, distance), L);
      };
      // the string cannot give more than its length
      double low = -towing.way - towing.start, high = towing.way + towing.start,
             distance = std::max(0., towing.way);
      for (unsigned int i = 0; i < 100; ++i)
        {
          const One f                 = at(distance);
          (f.val() > 0. ? high : low) = distance;
          double next                 = distance - f.val() / f.dx(0);
          if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
          const double change = std::abs(next - distance);
          distance            = next;
          if (change <= 1e-15 * (towing.way + towing.start))
            break;
        }
      return {distance, at(distance).dx(0)};
    }
  } // namespace



  // First the numbers, by Newton's method; then one more step of it in numbers
  // with derivatives, which gives those of the solution.
  TowedGap::TowedGap(const Step &step)
  {
    using Number                  = Sacado::Fad::SFad<double, 5>;
    const PointFriction &friction = step.friction;
    const double         eps      = step.tangential_penalty;
    const double         change =
      friction.after(0.).mu * step.pressure / eps - friction.old_limit;
    const Path<double> path({step.old_gap[0], step.old_gap[1]},
                            {step.motion[0], step.motion[1]},
                            friction.turn);
    const Root share = start_of_sliding(path, friction.old_limit, change);
    const Root slid =
      slid_distance(step, Towing<double>(path, share.at, share.at));

    const Path<Number> varied(
      {Number(5, 0, step.old_gap[0]), Number(5, 1, step.old_gap[1])},
      {Number(5, 2, step.motion[0]), Number(5, 3, step.motion[1])},
      friction.turn);
    const Number pressure(5, 4, step.pressure);
    Number       fraction = share.at;
    if (share.at > 0. && share.at < 1.)
      fraction -= overstretch<Number>(varied,
                                      fraction,
                                      friction.old_limit,
                                      friction.after(0.).mu * pressure / eps -
                                        friction.old_limit) /
                  share.slope;
    const Towing<Number> towing(varied, fraction, share.at);
    const auto           limit = friction.limit(step.pressure, slid.at);
    const auto           L     = [&](const Number &distance) {
      return Number((limit.value +
                     limit.coefficient.mu * (pressure - step.pressure) +
                     limit.slope * (distance - slid.at)) /
                    eps);
    };
    Number slides = slid.at;
    slides -= towing.excess(slides, L(slides)) / slid.slope;
    const auto end = towing.end(L(slides));
    direction      = {end.direction.x.val(), end.direction.y.val()};
    distance       = slid.at;
    for (unsigned int i = 0; i < 5; ++i)
      derivative.col(i) << end.direction.x.fastAccessDx(i),
        end.direction.y.fastAccessDx(i), slides.fastAccessDx(i);
  }
} // namespace Debond
