#ifndef debond_output_vtu_patches_h
#define debond_output_vtu_patches_h

#include <debond/geometry/nurbs_surface.h>

#include <deal.II/base/data_out_base.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Debond
{
  /** Number of values of a field at a point. */
  enum class FieldSize
  {
    scalar = 1,
    vector = 3,
    tensor = 9
  };

  /**
   * What deal.II's writers ask for: patches (cells or pieces of a surface,
   * each a regular grid of points) and the names of the fields.
   */
  template <int dim>
  class PatchSet
  {
  public:
    PatchSet(const std::vector<std::pair<std::string, FieldSize>> &fields)
    {
      using namespace dealii::DataComponentInterpretation;
      for (const auto &[name, size] : fields)
        {
          const auto n_values = static_cast<unsigned int>(size);
          if (size != FieldSize::scalar)
            ranges.emplace_back(names.size(),
                                names.size() + n_values - 1,
                                name,
                                size == FieldSize::vector ?
                                  component_is_part_of_vector :
                                  component_is_part_of_tensor);
          names.insert(names.end(), n_values, name);
        }
    }

    /** A new patch with room for all values, to be filled point by point. */
    void
    add_patch(const unsigned int n_subdivisions)
    {
      patches.emplace_back();
      auto &patch                = patches.back();
      patch.n_subdivisions       = n_subdivisions;
      patch.patch_index          = patches.size() - 1;
      patch.reference_cell       = dealii::ReferenceCells::get_hypercube<dim>();
      patch.points_are_available = true;
      std::fill(patch.neighbors.begin(),
                patch.neighbors.end(),
                dealii::DataOutBase::Patch<dim, 3>::no_neighbor);
      unsigned int n_points = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_points *= n_subdivisions + 1;
      patch.data.reinit(names.size() + 3, n_points);
      next_point = 0;
    }

    /** The next point of the last patch, first coordinate fastest; the
     *  @p values of all fields one after the other. */
    void
    add_point(const Eigen::Vector3d     &position,
              const std::vector<double> &values)
    {
      AssertDimension(values.size(), names.size());
      auto &data = patches.back().data;
      for (unsigned int i = 0; i < values.size(); ++i)
        data(i, next_point) = values[i];
      for (unsigned int d = 0; d < 3; ++d)
        data(names.size() + d, next_point) = position[d];
      ++next_point;
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
    unsigned int       next_point = 0;
  };

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

  /** Into how many pieces a cell or element is cut in each direction, so that
   *  a patch has about @p pieces of them: the fewer elements a disk has, the
   *  more pieces it takes to look round. */
  unsigned int
  n_pieces(const NurbsSurface &surface,
           unsigned int        pieces,
           unsigned int        least,
           unsigned int        most);
} // namespace Debond
#endif
