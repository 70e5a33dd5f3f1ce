#include <debond/geometry/surface_geometry.h>
#include <debond/input/csv_table.h>
#include <debond/input/expression_parser.h>
#include <debond/input/input_file.h>
#include <debond/interface/bonding_source.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/geometry/index/adaptors/query.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <utility>

// Where phi_0, the bonding degree of Eq. (13), comes from if not from a formula
// of the program: expressions, pictures, tables and random numbers. A mistake
// in a file is said with its line, since the picture of a wrong pattern looks
// as plausible as that of the right one.
namespace Debond
{
  namespace
  {
    /** phi_0 as a function of the reference position X [mm]. */
    using PlaceFunction = std::function<double(const Eigen::Vector3d &)>;



    // It is asked in reference coordinates, on the face as the implant was
    // made: the bond belongs to the surface and goes with it. Values out of [0,
    // 1] are refused where they occur, not clipped, since a bond of more than 1
    // would mean that the expression has been misread.
    PlaceFunction
    function_of_expression(const std::string    &expression,
                           const BodyParameters &implant)
    {
      Expression phi_0;
      try
        {
          phi_0 = read_expression("x,y,r,angle",
                                  expression,
                                  implant.characteristic_radius());
        }
      catch (const InputError &error)
        {
          throw EntryError(bonding_section + "Expression", error.what());
        }
      const double R = implant.characteristic_radius();
      return [phi_0, expression, R, face = implant.geometry()](
               const Eigen::Vector3d &X) {
        // x and y unroll a side or a sphere; r and angle are always about the
        // axis
        const Eigen::Vector2d place = face.on_face(X);
        const double          angle = std::atan2(X[1], X[0]) * 180. / M_PI;
        const double          r     = X.head<2>().norm();
        // on a pin r = R, whatever rounding says
        const double value = phi_0(
          {place[0], place[1], std::abs(r - R) < 1e-9 * R ? R : r, angle});
        // rounding may exceed the bounds by its own size
        if (!(value >= -1e-12 && value <= 1. + 1e-12))
          throw EntryError(bonding_section + "Expression",
                           "phi_0 " +
                             (std::isfinite(value) ? "= " + to_text(value, 6) :
                                                     "has no finite value") +
                             " at x = " + to_text(place[0], 6) + " mm, y = " +
                             to_text(place[1], 6) + " mm: expected 0 to 1" +
                             (std::isfinite(value) ? "" : remark_on_no_value),
                           expression);
        return std::clamp(value, 0., 1.);
      };
    }



    /** By element the area means of @p function, by at least its own and some
     *  @p n_across quadrature points across the face; else its values. */
    std::vector<double>
    values_of(const PlaceFunction         &function,
              const bool                   by_element,
              const NurbsSurface          &surface,
              const dealii::Quadrature<1> &along,
              const unsigned int           n_across)
    {
      // As many pieces of the rule of the run, each with so many points across,
      // as make n_across of them across the face, rounded up: an element takes
      // the mean over its area, and a pattern that is finer than the elements
      // is not met by chance at a few points.
      const unsigned int across = along.size() * surface.n_elements_across();
      const dealii::QIterated<2> quadrature(
        along, by_element ? (n_across + across - 1) / across : 1);
      std::vector<double> values;
      for (unsigned int element = 0; element < surface.n_elements(); ++element)
        {
          double sum = 0., area = 0.;
          for (const auto &point :
               element_quadrature(surface, element, quadrature))
            {
              const double value = function(point.X);
              if (!by_element)
                values.push_back(value);
              sum += point.JxW * value;
              area += point.JxW;
            }
          if (by_element)
            values.push_back(sum / area);
        }
      return values;
    }



    /** The picture over the square, or rectangle, around the face. */
    //
    // Elements take the mean over their area, of the picture in so many pixels
    // that more of them would change nothing: a threshold comes before that, as
    // a mean of grey levels is none of black and white.
    std::vector<double>
    values_of_image(const BondingParameters     &parameters,
                    const BodyParameters        &implant,
                    const bool                   by_element,
                    const NurbsSurface          &surface,
                    const dealii::Quadrature<1> &along,
                    std::string                 &remark)
    {
      // The picture spans the box around the face; pixels need not be square on
      // it, which is remarked upon beyond 2 %.
      GreyImage            image = read_grey_image(parameters.file,
                                        bonding_section + "File",
                                        parameters.white_level);
      const BodyGeometry   face  = implant.geometry();
      const auto           box   = face.box_of_face();
      const Eigen::Array2d size  = box[1] - box[0];
      const double ratio = image.width / size[0] / (image.height / size[1]);
      if (std::max(ratio, 1. / ratio) > 1.02)
        remark = "the picture of " + std::to_string(image.width) + " x " +
                 std::to_string(image.height) +
                 " pixels is stretched over the " + to_text(size[0], 4) +
                 " x " + to_text(size[1], 4) + " mm of the contact face";
      if (parameters.threshold >= 0.)
        image = image.threshold_at(parameters.threshold);
      if (by_element)
        image = image.reduced_to(256);
      return values_of(
        [&](const Eigen::Vector3d &X) {
          const Eigen::Array2d uv = (face.on_face(X) - box[0]).array() / size;
          return image.at(uv[0], uv[1]);
        },
        by_element,
        surface,
        along,
        std::max(200U, 2 * std::max(image.width, image.height)));
    }



    /** The CSV file of the pattern `file`. */
    struct PatternFile
    {
      const std::string               &name;
      std::vector<std::vector<double>> rows;
      std::vector<unsigned int>        lines; ///< where the rows are

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw EntryError(bonding_section + "File", why, name);
      }

      void
      expect(const bool         is_right,
             const unsigned int row,
             const std::string &otherwise) const
      {
        if (!is_right)
          refuse("line " + std::to_string(lines[row]) + ": " + otherwise);
      }

      void
      read(const std::vector<std::string> &columns)
      {
        rows = read_csv_columns(
          name, bonding_section + "File", columns, false, &lines);
        const auto phi_0 =
          std::find(columns.begin(), columns.end(), "phi_0") - columns.begin();
        for (unsigned int i = 0; i < rows.size(); ++i)
          expect(rows[i][phi_0] >= 0. && rows[i][phi_0] <= 1.,
                 i,
                 "phi_0 = " + to_text(rows[i][phi_0]) + ": expected 0 to 1");
      }
    };



    /** Rows of a number, if numbered, phi_0, and maybe x and y: one for each
     *  @p part, an element or a point, in order or with its number in front.
     *  Where they say where these are, those of another mesh are refused. */
    std::vector<double>
    values_by_number(const PatternFile                  &file,
                     const std::string                  &part,
                     const bool                          numbered,
                     const std::vector<Eigen::Vector2d> &centres,
                     const double                        size)
    {
      const unsigned int n_parts = centres.size();
      if (file.rows.size() != n_parts)
        file.refuse("it has " + std::to_string(file.rows.size()) +
                    " rows, but the contact face has " +
                    std::to_string(n_parts) + " " + part +
                    "s: expected a row for each");
      std::vector<double> values(n_parts, -1.);
      for (unsigned int i = 0; i < n_parts; ++i)
        {
          const auto  &row    = file.rows[i];
          const double number = numbered ? row[0] : i + 1.;
          file.expect(number >= 1. && number <= n_parts &&
                        number == std::floor(number),
                      i,
                      "there is no " + part + " " + to_text(number) +
                        ": they are numbered from 1 to " +
                        std::to_string(n_parts));
          const auto index = static_cast<unsigned int>(number) - 1;
          // -1 is where no row has been yet, so that each part is met once
          file.expect(values[index] < 0.,
                      i,
                      part + " " + to_text(number) + " is there twice");
          values[index] = row[numbered];
          if (row.size() < 4)
            continue;
          const Eigen::Vector2d &centre = centres[index];
          if (std::hypot(row[2] - centre[0], row[3] - centre[1]) > 1e-3 * size)
            file.refuse("it belongs to another mesh: " + part + " " +
                        to_text(number) + " is at x = " + to_text(row[2], 6) +
                        " mm, y = " + to_text(row[3], 6) + " mm there and at " +
                        to_text(centre[0], 6) + ", " + to_text(centre[1], 6) +
                        " here");
        }
      return values;
    }



    /** Rows of x, y and phi_0: the mean over the points inside an element;
     *  where there are none, or none is wanted, that of the nearest point. */
    std::vector<double>
    values_of_points(const PatternFile                  &file,
                     const bool                          by_element,
                     const NurbsSurface                 &surface,
                     const std::vector<Eigen::Vector2d> &centres,
                     const double                        size)
    {
      // Points outside of the face belong to the frame of a picture or scan and
      // are passed over; that none is on the face is a mistake of units or
      // origin.
      //
      // the contact face seen from above: of a cap what its border encloses
      ControlNet from_above = surface.control_points();
      from_above.row(2).setZero();
      std::vector<double>       values(centres.size(), 0.);
      std::vector<unsigned int> counts(centres.size(), 0);
      std::vector<std::pair<dealii::Point<2>, double>> on_face;
      for (const auto &row : file.rows)
        {
          const ClosestPoint closest =
            closest_point(surface, from_above, {row[0], row[1], 0.});
          if (closest.distance > 1e-9 * size)
            continue;
          on_face.emplace_back(dealii::Point<2>(row[0], row[1]), row[2]);
          if (by_element)
            {
              const unsigned int element = surface.element_of(closest.xi);
              values[element] += row[2];
              ++counts[element];
            }
        }
      if (on_face.empty())
        file.refuse("none of its " + std::to_string(file.rows.size()) +
                    " points lies on the contact face (x and y in mm, 0 at "
                    "its centre)");
      // An R-tree, as a table of a scan may have very many rows.
      namespace bgi   = boost::geometry::index;
      const auto tree = dealii::pack_rtree(on_face);
      for (unsigned int i = 0; i < values.size(); ++i)
        if (counts[i] > 0)
          values[i] /= counts[i];
        else
          for (const auto &nearest :
               tree | bgi::adaptors::queried(bgi::nearest(
                        dealii::Point<2>(centres[i][0], centres[i][1]), 1)))
            values[i] = nearest.second;
      return values;
    }



    // The names of the columns say which kind of table it is, as its user may
    // have written it, or as bonding.csv of another run has it. Tables by
    // number are tried first: they are exact, where places have to be looked
    // up.
    std::vector<double>
    values_of_file(const std::string                  &filename,
                   const BodyParameters               &implant,
                   const bool                          by_element,
                   const NurbsSurface                 &surface,
                   const std::vector<Eigen::Vector2d> &centres)
    {
      // columns element or point, phi_0, and maybe x_mm, y_mm: by number; x, y,
      // phi_0: by place
      PatternFile file{filename, {}, {}};
      double      size = 0.; // of the face
      for (const Eigen::Vector2d &centre : centres)
        size = std::max(size, centre.norm());
      const auto columns = read_csv_header(filename, bonding_section + "File");
      const auto has     = [&columns](const std::string &name) {
        return std::count(columns.begin(), columns.end(), name) > 0;
      };
      const std::string part     = by_element ? "element" : "point";
      const bool        numbered = has(part);
      const bool        has_mm   = has("x_mm") && has("y_mm");
      if (has("phi_0") && (numbered || columns.size() == 1))
        {
          std::vector<std::string> names{"phi_0"};
          if (numbered)
            names.insert(names.begin(), part);
          if (numbered && has_mm)
            names.insert(names.end(), {"x_mm", "y_mm"});
          file.read(names);
          return values_by_number(file, part, numbered, centres, size);
        }
      const bool in_bore = implant.geometry().is_in_bore();
      if (has("phi_0") && (has("element") || in_bore))
        file.refuse(
          "Expert / Interface / Bonding / Resolution asks for a value for each " +
          part + ": expected columns " + part + ",phi_0" +
          (in_bore ? " (a side is not seen from above, as x,y are)" :
                     " or x,y,phi_0"));
      if (columns.empty())
        file.refuse("this file is empty");
      if (!has("phi_0") || !(has_mm || (has("x") && has("y"))))
        file.refuse("the first line must name the columns, separated by "
                    "commas: element,phi_0 or phi_0 alone or x,y,phi_0 "
                    "(x_mm,y_mm); it is '" +
                    boost::join(columns, ",").substr(0, 60) + "'");
      file.read({has_mm ? "x_mm" : "x", has_mm ? "y_mm" : "y", "phi_0"});
      return values_of_points(file, by_element, surface, centres, size);
    }



    /** Random numbers that are the same everywhere: the C++ standard fixes the
     *  generator, but not its distributions. */
    class PortableRandom
    {
    public:
      explicit PortableRandom(const std::uint64_t seed)
        : generator(seed)
      {}

      /** Evenly distributed in (0, 1). */
      double
      uniform()
      {
        // the upper 53 bits, in the middle between two of their steps
        return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53;
      }

      /** A whole number in [0, @p n), all equally likely. */
      std::uint64_t
      index(const std::uint64_t n)
      {
        // numbers above the last whole multiple of n would favour small ones
        const std::uint64_t limit = generator.max() - generator.max() % n;
        std::uint64_t       draw;
        do
          draw = generator();
        while (draw >= limit);
        return draw % n;
      }

    private:
      std::mt19937_64 generator;
    };
  } // namespace



  // 200 points across the face are more than elements of usual meshes need, at
  // a cost that is not seen beside a step.
  std::vector<double>
  bonding_from_source(const BondingParameters            &parameters,
                      const BodyParameters               &implant,
                      const NurbsSurface                 &surface,
                      const dealii::Quadrature<1>        &along,
                      const std::vector<Eigen::Vector2d> &centres,
                      std::string                        &remark)
  {
    const bool by_element = parameters.resolution == BondingResolution::element;
    // a study may come to it hours after its scenes were read
    if (!parameters.identity.empty() &&
        parameters.identity != identity_of(parameters.file))
      throw EntryError(bonding_section + "File",
                       "the content of this file has changed since the scene "
                       "was read: start again",
                       parameters.file);
    // tables say a value for each part; pictures and expressions are functions
    // of the place, of which elements take the mean
    if (parameters.pattern == BondingPatternKind::file)
      return values_of_file(
        parameters.file, implant, by_element, surface, centres);
    if (parameters.pattern == BondingPatternKind::image)
      return values_of_image(
        parameters, implant, by_element, surface, along, remark);
    return values_of(function_of_expression(parameters.expression, implant),
                     by_element,
                     surface,
                     along,
                     200);
  }



  // Fisher and Yates (1938), from the end: every order is equally likely.
  std::vector<unsigned int>
  random_order(const unsigned int n, const std::uint64_t seed)
  {
    // A permutation of its own rather than std::shuffle, which is another one
    // with each library.
    std::vector<unsigned int> order(n);
    std::iota(order.begin(), order.end(), 0);
    PortableRandom random(seed);
    for (unsigned int i = n; i > 1; --i)
      std::swap(order[i - 1], order[random.index(i)]);
    return order;
  }



  // A sum of cosines with random directions and phases is a homogeneous field
  // whose correlation is the mean cosine. By the theorem of central limits its
  // values are normally distributed the better the more waves there are. It
  // needs no mesh, so that a finer one sees the same field.
  RandomField::RandomField(const std::uint64_t seed,
                           const double        correlation_length)
    : waves(1000)
  {
    // faces at z = 0 do not know of the second
    PortableRandom random(seed), upwards(~seed);
    for (Wave &wave : waves)
      {
        // normally distributed components of variance 2/l^2: the mean of
        // cos(k . d) over them is exp(-(d/l)^2)
        const double length =
          2. / correlation_length * std::sqrt(-std::log(random.uniform()));
        const double direction = 2. * M_PI * random.uniform();
        wave.k                 = {length * std::cos(direction),
                                  length * std::sin(direction),
                                  2. / correlation_length *
                                    std::sqrt(-std::log(upwards.uniform())) *
                                    std::cos(2. * M_PI * upwards.uniform())};
        wave.phase             = 2. * M_PI * random.uniform();
      }
  }



  // Each cosine has the variance 1/2: the factor makes that of the sum 1.
  double
  RandomField::operator()(const Eigen::Vector3d &place) const
  {
    double sum = 0.;
    for (const Wave &wave : waves)
      sum += std::cos(wave.k.dot(place) + wave.phase);
    return sum * std::sqrt(2. / waves.size());
  }
} // namespace Debond
