#include <debond/input/csv_table.h>
#include <debond/input/entry_table.h>
#include <debond/input/monotone_curve.h>
#include <debond/interface/modified_coulomb.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <optional>

// The law of Eq. (11) with a measured or computed decay of the bond in the
// place of Eq. (13): rows of sliding distance and bonding state from a CSV
// file. Both coefficients stay entries, and phi_0 stays that of the point; the
// table says s(g_s), what is left of a bond that was whole.
//
// A curve through the rows has to be smooth and must not rise anywhere.
// Straight lines would give dmu/dg_s a jump at every row, at which the Newton
// iteration of a point can go to and fro; ordinary cubic splines swing beyond
// the rows, so that a bond would heal for a while. Monotone cubics do neither:
// their slope is continuous from row to row, and they fall where the rows fall
// and are constant where these are. The slope at a row is the weighted harmonic
// mean of those of the chords beside it, at both ends that of the chord. Beyond
// the last row it is 0, so that it jumps there unless the last two rows have
// the same phi.
namespace Debond
{
  namespace
  {
    // A table is checked row by row, before anything is built, and refused with
    // the line of the file: a torque curve would not show that its law rises
    // somewhere, or does not begin at g_s = 0.
    void
    read_table(const std::string   &filename,
               std::vector<double> &slip,
               std::vector<double> &phi)
    {
      const std::string         entry = "Interface / Friction table";
      std::vector<unsigned int> lines;
      slip.clear();
      const auto expect = [&](const bool is_right, const std::string &why) {
        if (!is_right)
          throw EntryError(entry, why, filename);
      };
      expect(!filename.empty(),
             "Friction law = table needs the name of a CSV file");
      // Two columns by their names, in any order of the file; others are left
      // alone.
      for (const std::vector<double> &row :
           read_csv_columns(filename, entry, {"slip_mm", "phi"}, false, &lines))
        {
          const std::string line =
            "line " + std::to_string(lines[slip.size()]) + ": ";
          const std::string said = line + "phi = " + to_text(row[1]);
          // g_s from 0 on, ascending; equal distances would be a jump of mu,
          // which falls faster than any interface is stiff
          expect(slip.empty() ? row[0] == 0. : row[0] > slip.back(),
                 line + "slip_mm = " + to_text(row[0]) +
                   ": expected distances that begin with 0 and ascend");
          // s is a share of the bond. A first row below 1 is allowed: that much
          // of the bond is all there is.
          expect(row[1] >= 0. && row[1] <= 1., said + ": expected 0 to 1");
          const double before = phi.empty() ? 1. : phi.back();
          expect(row[1] <= before,
                 said + " is more than " + to_text(before) +
                   " in the row before: a bond does not heal");
          slip.push_back(row[0]);
          phi.push_back(row[1]);
        }
      // the slopes of the curve are formed from neighbouring rows, and the
      // interpolation wants four rows at least
      expect(slip.size() >= 4,
             "expected at least four rows of slip_mm and phi");
    }



    /** s(g_s) through the points of a table: monotone cubics between them
     *  (Fritsch and Butland), constant from the last one on. Works, and the
     *  check that local solutions are unique, need integral and steepest slope
     *  of the curve; both are formed once for each row, so that a point only
     *  looks them up. */
    class TableFriction : public ModifiedCoulomb
    {
    public:
      // The entries of the two coefficients are shared with modified coulomb,
      // so that the two laws can be compared by changing one line of a scene.
      void
      declare(EntryTable &table) override
      {
        declare_coefficients(table);
        table.add(
          "Friction table",
          file,
          Allowed::text("the name of a CSV file", false)
            .or_word_for("none", ""),
          "CSV file for Friction law = table, relative to the working "
          "directory, with the columns slip_mm, the sliding distance g_s [mm], "
          "ascending from 0, and phi, the bonding state of a point that was "
          "fully bonded, between 1 and 0 and never rising. It needs four rows "
          "at least. Between rows there are monotone cubics; beyond the last "
          "row phi is constant. `none': no table.");
      }

      // The curvature jumps at every row. Closed forms integrate from row to
      // row, where the law is as smooth as their quadrature wants it.
      void
      initialise() override
      {
        std::vector<double> phi;
        read_table(file, kinks, phi);
        last = phi.back();
        curve.emplace(kinks, phi);
        // from the first row on: int s dg_s up to each row [mm]
        integral.assign(kinks.size(), 0.);
        for (std::size_t i = 1; i < kinks.size(); ++i)
          integral[i] =
            integral[i - 1] + integral_between(kinks[i - 1], kinks[i]);
        // from the last row backwards: the largest -ds/dg_s [1/mm] from each
        // row on; behind the last one s is constant
        steepest.assign(kinks.size(), 0.);
        for (std::size_t i = kinks.size() - 1; i-- > 0;)
          steepest[i] = std::max(steepest[i + 1], steepest_between(i));
        // Of the whole table, or of its steepest part if it were to fall from 1
        // to 0 at that slope [mm]: a table may be long and have a short fall. A
        // constant table has no slope, 1/0 is infinite, and its length remains.
        characteristic_distance = std::min(kinks.back(), 1. / steepest.front());
        // the slope is in the file: what helps is a longer fall in there
        entries_against_fall =
          "distance over which the bond of Friction table falls";
      }

      // s, and its slope [1/mm] by the derivative of the same cubic. Both
      // belong to one curve: a slope from differences of the rows would cost
      // Newton's method its quadratic convergence. Beyond the last row s is the
      // value there: what a table does not say is not extrapolated. If that is
      // above 0 a part of the bond stays for ever.
      //
      // The bound of the slope begins with the row before g_s, not with g_s
      // itself: it may be too large within one interval, never too small. So
      // uniqueness is judged on the safe side.
      Decay
      decay(const double g_s) const override
      {
        // there always is a row before, as the first one is at 0
        const std::size_t i =
          std::upper_bound(kinks.begin(), kinks.end(), g_s) - kinks.begin() - 1;
        if (g_s < kinks.back())
          return {(*curve)(g_s),
                  curve->slope(g_s),
                  integral[i] + integral_between(kinks[i], g_s),
                  steepest[i]};
        return {last, 0., integral[i] + last * (g_s - kinks[i]), 0.};
      }

    private:
      // Simpson's rule is exact for a cubic.
      //
      // Both places lie in one interval of the table, so that the curve is one
      // cubic between them: works are exact integrals of this law, and a defect
      // of energy is none of its interpolation.
      double
      integral_between(const double from, const double to) const
      {
        return (to - from) / 6. *
               ((*curve)(from) + 4. * (*curve)(0.5 * (from + to)) +
                (*curve)(to));
      }

      // The slope is a parabola: largest at its ends or its vertex.
      //
      // Three of its values make it: on u in [0, 1] it is left + (right - left
      // - bending) u + bending u^2, with its vertex where the derivative
      // vanishes. If that lies outside, or there is none, the ends are enough.
      double
      steepest_between(const std::size_t i) const
      {
        const double a = kinks[i], h = kinks[i + 1] - a;
        const double left = curve->slope(a), right = curve->slope(a + h);
        const double middle  = curve->slope(a + 0.5 * h);
        const double bending = 2. * (left - 2. * middle + right);
        const double vertex =
          bending != 0. ? 0.5 * (left - right + bending) / bending : 0.;
        return -std::min(
          {left, right, curve->slope(a + std::clamp(vertex, 0., 1.) * h)});
      }

      std::optional<MonotoneCurve> curve;
      double                       last = 0; ///< phi of the last row
      std::vector<double>          integral; ///< of s, from 0 to each row [mm]
      std::vector<double>          steepest; ///< bound from each row on [1/mm]
    };
  } // namespace



  FrictionLawPlugin
  table_plugin()
  {
    return {
      "table",
      "as modified coulomb, with the decay of the bond from Friction table",
      TableFriction()};
  }
} // namespace Debond
