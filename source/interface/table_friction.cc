#include <debond/input/csv_table.h>
#include <debond/interface/bond_friction.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/math/interpolators/pchip.hpp>

#include <math.h> // pchip expects isnan() outside of any namespace

#include <algorithm>

namespace Debond
{
  namespace
  {
    /** s(g_s) through the points of a table: monotone cubics between them
     *  (Fritsch and Carlson), constant from the last one on. */
    class TableFriction : public BondFriction
    {
    public:
      TableFriction(const double               mu_broken,
                    const double               mu_unbroken,
                    const std::string         &filename,
                    const std::vector<double> &slip,
                    const std::vector<double> &phi)
        : BondFriction(mu_broken, mu_unbroken)
        , filename(filename)
        , slip(slip)
        , last(phi.back())
        , curve(std::vector<double>(slip), std::vector<double>(phi))
        , integral(slip.size(), 0.)
        , steepest(slip.size(), 0.)
      {
        for (std::size_t i = 1; i < slip.size(); ++i)
          integral[i] =
            integral[i - 1] + integral_between(slip[i - 1], slip[i]);
        for (std::size_t i = slip.size() - 1; i-- > 0;)
          steepest[i] = std::max(steepest[i + 1], steepest_between(i));
      }

      const std::vector<double> &
      kinks() const override
      {
        return slip;
      }

      double
      characteristic_distance() const override
      {
        return std::min(slip.back(), 1. / steepest.front());
      }

      std::string
      file() const override
      {
        return filename;
      }

      std::string
      entries_against_fall() const override
      {
        return "distance over which the bond of Friction table falls";
      }

    protected:
      double
      decay(const double g_s, double &slope) const override
      {
        const bool falls = g_s < slip.back();
        slope            = falls ? curve.prime(g_s) : 0.;
        return falls ? curve(g_s) : last;
      }

      double
      integrated_decay(const double g_s) const override
      {
        const std::size_t i = row_before(g_s);
        return integral[i] + (g_s < slip.back() ?
                                integral_between(slip[i], g_s) :
                                last * (g_s - slip[i]));
      }

      double
      steepest_decay(const double g_s) const override
      {
        return steepest[row_before(g_s)];
      }

    private:
      std::size_t
      row_before(const double g_s) const
      {
        return std::upper_bound(slip.begin(), slip.end(), g_s) - slip.begin() -
               1;
      }

      // Simpson's rule is exact for a cubic.
      double
      integral_between(const double from, const double to) const
      {
        return (to - from) / 6. *
               (curve(from) + 4. * curve(0.5 * (from + to)) + curve(to));
      }

      // The slope is a parabola: largest at its ends or its vertex.
      double
      steepest_between(const std::size_t i) const
      {
        const double a = slip[i], h = slip[i + 1] - a;
        const double left = curve.prime(a), right = curve.prime(a + h);
        const double middle  = curve.prime(a + 0.5 * h);
        const double bending = 2. * (left - 2. * middle + right);
        const double vertex =
          bending != 0. ? 0.5 * (left - right + bending) / bending : 0.;
        return -std::min(
          {left, right, curve.prime(a + std::clamp(vertex, 0., 1.) * h)});
      }

      const std::string         filename;
      const std::vector<double> slip; ///< g_s of the rows [mm]
      const double              last; ///< phi of the last one
      const boost::math::interpolators::pchip<std::vector<double>> curve;

      std::vector<double> integral; ///< of s, from 0 to each row [mm]
      std::vector<double> steepest; ///< bound from each row on [1/mm]
    };



    FrictionLawPointer
    read_table(const double       mu_broken,
               const double       mu_unbroken,
               const std::string &filename)
    {
      const std::string         entry = "Interface / Friction table";
      std::vector<double>       slip, phi;
      std::vector<unsigned int> lines;
      const auto expect = [&](const bool is_right, const std::string &why) {
        if (!is_right)
          throw EntryError(entry, why, filename);
      };
      expect(!filename.empty(),
             "Friction law = table needs the name of a CSV file");
      for (const std::vector<double> &row :
           read_csv_columns(filename, entry, {"slip_mm", "phi"}, false, &lines))
        {
          const std::string line =
            "line " + std::to_string(lines[slip.size()]) + ": ";
          const std::string said = line + "phi = " + to_text(row[1]);
          expect(slip.empty() ? row[0] == 0. : row[0] > slip.back(),
                 line + "slip_mm = " + to_text(row[0]) +
                   ": expected distances that begin with 0 and ascend");
          expect(row[1] >= 0. && row[1] <= 1., said + ": expected 0 to 1");
          const double before = phi.empty() ? 1. : phi.back();
          expect(row[1] <= before,
                 said + " is more than " + to_text(before) +
                   " in the row before: a bond does not heal");
          slip.push_back(row[0]);
          phi.push_back(row[1]);
        }
      expect(slip.size() >= 4,
             "expected at least four rows of slip_mm and phi");
      return std::make_shared<TableFriction>(
        mu_broken, mu_unbroken, filename, slip, phi);
    }
  } // namespace



  FrictionLawPlugin
  table_plugin()
  {
    return {
      "table",
      "as modified coulomb, with the decay of the bond from Friction table",
      BondFriction::entries(
        {{"",
          "Friction table",
          "",
          Allowed::text("the name of a CSV file"),
          "CSV file with the columns slip_mm, the sliding distance g_s [mm], "
          "ascending from 0, and phi, the bonding state there of a point that "
          "was fully bonded, from 1 to 0, dimensionless, which may not rise. "
          "Monotone cubics lie between the rows, of which there are four at "
          "least; from the last one on phi is constant. Used by table. The "
          "path is relative to the working directory."}}),
      [](const FrictionLawChoice &choice) {
        return read_table(choice.number("Friction coefficient broken"),
                          choice.number("Friction coefficient unbroken"),
                          choice.text("Friction table"));
      }};
  }
} // namespace Debond
