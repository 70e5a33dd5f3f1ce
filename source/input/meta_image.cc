#include <debond/input/allowed_values.h>
#include <debond/input/voxel_formats.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <locale>
#include <map>
#include <optional>
#include <utility>

namespace Debond
{
  namespace
  {
    /** Names of a header that mean the same. */
    using Names = std::vector<std::string>;



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
        while (size < bytes.size() && !has("ElementDataFile"))
          {
            const std::size_t end =
              std::min(bytes.find('\n', size), bytes.size());
            const std::string line = bytes.substr(size, end - size);
            const std::size_t at   = line.find_first_of("=:");
            size                   = std::min(end + 1, bytes.size());
            if (at == std::string::npos)
              continue;
            const std::string name      = boost::trim_copy(line.substr(0, at)),
                              value     = boost::trim_copy(line.substr(at + 1));
            const auto [before, is_new] = values.emplace(name, value);
            if (!is_new && before->second != value && name != "Comment")
              refuse_both(name, name + " = " + value);
          }
        if (!has("ElementDataFile"))
          refuse("it is no MetaImage: there is no line ElementDataFile = ...");
      }

      bool
      has(const std::string &name) const
      {
        return values.count(name) > 0;
      }

      std::string
      text(const std::string &name, const std::string &otherwise = "") const
      {
        const auto found = values.find(name);
        return found == values.end() ? otherwise : found->second;
      }

      /** For messages. */
      std::string
      line(const std::string &name) const
      {
        return name + " = " + text(name);
      }

      void
      refuse_both(const std::string &name, const std::string &other) const
      {
        refuse("it says " + line(name) + ", and " + other +
               ": remove the one that is wrong");
      }

      /** So many numbers. */
      std::vector<double>
      numbers(const std::string &name, const unsigned int count) const
      {
        std::vector<std::string> items;
        const std::string        value = text(name);
        boost::split(items, value, boost::is_space(), boost::token_compress_on);
        std::vector<double> result;
        for (const std::string &item : items)
          if (const auto number = read_number(item))
            result.push_back(*number);
        if (items.size() != count || result.size() != count)
          refuse(
            line(name) + ": expected " +
            (count == 1 ? "a number" : std::to_string(count) + " numbers"));
        return result;
      }

      /** What the first of the @p names says that is there; others that are
       *  there must say the same. */
      std::optional<std::vector<double>>
      agreed_numbers(const Names &names, const unsigned int count) const
      {
        std::optional<std::vector<double>> result;
        std::string                        first;
        for (const std::string &name : names)
          if (has(name))
            {
              const auto others = numbers(name, count);
              if (!result)
                {
                  result = others;
                  first  = name;
                }
              for (unsigned int i = 0; i < count; ++i)
                if (std::abs((*result)[i] - others[i]) >
                    1e-6 * (1. + std::abs(others[i])))
                  refuse_both(first, line(name));
            }
        return result;
      }

      double
      number(const std::string &name, const double otherwise) const
      {
        return has(name) ? numbers(name, 1)[0] : otherwise;
      }

      /** True or False, with several @p names as for numbers. */
      bool
      is_true(const Names &names, const bool otherwise) const
      {
        std::optional<bool> result;
        std::string         first;
        for (const std::string &name : names)
          if (has(name))
            {
              const std::string value =
                boost::to_upper_copy(text(name), std::locale::classic());
              const bool yes = value == "TRUE" || value == "1";
              if (!yes && value != "FALSE" && value != "0")
                refuse(line(name) + ": expected True or False");
              if (result && *result != yes)
                refuse_both(first, line(name));
              result = yes;
              first  = name;
            }
        return result.value_or(otherwise);
      }
    };



    void
    read_grid(const MetaHeader &header, StoredVoxels &voxels)
    {
      const double n_dimensions = header.number("NDims", 3.);
      if (n_dimensions != 3.)
        header.refuse(header.line("NDims") + ": expected 3");
      const auto size = header.numbers("DimSize", 3);
      for (unsigned int d = 0; d < 3; ++d)
        {
          if (!(size[d] >= 1. && size[d] <= 1e9 &&
                size[d] == std::floor(size[d])))
            header.refuse(header.line("DimSize") +
                          ": expected three whole numbers from 1 to 1e9");
          voxels.n[d] = static_cast<unsigned int>(size[d]);
        }
    }



    /** Millimetres in the header's unit of length. */
    double
    unit_of_length(const MetaHeader &header)
    {
      static const std::map<std::string, double> units{
        {"?", 1.}, {"mm", 1.}, {"um", 1e-3}, {"cm", 10.}, {"m", 1e3}};
      const auto unit = units.find(header.text("DistanceUnits", "mm"));
      if (unit == units.end())
        header.refuse(header.line("DistanceUnits") +
                      ": expected um, mm, cm or m");
      return unit->second;
    }



    /** ElementSize is that of a voxel, ElementSpacing the distance of two,
     *  which differ if slices overlap or have gaps between them. */
    void
    read_spacing(const MetaHeader &header, StoredVoxels &voxels)
    {
      const auto spacing = header.agreed_numbers({"ElementSpacing"}, 3),
                 edges   = header.agreed_numbers({"ElementSize"}, 3);
      if (!spacing && !edges)
        voxels.remarks.push_back(
          "it has no ElementSpacing: edges of voxels are taken as 1 mm");
      else if (spacing && edges)
        for (unsigned int d = 0; d < 3; ++d)
          if (std::abs((*spacing)[d] - (*edges)[d]) > 1e-6 * (*spacing)[d])
            {
              voxels.remarks.push_back(header.line("ElementSize") + ", but " +
                                       header.line("ElementSpacing") +
                                       ": the latter places the voxels");
              break;
            }
      const auto taken = spacing ? spacing : edges;
      for (unsigned int d = 0; d < 3; ++d)
        voxels.spacing[d] = unit_of_length(header) * (taken ? (*taken)[d] : 1.);
    }



    /** StoredVoxels::along of indices that run along the columns of @p
     *  directions, whose length is 1. @p source: what the header calls them. */
    std::array<int, 3>
    axes_along(const Eigen::Matrix3d &directions,
               const std::string     &source,
               const FileRefusal     &refuse)
    {
      constexpr double      tolerance = 1e-3;
      const Eigen::Matrix3d rounded   = directions.array().round();
      if ((directions - rounded).cwiseAbs().maxCoeff() > tolerance ||
          rounded.cwiseAbs() * Eigen::Vector3d::Ones() !=
            Eigen::Vector3d::Ones() ||
          rounded.cwiseAbs().transpose() * Eigen::Vector3d::Ones() !=
            Eigen::Vector3d::Ones())
        {
          std::string text;
          for (unsigned int d = 0; d < 3; ++d)
            {
              text += d == 0 ? "(" : d == 1 ? ", (" : " and (";
              for (unsigned int axis = 0; axis < 3; ++axis)
                text +=
                  to_text(std::round(1e4 * directions(axis, d)) / 1e4 + 0.) +
                  (axis < 2 ? ", " : ")");
            }
          refuse("its axes are oblique or scaled: by its " + source +
                 " the three indices run along " + text +
                 ", expected along x, y and z, with the length 1. Resample an "
                 "oblique image, or remove what turns it to take the axes as "
                 "they are stored");
        }
      std::array<int, 3> along{};
      for (int d = 0; d < 3; ++d)
        for (int axis = 0; axis < 3; ++axis)
          if (rounded(axis, d) != 0.)
            along[d] = rounded(axis, d) > 0. ? axis + 1 : -(axis + 1);
      return along;
    }



    /** AnatomicalOrientation has a letter for where each index begins; some
     *  write where it ends. @p source: what says how they run. */
    void
    check_orientation(const MetaHeader   &header,
                      const StoredVoxels &voxels,
                      const std::string  &source)
    {
      const std::string given =
        boost::to_upper_copy(header.text("AnatomicalOrientation", "?"),
                             std::locale::classic());
      if (given.find_first_not_of("?") == std::string::npos)
        return;
      std::string from, to;
      for (const int axis : voxels.along)
        {
          from += (axis > 0 ? "RAI" : "LPS")[std::abs(axis) - 1];
          to += (axis > 0 ? "LPS" : "RAI")[std::abs(axis) - 1];
        }
      if (given != from && given != to)
        header.refuse(header.line("AnatomicalOrientation") + ", but by its " +
                      source + " the axes run from " + from + " to " + to +
                      ": remove the one that is wrong");
    }



    /** In files of version 1 it is ElementOrigin and ElementDirection that
     * place the voxels. */
    void
    read_place(const MetaHeader &header, StoredVoxels &voxels)
    {
      const Names axes{"TransformMatrix",
                       "Rotation",
                       "Orientation",
                       "ElementDirection"};
      const auto  name =
        std::find_if(axes.begin(), axes.end(), [&](const std::string &each) {
          return header.has(each);
        });
      const std::string source =
        name != axes.end() ? *name : "lack of a TransformMatrix";
      // the direction of the first index comes first
      if (const auto matrix = header.agreed_numbers(axes, 9))
        voxels.along =
          axes_along(Eigen::Map<const Eigen::Matrix3d>(matrix->data()),
                     source,
                     header.refuse);
      check_orientation(header, voxels, source);
      if (const auto first = header.agreed_numbers(
            {"Offset", "Position", "Origin", "ImagePosition", "ElementOrigin"},
            3))
        voxels.first = unit_of_length(header) *
                       Eigen::Map<const Eigen::Vector3d>(first->data());
    }



    /** Size of a number [bytes], and what appends so many of them. */
    using NumberType = std::pair<std::size_t,
                                 void (*)(const char         *bytes,
                                          std::size_t         n,
                                          bool                is_big_endian,
                                          std::vector<float> &grey)>;

    template <typename Number>
    NumberType
    number_type()
    {
      return {sizeof(Number),
              [](const char         *bytes,
                 const std::size_t   n,
                 const bool          is_big_endian,
                 std::vector<float> &grey) {
                using namespace boost::endian;
                constexpr auto size = sizeof(Number);
                const auto    *from =
                  reinterpret_cast<const unsigned char *>(bytes);
                for (std::size_t i = 0; i < n; ++i, from += size)
                  grey.push_back(
                    is_big_endian ?
                      endian_load<Number, size, order::big>(from) :
                      endian_load<Number, size, order::little>(from));
              }};
    }



    NumberType
    read_type(const MetaHeader &header, StoredVoxels &voxels)
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
      if (header.text("ObjectType", "Image") != "Image")
        header.refuse(header.line("ObjectType") + ": expected Image");
      if (!header.is_true({"BinaryData"}, true))
        header.refuse("its data are text: expected BinaryData = True");
      if (header.is_true({"CompressedData"}, false))
        header.refuse("its data are compressed: expected CompressedData = "
                      "False");
      if (header.number("ElementNumberOfChannels", 1.) != 1.)
        header.refuse("its voxels have several numbers each: expected one");
      for (const auto &[name, usual] :
           {std::make_pair("ElementToIntensityFunctionSlope", 1.),
            std::make_pair("ElementToIntensityFunctionOffset", 0.)})
        if (header.number(name, usual) != usual)
          voxels.remarks.push_back(header.line(name) +
                                   ": grey values are taken as they are "
                                   "stored; say it in Young modulus");
      const auto type = types.find(header.text("ElementType"));
      if (type == types.end())
        header.refuse(header.line("ElementType") +
                      ": expected MET_UCHAR, MET_SHORT, MET_USHORT, MET_INT, "
                      "MET_FLOAT or the like");
      return type->second;
    }



    /** Where @p n_bytes of data begin in a file that has @p size bytes behind
     *  what has been read of it. */
    std::size_t
    begin_of_data(const MetaHeader &header,
                  const std::size_t n_bytes,
                  const std::size_t behind,
                  const std::size_t size)
    {
      const double given = header.number("HeaderSize", 0.);
      if (given != -1. &&
          !(given >= 0. && given <= 1e12 && given == std::floor(given)))
        header.refuse(header.line("HeaderSize") +
                      ": expected a number of bytes, or -1 for data at the "
                      "end of the file");
      if (given == -1. && size >= behind + n_bytes)
        return size - n_bytes;
      const std::size_t begin = given > 0. ? given : behind;
      if (begin < behind)
        header.refuse(header.line("HeaderSize") +
                      ": data begin behind the line ElementDataFile, after " +
                      std::to_string(behind) + " bytes");
      if (begin > size || size - begin != n_bytes)
        header.refuse(
          "there are " + std::to_string(size - std::min(begin, size)) +
          " bytes of data" +
          (given > 0. ? " behind " + header.line("HeaderSize") : "") +
          ": expected " + std::to_string(n_bytes) + ", those of DimSize");
      return begin;
    }
  } // namespace



  StoredVoxels
  read_meta_image(const std::string &filename, const FileRefusal &refuse)
  {
    std::string bytes = read_input_bytes(filename, refuse, largest_image_MB);
    const MetaHeader header(bytes, refuse);
    StoredVoxels     voxels;
    read_grid(header, voxels);
    read_spacing(header, voxels);
    read_place(header, voxels);
    const auto [size, append] = read_type(header, voxels);
    const std::string data    = header.text("ElementDataFile");
    std::size_t       behind  = header.size;
    if (!boost::iequals(data, "LOCAL", std::locale::classic()))
      {
        if (boost::starts_with(data + " ", "LIST ") ||
            data.find('%') != std::string::npos)
          refuse(header.line("ElementDataFile") +
                 ": expected the name of one file with all slices, or LOCAL");
        if (bytes.find_first_not_of(" \t\r\n", behind) != std::string::npos)
          refuse("lines behind ElementDataFile are not read: it must be the "
                 "last one");
        voxels.data_file =
          std::filesystem::path(filename).replace_filename(data).string();
        bytes = read_input_bytes(
          voxels.data_file,
          [&](const std::string &why) { refuse(data + ": " + why); },
          largest_image_MB);
        behind = 0;
      }
    const std::size_t n = voxels.n_voxels(refuse);
    voxels.grey.reserve(n);
    append(bytes.data() + begin_of_data(header, n * size, behind, bytes.size()),
           n,
           header.is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"},
                          false),
           voxels.grey);
    return voxels;
  }
} // namespace Debond
