#ifndef debond_bulk_hyperelastic_material_h
#define debond_bulk_hyperelastic_material_h

#include <Eigen/Core>

#include <memory>

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
    virtual ~HyperelasticMaterial() = default;

    /** In cells of 2 x 2 x 2 points, or of 3 x 3 x 3. */
    virtual void
    stress(const PointValues<8> (&H)[3][3],
           PointValues<8> (&P)[3][3],
           PointValues<8> &W) const = 0;
    virtual void
    stress(const PointValues<27> (&H)[3][3],
           PointValues<27> (&P)[3][3],
           PointValues<27> &W) const = 0;
    virtual void
    tangent(const PointValues<8> (&H)[3][3],
            PointValues<8> (&C)[3][3][3][3]) const = 0;
    virtual void
    tangent(const PointValues<27> (&H)[3][3],
            PointValues<27> (&C)[3][3][3][3]) const = 0;
  };



  /** That of a Law with the templates stress(H, P), energy(H) and tangent(H, C)
   *  for a Number, as NeoHookean has them. */
  template <typename Law>
  class MaterialOf : public HyperelasticMaterial
  {
  public:
    explicit MaterialOf(const Law &law)
      : law(law)
    {}
    void
    stress(const PointValues<8> (&H)[3][3],
           PointValues<8> (&P)[3][3],
           PointValues<8> &W) const override
    {
      law.stress(H, P);
      W = law.energy(H);
    }
    void
    stress(const PointValues<27> (&H)[3][3],
           PointValues<27> (&P)[3][3],
           PointValues<27> &W) const override
    {
      law.stress(H, P);
      W = law.energy(H);
    }
    void
    tangent(const PointValues<8> (&H)[3][3],
            PointValues<8> (&C)[3][3][3][3]) const override
    {
      law.tangent(H, C);
    }
    void
    tangent(const PointValues<27> (&H)[3][3],
            PointValues<27> (&C)[3][3][3][3]) const override
    {
      law.tangent(H, C);
    }

  private:
    const Law law;
  };

  template <typename Law>
  std::shared_ptr<const HyperelasticMaterial>
  material_of(const Law &law)
  {
    return std::make_shared<MaterialOf<Law>>(law);
  }
} // namespace Debond
#endif
