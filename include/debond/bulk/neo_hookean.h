#pragma once

#include <debond/bulk/hyperelastic_material.h>

#include <cmath>

namespace Debond
{
  /**
   * Neo-Hookean material of Eqs.\ (1) and (2) of the paper in total Lagrangian
   * form, W = G/2 (tr C - 3) - G ln J + Lambda/2 (ln J)^2.
   *
   * Everything is a function of the displacement gradient H = F - I, never of
   * F itself: strains are of the order of 1e-3 here, and F - F^-T or ln J
   * computed from F would lose the three leading digits. Number is double, or
   * an Eigen array of doubles for several points at once.
   */
  struct NeoHookean
  {
    double G      = 0; ///< shear modulus [MPa]
    double Lambda = 0; ///< first Lame parameter [MPa]

    /** Eq.\ (2). @p young_modulus [MPa], @p poisson_ratio in (-1, 0.5). */
    static NeoHookean
    from_young(double young_modulus, double poisson_ratio)
    {
      NeoHookean material;
      material.G = young_modulus / (2. * (1. + poisson_ratio));
      material.Lambda =
        2. * material.G * poisson_ratio / (1. - 2. * poisson_ratio);
      return material;
    }

    /** F^-T for F = I + H with @p J = det F. */
    template <typename Number>
    static void
    inverse_transpose(const Number (&H)[3][3],
                      const Number &J,
                      Number (&F_inv_T)[3][3])
    {
      Number F[3][3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          F[i][j] = H[i][j] + (i == j ? 1. : 0.);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
            const unsigned int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            F_inv_T[i][j] = (F[i1][j1] * F[i2][j2] - F[i1][j2] * F[i2][j1]) / J;
          }
    }

    /** First Piola-Kirchhoff stress P = G (F - F^-T) + Lambda ln J F^-T [MPa],
     *  with F - F^-T = H + H^T F^-T. */
    template <typename Number>
    void
    stress(const Number (&H)[3][3], Number (&P)[3][3]) const
    {
      using std::log1p;
      const Number j = volume_change(H);
      Number       A[3][3];
      inverse_transpose(H, Number(1. + j), A);
      const Number pressure_term = Lambda * log1p(j);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int k = 0; k < 3; ++k)
          P[i][k] = G * (H[i][k] + H[0][i] * A[0][k] + H[1][i] * A[1][k] +
                         H[2][i] * A[2][k]) +
                    pressure_term * A[i][k];
    }

    /** Strain energy density W [MPa = N mm / mm^3], with
     *  (tr C - 3)/2 = tr H + H:H/2 and tr H - ln J = (tr H - j) + (j -
     * ln(1+j)), j = J - 1. */
    template <typename Number>
    Number
    energy(const Number (&H)[3][3]) const
    {
      using std::log1p;
      Number HH = H[0][0] * H[0][0];
      for (unsigned int k = 1; k < 9; ++k)
        HH += H[k / 3][k % 3] * H[k / 3][k % 3];
      const Number j    = volume_change(H);
      const Number ln_J = log1p(j);
      return G * (0.5 * HH + (H[0][0] + H[1][1] + H[2][2] - j) + (j - ln_J)) +
             0.5 * Lambda * ln_J * ln_J;
    }

    /** C_iJkL = dP_iJ/dF_kL = G (d_ik d_JL + A_iL A_kJ)
     *  + Lambda (A_iJ A_kL - ln J A_iL A_kJ) with A = F^-T [MPa]. */
    template <typename Number>
    void
    tangent(const Number (&H)[3][3], Number (&C)[3][3][3][3]) const
    {
      using std::log1p;
      const Number j = volume_change(H);
      Number       A[3][3];
      inverse_transpose(H, Number(1. + j), A);
      const Number crossed = G - Lambda * log1p(j);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int J = 0; J < 3; ++J)
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int L = 0; L < 3; ++L)
              {
                C[i][J][k][L] =
                  crossed * A[i][L] * A[k][J] + Lambda * A[i][J] * A[k][L];
                if (i == k && J == L)
                  C[i][J][k][L] += G;
              }
    }
  };
} // namespace Debond
