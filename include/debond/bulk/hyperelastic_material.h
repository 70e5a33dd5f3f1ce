#pragma once

#include <Eigen/Core>

#include <functional>
#include <tuple>

namespace Debond
{
  /** J - 1 = tr H + second and third invariant of H = F - I, free of
   *  cancellation. Number is double, or an Eigen array for several points. */
  template <typename Number>
  Number
  volume_change(const Number (&H)[3][3])
  {
    const Number minors = H[0][0] * H[1][1] - H[0][1] * H[1][0] +
                          H[0][0] * H[2][2] - H[0][2] * H[2][0] +
                          H[1][1] * H[2][2] - H[1][2] * H[2][1];
    const Number determinant =
      H[0][0] * (H[1][1] * H[2][2] - H[1][2] * H[2][1]) -
      H[0][1] * (H[1][0] * H[2][2] - H[1][2] * H[2][0]) +
      H[0][2] * (H[1][0] * H[2][1] - H[1][1] * H[2][0]);
    return H[0][0] + H[1][1] + H[2][2] + minors + determinant;
  }



  /** One number for each of the n Gauss points of a cell. */
  template <int n>
  using PointValues = Eigen::Array<double, n, 1>;



  /**
   * The material of a body: strain energy density W(F) [MPa], first
   * Piola-Kirchhoff stress P = dW/dF [MPa] and C_iJkL = dP_iJ/dF_kL [MPa], as
   * functions of the displacement gradient H = F - I, at all Gauss points of a
   * cell at once. W is proportional to Young's modulus, so that one which
   * varies is a factor for each point.
   *
   * A body with small strains is that of the same material at rest: its stress
   * is C(0) : H.
   */
  class HyperelasticMaterial
  {
  public:
    /** Material of a law with the templates stress(H, P), energy(H) and
     *  tangent(H, C) for a Number, as NeoHookean has them. */
    template <typename Law>
    HyperelasticMaterial(const Law &law)
      : in_cells(law, law)
    {}

    /** In cells of n = 2 x 2 x 2 points, or of 3 x 3 x 3. */
    template <int n>
    void
    stress(const PointValues<n> (&H)[3][3],
           PointValues<n> (&P)[3][3],
           PointValues<n> &W) const
    {
      std::get<InCell<n>>(in_cells).stress(H, P, W);
    }
    template <int n>
    void
    tangent(const PointValues<n> (&H)[3][3],
            PointValues<n> (&C)[3][3][3][3]) const
    {
      std::get<InCell<n>>(in_cells).tangent(H, C);
    }

  private:
    template <int n>
    struct InCell
    {
      template <typename Law>
      InCell(const Law &law)
        : stress([law](const auto &H, auto &P, auto &W) {
          law.stress(H, P);
          W = law.energy(H);
        })
        , tangent([law](const auto &H, auto &C) { law.tangent(H, C); })
      {}

      using Gradient = PointValues<n>[3][3];
      using Tangent  = PointValues<n>[3][3][3][3];
      std::function<void(const Gradient &, Gradient &, PointValues<n> &)>
                                                       stress;
      std::function<void(const Gradient &, Tangent &)> tangent;
    };

    const std::tuple<InCell<8>, InCell<27>> in_cells;
  };
} // namespace Debond
