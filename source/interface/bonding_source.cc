#include <debond/bulk/body_parameters.h>
#include <debond/geometry/closest_point.h>
#include <debond/geometry/surface_quadrature.h>
#include <debond/input/csv_table.h>
#include <debond/input/expression_parser.h>
#include <debond/interface/bonding_source.h>
#include <debond/interface/grey_image.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/rtree.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/geometry/index/adaptors/query.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace Debond
{
  namespace
  {
    /** phi_0 as a function of the place (x, y) on the contact face [mm]. */
    using PlaceFunction = std::function<double(const Eigen::Vector2d &)>;



    PlaceFunction
    function_of_expression(const std::string &expression, const double radius)
    {
      Expression phi_0;
      try
        {
          phi_0 = read_expression("x,y,r,angle", expression, radius);
        }
      catch (const InputError &error)
        {
          throw EntryError(bonding_section + "Expression", error.what());
        }
      return [phi_0, expression](const Eigen::Vector2d &place) {
        const double angle = std::atan2(place[1], place[0]) * 180. / M_PI;
        const double value = phi_0({place[0], place[1], place.norm(), angle});
        // rounding may exceed the bounds by its own size
        if (!(value >= -1e-12 && value <= 1. + 1e-12))
          throw EntryError(bonding_section + "Expression",
                           "phi_0 " +
                             (std::isfinite(value) ? "= " + to_text(value, 6) :
                                                     "has no finite value") +
                             " at x = " + to_text(place[0], 6) + " mm, y = " +
                             to_text(place[1], 6) + " mm: expected 0 to 1",
                           expression);
        return std::clamp(value, 0., 1.);
      };
    }



    /** The picture over the square, or rectangle, around the face. */
    PlaceFunction
    function_of_image(GreyImage image, const BodyParameters &implant)
    {
      const Eigen::Array2d size(implant.width(0), implant.width(1));
      const auto shared = std::make_shared<const GreyImage>(std::move(image));
      return [shared, size](const Eigen::Vector2d &place) {
        const Eigen::Array2d uv = place.array() / size + 0.5;
        return shared->at(uv[0], uv[1]);
      };
    }



    /** The area mean of @p function over every element, by at least @p n x @p n
     *  and some @p n_across quadrature points across the face. */
    std::vector<double>
    element_means(const PlaceFunction &function,
                  const NurbsSurface  &surface,
                  const unsigned int   n,
                  const unsigned int   n_across)
    {
      const auto         n_elements = surface.n_elements_per_direction();
      const unsigned int across =
        n * std::min(n_elements[0], n_elements[1]); // points of one copy
      const dealii::QIterated<2> quadrature(dealii::QGauss<1>(n),
                                            (n_across + across - 1) / across);
      std::vector<double>        means;
      for (unsigned int element = 0; element < surface.n_elements(); ++element)
        {
          double sum = 0., area = 0.;
          for (const auto &point :
               element_quadrature(surface, element, quadrature))
            {
              sum += point.JxW * function(point.X.head<2>());
              area += point.JxW;
            }
          means.push_back(sum / area);
        }
      return means;
    }



    std::vector<double>
    point_values(const PlaceFunction &function,
                 const NurbsSurface  &surface,
                 const unsigned int   n)
    {
      std::vector<double> values;
      for (const auto &point : surface_quadrature(surface, n))
        values.push_back(function(point.X.head<2>()));
      return values;
    }



    std::vector<double>
    values_of_image(const BondingParameters &parameters,
                    const BodyParameters    &implant,
                    const NurbsSurface      &surface,
                    const unsigned int       n,
                    std::string             &remark)
    {
      GreyImage image =
        read_grey_image(parameters.file, bonding_section + "File");
      const Eigen::Array2d size(implant.width(0), implant.width(1));
      const double ratio = image.width / size[0] / (image.height / size[1]);
      if (std::max(ratio, 1. / ratio) > 1.02)
        remark = "the picture of " + std::to_string(image.width) + " x " +
                 std::to_string(image.height) +
                 " pixels is stretched over the " + to_text(size[0], 4) +
                 " x " + to_text(size[1], 4) + " mm of the contact face";
      if (parameters.threshold >= 0.)
        image = image.threshold_at(parameters.threshold);
      if (parameters.resolution == BondingResolution::quadrature_point)
        return point_values(function_of_image(std::move(image), implant),
                            surface,
                            n);
      image                       = image.reduced_to(256);
      const unsigned int n_across = 2 * std::max(image.width, image.height);
      return element_means(function_of_image(std::move(image), implant),
                           surface,
                           n,
                           std::max(200U, n_across));
    }
  } // namespace



  std::vector<double>
  values_by_place(const BondingParameters &parameters,
                  const BodyParameters    &implant,
                  const NurbsSurface      &surface,
                  const unsigned int       n,
                  std::string             &remark)
  {
    if (parameters.pattern == BondingPatternKind::image)
      return values_of_image(parameters, implant, surface, n, remark);
    const PlaceFunction function =
      function_of_expression(parameters.expression,
                             implant.characteristic_radius());
    return parameters.resolution == BondingResolution::element ?
             element_means(function, surface, n, 200) :
             point_values(function, surface, n);
  }



  namespace
  {
    /** Points of a CSV file with their phi_0. */
    struct DataPoint
    {
      Eigen::Vector2d place; ///< [mm]
      double          phi_0;
      unsigned int    element = 0; ///< that it lies in
    };



    [[noreturn]] void
    refuse_file(const std::string &filename, const std::string &why)
    {
      throw EntryError(bonding_section + "File", why, filename);
    }



    [[noreturn]] void
    refuse_line(const std::string &filename,
                const unsigned int line,
                const std::string &why)
    {
      refuse_file(filename, "line " + std::to_string(line) + ": " + why);
    }



    void
    check_phi_0(const std::string &filename,
                const double       phi_0,
                const unsigned int line)
    {
      if (!(phi_0 >= 0. && phi_0 <= 1.))
        refuse_line(filename,
                    line,
                    "phi_0 = " + to_text(phi_0) + ": expected 0 to 1");
    }



    /** A table with a row for each element: in order, or with the number of the
     *  element in front. */
    std::vector<double>
    values_by_element(const std::string &filename,
                      const bool         numbered,
                      const unsigned int n_elements)
    {
      std::vector<unsigned int> lines;
      const auto                rows =
        read_csv_columns(filename,
                         bonding_section + "File",
                         numbered ?
                           std::vector<std::string>{"element", "phi_0"} :
                           std::vector<std::string>{"phi_0"},
                         false,
                         &lines);
      if (rows.size() != n_elements)
        refuse_file(filename,
                    "it has " + std::to_string(rows.size()) +
                      " rows, but the contact face has " +
                      std::to_string(n_elements) +
                      " elements: expected a row for each");
      std::vector<double> values(n_elements, -1.);
      for (unsigned int i = 0; i < n_elements; ++i)
        {
          check_phi_0(filename, rows[i].back(), lines[i]);
          const double number = numbered ? rows[i][0] : i + 1.;
          if (!(number >= 1. && number <= n_elements) ||
              number != std::floor(number))
            refuse_line(filename,
                        lines[i],
                        "there is no element " + to_text(number) +
                          ": they are numbered from 1 to " +
                          std::to_string(n_elements));
          double &value = values[static_cast<unsigned int>(number) - 1];
          if (value >= 0.)
            refuse_line(filename,
                        lines[i],
                        "element " + to_text(number) + " is there twice");
          value = rows[i].back();
        }
      return values;
    }



    double
    size_of(const std::vector<Eigen::Vector2d> &centres)
    {
      double size = 0.;
      for (const Eigen::Vector2d &centre : centres)
        size = std::max(size, centre.norm());
      return size;
    }



    /** Refuses a table of elements of another mesh, where it says where they
     *  are. Rows: element, x, y. */
    void
    check_centres(const std::string                      &filename,
                  const std::vector<std::vector<double>> &rows,
                  const std::vector<Eigen::Vector2d>     &centres)
    {
      for (const auto &row : rows)
        {
          const Eigen::Vector2d &centre =
            centres[static_cast<unsigned int>(row[0]) - 1];
          if ((Eigen::Vector2d(row[1], row[2]) - centre).norm() >
              1e-3 * size_of(centres))
            refuse_file(filename,
                        "it belongs to another mesh: element " +
                          to_text(row[0]) + " is at x = " + to_text(row[1], 6) +
                          " mm, y = " + to_text(row[2], 6) +
                          " mm there and at " + to_text(centre[0], 6) + ", " +
                          to_text(centre[1], 6) + " here");
        }
    }



    /** The contact face seen from above: of a cap what its border encloses. */
    ControlNet
    seen_from_above(const NurbsSurface &surface)
    {
      ControlNet net = surface.control_points();
      net.row(2).setZero();
      return net;
    }



    /** Of the points those on the face, with the numbers of their elements;
     *  refuses a file without any. */
    std::vector<DataPoint>
    points_on_face(const std::string            &filename,
                   const std::vector<DataPoint> &points,
                   const NurbsSurface           &surface,
                   const double                  size)
    {
      const ControlNet       net = seen_from_above(surface);
      std::vector<DataPoint> result;
      for (DataPoint point : points)
        {
          const ClosestPoint closest =
            closest_point(surface, net, {point.place[0], point.place[1], 0.});
          if (closest.distance > 1e-9 * size)
            continue;
          point.element = surface.element_of(closest.xi);
          result.push_back(point);
        }
      if (result.empty())
        refuse_file(filename,
                    "none of its " + std::to_string(points.size()) +
                      " points lies on the contact face (x and y in mm, 0 at "
                      "its centre)");
      return result;
    }



    /** The mean over the points inside every element, where there are any; -1
     *  elsewhere. */
    std::vector<double>
    means_of_points(const std::vector<DataPoint> &points,
                    const unsigned int            n_elements)
    {
      std::vector<double>       sums(n_elements, 0.);
      std::vector<unsigned int> counts(n_elements, 0);
      for (const DataPoint &point : points)
        {
          sums[point.element] += point.phi_0;
          ++counts[point.element];
        }
      for (unsigned int e = 0; e < n_elements; ++e)
        sums[e] = counts[e] > 0 ? sums[e] / counts[e] : -1.;
      return sums;
    }



    /** Where there is no mean of points inside, or none is wanted, the value of
     *  the nearest point. */
    std::vector<double>
    values_of_points(const std::vector<DataPoint>       &points,
                     const bool                          by_element,
                     const NurbsSurface                 &surface,
                     const std::vector<Eigen::Vector2d> &centres)
    {
      std::vector<double> values(centres.size(), -1.);
      if (by_element)
        values = means_of_points(points, surface.n_elements());
      std::vector<std::pair<dealii::Point<2>, double>> entries;
      for (const DataPoint &point : points)
        entries.emplace_back(dealii::Point<2>(point.place[0], point.place[1]),
                             point.phi_0);
      const auto tree = dealii::pack_rtree(entries);
      for (unsigned int i = 0; i < values.size(); ++i)
        if (values[i] < 0.)
          {
            const dealii::Point<2> centre(centres[i][0], centres[i][1]);
            for (const auto &[place, phi_0] :
                 tree | boost::geometry::index::adaptors::queried(
                          boost::geometry::index::nearest(centre, 1)))
              values[i] = phi_0;
          }
      return values;
    }
  } // namespace



  namespace
  {
    [[noreturn]] void
    refuse_columns(const std::string              &filename,
                   const std::vector<std::string> &columns)
    {
      if (columns.empty())
        refuse_file(filename, "this file is empty");
      refuse_file(filename,
                  "the first line must name the columns, separated by commas: "
                  "element,phi_0 or phi_0 alone or x,y,phi_0 (x_mm,y_mm); it "
                  "is '" +
                    boost::join(columns, ",").substr(0, 60) + "'");
    }



    std::vector<DataPoint>
    read_points(const std::string &filename,
                const std::string &x,
                const std::string &y)
    {
      std::vector<DataPoint>    points;
      std::vector<unsigned int> lines;
      for (const auto &row : read_csv_columns(filename,
                                              bonding_section + "File",
                                              {x, y, "phi_0"},
                                              false,
                                              &lines))
        {
          check_phi_0(filename, row[2], lines[points.size()]);
          points.push_back({{row[0], row[1]}, row[2], 0});
        }
      return points;
    }
  } // namespace



  std::vector<double>
  values_from_file(const BondingParameters            &parameters,
                   const NurbsSurface                 &surface,
                   const std::vector<Eigen::Vector2d> &centres)
  {
    const std::string &filename = parameters.file;
    const std::string  entry    = bonding_section + "File";
    const auto         columns  = read_csv_header(filename, entry);
    const auto         has      = [&columns](const std::string &name) {
      return std::count(columns.begin(), columns.end(), name) > 0;
    };
    const bool by_element = parameters.resolution == BondingResolution::element;
    const bool numbered   = has("element");
    const bool has_mm     = has("x_mm") && has("y_mm");
    if (has("phi_0") && (numbered || columns.size() == 1))
      {
        if (!by_element)
          refuse_file(filename,
                      "a value for every element needs Resolution = element; "
                      "with Resolution = quadrature point columns x,y,phi_0 "
                      "are expected");
        const auto values =
          values_by_element(filename, numbered, surface.n_elements());
        if (numbered && has_mm)
          check_centres(filename,
                        read_csv_columns(filename,
                                         entry,
                                         {"element", "x_mm", "y_mm"}),
                        centres);
        return values;
      }
    if (!has("phi_0") || !(has_mm || (has("x") && has("y"))))
      refuse_columns(filename, columns);
    const auto points =
      read_points(filename, has_mm ? "x_mm" : "x", has_mm ? "y_mm" : "y");
    return values_of_points(
      points_on_face(filename, points, surface, size_of(centres)),
      by_element,
      surface,
      centres);
  }
} // namespace Debond
