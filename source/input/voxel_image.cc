#include <debond/input/csv_table.h>
#include <debond/input/voxel_formats.h>
#include <debond/input/voxel_image.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <mutex>
#include <set>

namespace Debond
{
  std::size_t
  StoredVoxels::n_voxels(const FileRefusal &refuse) const
  {
    double number = 1.;
    for (const unsigned int along_index : n)
      number *= along_index;
    if (!(number >= 1. && number <= 1e9))
      refuse("it has " + to_text(number, 6) + " voxels: expected 1 to 1e9");
    return static_cast<std::size_t>(number);
  }



  namespace
  {
    /** Number, distance and the first of places along a direction. */
    struct GridLine
    {
      unsigned int n       = 1;
      double       spacing = 1., first = 0.;

      unsigned int
      index(const double x) const
      {
        return static_cast<unsigned int>(std::lround((x - first) / spacing));
      }
    };



    GridLine
    grid_line(const std::vector<std::vector<double>> &rows,
              const unsigned int                      d,
              const FileRefusal                      &refuse)
    {
      double least = rows[0][d], largest = least;
      for (const auto &row : rows)
        {
          least   = std::min(least, row[d]);
          largest = std::max(largest, row[d]);
        }
      const double     rounding = 1e-5 * (largest - least);
      std::set<double> places;
      for (const auto &row : rows)
        {
          const auto above = places.lower_bound(row[d] - rounding);
          if (above == places.end() || *above > row[d] + rounding)
            places.insert(row[d]);
        }
      const std::string name(1, "xyz"[d]);
      if (places.size() < 2)
        refuse("all voxels have the same " + name +
               ": expected two layers at least");
      GridLine line;
      line.n       = places.size();
      line.first   = *places.begin();
      line.spacing = (largest - least) / (line.n - 1);
      for (const double x : places)
        if (std::abs(x - line.first - line.index(x) * line.spacing) >
            0.01 * line.spacing)
          refuse("the values of " + name + " have no equal distances: " + name +
                 " = " + to_text(x, 6) + " mm is off the grid of " +
                 to_text(line.spacing, 6) + " mm");
      return line;
    }



    StoredVoxels
    read_csv_voxels(const std::string &filename,
                    const std::string &entry,
                    const FileRefusal &refuse)
    {
      std::vector<unsigned int> lines;
      const auto                rows = read_csv_columns(
        filename, entry, {"x", "y", "z", "grey"}, false, &lines);
      StoredVoxels            image;
      std::array<GridLine, 3> grid;
      for (unsigned int d = 0; d < 3; ++d)
        {
          grid[d]          = grid_line(rows, d, refuse);
          image.n[d]       = grid[d].n;
          image.spacing[d] = grid[d].spacing;
          image.first[d]   = grid[d].first;
        }
      const std::size_t n = image.n_voxels(refuse);
      image.grey.assign(n, std::nanf(""));
      for (std::size_t i = 0; i < rows.size(); ++i)
        {
          const std::size_t place =
            grid[0].index(rows[i][0]) +
            image.n[0] * (grid[1].index(rows[i][1]) +
                          std::size_t(image.n[1]) * grid[2].index(rows[i][2]));
          if (!std::isnan(image.grey[place]))
            refuse("line " + std::to_string(lines[i]) +
                   ": there is another row for this voxel");
          image.grey[place] = static_cast<float>(rows[i][3]);
        }
      if (rows.size() < n)
        refuse("it has " + std::to_string(rows.size()) +
               " rows: expected one for each of the " +
               std::to_string(image.n[0]) + " x " + std::to_string(image.n[1]) +
               " x " + std::to_string(image.n[2]) + " voxels");
      return image;
    }



    /** They have no modulus: what was not measured must be given a value. */
    void
    refuse_no_numbers(const StoredVoxels &image, const FileRefusal &refuse)
    {
      const std::size_t first =
        std::find_if(image.grey.begin(),
                     image.grey.end(),
                     [](const float grey) { return !std::isfinite(grey); }) -
        image.grey.begin();
      if (first < image.grey.size())
        refuse("the grey value of voxel (" +
               std::to_string(first % image.n[0]) + ", " +
               std::to_string(first / image.n[0] % image.n[1]) + ", " +
               std::to_string(first / image.n[0] / image.n[1]) +
               "), counted from 0, is no finite number");
    }



    std::string
    order_text(const std::array<int, 3> &along)
    {
      static const char *const low[]{"left", "front", "bottom"},
        *const                 high[]{"right", "back", "top"};
      std::string              place, lowest, axes;
      for (int axis = 0; axis < 3; ++axis)
        {
          const std::string comma = axis == 0 ? "" : ", ";
          const bool        is_low =
            std::find(along.begin(), along.end(), axis + 1) != along.end();
          place += comma + (is_low ? low : high)[axis];
          lowest += comma + (is_low ? "lowest " : "highest ") + "xyz"[axis];
          axes += comma + (along[axis] > 0 ? "+" : "-") +
                  "xyz"[std::abs(along[axis]) - 1];
        }
      return "the first voxel of the file is at the " + place + " (" + lowest +
             "), and its three indices run along " + axes;
    }



    /** Its first voxel is the one with the lowest x, y and z, and x is fastest
     *  whatever the order in the file. */
    VoxelImage
    in_scene_order(StoredVoxels stored)
    {
      VoxelImage image;
      image.order          = order_text(stored.along);
      image.data_file      = std::move(stored.data_file);
      image.remarks        = std::move(stored.remarks);
      std::ptrdiff_t first = 0, step = 1;  // in the order of the file
      std::array<std::ptrdiff_t, 3> steps; // to the next one along x, y, z
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int axis   = std::abs(stored.along[d]) - 1;
          const bool         is_low = stored.along[d] > 0;
          const double       length = (stored.n[d] - 1) * stored.spacing[d];
          image.n[axis]             = stored.n[d];
          image.spacing[axis]       = stored.spacing[d];
          image.corner[axis] = stored.first[axis] - (is_low ? 0. : length) -
                               0.5 * stored.spacing[d];
          first += is_low ? 0 : (stored.n[d] - 1) * step;
          steps[axis] = is_low ? step : -step;
          step *= stored.n[d];
        }
      if (stored.along == StoredVoxels().along)
        {
          image.grey = std::move(stored.grey);
          return image;
        }
      image.grey.reserve(stored.grey.size());
      for (std::ptrdiff_t k = 0; k < image.n[2]; ++k)
        for (std::ptrdiff_t j = 0; j < image.n[1]; ++j)
          for (std::ptrdiff_t i = 0; i < image.n[0]; ++i)
            image.grey.push_back(
              stored.grey[first + i * steps[0] + j * steps[1] + k * steps[2]]);
      return image;
    }



    VoxelImage
    read_anew(const std::string &filename, const std::string &entry)
    {
      const FileRefusal refuse = [&](const std::string &why) {
        throw EntryError(entry, why, filename);
      };
      const std::string lower =
        boost::to_lower_copy(filename, std::locale::classic());
      const auto ends_in = [&](const std::string &end) {
        return boost::ends_with(lower, end);
      };
      StoredVoxels stored;
      if (ends_in(".mhd") || ends_in(".mha"))
        stored = read_meta_image(filename, refuse);
      else if (ends_in(".csv"))
        stored = read_csv_voxels(filename, entry, refuse);
      else
        refuse(std::string("expected the name of a .mhd, .mha or .csv file") +
               (ends_in(".nii") || ends_in(".nii.gz") ?
                  ": python3 -m debond nifti " + filename +
                    " voxels.mha writes one of it" :
                  ""));
      for (const double edge : stored.spacing)
        if (!(edge > 0. && std::isfinite(edge)))
          refuse("its voxels have an edge of " + to_text(edge) +
                 " mm: expected more than 0");
      refuse_no_numbers(stored, refuse);
      VoxelImage image = in_scene_order(std::move(stored));
      if (ends_in(".csv"))
        image.order = "the rows of the file say where each voxel is";
      return image;
    }
  } // namespace



  std::shared_ptr<const VoxelImage>
  read_voxel_image(const std::string &filename, const std::string &entry)
  {
    static std::map<std::string, std::weak_ptr<const VoxelImage>> known;
    static std::mutex                                             one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    const std::string                 header = identity_of(filename);
    auto                              image  = known[filename].lock();
    if (!image || image->identity != header + identity_of(image->data_file))
      {
        auto anew = std::make_shared<VoxelImage>(read_anew(filename, entry));
        anew->identity  = header + identity_of(anew->data_file);
        known[filename] = image = anew;
      }
    return image;
  }
} // namespace Debond
