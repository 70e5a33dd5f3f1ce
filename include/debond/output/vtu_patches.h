#ifndef debond_output_vtu_patches_h
#define debond_output_vtu_patches_h

#include <debond/geometry/nurbs_surface.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Debond
{
  /** Appends the components of a vector or, row by row, a matrix. */
  template <typename Derived>
  void
  append_values(std::vector<double>              &values,
                const Eigen::MatrixBase<Derived> &matrix)
  {
    for (unsigned int i = 0; i < matrix.rows(); ++i)
      for (unsigned int j = 0; j < matrix.cols(); ++j)
        values.push_back(matrix(i, j));
  }

  /**
   * What deal.II's writers ask for: patches (cells or pieces of a surface,
   * each a regular grid of points) and the names of the fields.
   */
  template <int dim>
  class PatchSet
  {
  public:
    /** Names of the fields, and how many values each has: 1, a vector's 3, a
     *  tensor's 9. */
    PatchSet(const std::vector<std::pair<std::string, unsigned int>> &fields)
    {
      using namespace dealii::DataComponentInterpretation;
      for (const auto &[name, n_values] : fields)
        {
          if (n_values > 1)
            ranges.emplace_back(names.size(),
                                names.size() + n_values - 1,
                                name,
                                n_values == 3 ? component_is_part_of_vector :
                                                component_is_part_of_tensor);
          names.insert(names.end(), n_values, name);
        }
    }

    /** Adds a patch of @p n pieces in each direction. draw(point, values) is
     *  called for their corners, of [-1, 1]^dim: it appends the values of all
     *  fields to an empty list and returns the position. */
    template <typename Draw>
    void
    add_patch(const unsigned int n, const Draw &draw)
    {
      auto &patch                = patches.emplace_back();
      patch.n_subdivisions       = n;
      patch.patch_index          = patches.size() - 1;
      patch.reference_cell       = dealii::ReferenceCells::get_hypercube<dim>();
      patch.points_are_available = true;
      const auto n_points        = dealii::Utilities::fixed_power<dim>(n + 1);
      patch.data.reinit(names.size() + 3, n_points);
      std::vector<double> values;
      for (unsigned int p = 0; p < n_points; ++p)
        {
          // the first coordinate is the fastest
          Eigen::Matrix<double, dim, 1> point;
          for (unsigned int d = 0, rest = p; d < dim; ++d, rest /= n + 1)
            point[d] = 2. * (rest % (n + 1)) / n - 1.;
          values.clear();
          const Eigen::Vector3d position = draw(point, values);
          AssertDimension(values.size(), names.size());
          append_values(values, position);
          for (unsigned int i = 0; i < values.size(); ++i)
            patch.data(i, p) = values[i];
        }
    }

    /** The text of a VTU file. */
    std::string
    vtu() const
    {
      dealii::DataOutBase::VtkFlags flags;
      flags.print_date_and_time = false;
      flags.compression_level   = flags.best_speed;
      std::ostringstream text;
      dealii::DataOutBase::write_vtu(patches, names, ranges, flags, text);
      return text.str();
    }

  private:
    using Range = std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>;

    std::vector<dealii::DataOutBase::Patch<dim, 3>> patches;
    std::vector<std::string>                        names;
    std::vector<Range> ranges; ///< vectors, tensors
  };

  /** Into how many pieces a cell or element is cut in each direction, so that
   *  a patch has about @p pieces of them: the fewer elements a disk has, the
   *  more pieces it takes to look round. */
  inline unsigned int
  n_pieces(const NurbsSurface &surface,
           const unsigned int  pieces,
           const unsigned int  least,
           const unsigned int  most)
  {
    const auto         n      = surface.n_elements_per_direction();
    const unsigned int fewest = std::min(n[0], n[1]);
    return std::clamp((pieces + fewest - 1) / fewest, least, most);
  }
} // namespace Debond
#endif
