// Files of voxels whose headers are turned, old, redundant or wrong. One
// specimen, whose grey value is a linear function of the place, is stored in
// many ways: each must give that function again. All other files are refused,
// with a message that says why.

#include <debond/input/voxel_image.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>

#include <Eigen/Core>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "checks.h"

using namespace Debond;

namespace
{
  // x to the left, y to the back, z to the head
  constexpr unsigned int n[3]{4, 3, 2};
  constexpr double       edge[3]{0.5, 1., 2.};  // [mm]
  const Eigen::Vector3d  lowest(-1.5, 2., -7.); // centre

  double
  grey_at(const Eigen::Vector3d &place)
  {
    return 100. + 8. * place[0] + 20. * place[1] + 4. * place[2];
  }



  /** An order of storage: along which axes, 1 to 3 and with a sign, the indices
   *  run. */
  struct Order
  {
    std::array<int, 3> along{{1, 2, 3}};

    unsigned int
    axis(const unsigned int index) const
    {
      return std::abs(along[index]) - 1;
    }
    Eigen::Vector3d
    direction(const unsigned int index) const
    {
      return (along[index] > 0 ? 1. : -1.) * Eigen::Vector3d::Unit(axis(index));
    }
    /** The centre of voxel i, j, k of the file. */
    Eigen::Vector3d
    place(const std::array<unsigned int, 3> &index) const
    {
      Eigen::Vector3d place = lowest;
      for (unsigned int d = 0; d < 3; ++d)
        place[axis(d)] +=
          edge[axis(d)] * (along[d] > 0 ? index[d] : n[axis(d)] - 1 - index[d]);
      return place;
    }
  };

  std::vector<Order>
  all_orders()
  {
    std::vector<Order> orders;
    std::array<int, 3> axes{{1, 2, 3}};
    do
      for (unsigned int signs = 0; signs < 8; ++signs)
        {
          Order order{axes};
          for (unsigned int d = 0; d < 3; ++d)
            order.along[d] *= (signs >> d & 1) != 0 ? -1 : 1;
          orders.push_back(order);
        }
    while (std::next_permutation(axes.begin(), axes.end()));
    return orders;
  }



  template <typename Number>
  std::string
  bytes_of(Number value, const bool reversed = false)
  {
    std::string bytes(reinterpret_cast<const char *>(&value), sizeof(value));
    if (reversed)
      std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }

  template <typename Number>
  std::string
  data(const Order &order, const bool reversed = false)
  {
    std::string bytes;
    for (unsigned int k = 0; k < n[order.axis(2)]; ++k)
      for (unsigned int j = 0; j < n[order.axis(1)]; ++j)
        for (unsigned int i = 0; i < n[order.axis(0)]; ++i)
          bytes +=
            bytes_of<Number>(grey_at(order.place({{i, j, k}})), reversed);
    return bytes;
  }



  void
  write(const std::string &name, const std::string &bytes)
  {
    std::ofstream(name, std::ios::binary) << bytes;
  }

  /** The largest difference from the specimen; an infinite one if the grid is
   *  another one. Reports what the file says beside. */
  double
  error_of(const std::string &name, const std::string &bytes)
  {
    write(name, bytes);
    const auto image = read_voxel_image(name, "Voxel file");
    for (const std::string &remark : image->remarks)
      std::cout << "  " << remark << '\n';
    double error = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        if (image->n[d] != n[d])
          return INFINITY;
        grow(error, std::abs(image->spacing[d] - edge[d]));
        grow(error, std::abs(image->corner[d] + 0.5 * edge[d] - lowest[d]));
      }
    auto grey = image->grey.begin();
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          grow(error, std::abs(*grey++ - grey_at(Order().place({{i, j, k}}))));
    return error;
  }

  void
  reads(const std::string &what,
        const std::string &name,
        const std::string &bytes)
  {
    try
      {
        report(what, error_of(name, bytes), 1e-5);
      }
    catch (const InputError &error)
      {
        std::cout << what << ": NO, " << error.what() << std::endl;
      }
  }

  void
  refuses(const std::string &what,
          const std::string &name,
          const std::string &bytes)
  {
    try
      {
        report(what + ": it is read, error", error_of(name, bytes), -1.);
      }
    catch (const EntryError &error)
      {
        std::cout << what << ": " << error.why << std::endl;
      }
  }



  std::string
  text_of(const Eigen::Vector3d &numbers)
  {
    std::ostringstream text;
    text << numbers[0] << ' ' << numbers[1] << ' ' << numbers[2];
    return text.str();
  }

  /** A MetaImage of 16-bit integers; lines named in @p others are those of @p
   *  others. */
  std::string
  meta(const std::string &others, const Order &order = {})
  {
    Eigen::Vector3d size, spacing;
    std::string     matrix;
    for (unsigned int d = 0; d < 3; ++d)
      {
        size[d]    = n[order.axis(d)];
        spacing[d] = edge[order.axis(d)];
        matrix += (d == 0 ? "" : " ") + text_of(order.direction(d));
      }
    std::string header;
    for (const auto &[name, value] :
         std::vector<std::pair<std::string, std::string>>{
           {"NDims", "3"},
           {"Offset", text_of(order.place({{0, 0, 0}}))},
           {"TransformMatrix", matrix},
           {"ElementSpacing", text_of(spacing)},
           {"DimSize", text_of(size)},
           {"ElementType", "MET_SHORT"}})
      if (("\n" + others).find("\n" + name + " =") == std::string::npos)
        header += name + " = " + value + "\n";
    header += others;
    if (others.find("ElementDataFile") == std::string::npos)
      header += "ElementDataFile = LOCAL\n";
    return header;
  }

  std::string
  meta_and_data(const std::string &others, const Order &order = {})
  {
    return meta(others, order) + data<std::int16_t>(order);
  }



  void
  check_meta_images()
  {
    double error = 0.;
    for (const Order &order : all_orders())
      grow(error, error_of("turned.mha", meta_and_data("", order)));
    report("MetaImage in 48 orders", error, 1e-5);
    const std::string values = data<std::int16_t>({});
    write("lead.raw", std::string(16, 'x') + values);
    write("all.raw", values);
    for (const std::string same :
         {"TransformMatrix =  1  0 0\t0 1.0000001 -0  0 0  1\n",
          "AnatomicalOrientation = RAI\nObjectType = Image\n",
          "AnatomicalOrientation = lps\nCompressedData = False\n",
          "AnatomicalOrientation = ???\nBinaryData = 1\n",
          "Rotation = 1 0 0 0 1 0 0 0 1\nElementNumberOfChannels = 1\n",
          "Position = -1.5 2.0 -7\nOrigin = -1.5 2 -7.0\n",
          "ElementSize = 0.50 1 2\nHeaderSize = 0\n",
          "ElementSpacing = 500 1000 2000\nOffset = -1500 2000 -7000\n"
          "DistanceUnits = um\n",
          "BinaryDataByteOrderMSB = False\nElementByteOrderMSB = false\n",
          "HeaderSize = -1\n",
          "HeaderSize = 16\nElementDataFile = lead.raw\n",
          "HeaderSize = -1\nElementDataFile = lead.raw\n",
          "ElementDataFile = all.raw\n",
          "ElementDataFile = Local\n",
          "Comment = one\nComment = two\n",
          "ElementSize = 0.4 1 2\n"})
      {
        const std::string header = meta(same);
        reads(same.substr(0, same.find('\n')),
              "same.mha",
              header +
                (header.find(".raw") == std::string::npos ? values : ""));
      }
    reads("no TransformMatrix",
          "plain.mha",
          "DimSize = 4 3 2\nElementSpacing = 0.5 1 2\nOffset = -1.5 2 -7\n"
          "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
            values);
    reads("colons",
          "colons.mha",
          "DimSize : 4 3 2\nElementSpacing: 0.5 1 2\nOffset: -1.5 2 -7\n"
          "ElementType: MET_SHORT\nElementDataFile: LOCAL\n" +
            values);
    Order back;
    back.along = {{-1, -2, 3}};
    reads("names of version 1",
          "version_1.mha",
          "FileFormatVersion = 1\nDimSize = 4 3 2\nElementSpacing = 0.5 1 2\n"
          "ElementOrigin = 0 4 -7\nElementDirection = -1 0 0 0 -1 0 0 0 1\n"
          "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
            data<std::int16_t>(back));
    reads("two fields of one byte order",
          "big.mha",
          meta("ElementByteOrderMSB = True\nBinaryDataByteOrderMSB = true\n") +
            data<std::int16_t>({}, true));
  }



  void
  refuse_meta_images()
  {
    write("short.raw", data<std::int16_t>({}).substr(2));
    write("lead.raw", std::string(16, 'x') + data<std::int16_t>({}));
    for (const std::string wrong :
         {"BinaryDataByteOrderMSB = False\nElementByteOrderMSB = True\n",
          "Offset = -1.5 2 -7\nPosition = 0 0 0\n",
          "ImagePosition = 0 0 0\n",
          "FileFormatVersion = 1\nElementOrigin = 0 0 0\n",
          "ElementDirection = -1 0 0 0 -1 0 0 0 1\n",
          "Offset = -1.5 2 -7\nOrigin = -1.5 2 -7.01\n",
          "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
          "Orientation = -1 0 0 0 -1 0 0 0 1\n",
          "TransformMatrix = 0.9962 0.0872 0 -0.0872 0.9962 0 0 0 1\n",
          "TransformMatrix = 2 0 0 0 2 0 0 0 2\n",
          "TransformMatrix = 1 0 0 1 0 0 0 0 1\n",
          "TransformMatrix = 1 0 0 1\n",
          "AnatomicalOrientation = LAI\n",
          "ElementSpacing = 0.5 1 2\nElementSpacing = 1 1 1\n",
          "ElementSpacing = 0.5 -1 2\n",
          "ElementSpacing = 0.5 nan 2\n",
          "DistanceUnits = inch\n",
          "NDims = 2\n",
          "NDims = 4\n",
          "DimSize = 4 6\n",
          "ObjectType = Tube\n",
          "BinaryData = False\n",
          "BinaryData = yes\n",
          "CompressedData = True\n",
          "ElementNumberOfChannels = 3\n",
          "ElementType = MET_UCHAR_ARRAY\n",
          "HeaderSize = 8\n",
          "HeaderSize = 1.5\n",
          "HeaderSize = 8\nElementDataFile = lead.raw\n",
          "HeaderSize = 900\nElementDataFile = lead.raw\n",
          "ElementDataFile = lead.raw\n",
          "ElementDataFile = short.raw\n",
          "HeaderSize = -1\nElementDataFile = short.raw\n",
          "ElementDataFile = lead.raw\nElementSpacing = 1 1 1\n",
          "ElementDataFile = LIST\n",
          "ElementDataFile = slice%03d.raw 1 2 1\n"})
      refuses(wrong.substr(0, wrong.find('\n')),
              "wrong.mha",
              wrong.find("ElementDataFile") == std::string::npos ?
                meta_and_data(wrong) :
                meta(wrong));
    refuses("too much", "wrong.mha", meta_and_data("") + "\n");
    refuses("too little", "wrong.mha", meta("") + "xx");
    const std::string ones = data<float>({}).substr(4);
    for (const float value : {NAN, -INFINITY})
      refuses("no number",
              "wrong.mha",
              meta("ElementType = MET_FLOAT\n") + bytes_of(value) + ones);
    refuses("a number beyond those of single precision",
            "wrong.mha",
            meta("ElementType = MET_DOUBLE\n") + bytes_of(-1e300) +
              data<double>({}).substr(8));
  }



  void
  refuse_csv_files()
  {
    std::string csv = "x,y,z,grey\n";
    for (unsigned int i = 0; i < 8; ++i)
      csv += std::to_string(i & 1) + "," + std::to_string(i >> 1 & 1) + "," +
             std::to_string(i >> 2) + "," + (i == 5 ? "GREY\n" : "1\n");
    for (const std::string grey : {"nan", "inf", "1e39"})
      refuses("CSV, " + grey,
              "wrong.csv",
              std::string(csv).replace(csv.find("GREY"), 4, grey));
  }



  // The bone has voxels of 104 to 156, and a mean of 131.2 over 20 samples in
  // each direction.
  void
  check_words()
  {
    Order order;
    order.along = {{-2, 1, -3}};
    write("words.mha", meta_and_data("", order));
    BodyParameters bone;
    bone.size               = {{1, 2, 3}};
    bone.modulus_expression = "40 * grey";
    bone.voxel_file         = "words.mha";
    bone.read_modulus(1.);
    std::cout << bone.modulus->in_words() << std::endl;
  }
} // namespace



int
main()
{
  check_meta_images();
  refuse_meta_images();
  refuse_csv_files();
  check_words();
}
