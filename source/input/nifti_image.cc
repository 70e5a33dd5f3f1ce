#include <debond/input/voxel_formats.h>
#include <debond/support/number_text.h>

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>

#include <Eigen/Geometry>
#include <nifti2_io.h>

#include <cmath>
#include <cstdint>
#include <map>

namespace Debond
{
  namespace
  {
    /** The first three columns: the steps of the indices; the last one: the
     *  first voxel. */
    using Affine = Eigen::Matrix<double, 3, 4>;



    /** What is used of a header of version 1 or 2, as it stands there: what the
     *  library makes of it has numbers in the place of what is none. */
    struct NiftiHeader
    {
      std::array<std::int64_t, 8> dim;
      int             datatype, bitpix, qform_code, sform_code, xyzt_units;
      double          vox_offset, scl_slope, scl_inter, qfac;
      Eigen::Vector3d pixdim, quatern, qoffset;
      Affine          srow;
      std::string     magic;
      bool            is_big_endian;
      std::size_t     size; ///< [bytes]
    };

    template <typename Header>
    NiftiHeader
    header_from(const std::string &bytes,
                const bool         swap,
                void (*to_own_order)(Header *),
                const FileRefusal &refuse)
    {
      alignas(8) Header h; // packed, but with its fields in their places
      if (bytes.size() < sizeof(h) + 4) // of which 4 tell of extensions
        refuse("it is cut off: it has " + std::to_string(bytes.size()) +
               " bytes, its header " + std::to_string(sizeof(h) + 4));
      std::memcpy(&h, bytes.data(), sizeof(h));
      if (swap)
        to_own_order(&h);
      NiftiHeader own;
      for (unsigned int i = 0; i < 8; ++i)
        own.dim[i] = h.dim[i];
      own.datatype   = h.datatype;
      own.bitpix     = h.bitpix;
      own.qform_code = h.qform_code;
      own.sform_code = h.sform_code;
      own.xyzt_units = h.xyzt_units;
      own.vox_offset = h.vox_offset;
      own.scl_slope  = h.scl_slope;
      own.scl_inter  = h.scl_inter;
      own.qfac       = h.pixdim[0];
      own.pixdim     = {h.pixdim[1], h.pixdim[2], h.pixdim[3]};
      own.quatern    = {h.quatern_b, h.quatern_c, h.quatern_d};
      own.qoffset    = {h.qoffset_x, h.qoffset_y, h.qoffset_z};
      for (unsigned int i = 0; i < 4; ++i)
        own.srow.col(i) << h.srow_x[i], h.srow_y[i], h.srow_z[i];
      own.magic = std::string(h.magic, 3);
      own.is_big_endian =
        swap == (boost::endian::order::native == boost::endian::order::little);
      own.size = sizeof(h);
      return own;
    }



    NiftiHeader
    read_header(const std::string &bytes, const FileRefusal &refuse)
    {
      std::int32_t size = 0;
      std::memcpy(&size, bytes.data(), std::min(sizeof(size), bytes.size()));
      NiftiHeader        header;
      const std::int32_t swapped = boost::endian::endian_reverse(size);
      if (size == sizeof(nifti_1_header) || swapped == sizeof(nifti_1_header))
        header = header_from<nifti_1_header>(bytes,
                                             size != sizeof(nifti_1_header),
                                             nifti_swap_as_nifti1,
                                             refuse);
      else if (size == sizeof(nifti_2_header) ||
               swapped == sizeof(nifti_2_header))
        header = header_from<nifti_2_header>(bytes,
                                             size != sizeof(nifti_2_header),
                                             nifti_swap_as_nifti2,
                                             refuse);
      else
        refuse("it is no NIfTI file: it does not begin with the size of a "
               "header, 348 or 540");
      if (header.magic == "ni1" || header.magic == "ni2")
        refuse("its data are in a file of their own, .img: expected one file "
               "with header and data");
      if (header.magic != "n+1" && header.magic != "n+2")
        refuse("it is no NIfTI file, maybe one of Analyze 7.5, which does not "
               "say where its axes run: convert it");
      return header;
    }



    void
    refuse_no_number(const Eigen::MatrixXd &numbers,
                     const std::string     &name,
                     const FileRefusal     &refuse)
    {
      if (!numbers.allFinite())
        refuse("its header has no finite number in " + name);
    }



    /** By quaternion and pixdim. */
    Affine
    qform(const NiftiHeader &header, const FileRefusal &refuse)
    {
      refuse_no_number(header.quatern, "quatern_b, c, d", refuse);
      refuse_no_number(header.qoffset, "qoffset_x, y, z", refuse);
      const double rest = 1. - header.quatern.squaredNorm();
      if (rest < -1e-5)
        refuse("quatern_b, c, d are no rotation: the sum of their squares is " +
               to_text(1. - rest, 8) + ", expected 1 at most");
      // what is left of 1 by rounding is no rotation by 0.04 degrees
      const Eigen::Quaterniond rotation(rest < 2.5e-7 ? 0. : std::sqrt(rest),
                                        header.quatern[0],
                                        header.quatern[1],
                                        header.quatern[2]);
      Affine result;
      result.leftCols(3) =
        rotation.normalized().toRotationMatrix() * header.pixdim.asDiagonal();
      if (header.qfac < 0.)
        result.col(2) *= -1.;
      result.col(3) = header.qoffset;
      return result;
    }



    std::string
    edges_text(const Eigen::Vector3d &edges)
    {
      return to_text(edges[0], 6) + " x " + to_text(edges[1], 6) + " x " +
             to_text(edges[2], 6);
    }



    /** What the header says twice must agree; all in its own unit. */
    Affine
    place_of_voxels(const NiftiHeader &header,
                    StoredVoxels      &voxels,
                    const FileRefusal &refuse)
    {
      refuse_no_number(header.pixdim, "pixdim", refuse);
      const bool has_sform = header.sform_code > 0,
                 has_qform = header.qform_code > 0;
      if ((has_qform || !has_sform) && !(header.pixdim.minCoeff() > 0.))
        refuse("pixdim says voxels of " + edges_text(header.pixdim) +
               ": expected more than 0");
      Affine by_pixdim                 = Affine::Zero();
      by_pixdim.leftCols(3).diagonal() = header.pixdim;
      const Affine by_qform = has_qform ? qform(header, refuse) : by_pixdim;
      if (!has_sform)
        return by_qform;

      refuse_no_number(header.srow, "srow_x, y, z", refuse);
      const Eigen::Vector3d edges = header.srow.leftCols(3).colwise().norm();
      if (!(edges.minCoeff() > 0.))
        refuse("its sform says voxels of " + edges_text(edges) +
               ": expected more than 0");
      if (has_qform)
        {
          // the farthest voxel
          const Affine          gap = (header.srow - by_qform).cwiseAbs();
          const Eigen::Vector4d n(voxels.n[0], voxels.n[1], voxels.n[2], 1.);
          const double          distance = (gap * n).maxCoeff();
          if (distance > 0.01 * edges.minCoeff())
            refuse("its qform and its sform differ, by " +
                   to_text(distance / edges.minCoeff(), 3) +
                   " voxels at most: set the code of the one that is wrong "
                   "to 0");
          return by_qform;
        }
      for (unsigned int d = 0; d < 3; ++d)
        if (header.pixdim[d] > 0. &&
            std::abs(header.pixdim[d] / edges[d] - 1.) > 1e-4)
          {
            voxels.remarks.push_back(
              "pixdim says voxels of " + edges_text(header.pixdim) +
              ", but its sform " + edges_text(edges) + ": the latter is taken");
            break;
          }
      return header.srow;
    }



    double
    unit_of_length(const NiftiHeader &header,
                   StoredVoxels      &voxels,
                   const FileRefusal &refuse)
    {
      switch (XYZT_TO_SPACE(header.xyzt_units))
        {
          case NIFTI_UNITS_METER:
            return 1e3;
          case NIFTI_UNITS_MICRON:
            return 1e-3;
          case NIFTI_UNITS_UNKNOWN:
            voxels.remarks.push_back("it says no unit of length: taken as mm");
            return 1.;
          case NIFTI_UNITS_MM:
            return 1.;
          default:
            refuse("xyzt_units = " + std::to_string(header.xyzt_units) +
                   " has no unit of length: expected 1, 2 or 3 for m, mm, um");
            return 0.;
        }
    }



    void
    read_grid(const NiftiHeader &header,
              StoredVoxels      &voxels,
              const FileRefusal &refuse)
    {
      const auto &dim = header.dim;
      if (dim[0] < 1 || dim[0] > 7)
        refuse("dim[0] = " + std::to_string(dim[0]) +
               " dimensions: expected 3");
      for (unsigned int d = 4; d <= dim[0]; ++d)
        if (dim[d] != 1)
          refuse("it has more than one image: expected one of three "
                 "dimensions");
      for (unsigned int d = 0; d < 3; ++d)
        {
          if (dim[0] < 3 || dim[d + 1] < 1 || dim[d + 1] > 1000000000)
            refuse("it has " + std::to_string(dim[0]) + " dimensions of " +
                   std::to_string(dim[1]) + ", " + std::to_string(dim[2]) +
                   ", " + std::to_string(dim[3]) +
                   " voxels: expected three, of 1 to 1e9");
          voxels.n[d] = dim[d + 1];
        }
      const double unit  = unit_of_length(header, voxels, refuse);
      Affine       place = place_of_voxels(header, voxels, refuse);
      // If it knows of a body, x is to its right and y to its front.
      if (header.qform_code > 0 || header.sform_code > 0)
        place.topRows(2) *= -1.;
      const Eigen::Vector3d edges = place.leftCols(3).colwise().norm();
      for (unsigned int d = 0; d < 3; ++d)
        voxels.spacing[d] = unit * edges[d];
      voxels.along =
        axes_along(place.leftCols(3) * edges.cwiseInverse().asDiagonal(),
                   header.qform_code > 0 ? "qform" : "sform",
                   refuse);
      voxels.first = unit * place.col(3);
    }



    void
    read_data(const std::string &bytes,
              const NiftiHeader &header,
              StoredVoxels      &voxels,
              const FileRefusal &refuse)
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
      const auto found = types.find(header.datatype);
      if (found == types.end())
        refuse("its voxels are of the type " +
               std::string(nifti_datatype_string(header.datatype)) +
               ": expected one number each, of 8, 16 or 32 bits or FLOAT64");
      const NumberType &type = found->second;
      if (header.bitpix != int(8 * type.size))
        refuse("bitpix = " + std::to_string(header.bitpix) +
               " is not that of its type, " +
               nifti_datatype_string(header.datatype));
      const std::size_t n = voxels.n_voxels(refuse);
      if (!(header.vox_offset >= header.size + 4. &&
            header.vox_offset <= 1e12 &&
            header.vox_offset == std::floor(header.vox_offset)))
        refuse("vox_offset = " + to_text(header.vox_offset) +
               ", where data begin: expected " +
               std::to_string(header.size + 4) + " bytes or more");
      const auto begin = static_cast<std::size_t>(header.vox_offset);
      if (begin > bytes.size() || bytes.size() - begin != n * type.size)
        refuse("there are " +
               std::to_string(bytes.size() - std::min(begin, bytes.size())) +
               " bytes of data behind vox_offset = " + std::to_string(begin) +
               ": expected " + std::to_string(n * type.size) +
               ", those of dim");
      voxels.grey.reserve(n);
      type.append(bytes.data() + begin, n, header.is_big_endian, voxels.grey);

      refuse_no_number(Eigen::Vector2d(header.scl_slope, header.scl_inter),
                       "scl_slope, scl_inter (0 or 1, and 0: as stored)",
                       refuse);
      if (header.scl_slope != 0.)
        for (float &value : voxels.grey)
          value = header.scl_slope * value + header.scl_inter;
      else if (header.scl_inter != 0.)
        voxels.remarks.push_back("scl_inter = " + to_text(header.scl_inter) +
                                 " without scl_slope is not added");
    }



    /** The bytes themselves, or what gzip has made them of. */
    std::string
    unpacked(std::string bytes, const FileRefusal &refuse)
    {
      if (bytes.compare(0, 2, "\x1f\x8b") != 0)
        return bytes;
      std::string result, part(1 << 20, '\0');
      try
        {
          boost::iostreams::filtering_streambuf<boost::iostreams::input> stream;
          stream.push(boost::iostreams::gzip_decompressor());
          stream.push(
            boost::iostreams::array_source(bytes.data(), bytes.size()));
          while (const std::streamsize n = stream.sgetn(&part[0], part.size()))
            {
              result.append(part, 0, n);
              if (result.size() > largest_image_MB * std::size_t(1000000))
                refuse("unpacked, this file has more than " +
                       std::to_string(largest_image_MB) + " MB");
            }
        }
      catch (const std::ios_base::failure &)
        {
          refuse("this file is damaged: it cannot be unpacked");
        }
      return result;
    }
  } // namespace



  // The library reads data, too, but puts 0 in the place of what is no number.
  StoredVoxels
  read_nifti_image(const std::string &filename, const FileRefusal &refuse)
  {
    const std::string bytes =
      unpacked(read_input_bytes(filename, refuse, largest_image_MB), refuse);
    const NiftiHeader header = read_header(bytes, refuse);
    StoredVoxels      voxels;
    read_grid(header, voxels, refuse);
    read_data(bytes, header, voxels, refuse);
    return voxels;
  }
} // namespace Debond
