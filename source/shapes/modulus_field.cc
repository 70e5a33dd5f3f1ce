#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
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
    place_text(const Eigen::Vector3d &X)
    {
      return "x = " + to_text(X[0], 6) + " mm, y = " + to_text(X[1], 6) +
             " mm, z = " + to_text(X[2], 6) + " mm";
    }



    std::string
    box_text(const ModulusField::Box &box)
    {
      const auto corner = [](const Eigen::Vector3d &X) {
        std::string text;
        for (unsigned int d = 0; d < 3; ++d)
          text += (d == 0 ? "(" : ", ") +
                  to_text(std::abs(X[d]) < 1e-9 ? 0. : X[d], 6); // no 1e-16
        return text + ")";
      };
      return "from " + corner(box[0]) + " to " + corner(box[1]) + " mm";
    }



    /** Of voxels with this lowest corner; empty without any. */
    ModulusField::Box
    box_of(const VoxelImage *const image, const std::array<double, 3> &corner)
    {
      ModulusField::Box box{
        {Eigen::Vector3d(corner.data()), Eigen::Vector3d(corner.data())}};
      for (unsigned int d = 0; image && d < 3; ++d)
        box[1][d] += image->length(d);
      return box;
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
                             const double                      radius,
                             const Box                        &bone)
    : is_layered(!voxels && can_be_parsed("z", expression, radius))
    , text(expression)
    , image(std::move(voxels))
    , bone(bone)
    , of_voxels(box_of(image.get(), corner))
    , modulus(parsed(image ? "x,y,z,grey" : "x,y,z", expression, radius))
  {
    if (image && can_be_parsed("x,y,z", expression, radius))
      throw EntryError("Bone / Voxel file",
                       "Young modulus = " + expression +
                         " does not say what the grey values of these voxels "
                         "mean: expected an expression of grey");
    constexpr unsigned int n    = 20;
    const Eigen::Vector3d  part = (bone[1] - bone[0]) / n;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const double value =
              at(bone[0] +
                 part.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)));
            range.smallest = std::min(range.smallest, value);
            range.largest  = std::max(range.largest, value);
            range.mean += value / (n * n * n);
          }
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
            const double i = (X[d] - of_voxels[0][d]) / image->spacing[d];
            if (!(i >= -1e-6 && i <= image->n[d] + 1e-6))
              throw EntryError("Bone / Voxel file",
                               "there is no voxel at " + place_text(X) +
                                 ": they are " + box_text(of_voxels) +
                                 ", expected all over the bone (Bone / Size, "
                                 "Expert / Bone / Voxel corner)");
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
          " at " + place_text(X) +
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



  std::string
  ModulusField::in_words() const
  {
    const std::string of_bone =
      "Young's modulus of the bone: " + to_text(range.smallest, 3) + " to " +
      to_text(range.largest, 3) + " MPa, mean " + to_text(range.mean, 3);
    if (!image)
      return of_bone;
    const auto [least, largest] =
      std::minmax_element(image->grey.begin(), image->grey.end());
    return grid_text(image->n) + " voxels of " + grid_text(image->spacing) +
           " mm " + box_text(of_voxels) + ", grey values from " +
           to_text(*least, 6) + " to " + to_text(*largest, 6) +
           "\nThe bone is " + box_text(bone) + "; " + image->order + "\n" +
           of_bone;
  }
} // namespace Debond
