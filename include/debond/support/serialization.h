#ifndef debond_support_serialization_h
#define debond_support_serialization_h

// What Boost needs to know to put the members of this program's classes into
// an archive. Classes have a member
//   template <class Archive> void serialize(Archive &, unsigned int),
// which holds the accepted state: all that steers later arithmetic, and nothing
// that the scene gives again. Floating point numbers keep every bit.

#include <boost/archive/archive_exception.hpp>
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <Eigen/Core>

namespace boost
{
  namespace serialization
  {
    /** Throws boost::archive::archive_exception if a size that is known at
     *  compile time is another one. */
    template <class Archive, typename T, int R, int C, int O, int MR, int MC>
    void
    serialize(Archive                           &archive,
              Eigen::Matrix<T, R, C, O, MR, MC> &matrix,
              const unsigned int)
    {
      Eigen::Index   rows = matrix.rows(), columns = matrix.cols();
      archive &rows &columns;
      if ((R != Eigen::Dynamic && R != rows) ||
          (C != Eigen::Dynamic && C != columns))
        throw boost::archive::archive_exception(
          boost::archive::archive_exception::input_stream_error);
      matrix.resize(rows, columns); // changes nothing in one that is saved
      auto     values = make_array(matrix.data(), matrix.size());
      archive &values;
    }
  } // namespace serialization
} // namespace boost
#endif
