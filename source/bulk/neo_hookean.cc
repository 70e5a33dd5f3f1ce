#include <debond/bulk/neo_hookean.h>

namespace Debond
{
  void
  NeoHookean::tangent(const double (&H)[3][3], double (&C)[9][9]) const
  {
    const double j = volume_change(H);
    double       A[3][3];
    inverse_transpose(H, 1. + j, A);
    const double factor = G - Lambda * std::log1p(j);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int J = 0; J < 3; ++J)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int L = 0; L < 3; ++L)
            C[3 * i + J][3 * k + L] = (i == k && J == L ? G : 0.) +
                                      factor * A[i][L] * A[k][J] +
                                      Lambda * A[i][J] * A[k][L];
  }



  void
  NeoHookean::cauchy_stress(const double (&H)[3][3],
                            double (&sigma)[3][3]) const
  {
    // b - I = H + H^T + H H^T
    const double j = volume_change(H);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        {
          double b_minus_I = H[i][k] + H[k][i];
          for (unsigned int l = 0; l < 3; ++l)
            b_minus_I += H[i][l] * H[k][l];
          sigma[i][k] =
            (G * b_minus_I + (i == k ? Lambda * std::log1p(j) : 0.)) / (1. + j);
        }
  }



  void
  NeoHookean::linear_stress(const double (&H)[3][3],
                            double (&sigma)[3][3]) const
  {
    const double trace = H[0][0] + H[1][1] + H[2][2];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        sigma[i][k] = G * (H[i][k] + H[k][i]) + (i == k ? Lambda * trace : 0.);
  }
} // namespace Debond
