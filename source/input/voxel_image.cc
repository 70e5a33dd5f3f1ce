#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/input/voxel_image.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/endian/conversion.hpp>

#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <locale>
#include <map>
#include <memory>
#include <mutex>
#include <set>

namespace Debond
{
  namespace
  {
    constexpr unsigned int largest_image_MB = 4000;



    /** The number of voxels, if there are not too many for this program. */
    std::size_t
    n_voxels(const VoxelImage &image, const FileRefusal &refuse)
    {
      double number = 1.;
      for (const unsigned int n : image.n)
        number *= n;
      if (!(number >= 1. && number <= 1e9))
        refuse("it has " + to_text(number, 6) + " voxels: expected 1 to 1e9");
      return static_cast<std::size_t>(number);
    }



    template <typename Number>
    void
    append_numbers(const char         *bytes,
                   const std::size_t   n,
                   const bool          is_big_endian,
                   std::vector<float> &grey)
    {
      const bool swap = is_big_endian == (boost::endian::order::native ==
                                          boost::endian::order::little);
      for (std::size_t i = 0; i < n; ++i)
        {
          std::array<char, sizeof(Number)> own;
          std::copy_n(bytes + i * sizeof(Number), sizeof(Number), own.begin());
          if (swap)
            std::reverse(own.begin(), own.end());
          Number number;
          std::memcpy(&number, own.data(), sizeof(Number));
          grey.push_back(static_cast<float>(number));
        }
    }



    /** A type of numbers in a file. */
    struct NumberType
    {
      unsigned int size; ///< [bytes]
      void (*append)(const char *, std::size_t, bool, std::vector<float> &);
    };

    template <typename Number>
    NumberType
    number_type()
    {
      return {sizeof(Number), &append_numbers<Number>};
    }



    const char *const unturned = "1 0 0 0 1 0 0 0 1";
    const char *const axes_as_stored =
      ": the axes are not turned; x, y, z are those of the rows, columns and "
      "slices as they are stored";



    /** The header of a MetaImage. */
    struct MetaHeader
    {
      std::map<std::string, std::string> values;
      std::size_t                        size = 0; ///< where data may begin
      const FileRefusal                 &refuse;

      // The line ElementDataFile is the last one.
      MetaHeader(const std::string &bytes, const FileRefusal &refuse)
        : refuse(refuse)
      {
        while (size < bytes.size() && values.count("ElementDataFile") == 0)
          {
            const std::size_t end =
              std::min(bytes.find('\n', size), bytes.size());
            const std::string line = bytes.substr(size, end - size);
            const std::size_t at   = line.find('=');
            size                   = end + 1;
            if (at != std::string::npos)
              values[boost::trim_copy(line.substr(0, at))] =
                boost::trim_copy(line.substr(at + 1));
          }
        if (values.count("ElementDataFile") == 0)
          refuse("it is no MetaImage: there is no line ElementDataFile = ...");
      }

      std::string
      text(const std::string &name, const std::string &otherwise) const
      {
        const auto found = values.find(name);
        return found == values.end() ? otherwise : found->second;
      }

      bool
      is_true(const std::string &name,
              const std::string &otherwise = "False") const
      {
        return boost::iequals(text(name, otherwise),
                              "True",
                              std::locale::classic());
      }

      /** Three numbers; of a name that is missing @p otherwise. */
      std::array<double, 3>
      numbers(const std::string &name, const std::string &otherwise) const
      {
        std::vector<std::string> items;
        const std::string        value = text(name, otherwise);
        boost::split(items, value, boost::is_space(), boost::token_compress_on);
        std::array<double, 3> result;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const auto number =
              items.size() == 3 ? read_number(items[d]) : std::nullopt;
            if (!number)
              refuse(name + " = " + value + ": expected three numbers");
            result[d] = *number;
          }
        return result;
      }
    };



    VoxelImage
    read_meta_image(const std::string &filename, const FileRefusal &refuse)
    {
      static const std::map<std::string, NumberType> types{
        {"MET_CHAR", number_type<std::int8_t>()},
        {"MET_UCHAR", number_type<std::uint8_t>()},
        {"MET_SHORT", number_type<std::int16_t>()},
        {"MET_USHORT", number_type<std::uint16_t>()},
        {"MET_INT", number_type<std::int32_t>()},
        {"MET_UINT", number_type<std::uint32_t>()},
        {"MET_FLOAT", number_type<float>()},
        {"MET_DOUBLE", number_type<double>()}};
      std::string bytes = read_input_bytes(filename, refuse, largest_image_MB);
      const MetaHeader header(bytes, refuse);
      VoxelImage       image;
      const auto       size = header.numbers("DimSize", "");
      for (unsigned int d = 0; d < 3; ++d)
        {
          if (!(size[d] >= 1. && size[d] <= 1e9 &&
                size[d] == std::floor(size[d])))
            refuse("DimSize = " + header.text("DimSize", "") +
                   ": expected three whole numbers from 1 to 1e9");
          image.n[d] = static_cast<unsigned int>(size[d]);
        }
      image.spacing =
        header.numbers("ElementSpacing", header.text("ElementSize", "1 1 1"));
      if (header.text("ElementSpacing", header.text("ElementSize", "")) == "")
        image.remarks.push_back(
          "it has no ElementSpacing: edges of voxels are taken as 1 mm");
      // its place is that of the centre of the first voxel
      image.corner =
        header.numbers("Offset",
                       header.text("Position", header.text("Origin", "0 0 0")));
      for (unsigned int d = 0; d < 3; ++d)
        image.corner[d] -= 0.5 * image.spacing[d];
      for (const char *const name :
           {"TransformMatrix", "Rotation", "Orientation"})
        if (header.text(name, unturned) != unturned)
          image.remarks.push_back(name + (" = " + header.text(name, "")) +
                                  axes_as_stored);
      if (!header.is_true("BinaryData", "True"))
        refuse("its data are text: expected BinaryData = True");
      if (header.is_true("CompressedData"))
        refuse("its data are compressed: expected CompressedData = False");
      if (header.text("ElementNumberOfChannels", "1") != "1")
        refuse("its voxels have several numbers each: expected one");
      const auto type = types.find(header.text("ElementType", ""));
      if (type == types.end())
        refuse("ElementType = " + header.text("ElementType", "") +
               ": expected MET_UCHAR, MET_SHORT, MET_USHORT, MET_INT, "
               "MET_FLOAT or the like");

      std::size_t       begin = header.size;
      const std::string data  = header.text("ElementDataFile", "");
      if (data != "LOCAL")
        {
          image.data_file =
            std::filesystem::path(filename).replace_filename(data).string();
          bytes = read_input_bytes(
            image.data_file,
            [&](const std::string &why) { refuse(data + ": " + why); },
            largest_image_MB);
          begin = 0;
        }
      const std::size_t n = n_voxels(image, refuse);
      if (bytes.size() != begin + n * type->second.size)
        refuse("there are " + std::to_string(bytes.size() - begin) +
               " bytes of data: expected " +
               std::to_string(n * type->second.size) + ", those of DimSize");
      image.grey.reserve(n);
      type->second.append(bytes.data() + begin,
                          n,
                          header.is_true("ElementByteOrderMSB") ||
                            header.is_true("BinaryDataByteOrderMSB"),
                          image.grey);
      return image;
    }



    VoxelImage
    read_nifti(const std::string &filename, const FileRefusal &refuse)
    {
      static const std::map<int, NumberType> types{
        {DT_INT8, number_type<std::int8_t>()},
        {DT_UINT8, number_type<std::uint8_t>()},
        {DT_INT16, number_type<std::int16_t>()},
        {DT_UINT16, number_type<std::uint16_t>()},
        {DT_INT32, number_type<std::int32_t>()},
        {DT_UINT32, number_type<std::uint32_t>()},
        {DT_FLOAT32, number_type<float>()},
        {DT_FLOAT64, number_type<double>()}};
      nifti_set_debug_level(0); // it would write to the console
      const std::unique_ptr<nifti_image, void (*)(nifti_image *)> file(
        nifti_image_read(filename.c_str(), 1), &nifti_image_free);
      if (!file || file->data == nullptr)
        refuse("it cannot be read as a NIfTI file");
      if (file->nvox != file->nx * file->ny * file->nz)
        refuse("it has more than one image: expected one of three dimensions");
      const double unit = file->xyz_units == NIFTI_UNITS_METER  ? 1e3 :
                          file->xyz_units == NIFTI_UNITS_MICRON ? 1e-3 :
                                                                  1.;
      VoxelImage   image;
      image.n       = {{static_cast<unsigned int>(file->nx),
                        static_cast<unsigned int>(file->ny),
                        static_cast<unsigned int>(file->nz)}};
      image.spacing = {{unit * file->dx, unit * file->dy, unit * file->dz}};
      // there are two ways to say where the centre of the first voxel is
      const auto &to_place = file->qform_code > 0 || file->sform_code <= 0 ?
                               file->qto_xyz :
                               file->sto_xyz;
      for (unsigned int d = 0; d < 3; ++d)
        image.corner[d] = unit * to_place.m[d][3] - 0.5 * image.spacing[d];
      if (file->xyz_units == NIFTI_UNITS_UNKNOWN)
        image.remarks.push_back("it says no unit of length: taken as mm");
      const auto is_turned = [](const auto &to_place) {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            if ((std::abs(to_place.m[i][j]) > 1e-6) != (i == j) ||
                (i == j && to_place.m[i][j] < 0.))
              return true;
        return false;
      };
      if ((file->qform_code > 0 && is_turned(file->qto_xyz)) ||
          (file->sform_code > 0 && is_turned(file->sto_xyz)))
        image.remarks.push_back(
          std::string("its header turns or mirrors the axes") + axes_as_stored);
      const auto type = types.find(file->datatype);
      if (type == types.end())
        refuse("its voxels are of the type " +
               std::string(nifti_datatype_string(file->datatype)) +
               ": expected one number each");
      // the library has put the bytes in the order of this machine
      type->second.append(static_cast<const char *>(file->data),
                          n_voxels(image, refuse),
                          boost::endian::order::native ==
                            boost::endian::order::big,
                          image.grey);
      if (file->scl_slope != 0.)
        for (float &value : image.grey)
          value = file->scl_slope * value + file->scl_inter;
      return image;
    }



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



    VoxelImage
    read_csv_voxels(const std::string &filename,
                    const std::string &entry,
                    const FileRefusal &refuse)
    {
      std::vector<unsigned int> lines;
      const auto                rows = read_csv_columns(
        filename, entry, {"x", "y", "z", "grey"}, false, &lines);
      if (rows.empty())
        refuse("it has no rows");
      VoxelImage              image;
      std::array<GridLine, 3> grid;
      for (unsigned int d = 0; d < 3; ++d)
        {
          grid[d]          = grid_line(rows, d, refuse);
          image.n[d]       = grid[d].n;
          image.spacing[d] = grid[d].spacing;
          image.corner[d]  = grid[d].first - 0.5 * grid[d].spacing;
        }
      const std::size_t n = n_voxels(image, refuse);
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
      const std::size_t missing =
        std::find_if(image.grey.begin(),
                     image.grey.end(),
                     [](const float grey) { return std::isnan(grey); }) -
        image.grey.begin();
      if (missing < n)
        {
          const std::array<std::size_t, 3> index{
            {missing % image.n[0],
             missing / image.n[0] % image.n[1],
             missing / image.n[0] / image.n[1]}};
          std::string where;
          for (unsigned int d = 0; d < 3; ++d)
            where += (d == 0 ? "" : ", ") + std::string(1, "xyz"[d]) + " = " +
                     to_text(grid[d].first + index[d] * grid[d].spacing, 6);
          refuse("it has " + std::to_string(rows.size()) +
                 " rows: expected one for each of the " + image.grid_text() +
                 " voxels; the first that is missing is at " + where);
        }
      return image;
    }
  } // namespace



  namespace
  {
    /** They have no modulus: what was not measured must be given a value. */
    void
    refuse_no_numbers(const VoxelImage &image, const FileRefusal &refuse)
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
      VoxelImage image;
      if (ends_in(".mhd") || ends_in(".mha"))
        image = read_meta_image(filename, refuse);
      else if (ends_in(".nii") || ends_in(".nii.gz"))
        {
          read_input_bytes(filename, refuse, largest_image_MB); // it is there
          image = read_nifti(filename, refuse);
        }
      else if (ends_in(".csv"))
        image = read_csv_voxels(filename, entry, refuse);
      else
        refuse("expected the name of a .mhd, .mha, .nii, .nii.gz or .csv file");
      for (const double edge : image.spacing)
        if (!(edge > 0. && std::isfinite(edge)))
          refuse("its voxels have an edge of " + to_text(edge) +
                 " mm: expected more than 0");
      refuse_no_numbers(image, refuse);
      return image;
    }
  } // namespace



  std::string
  VoxelImage::grid_text() const
  {
    return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
           std::to_string(n[2]);
  }



  std::shared_ptr<const VoxelImage>
  read_voxel_image(const std::string &filename, const std::string &entry)
  {
    struct Known
    {
      std::weak_ptr<const VoxelImage> image;
      std::filesystem::file_time_type time;
    };
    static std::map<std::string, Known> known;
    static std::mutex                   one_at_a_time;
    const std::lock_guard<std::mutex>   lock(one_at_a_time);
    // that of the latest of its files
    const auto time_of = [&](const VoxelImage &image) {
      std::error_code none;
      auto            time = std::filesystem::last_write_time(filename, none);
      if (!image.data_file.empty())
        time =
          std::max(time,
                   std::filesystem::last_write_time(image.data_file, none));
      return time;
    };
    Known &file  = known[filename];
    auto   image = file.image.lock();
    if (!image || time_of(*image) != file.time)
      {
        image = std::make_shared<VoxelImage>(read_anew(filename, entry));
        file  = {image, time_of(*image)};
      }
    return image;
  }
} // namespace Debond
