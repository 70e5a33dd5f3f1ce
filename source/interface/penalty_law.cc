#include <debond/interface/contact_law.h>

namespace Debond
{
  namespace
  {
    // Eq. (28) along the normal, t_n = eps_n g_n n: a spring that pushes, p =
    // -eps_n g_n > 0, while g_n < 0. Its compliance 1/eps_n is a property of
    // the interface, not a numerical device: in the paper's test it is most of
    // the compliance of the whole.
    class Penalty : public NormalLaw
    {
    public:
      Penalty(const double stiffness, const bool opening_breaks_bond)
        : eps_n(stiffness)
        , opening_breaks_bond(opening_breaks_bond)
      {}

      NormalResponse
      respond(const double g_n, const PointHistory &) const override
      {
        // p, -dp/dg_n, and the potential eps_n g_n^2 / 2
        return {-eps_n * g_n, eps_n, 0.5 * eps_n * g_n * g_n};
      }

      void
      open(PointHistory &history) const override
      {
        // once broken, a bond stays so
        history.broken = history.broken || opening_breaks_bond;
      }

      double
      initial_stiffness() const override
      {
        return eps_n;
      }

    private:
      const double eps_n;
      const bool   opening_breaks_bond;
    };
  } // namespace



  std::shared_ptr<const NormalLaw>
  penalty_law(const double stiffness, const bool opening_breaks_bond)
  {
    return std::make_shared<Penalty>(stiffness, opening_breaks_bond);
  }
} // namespace Debond
