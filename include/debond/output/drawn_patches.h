#pragma once

#include <debond/support/number_text.h>
#include <debond/support/runtime.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <Eigen/Core>

#include <algorithm>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Debond
{
  /** Names of fields, and how many values each has: 1, a vector's 3 or a
   *  tensor's 9. */
  using FieldNames = std::vector<std::pair<std::string, unsigned int>>;

  /** A VTU file: patches, each a regular grid of points with the values of all
   *  fields, or, with @p dim 0, single points. These are no finite element
   *  functions, of which DataOut could be told. */
  template <int dim>
  class DrawnPatches
  {
  public:
    explicit DrawnPatches(const FieldNames &fields,
                          const bool        has_curves = false)
    {
      using namespace dealii::DataComponentInterpretation;
      for (const auto &[name, n] : fields)
        {
          if (n > 1)
            ranges.emplace_back(names.size(),
                                names.size() + n - 1,
                                name,
                                n == 3 ? component_is_part_of_vector :
                                         component_is_part_of_tensor);
          names.insert(names.end(), n, name);
        }
      flags.print_date_and_time      = false;
      flags.compression_level        = flags.best_speed;
      flags.write_higher_order_cells = has_curves;
    }

    /** Adds patches of @p n pieces in each direction. draw(k) is a function for
     *  the patch k, which several threads may call for different ones: of
     *  the number of a point it returns the position, and appends the values of
     *  all fields to an empty list. */
    template <typename Draw>
    void
    add(const unsigned int n_patches, const unsigned int n, const Draw &draw)
    {
      const std::size_t begin = patches.size();
      patches.resize(begin + n_patches);
      for_each_chunk(n_patches,
                     [&](unsigned int, const unsigned int first, unsigned end) {
                       for (unsigned int k = first; k < end; ++k)
                         {
                           patches[begin + k].patch_index = begin + k;
                           fill(patches[begin + k], n, draw(k));
                         }
                     });
    }

    std::string
    vtu() const
    {
      Classic<std::ostringstream> text;
      dealii::DataOutBase::write_vtu(patches, names, ranges, flags, text);
      return text.str();
    }

    /** The text of a file that joins those of several ranks, given by their
     *  names. */
    std::string
    pvtu(const std::vector<std::string> &pieces) const
    {
      Classic<std::ostringstream> text;
      dealii::DataOutBase::write_pvtu_record(
        text, pieces, names, ranges, flags);
      return text.str();
    }

  private:
    using Patch = dealii::DataOutBase::Patch<dim, 3>;
    using Range = std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>;

    template <typename DrawPoint>
    void
    fill(Patch &patch, const unsigned int n, const DrawPoint &draw) const
    {
      patch.points_are_available = true;
      if constexpr (dim > 0)
        {
          patch.n_subdivisions = n;
          patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim>();
        }
      patch.data.reinit(names.size() + 3, dealii::Utilities::pow(n + 1, dim));
      std::vector<double> values;
      for (unsigned int p = 0; p < patch.data.size(1); ++p)
        {
          values.clear();
          const Eigen::Vector3d position = draw(p, values);
          AssertDimension(values.size(), names.size());
          values.insert(values.end(), position.data(), position.data() + 3);
          for (unsigned int i = 0; i < values.size(); ++i)
            patch.data(i, p) = values[i];
        }
    }

    std::vector<Patch>            patches;
    std::vector<std::string>      names;
    std::vector<Range>            ranges; ///< vectors and tensors
    dealii::DataOutBase::VtkFlags flags;
  };

  /** Appends the values of a vector or tensor, for DrawnPatches. */
  template <typename Values>
  void
  append_values(std::vector<double> &values, const Values &more)
  {
    values.insert(values.end(), more.data(), more.data() + more.size());
  }

  /** Into how many pieces a cell is cut in each direction, of which a face has
   *  @p n_cells across, so that there are about @p across of them on it: the
   *  fewer cells a disk has, the more pieces it takes to look round. */
  inline unsigned int
  n_pieces(const unsigned int n_cells,
           const unsigned int across,
           const unsigned int least,
           const unsigned int most)
  {
    return std::clamp((across + n_cells - 1) / n_cells, least, most);
  }
} // namespace Debond
