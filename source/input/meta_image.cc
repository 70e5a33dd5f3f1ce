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
#include <utility>

namespace Debond
{
  namespace
  {
    /** Names of a header that mean the same as others; ElementOrigin and
     *  ElementDirection place the voxels in files of version 1. */
    const std::map<std::string, std::string> synonyms{
      {"Position", "Offset"},
      {"Origin", "Offset"},
      {"ImagePosition", "Offset"},
      {"ElementOrigin", "Offset"},
      {"Rotation", "TransformMatrix"},
      {"Orientation", "TransformMatrix"},
      {"ElementDirection", "TransformMatrix"},
      {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}};



    /** The numbers of a text; none if it has something else. */
    std::vector<double>
    numbers_in(const std::string &text)
    {
      std::vector<std::string> items;
      boost::split(items, text, boost::is_space(), boost::token_compress_on);
      std::vector<double> numbers;
      for (const std::string &item : items)
        if (const auto number = read_number(item))
          numbers.push_back(*number);
        else
          return {};
      return numbers;
    }



    bool
    say_the_same(const std::string &one, const std::string &other)
    {
      const auto numbers = numbers_in(one), others = numbers_in(other);
      return boost::iequals(one, other, std::locale::classic()) ||
             (!numbers.empty() &&
              std::equal(numbers.begin(),
                         numbers.end(),
                         others.begin(),
                         others.end(),
                         [](const double a, const double b) {
                           return std::abs(a - b) <= 1e-6 * (1. + std::abs(b));
                         }));
    }



    /** The header of a MetaImage. */
    struct MetaHeader
    {
      /** Names as written and values, by the name without synonyms. */
      std::map<std::string, std::pair<std::string, std::string>> lines;
      std::size_t        size = 0; ///< where data may begin
      const FileRefusal &refuse;

      // The line ElementDataFile is the last one.
      MetaHeader(const std::string &bytes, const FileRefusal &refuse)
        : refuse(refuse)
      {
        while (size < bytes.size() && !has("ElementDataFile"))
          {
            const std::size_t end =
              std::min(bytes.find('\n', size), bytes.size());
            const std::string text = bytes.substr(size, end - size);
            const std::size_t at   = text.find_first_of("=:");
            size                   = std::min(end + 1, bytes.size());
            if (at != std::string::npos)
              take(boost::trim_copy(text.substr(0, at)),
                   boost::trim_copy(text.substr(at + 1)));
          }
        if (!has("ElementDataFile"))
          refuse("it is no MetaImage: there is no line ElementDataFile = ...");
      }

      void
      take(const std::string &written, const std::string &value)
      {
        const auto        synonym = synonyms.find(written);
        const std::string name =
          synonym == synonyms.end() ? written : synonym->second;
        const auto [before, is_new] =
          lines.emplace(name, std::make_pair(written, value));
        if (!is_new && name != "Comment" &&
            !say_the_same(before->second.second, value))
          refuse("it says " + line(name) + ", and " + written + " = " + value +
                 ": remove the one that is wrong");
      }

      bool
      has(const std::string &name) const
      {
        return lines.count(name) > 0;
      }

      std::string
      text(const std::string &name, const std::string &otherwise = "") const
      {
        return has(name) ? lines.at(name).second : otherwise;
      }

      /** For messages. */
      std::string
      line(const std::string &name) const
      {
        return (has(name) ? lines.at(name).first : name) + " = " + text(name);
      }

      /** So many numbers. */
      std::vector<double>
      numbers(const std::string &name, const unsigned int count) const
      {
        const std::vector<double> result = numbers_in(text(name));
        if (result.size() != count)
          refuse(
            line(name) + ": expected " +
            (count == 1 ? "a number" : std::to_string(count) + " numbers"));
        return result;
      }

      double
      number(const std::string &name, const double otherwise) const
      {
        return has(name) ? numbers(name, 1)[0] : otherwise;
      }

      bool
      is_true(const std::string &name, const bool otherwise) const
      {
        const std::string value =
          boost::to_upper_copy(text(name, otherwise ? "TRUE" : "FALSE"),
                               std::locale::classic());
        const bool yes = value == "TRUE" || value == "1";
        if (!yes && value != "FALSE" && value != "0")
          refuse(line(name) + ": expected True or False");
        return yes;
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
      const bool has_spacing   = header.has("ElementSpacing"),
                 has_edges     = header.has("ElementSize");
      const std::string   name = has_spacing ? "ElementSpacing" : "ElementSize";
      std::vector<double> taken{1., 1., 1.};
      if (has_spacing || has_edges)
        taken = header.numbers(name, 3);
      else
        voxels.remarks.push_back(
          "it has no ElementSpacing: edges of voxels are taken as 1 mm");
      if (has_spacing && has_edges &&
          !say_the_same(header.text("ElementSize"), header.text(name)))
        voxels.remarks.push_back(header.line("ElementSize") + ", but " +
                                 header.line(name) +
                                 ": the latter places the voxels");
      for (unsigned int d = 0; d < 3; ++d)
        voxels.spacing[d] = unit_of_length(header) * taken[d];
    }



    /** Along which axes the indices run, the direction of the first one coming
     *  first. AnatomicalOrientation has a letter for where each index begins;
     *  some write where it ends. */
    void
    read_axes(const MetaHeader &header, StoredVoxels &voxels)
    {
      constexpr double tolerance = 1e-3;
      if (header.has("TransformMatrix"))
        {
          const auto matrix = header.numbers("TransformMatrix", 9);
          const Eigen::Map<const Eigen::Matrix3d> directions(matrix.data());
          const Eigen::Matrix3d rounded = directions.array().round();
          if ((directions - rounded).cwiseAbs().maxCoeff() > tolerance ||
              rounded.cwiseAbs() * Eigen::Vector3d::Ones() !=
                Eigen::Vector3d::Ones() ||
              rounded.cwiseAbs().transpose() * Eigen::Vector3d::Ones() !=
                Eigen::Vector3d::Ones())
            header.refuse("its axes are oblique or scaled: " +
                          header.line("TransformMatrix") +
                          ", expected three indices along x, y and z, with the "
                          "length 1. Resample an oblique image, or remove what "
                          "turns it to take the axes as they are stored");
          for (int d = 0; d < 3; ++d)
            voxels.along[d] =
              static_cast<int>(rounded.col(d).dot(Eigen::Vector3d(1., 2., 3.)));
        }
      const std::string given =
        boost::to_upper_copy(header.text("AnatomicalOrientation", "?"),
                             std::locale::classic());
      std::string from, to;
      for (const int axis : voxels.along)
        {
          from += (axis > 0 ? "RAI" : "LPS")[std::abs(axis) - 1];
          to += (axis > 0 ? "LPS" : "RAI")[std::abs(axis) - 1];
        }
      if (given.find_first_not_of("?") != std::string::npos && given != from &&
          given != to)
        header.refuse(header.line("AnatomicalOrientation") +
                      ", but by its TransformMatrix, or without one, the axes "
                      "run from " +
                      from + " to " + to + ": remove the one that is wrong");
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
      if (!header.is_true("BinaryData", true))
        header.refuse("its data are text: expected BinaryData = True");
      if (header.is_true("CompressedData", false))
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
      const double given = header.number("HeaderSize", 0.),
                   begin = given == -1. ?
                             std::max<double>(behind, double(size) - n_bytes) :
                           given == 0. ? behind :
                                         given;
      if (!(begin >= behind && begin + n_bytes == size))
        header.refuse(
          "there are " + to_text(std::max(0., size - begin)) +
          " bytes of data" +
          (header.has("HeaderSize") ? " by " + header.line("HeaderSize") : "") +
          ": expected " + std::to_string(n_bytes) +
          ", those of DimSize, behind a header of " + std::to_string(behind));
      return static_cast<std::size_t>(begin);
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
    read_axes(header, voxels);
    if (header.has("Offset"))
      voxels.first =
        unit_of_length(header) *
        Eigen::Map<const Eigen::Vector3d>(header.numbers("Offset", 3).data());
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
           header.is_true("BinaryDataByteOrderMSB", false),
           voxels.grey);
    return voxels;
  }
} // namespace Debond
