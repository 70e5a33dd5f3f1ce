// Files of voxels whose headers are turned, old, redundant or wrong. One
// specimen, whose grey value is a linear function of the place, is stored in
// many ways: each must give that function again. All other files are refused,
// with a message that says why.

#include <debond/input/voxel_image.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include <Eigen/Geometry>

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
          "BinaryDataByteOrderMSB = False\nElementByteOrderMSB = 0\n",
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



  /** NIfTI-1 or 2, of 16-bit integers until set otherwise. */
  class Nifti
  {
  public:
    Order       order;
    std::string values;

    Nifti(const Order &order   = {},
          const int    version = 1,
          const bool   big     = false)
      : order(order)
      , values(data<std::int16_t>(order, big))
      , version(version)
      , big(big)
      , header(version == 1 ? 352 : 544, '\0')
    {
      set<std::int32_t>(0, 0, version == 1 ? 348 : 540);
      put(344,
          4,
          version == 1 ? std::string("n+1\0", 4) :
                         std::string("n+2\0\r\n\x1a\n", 8));
      dim({{3,
            int(n[order.axis(0)]),
            int(n[order.axis(1)]),
            int(n[order.axis(2)]),
            1,
            1,
            1,
            1}});
      type(4, 16);
      set<std::int16_t>(72, 14, 16);
      pixdim(1., edges());
      if (version == 1)
        real(108, 0, 352);
      else
        set<std::int64_t>(0, 168, 544);
      units(2);
    }

    Nifti &
    dim(const std::array<int, 8> &dim)
    {
      for (unsigned int i = 0; i < 8; ++i)
        if (version == 1)
          set<std::int16_t>(40 + 2 * i, 0, dim[i]);
        else
          set<std::int64_t>(0, 16 + 8 * i, dim[i]);
      return *this;
    }
    Nifti &
    type(const int datatype, const int bits)
    {
      set<std::int16_t>(70, 12, datatype);
      set<std::int16_t>(72, 14, bits);
      return *this;
    }
    Nifti &
    units(const int code)
    {
      if (version == 1)
        set<std::int8_t>(123, 0, code);
      else
        set<std::int32_t>(0, 500, code);
      return *this;
    }
    Nifti &
    pixdim(const double qfac, const Eigen::Vector3d &edges)
    {
      real(76, 104, qfac);
      for (unsigned int d = 0; d < 3; ++d)
        real(80 + 4 * d, 112 + 8 * d, edges[d]);
      return *this;
    }
    /** Of the order, or with other steps of the indices and another place. */
    Nifti &
    sform(const double           unit  = 1.,
          const Eigen::Matrix3d &more  = Eigen::Matrix3d::Identity(),
          const Eigen::Vector3d &shift = {0., 0., 0.})
    {
      code(254, 348);
      const Eigen::Matrix3d steps = more * directions() * edges().asDiagonal();
      const Eigen::Vector3d first = to_nifti(order.place({{0, 0, 0}})) + shift;
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int d = 0; d < 3; ++d)
            real(280 + 16 * i + 4 * d,
                 400 + 32 * i + 8 * d,
                 unit * steps(i, d));
          real(292 + 16 * i, 424 + 32 * i, unit * first[i]);
        }
      return *this;
    }
    Nifti &
    qform()
    {
      code(252, 344);
      Eigen::Matrix3d rotation = directions();
      const double    qfac     = rotation.determinant() > 0. ? 1. : -1.;
      rotation.col(2) *= qfac;
      pixdim(qfac, edges());
      Eigen::Quaterniond q(rotation);
      if (q.w() < 0.)
        q.coeffs() *= -1.;
      const Eigen::Vector3d first = to_nifti(order.place({{0, 0, 0}}));
      for (unsigned int d = 0; d < 3; ++d)
        {
          real(256 + 4 * d, 352 + 8 * d, q.vec()[d]);
          real(268 + 4 * d, 376 + 8 * d, first[d]);
        }
      return *this;
    }
    Nifti &
    real(const std::size_t at_1, const std::size_t at_2, const double value)
    {
      if (version == 1)
        set<float>(at_1, 0, value);
      else
        set<double>(0, at_2, value);
      return *this;
    }
    template <typename Number>
    Nifti &
    set(const std::size_t at_1, const std::size_t at_2, const Number value)
    {
      return put(at_1, at_2, bytes_of(value, big));
    }
    Nifti &
    put(const std::size_t  at_1,
        const std::size_t  at_2,
        const std::string &bytes)
    {
      header.replace(version == 1 ? at_1 : at_2, bytes.size(), bytes);
      return *this;
    }
    template <typename Number>
    Nifti &
    numbers(const int datatype, const Number first)
    {
      type(datatype, 8 * sizeof(Number));
      values = bytes_of(first) + data<Number>(order).substr(sizeof(Number));
      return *this;
    }
    std::string
    bytes() const
    {
      return header + values;
    }

  private:
    /** x to the right, y to the front. */
    static Eigen::Vector3d
    to_nifti(const Eigen::Vector3d &place)
    {
      return {-place[0], -place[1], place[2]};
    }
    Eigen::Matrix3d
    directions() const
    {
      Eigen::Matrix3d directions;
      for (unsigned int d = 0; d < 3; ++d)
        directions.col(d) = to_nifti(order.direction(d));
      return directions;
    }
    Eigen::Vector3d
    edges() const
    {
      return {edge[order.axis(0)], edge[order.axis(1)], edge[order.axis(2)]};
    }
    void
    code(const std::size_t at_1, const std::size_t at_2)
    {
      if (version == 1)
        set<std::int16_t>(at_1, 0, 1);
      else
        set<std::int32_t>(0, at_2, 1);
    }

    const int   version;
    const bool  big;
    std::string header;
  };



  std::string
  packed(const std::string &bytes)
  {
    std::istringstream                  plain(bytes);
    std::ostringstream                  result;
    boost::iostreams::filtering_istream stream;
    stream.push(boost::iostreams::gzip_compressor());
    stream.push(plain);
    boost::iostreams::copy(stream, result);
    return result.str();
  }

  void
  check_nifti_files()
  {
    for (const int version : {1, 2})
      for (const bool big : {false, true})
        {
          double error = 0.;
          for (const Order &order : all_orders())
            {
              const auto make = [&] { return Nifti(order, version, big); };
              for (const auto &file :
                   {make().sform(), make().qform(), make().qform().sform()})
                grow(error, error_of("turned.nii", file.bytes()));
            }
          report("NIfTI-" + std::to_string(version) +
                   (big ? ", the other order of bytes" : "") + ", in 48 orders",
                 error,
                 1e-5);
        }
    const Eigen::Vector3d none(0., 0., 0.), one(1., 1., 1.);
    reads("sform, edges of 1",
          "same.nii",
          Nifti().sform().pixdim(1., one).bytes());
    reads("sform, edges of 0",
          "same.nii",
          Nifti().sform().pixdim(0., none).bytes());
    reads("um",
          "same.nii",
          Nifti().sform(1e3).pixdim(0., none).units(3).bytes());
    reads("m",
          "same.nii",
          Nifti().sform(1e-3).pixdim(0., none).units(1).bytes());
    reads("no unit", "same.nii", Nifti().qform().units(0).bytes());
    reads("a unit of time", "same.nii", Nifti().qform().units(2 + 8).bytes());
    reads("four dimensions",
          "same.nii",
          Nifti().qform().dim({{4, 4, 3, 2, 1, 5, 5, 5}}).bytes());
    reads("a quaternion that has lost its last bit",
          "same.nii",
          Nifti().qform().real(264, 0, 0.99999994).bytes());
    reads("slope 1", "same.nii", Nifti().qform().real(112, 0, 1.).bytes());
    reads("no slope", "same.nii", Nifti().qform().real(116, 0, 3.).bytes());
    Nifti scaled = Nifti().qform().real(112, 0, 0.5).real(116, 0, 50.);
    scaled.values.clear();
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          scaled.values += bytes_of<std::int16_t>(
            2. * (grey_at(Order().place({{i, j, k}})) - 50.));
    reads("slope and intercept", "same.nii", scaled.bytes());
    Nifti extended  = Nifti().qform().real(108, 0, 368.);
    extended.values = std::string(16, '\1') + extended.values;
    reads("an extension", "same.nii", extended.bytes());
    reads("packed", "same.nii.gz", packed(Nifti().qform().bytes()));
    reads("called packed", "plain.nii.gz", Nifti().qform().bytes());
    reads("64 bits",
          "same.nii",
          Nifti().qform().numbers(64, 100. - 12. + 40. - 28.).bytes());

    // It knows of no body: axes as stored, from the centre of the first voxel.
    write("bare.nii", Nifti().bytes());
    const auto bare  = read_voxel_image("bare.nii", "Voxel file");
    double     error = std::abs(bare->grey[1] - bare->grey[0] - 4.);
    for (unsigned int d = 0; d < 3; ++d)
      grow(error, std::abs(bare->corner[d] + 0.5 * edge[d]));
    report("neither qform nor sform", error, 1e-6);
  }



  void
  refuse_nifti_files()
  {
    const auto refused = [](const std::string &what, const Nifti &file) {
      refuses(what, "wrong.nii", file.bytes());
    };
    const double nan = NAN;
    refused("NaN of 32 bits", Nifti().numbers(16, NAN));
    refused("infinity of 64 bits", Nifti().numbers<double>(64, INFINITY));
    refused("1e300 of 64 bits", Nifti().numbers<double>(64, 1e300));
    refused("scl_slope", Nifti().real(112, 0, nan));
    refused("scl_inter", Nifti().real(112, 0, 1.).real(116, 0, INFINITY));
    refused("infinite when scaled", Nifti().real(112, 0, 3e38));
    refused("pixdim", Nifti().sform().real(84, 0, nan));
    refused("pixdim", Nifti().real(80, 0, 0.));
    refused("pixdim", Nifti().qform().real(80, 0, -0.5));
    refused("quatern", Nifti().qform().real(260, 0, nan));
    refused("quatern", Nifti().qform().real(260, 0, 2.));
    refused("qoffset", Nifti().qform().real(268, 0, INFINITY));
    refused("srow", Nifti().sform().real(280, 0, nan));
    Eigen::Matrix3d other = Eigen::Matrix3d::Identity();
    other(2, 2)           = 0.;
    refused("sform, flat", Nifti().sform(1., other));
    other = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
    refused("sform, oblique", Nifti().sform(1., other));
    other       = Eigen::Matrix3d::Identity();
    other(0, 1) = 0.2;
    refused("sform, sheared", Nifti().sform(1., other));
    refused("forms, shifted",
            Nifti().qform().sform(1., other.Identity(), {0., 0.1, 0.}));
    refused("forms, turned",
            Nifti().qform().sform(
              1.,
              Eigen::DiagonalMatrix<double, 3>(-1., -1., 1.).toDenseMatrix()));
    refused("forms, in size", Nifti().qform().sform(2.));
    refused("forms and units", Nifti().qform().sform(1e3).units(3));
    refused("units", Nifti().units(4));
    refused("dim", Nifti().dim({{2, 4, 6, 1, 1, 1, 1, 1}}));
    refused("dim", Nifti().dim({{3, 4, 3, 0, 1, 1, 1, 1}}));
    refused("dim", Nifti().dim({{9, 4, 3, 2, 1, 1, 1, 1}}));
    refused("dim", Nifti().dim({{5, 4, 3, 1, 1, 2, 1, 1}}));
    refused("complex", Nifti().type(32, 64));
    refused("RGB", Nifti().type(128, 24));
    refused("bitpix", Nifti().type(4, 32));
    refused("vox_offset", Nifti().real(108, 0, 0.));
    refused("vox_offset", Nifti().real(108, 0, 352.5));
    refused("vox_offset", Nifti().real(108, 0, 400.));
    refused("vox_offset", Nifti().real(108, 0, nan));
    refused("a pair of files", Nifti().put(344, 0, "ni1"));
    refused("Analyze 7.5", Nifti().put(344, 0, std::string(4, '\0')));
    refused("no header", Nifti().set<std::int32_t>(0, 0, 349));
    refuses("cut off", "wrong.nii", Nifti().bytes().substr(0, 300));
    refuses("empty", "wrong.nii", "");
    refuses("too little", "wrong.nii", Nifti().bytes().substr(0, 380));
    refuses("too much", "wrong.nii", Nifti().bytes() + "  ");
    const std::string gz = packed(Nifti().qform().bytes());
    refuses("packed, cut off", "wrong.nii.gz", gz.substr(0, gz.size() / 2));
    std::string damaged = gz;
    damaged[gz.size() - 8] ^= 1;
    refuses("packed, damaged", "wrong.nii.gz", damaged);

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
    std::cout << bone.modulus_in_words() << std::endl;
  }
} // namespace



int
main()
{
  check_meta_images();
  refuse_meta_images();
  check_nifti_files();
  refuse_nifti_files();
  check_words();
}
