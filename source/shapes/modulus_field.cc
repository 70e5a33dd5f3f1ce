#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

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
      static const std::regex grey("\\bgrey\\b");
      if (variables == "x,y,z" && std::regex_search(text, grey))
        throw EntryError(entry,
                         "grey is the grey value of a voxel, and there is no "
                         "Voxel file",
                         text);
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



    std::string
    box_text(const std::array<double, 3> &lower,
             const std::array<double, 3> &upper)
    {
      const auto corner = [](const std::array<double, 3> &X) {
        std::string text;
        for (unsigned int d = 0; d < 3; ++d)
          text += (d == 0 ? "(" : ", ") +
                  to_text(std::abs(X[d]) < 1e-9 ? 0. : X[d], 6); // no 1e-16
        return text + ")";
      };
      return "from " + corner(lower) + " to " + corner(upper) + " mm";
    }



    /** "125 x 125 x 50" */
    template <typename Number>
    std::string
    grid_text(const std::array<Number, 3> &n)
    {
      return to_text(n[0], 6) + " x " + to_text(n[1], 6) + " x " +
             to_text(n[2], 6);
    }
  } // namespace



  ModulusField::ModulusField(const std::string                &expression,
                             std::shared_ptr<const VoxelImage> voxels,
                             const std::array<double, 3>      &corner,
                             const double                      radius)
    : text(expression)
    , image(std::move(voxels))
    , corner(corner)
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
            const double i = (X[d] - corner[d]) / image->spacing[d];
            if (!(i >= -1e-6 && i <= image->n[d] + 1e-6))
              throw EntryError("Bone / Voxel file",
                               "there is no voxel at " + in_words(X) +
                                 ": they are " + extent_text() +
                                 ", expected all over the bone (Bone / Size, "
                                 "Voxel corner)");
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
      throw EntryError(
        entry,
        (std::isfinite(value) ? "it is " + to_text(value, 6) + " MPa" :
                                std::string("it has no finite value")) +
          " at " + in_words(X) +
          (image ? ", where grey = " + to_text(variables.back(), 6) : "") +
          ": expected 1e-6 to 1e12 MPa" +
          (!std::isfinite(value) ? remark_on_no_value :
           value < 1e-6          ? "; max(10, ...) makes what is empty soft" :
                                   ""),
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



  ModulusField::Range
  ModulusField::range(const Eigen::Vector3d &lower,
                      const Eigen::Vector3d &upper) const
  {
    constexpr unsigned int n    = 20;
    const Eigen::Vector3d  part = (upper - lower) / n;
    Range                  range{1e300, 0., 0.};
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const double value =
              at(lower +
                 part.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)));
            range.smallest = std::min(range.smallest, value);
            range.largest  = std::max(range.largest, value);
            range.mean += value / (n * n * n);
          }
    return range;
  }



  std::string
  ModulusField::extent_text() const
  {
    std::array<double, 3> end;
    for (unsigned int d = 0; d < 3; ++d)
      end[d] = corner[d] + image->length(d);
    return box_text(corner, end);
  }



  std::string
  ModulusField::voxels_text(const std::array<double, 3> &bone_lower,
                            const std::array<double, 3> &bone_upper) const
  {
    if (!image)
      return "";
    const auto [least, largest] =
      std::minmax_element(image->grey.begin(), image->grey.end());
    return grid_text(image->n) + " voxels of " + grid_text(image->spacing) +
           " mm " + extent_text() + ", grey values from " + to_text(*least, 6) +
           " to " + to_text(*largest, 6) + "\nThe bone is " +
           box_text(bone_lower, bone_upper) + "; " + image->order + "\n";
  }
} // namespace Debond
