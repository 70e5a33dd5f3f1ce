#include <debond/bulk/modulus_field.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Debond
{
  namespace
  {
    const char *const entry = "Bone / Young modulus";



    Expression
    parsed(const std::string &variables,
           const std::string &text,
           const double       radius)
    {
      try
        {
          return read_expression(variables, text, radius);
        }
      catch (const InputError &error)
        {
          throw EntryError(entry,
                           std::string(error.what()) +
                             " (expected a number of MPa, or such an "
                             "expression)");
        }
    }



    bool
    can_be_parsed(const std::string &variables,
                  const std::string &text,
                  const double       radius)
    {
      try
        {
          read_expression(variables, text, radius);
        }
      catch (const InputError &)
        {
          return false;
        }
      return true;
    }



    std::string
    in_words(const Eigen::Vector3d &X)
    {
      return "x = " + to_text(X[0], 6) + " mm, y = " + to_text(X[1], 6) +
             " mm, z = " + to_text(X[2], 6) + " mm";
    }
  } // namespace



  ModulusField::ModulusField(const std::string        &expression,
                             std::optional<VoxelImage> voxels,
                             const double              radius)
    : text(expression)
    , image(std::move(voxels))
    , layered(!image && can_be_parsed("z", expression, radius))
    , modulus(parsed(image ? "x,y,z,grey" : "x,y,z", expression, radius))
  {
    if (image && can_be_parsed("x,y,z", expression, radius))
      throw EntryError("Bone / Voxel file",
                       "Young modulus = " + expression +
                         " does not say what the grey values of these voxels "
                         "mean: expected an expression of grey");
  }



  double
  ModulusField::at(const Eigen::Vector3d &X) const
  {
    std::vector<double> variables{X[0], X[1], X[2]};
    if (image)
      {
        std::array<unsigned int, 3> index;
        for (unsigned int d = 0; d < 3; ++d)
          {
            // rounding may leave the grid at its sides
            const double i = (X[d] - image->corner[d]) / image->spacing[d];
            if (!(i >= -1e-6 && i <= image->n[d] + 1e-6))
              throw EntryError("Bone / Voxel file",
                               "there is no voxel at " + in_words(X) +
                                 ": expected voxels all over the bone, or "
                                 "another Voxel corner");
            index[d] = std::clamp(static_cast<int>(std::floor(i)),
                                  0,
                                  static_cast<int>(image->n[d]) - 1);
          }
        variables.push_back(
          image->grey[index[0] +
                      image->n[0] *
                        (index[1] + std::size_t(image->n[1]) * index[2])]);
      }
    const double value = modulus(variables);
    if (!(value >= 1e-6 && value <= 1e12))
      throw EntryError(entry,
                       "it is " +
                         (std::isfinite(value) ? to_text(value, 6) + " MPa" :
                                                 std::string("no number")) +
                         " at " + in_words(X) +
                         (image ?
                            ", where grey = " + to_text(variables.back(), 6) :
                            "") +
                         ": expected 1e-6 to 1e12 MPa; max(10, ...) makes "
                         "what is empty soft",
                       text);
    return value;
  }



  // Voxels are as they are: a sample lies in one of them. Where they are
  // smaller than the box, samples are as close as voxels.
  double
  ModulusField::over_box(const Eigen::Vector3d &lower,
                         const Eigen::Vector3d &upper,
                         const Eigen::Vector3d &point) const
  {
    if (!image)
      return at(point);
    const Eigen::Vector3d       size = upper - lower;
    std::array<unsigned int, 3> n;
    for (unsigned int d = 0; d < 3; ++d)
      n[d] = std::max(
        1.,
        std::min(1e4, std::ceil(size[d] / image->spacing[d] * (1. - 1e-9))));
    double sum = 0.;
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          sum += at(lower + Eigen::Vector3d((i + 0.5) / n[0] * size[0],
                                            (j + 0.5) / n[1] * size[1],
                                            (k + 0.5) / n[2] * size[2]));
    return sum / (double(n[0]) * n[1] * n[2]);
  }



  double
  ModulusField::mean(const Eigen::Vector3d &lower,
                     const Eigen::Vector3d &upper) const
  {
    constexpr unsigned int n    = 20;
    const Eigen::Vector3d  part = (upper - lower) / n;
    double                 sum  = 0.;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const Eigen::Vector3d corner =
              lower + part.cwiseProduct(Eigen::Vector3d(i, j, k));
            sum += at(corner + 0.5 * part);
          }
    return sum / (n * n * n);
  }
} // namespace Debond
