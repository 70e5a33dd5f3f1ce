#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/output/field_output.h>
#include <debond/output/result_files.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/system/coupled_system.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** The quadrature points of a surface as one tensor grid over the patch, or
     *  one in each of several patches. */
    class QuadratureGrid
    {
    public:
      QuadratureGrid(const ContactInterface &interface,
                     const NurbsSurface     &surface)
        : points(interface.get_points())
        , n(interface.points_per_element().size())
        , is_one_patch(surface.is_one_patch())
        , n_elements(is_one_patch ? surface.n_elements_per_direction() :
                                    std::array<unsigned int, 2>{{1, 1}})
      {
        for (unsigned int d = 0; d < 2; ++d)
          for (unsigned int i = 0; i < n * n_elements[d]; ++i)
            coordinates[d].push_back(
              points[d == 0 ? index(0, i, 0) : index(0, 0, i)].xi[d]);
      }

      /** Four points and their weights, and the nearest point. */
      struct Stencil
      {
        std::array<const SlavePoint *, 4> point;
        std::array<double, 4>             weight;
        const SlavePoint                 *nearest;
      };

      /** At a point of @p element, between all points, for fields that are
       *  continuous over the whole patch, or those of the element only, for
       *  fields that may jump at its borders; constant beyond these. */
      Stencil
      stencil(const unsigned int     element,
              const Eigen::Vector2d &place,
              const bool             in_element) const
      {
        // patches have coordinates alike
        const unsigned int patch = is_one_patch ? 0 : element;
        Eigen::Vector2d    xi    = place;
        if (!is_one_patch)
          xi += points[0].xi - points[n * n * patch].xi;
        std::array<unsigned int, 2> first, second;
        std::array<double, 2>       share; // of the second
        for (unsigned int d = 0; d < 2; ++d)
          {
            const auto &x     = coordinates[d];
            std::size_t begin = 0, end = x.size();
            if (in_element && is_one_patch)
              {
                begin = n * (d == 0 ? element % n_elements[0] :
                                      element / n_elements[0]);
                end   = begin + n;
              }
            const std::size_t upper =
              std::upper_bound(x.begin() + begin, x.begin() + end, xi[d]) -
              x.begin();
            first[d]  = std::max(upper, begin + 1) - 1;
            second[d] = std::min(upper, end - 1);
            share[d]  = first[d] == second[d] ?
                          0. :
                          (xi[d] - x[first[d]]) / (x[second[d]] - x[first[d]]);
          }
        Stencil result;
        for (unsigned int a = 0; a < 4; ++a)
          {
            result.weight[a] = dealii::GeometryInfo<2>::d_linear_shape_function(
              dealii::Point<2>(share[0], share[1]), a);
            result.point[a] = &points[index(patch,
                                            a % 2 == 0 ? first[0] : second[0],
                                            a / 2 == 0 ? first[1] : second[1])];
          }
        result.nearest = &points[index(patch,
                                       share[0] < 0.5 ? first[0] : second[0],
                                       share[1] < 0.5 ? first[1] : second[1])];
        return result;
      }

    private:
      /** Points are numbered element by element, the first parameter fastest in
       *  both; @p i and @p j count over the whole patch. */
      unsigned int
      index(const unsigned int patch,
            const unsigned int i,
            const unsigned int j) const
      {
        const unsigned int element = patch + i / n + n_elements[0] * (j / n);
        return n * n * element + i % n + n * (j % n);
      }

      const std::vector<SlavePoint>     &points;
      const unsigned int                 n;
      const bool                         is_one_patch;
      const std::array<unsigned int, 2>  n_elements; ///< of a patch
      std::array<std::vector<double>, 2> coordinates;
    };



    /** Pressure, traction on the slave, gap and sliding distance of a point,
     *  which are continuous over the patch. A point that does not face the
     *  master has no gap: the distance to the nearest border is none. An open
     *  point with a negative gap is beyond the border, too. */
    Eigen::Matrix<double, 6, 1>
    continuous_values(const ContactInterface &interface,
                      const SlavePoint       &point)
    {
      const ContactPointResult &trial    = point.trial;
      const PointTraction       traction = interface.traction(point);
      const bool                is_beyond =
        trial.state.status == PointStatus::open &&
        (!trial.state.has_partner || trial.normal_gap < -trial.state.crushed);
      Eigen::Matrix<double, 6, 1> values;
      values << traction.pressure, traction.tangential,
        is_beyond ? 0. : trial.normal_gap, trial.state.slip;
      return values;
    }



    /** Sliding distance [mm] and internal variables from those points that face
     *  the implant: the others of a bone have never slid and would heal its
     *  bond at the rim. */
    PointHistory
    history_under_implant(const QuadratureGrid::Stencil &stencil)
    {
      PointHistory state;
      double       weight = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        if (stencil.point[a]->faces_implant)
          weight += stencil.weight[a];
      for (unsigned int a = 0; a < 4; ++a)
        if (stencil.point[a]->faces_implant)
          {
            const auto  &own  = stencil.point[a]->trial.state;
            const double part = stencil.weight[a] / weight;
            state.slip += part * own.slip;
            state.damage += part * own.damage;
            for (unsigned int i = 0; i < state.internal.size(); ++i)
              state.internal[i] += part * own.internal[i];
          }
      return state;
    }



    /**
     * phi_0, phi and mu at a point of an element, under a pressure. Patterns
     * jump from element to element, so phi_0 is that of the element's own
     * points; phi and mu follow from it and the sliding distance, which does
     * not jump, by the friction law: they are as sharp as the pattern where it
     * jumps, smooth elsewhere.
     */
    std::array<double, 3>
    bonding_values(const InterfaceLaw            &law,
                   const QuadratureGrid::Stencil &across_elements,
                   const QuadratureGrid::Stencil &own,
                   const double                   pressure)
    {
      double phi_0 = 0., phi_0_left = 0.; // without bonds that opening broke
      for (unsigned int a = 0; a < 4; ++a)
        {
          const double part = own.weight[a] * own.point[a]->phi_0;
          phi_0 += part;
          if (!own.point[a]->trial.state.broken)
            phi_0_left += part;
        }
      const FrictionCoefficient friction =
        law.reported(history_under_implant(across_elements),
                     phi_0_left,
                     pressure);
      return {{phi_0, friction.phi, friction.mu}};
    }



    /** x - X of the control points of a body's contact surface. */
    ControlNet
    control_point_displacement(const CoupledSystem &system, const Body &body)
    {
      const ControlNet &X = body.surface().control_points();
      ControlNet        u = body.contact_displacement();
      if (body.mesh().side() == Side::implant)
        for (unsigned int A = 0; A < u.cols(); ++A)
          u.col(A) = system.chuck.map(X.col(A), u.col(A)) - X.col(A);
      return u;
    }



    FieldNames
    fields_of(const InterfaceLaw &law)
    {
      FieldNames fields{{"pressure_MPa", 1},
                        {"traction_MPa", 3},
                        {"gap_mm", 1},
                        {"slip_mm", 1},
                        {"phi_0", 1},
                        {"phi", 1},
                        {"mu", 1},
                        {"state", 1},
                        {"motion_um", 1},
                        {"displacement", 3}};
      if (law.pulls())
        fields.insert(fields.end(),
                      {{"left_by_opening", 1},
                       {"left_by_slip", 1},
                       {"mode_deg", 1}});
      if (law.bone.crushes())
        fields.emplace_back("crushed_mm", 1);
      if (law.bone.shears())
        fields.emplace_back("sheared_mm", 1);
      return fields;
    }



    /** Appends the values of those fields at a place between points of all
     *  elements, and of its @p own element. */
    void
    append_fields(std::vector<double>           &values,
                  const ContactInterface        &interface,
                  const QuadratureGrid::Stencil &stencil,
                  const QuadratureGrid::Stencil &own,
                  const Eigen::Vector3d         &displacement)
    {
      const InterfaceLaw         &law = interface.get_law();
      Eigen::Matrix<double, 6, 1> continuous =
        Eigen::Matrix<double, 6, 1>::Zero();
      for (unsigned int a = 0; a < 4; ++a)
        continuous +=
          stencil.weight[a] * continuous_values(interface, *stencil.point[a]);
      append_values(values, continuous);
      for (const double value :
           bonding_values(law, stencil, own, continuous[0]))
        values.push_back(value);
      values.push_back(static_cast<double>(interface.status(*stencil.nearest)));
      Eigen::Vector3d motion = Eigen::Vector3d::Zero(); // [mm]
      for (unsigned int a = 0; a < 4; ++a)
        motion +=
          stencil.weight[a] * interface.motion_since_mark(*stencil.point[a]);
      values.push_back(1e3 * motion.norm());
      append_values(values, displacement);
      if (law.pulls())
        {
          const auto left = law.left_by_each(history_under_implant(stencil));
          const PointTraction traction{continuous[0], continuous.segment<3>(1)};
          append_values(values,
                        Eigen::Vector3d(left[0], left[1], traction.mode_deg()));
        }
      double crushed = 0., sheared = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        {
          const PointHistory &state = stencil.point[a]->trial.state;
          crushed += stencil.weight[a] * state.crushed;
          sheared += stencil.weight[a] * state.sheared;
        }
      if (law.bone.crushes())
        values.push_back(crushed);
      if (law.bone.shears())
        values.push_back(sheared);
    }
    /** The fields of the interface in the trial state on the surface of the
     *  slave; class FieldOutput says which, and how they are interpolated. */
    std::string
    interface_vtu(const CoupledSystem &system)
    {
      const ContactInterface &interface = system.interface;
      const Body             &slave     = *system.body[interface.slave_side()];
      const NurbsSurface     &surface   = slave.surface();
      const ControlNet        u = control_point_displacement(system, slave);
      const QuadratureGrid    grid(interface, surface);
      const unsigned int n = n_pieces(surface.n_elements_across(), 96, 4, 16);
      const auto         corners =
        dealii::QIterated<2>(dealii::QTrapezoid<1>(), n).get_points();
      DrawnPatches<2> face(fields_of(interface.get_law()));
      face.add(surface.n_elements(), n, [&](const unsigned int element) {
        return [&, element](const unsigned int k, std::vector<double> &values) {
          const Eigen::Vector2d xi =
            parameters_at(surface.element_bounds(element), corners[k]);
          SurfaceBasis basis;
          surface.evaluate_in_element(element, xi, basis);
          append_fields(values,
                        interface,
                        grid.stencil(element, xi, false),
                        grid.stencil(element, xi, true),
                        interpolate(basis, u));
          return Eigen::Vector3d(interpolate(basis, surface.control_points()));
        };
      });
      return face.vtu();
    }



    /** The same of the quadrature points. */
    std::string
    points_vtu(const CoupledSystem &system)
    {
      const ContactInterface &interface = system.interface;
      ControlNet              u =
        control_point_displacement(system,
                                   *system.body[interface.slave_side()]);
      const auto &points = interface.get_points();
      FieldNames  fields = fields_of(interface.get_law());
      // gaps at the start have no part in it
      u.conservativeResize(Eigen::NoChange, u.cols() + 4);
      u.rightCols<4>().setZero();
      fields.insert(fields.end(),
                    {{"area_mm2", 1},
                     {"force_N", 3},
                     {"moment_Nmm", 3},
                     {"energy_Nmm", 1}});
      DrawnPatches<0> drawn(fields);
      drawn.add(points.size(), 0, [&](const unsigned int q) {
        return [&, q](const unsigned int, std::vector<double> &values) {
          const SlavePoint &point = points[q];
          const PointLoad   load  = interface.load(q, system.chuck.centre());
          const QuadratureGrid::Stencil itself{
            {{&point, &point, &point, &point}}, {{1., 0., 0., 0.}}, &point};
          append_fields(
            values, interface, itself, itself, interpolate(point.basis, u));
          values.push_back(point.JxW);
          append_values(values, load.force);
          append_values(values, load.moment);
          values.push_back(load.energy);
          return point.X;
        };
      });
      return drawn.vtu();
    }



    /** A list of files by deal.II, which begins with a comment that holds the
     *  date: equal runs write equal files. */
    std::string
    without_date(std::string list)
    {
      const auto begin = list.find("<!--"), end = list.find("-->");
      return begin < end && end != list.npos ?
               list.erase(begin, end + 4 - begin) :
               list;
    }
  } // namespace



  // Where several ranks drew the bulk its file is the list of their pieces.
  void
  FieldOutput::write(const double time)
  {
    const std::string number =
      "-" + dealii::Utilities::int_to_string(files["bulk"].size(), 4);
    const BulkFields bulk({{&system.bone, &system.implant}}, system.chuck);
    if (bulk.tension.MPa > largest_tension.MPa)
      {
        largest_tension      = bulk.tension;
        largest_tension.time = time;
      }
    const auto add = [&](const std::string &series,
                         const std::string &ending,
                         const std::string &text) {
      files[series].emplace_back(time, series + number + ending);
      write_file(directory.file(files[series].back().second), text);
    };
    if (Ranks::number() == 1)
      add("bulk", ".vtu", bulk.vtu());
    else
      {
        std::vector<std::string> pieces;
        for (unsigned int rank = 0; rank < Ranks::number(); ++rank)
          pieces.push_back("bulk" + number + "." + std::to_string(rank) +
                           ".vtu");
        write_own_file(directory.file(pieces[Ranks::own()]), bulk.vtu());
        add("bulk", ".pvtu", without_date(bulk.pvtu(pieces)));
      }
    const bool draws = Ranks::is_first();
    add("interface", ".vtu", draws ? interface_vtu(system) : "");
    add("points", ".vtu", draws ? points_vtu(system) : "");
    for (const auto &[series, list] : files)
      {
        Classic<std::ostringstream> record;
        record.precision(12);
        dealii::DataOutBase::write_pvd_record(record, list);
        write_file(directory.file(series + ".pvd"), without_date(record.str()));
      }
  }



  nlohmann::ordered_json
  FieldOutput::measures() const
  {
    if (largest_tension.MPa == 0.)
      return nlohmann::ordered_json::object();
    return {{"bone_tension_MPa", largest_tension.MPa},
            {"bone_tension_at_mm", largest_tension.X_mm},
            {"bone_tension_time", largest_tension.time}};
  }



  void
  FieldOutput::put_on_disk()
  {
    for (const auto &[series, list] : files)
      for (std::size_t i = n_on_disk; i < list.size(); ++i)
        Debond::put_on_disk(directory.file(list[i].second));
    n_on_disk = files["bulk"].size();
  }
} // namespace Debond
