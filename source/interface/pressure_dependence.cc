#include <debond/input/csv_table.h>
#include <debond/input/entry_table.h>
#include <debond/interface/pressure_dependence.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <functional>

// Friction coefficients fall with the pressure: asperities that give way
// elastically have an area that grows with p^(2/3), and so does their traction.
// All friction laws are in proportion to the pressure that they are asked with,
// L = mu(phi, ...) p; asked with f(p) they are what such faces do, with works,
// bonds, and what they remember.
namespace Debond
{
  namespace
  {
    /** f [MPa] and df/dp. */
    struct Effective
    {
      double pressure, slope;
    };
    using Dependence = std::function<Effective(double)>;

    // f = p_0 (p/p_0)^n, n = 1 being Coulomb's law. For n < 1 its slope is
    // infinite at p = 0; below 1e-3 p_0 there is a parabola through 0 instead,
    // which meets value and slope.
    Dependence
    power(const double n, const double p_0)
    {
      const auto law = [n, p_0](const double p) -> Effective {
        const double f = p_0 * std::pow(p / p_0, n);
        return {f, n * f / p};
      };
      const double    p_1 = n < 1. ? 1e-3 * p_0 : 0.;
      const Effective at  = p_1 > 0. ? law(p_1) : Effective{0., 0.};
      return [law, p_1, at](const double p) -> Effective {
        if (p >= p_1)
          return law(p);
        const double x = p / p_1, secant = at.pressure / p_1;
        return {p * (2. * secant - at.slope + x * (at.slope - secant)),
                2. * secant - at.slope + 2. * x * (at.slope - secant)};
      };
    }



    // f = factor p, with monotone cubics between the rows, constant beyond:
    // what a table does not say is not extrapolated. The slope of the factor
    // jumps at both ends of the table; p is hardly ever just there, and
    // Newton's method passes such a kink as it passes those of the bond. The
    // factor must not vanish, as points without a limit are pulled along.
    Dependence
    of_table(const std::string &filename)
    {
      const std::string         entry = "Interface / Friction over pressure";
      std::vector<double>       pressure, factor;
      std::vector<unsigned int> lines;
      for (const std::vector<double> &row : read_csv_columns(
             filename, entry, {"pressure_MPa", "factor"}, false, &lines))
        {
          const bool ascends =
            pressure.empty() ? row[0] >= 0. : row[0] > pressure.back();
          if (!ascends || !(row[1] > 0.))
            throw EntryError(entry,
                             "line " + std::to_string(lines[pressure.size()]) +
                               ": expected pressures from 0 on that ascend, "
                               "and factors above 0",
                             filename);
          pressure.push_back(row[0]);
          factor.push_back(row[1]);
        }
      if (pressure.size() < 4)
        throw EntryError(entry,
                         "expected at least four rows of pressure_MPa and "
                         "factor",
                         filename);
      // A factor that falls faster than 1/p makes f fall: a point that is
      // pressed harder then holds less. That is odd, but no law forbids it, and
      // the tangent is right: measured tables may say so between two rows.
      const MonotoneCurve curve(pressure, factor);
      return [curve](const double p) -> Effective {
        const double within = std::clamp(p, curve.first(), curve.last()),
                     value  = curve(within);
        return {value * p,
                value + (within == p ? p * curve.slope(within) : 0.)};
      };
    }



    // A friction law that is asked with f(p) wherever it would be asked with
    // p: for the limit, for works, and for the steepest fall, by which
    // uniqueness is judged. What it remembers, and the decay of its bond, know
    // no pressure and are its own. Its copy of what the law says of itself,
    // kinks and lengths, makes it look the same from outside.
    class UnderEffectivePressure : public FrictionLaw
    {
    public:
      UnderEffectivePressure(const FrictionLawPointer &law, Dependence f)
        : FrictionLaw(*law)
        , law(law)
        , f(std::move(f))
      {}

      // By the chain rule dL/dp = (dL/df) df/dp; derivatives by bond and
      // distance are those at f(p) already.
      FrictionLimit
      limit(const PointStart &start,
            const double      phi,
            const double      pressure,
            const double      distance) const override
      {
        const Effective p = f(pressure);
        FrictionLimit   L = law->limit(start, phi, p.pressure, distance);
        L.by_pressure *= p.slope;
        return L;
      }

      InternalVariables
      advance(const PointStart &start, const double distance) const override
      {
        return law->advance(start, distance);
      }

      // At a constant pressure f is constant, too; the mean over both ends of a
      // step is formed by the law of the interface.
      PointWork
      work(const PointStart &start,
           const double      pressure,
           const double      distance) const override
      {
        return law->work(start, f(pressure).pressure, distance);
      }

      double
      steepest_fall(const PointStart &start,
                    const double      pressure,
                    const double      distance) const override
      {
        return law->steepest_fall(start, f(pressure).pressure, distance);
      }

      Decay
      decay(const double slip) const override
      {
        return law->decay(slip);
      }

    private:
      FrictionLawPointer law;
      Dependence         f;
    };
  } // namespace



  void
  PressureDependence::declare(EntryTable &entries)
  {
    entries.add("Friction exponent",
                exponent,
                Allowed::number_between(0.1, 2, ""),
                "Exponent n of friction over pressure, L = mu p_0 (p/p_0)^n, "
                "dimensionless. 1: Coulomb; 2/3: one elastic asperity. Below "
                "p_0/1000 and for n < 1 a parabola goes on to 0.");
    entries.add(
      "Reference pressure",
      reference,
      Allowed::number_between(1e-9, 1e9, "MPa").or_word_for("none", "0"),
      "Pressure p_0 [MPa] at which friction coefficients are what "
      "the scene says. Must be set where Friction exponent is not "
      "1.");
    entries.add(
      "Friction over pressure",
      table,
      Allowed::text("the name of a CSV file", false).or_word_for("none", ""),
      "CSV file with the columns pressure_MPa, ascending, and "
      "factor, by which friction coefficients are multiplied at "
      "that pressure: L = mu factor p. Four rows at least; between "
      "them monotone cubics, beyond them constant. Not together "
      "with Friction exponent. `none': the factor is 1.");
  }



  // Made once, where a scene is read. A law that is not changed stays the
  // object that it was, so that scenes without these entries are asked the
  // shortest way.
  FrictionLawPointer
  PressureDependence::of(const FrictionLawPointer &law) const
  {
    if (exponent != 1. && !table.empty())
      throw EntryError("Interface / Friction over pressure",
                       "Friction exponent is set, too: expected one of them",
                       table);
    if (exponent != 1. && reference == 0.)
      throw EntryError("Interface / Reference pressure",
                       "with Friction exponent = " + to_text(exponent) +
                         " friction coefficients are those at a pressure: "
                         "expected a number [MPa]",
                       "none");
    if (is_none() || law->is_frictionless)
      return law;
    return std::make_shared<UnderEffectivePressure>(
      law, table.empty() ? power(exponent, reference) : of_table(table));
  }
} // namespace Debond
