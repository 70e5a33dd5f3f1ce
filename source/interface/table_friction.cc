#include <debond/input/csv_table.h>
#include <debond/input/monotone_curve.h>
#include <debond/interface/bond_friction.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>

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
    /** s(g_s) through the points of a table: monotone cubics between them
     *  (Fritsch and Butland), constant from the last one on. Works, and the
     *  check that local solutions are unique, need integral and steepest slope
     *  of the curve; both are formed once for each row, so that a point only
     *  looks them up. */
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
        , curve(slip, phi)
        , integral(slip.size(), 0.)
        , steepest(slip.size(), 0.)
      {
        // from the first row on: int s dg_s up to each row [mm]
        for (std::size_t i = 1; i < slip.size(); ++i)
          integral[i] =
            integral[i - 1] + integral_between(slip[i - 1], slip[i]);
        // from the last row backwards: the largest -ds/dg_s [1/mm] from each
        // row on; behind the last one s is constant
        for (std::size_t i = slip.size() - 1; i-- > 0;)
          steepest[i] = std::max(steepest[i + 1], steepest_between(i));
      }

      // The curvature jumps at every row. Closed forms integrate from row to
      // row, where the law is as smooth as their quadrature wants it.
      const std::vector<double> &
      kinks() const override
      {
        return slip;
      }

      // Of the whole table, or of its steepest part if it were to fall from 1
      // to 0 at that slope [mm]: a table may be long and have a short fall. A
      // constant table has no slope, 1/0 is infinite, and its length remains.
      double
      characteristic_distance() const override
      {
        return std::min(slip.back(), 1. / steepest.front());
      }

      // The content of this file belongs to the scene: with another one a run
      // is not gone on with.
      std::string
      file() const override
      {
        return filename;
      }

      // The slope is in the file: what helps is a longer fall in there.
      std::string
      entries_against_fall() const override
      {
        return "distance over which the bond of Friction table falls";
      }

    protected:
      // s, and its slope [1/mm] by the derivative of the same cubic. Both
      // belong to one curve: a slope from differences of the rows would cost
      // Newton's method its quadratic convergence. Beyond the last row s is the
      // value there: what a table does not say is not extrapolated. If that is
      // above 0 a part of the bond stays for ever.
      double
      decay(const double g_s, double &slope) const override
      {
        const bool falls = g_s < slip.back();
        slope            = falls ? curve.slope(g_s) : 0.;
        return falls ? curve(g_s) : last;
      }

      // Up to the row before from the sum, then the rest of that interval;
      // beyond the last row the constant goes on.
      double
      integrated_decay(const double g_s) const override
      {
        const std::size_t i = row_before(g_s);
        return integral[i] + (g_s < slip.back() ?
                                integral_between(slip[i], g_s) :
                                last * (g_s - slip[i]));
      }

      // The bound begins with the row before g_s, not with g_s itself: it may
      // be too large within one interval, never too small. So uniqueness is
      // judged on the safe side.
      double
      steepest_decay(const double g_s) const override
      {
        return steepest[row_before(g_s)];
      }

    private:
      // The last row at or before g_s >= 0, by bisection; the first row is at
      // 0, so that there always is one.
      std::size_t
      row_before(const double g_s) const
      {
        return std::upper_bound(slip.begin(), slip.end(), g_s) - slip.begin() -
               1;
      }

      // Simpson's rule is exact for a cubic.
      //
      // Both places lie in one interval of the table, so that the curve is one
      // cubic between them: works are exact integrals of this law, and a defect
      // of energy is none of its interpolation.
      double
      integral_between(const double from, const double to) const
      {
        return (to - from) / 6. *
               (curve(from) + 4. * curve(0.5 * (from + to)) + curve(to));
      }

      // The slope is a parabola: largest at its ends or its vertex.
      //
      // Three of its values make it: on u in [0, 1] it is left + (right - left
      // - bending) u + bending u^2, with its vertex where the derivative
      // vanishes. If that lies outside, or there is none, the ends are enough.
      double
      steepest_between(const std::size_t i) const
      {
        const double a = slip[i], h = slip[i + 1] - a;
        const double left = curve.slope(a), right = curve.slope(a + h);
        const double middle  = curve.slope(a + 0.5 * h);
        const double bending = 2. * (left - 2. * middle + right);
        const double vertex =
          bending != 0. ? 0.5 * (left - right + bending) / bending : 0.;
        return -std::min(
          {left, right, curve.slope(a + std::clamp(vertex, 0., 1.) * h)});
      }

      // The rows and the curve through them, in the distance g_s [mm].
      const std::string         filename;
      const std::vector<double> slip; ///< g_s of the rows [mm]
      const double              last; ///< phi of the last one
      const MonotoneCurve       curve;

      std::vector<double> integral; ///< of s, from 0 to each row [mm]
      std::vector<double> steepest; ///< bound from each row on [1/mm]
    };



    // A table is checked row by row, before anything is built, and refused with
    // the line of the file: a torque curve would not show that its law rises
    // somewhere, or does not begin at g_s = 0.
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
      return std::make_shared<TableFriction>(
        mu_broken, mu_unbroken, filename, slip, phi);
    }
  } // namespace



  // The choice `table' of the entry Friction law. The entries of the two
  // coefficients are shared with modified coulomb, so that the two laws can be
  // compared by changing one line of a scene.
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
          Allowed::text("the name of a CSV file", false)
            .or_word_for("none", ""),
          "CSV file for Friction law = table, relative to the working "
          "directory, with the columns slip_mm, the sliding distance g_s [mm], "
          "ascending from 0, and phi, the bonding state of a point that was "
          "fully bonded, between 1 and 0 and never rising. It needs four rows "
          "at least. Between rows there are monotone cubics; beyond the last "
          "row phi is constant. `none': no table."}}),
      [](const LawChoice &choice) {
        return read_table(choice.number("Friction coefficient broken"),
                          choice.number("Friction coefficient unbroken"),
                          choice.text("Friction table"));
      }};
  }
} // namespace Debond
