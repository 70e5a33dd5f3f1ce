#include <debond/body.h>
#include <debond/chuck.h>
#include <debond/contact_interface.h>
#include <debond/field_output.h>
#include <debond/friction_law.h>
#include <debond/result_files.h>
#include <debond/vertex_stress.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <tuple>

namespace Debond
{
  namespace
  {
    /** Number of values of a field at a point. */
    enum FieldSize
    {
      scalar = 1,
      vector = 3,
      tensor = 9
    };



    /**
     * What deal.II's writers ask for: patches (cells or pieces of a surface,
     * each a regular grid of points) and the names of the fields.
     */
    template <int dim>
    class PatchSet : public dealii::DataOutInterface<dim, 3>
    {
    public:
      PatchSet(const std::vector<std::pair<std::string, FieldSize>> &fields)
      {
        using namespace dealii::DataComponentInterpretation;
        for (const auto &[name, size] : fields)
          {
            if (size != scalar)
              ranges.emplace_back(names.size(),
                                  names.size() + size - 1,
                                  name,
                                  size == vector ? component_is_part_of_vector :
                                                   component_is_part_of_tensor);
            names.insert(names.end(), size, name);
          }
      }

      /** A new patch with room for all values, to be filled point by point. */
      void
      add_patch(const unsigned int n_subdivisions)
      {
        patches.emplace_back();
        auto &patch          = patches.back();
        patch.n_subdivisions = n_subdivisions;
        patch.patch_index    = patches.size() - 1;
        patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim>();
        patch.points_are_available = true;
        std::fill(patch.neighbors.begin(),
                  patch.neighbors.end(),
                  dealii::DataOutBase::Patch<dim, 3>::no_neighbor);
        unsigned int n_points = 1;
        for (unsigned int d = 0; d < dim; ++d)
          n_points *= n_subdivisions + 1;
        patch.data.reinit(names.size() + 3, n_points);
        next_point = 0;
      }

      /** The next point of the last patch, first coordinate fastest; the
       *  @p values of all fields one after the other. */
      void
      add_point(const Eigen::Vector3d     &position,
                const std::vector<double> &values)
      {
        AssertDimension(values.size(), names.size());
        auto &data = patches.back().data;
        for (unsigned int i = 0; i < values.size(); ++i)
          data(i, next_point) = values[i];
        for (unsigned int d = 0; d < 3; ++d)
          data(names.size() + d, next_point) = position[d];
        ++next_point;
      }

      /** The text of a VTU file. */
      std::string
      vtu()
      {
        dealii::DataOutBase::VtkFlags flags;
        flags.print_date_and_time = false;
        flags.compression_level   = flags.best_speed;
        this->set_flags(flags);
        std::ostringstream text;
        this->write_vtu(text);
        return text.str();
      }

    protected:
      const std::vector<dealii::DataOutBase::Patch<dim, 3>> &
      get_patches() const override
      {
        return patches;
      }

      std::vector<std::string>
      get_dataset_names() const override
      {
        return names;
      }

      using Range = std::tuple<
        unsigned int,
        unsigned int,
        std::string,
        dealii::DataComponentInterpretation::DataComponentInterpretation>;

      std::vector<Range>
      get_nonscalar_data_ranges() const override
      {
        return ranges;
      }

    private:
      std::vector<dealii::DataOutBase::Patch<dim, 3>> patches;
      std::vector<std::string>                        names;
      std::vector<Range>                              ranges;
      unsigned int                                    next_point = 0;
    };



    /** Appends the components of a vector or, row by row, a matrix. */
    template <typename Derived>
    void
    append_values(std::vector<double>              &values,
                  const Eigen::MatrixBase<Derived> &matrix)
    {
      for (unsigned int i = 0; i < matrix.rows(); ++i)
        for (unsigned int j = 0; j < matrix.cols(); ++j)
          values.push_back(matrix(i, j));
    }



    /** Into how many pieces a cell or element is cut in each direction, so that
     *  a patch has about @p pieces of them: the fewer elements a disk has, the
     *  more pieces it takes to look round. */
    unsigned int
    n_pieces(const NurbsSurface &surface,
             const unsigned int  pieces,
             const unsigned int  least,
             const unsigned int  most)
    {
      const auto         n      = surface.n_elements_per_direction();
      const unsigned int fewest = std::min(n[0], n[1]);
      return std::clamp((pieces + fewest - 1) / fewest, least, most);
    }



    /** A number between two others, exact at both ends: neighbouring patches
     *  must agree on their border. */
    double
    between(const double begin, const double end, const double t)
    {
      return (1. - t) * begin + t * end;
    }
  } // namespace



  FieldOutput::FieldOutput(const ResultDirectory  &directory,
                           Body                   &bone,
                           Body                   &implant,
                           const ContactInterface &interface,
                           const Chuck            &chuck)
    : directory(directory)
    , bodies{{&bone, &implant}}
    , interface(interface)
    , chuck(chuck)
  {}



  void
  FieldOutput::write(const double time)
  {
    append(bulk_series, time, bulk_vtu());
    append(interface_series, time, interface_vtu());
  }



  void
  FieldOutput::append(Series            &series,
                      const double       time,
                      const std::string &vtu) const
  {
    const std::string name = file_name(series, series.files.size());
    write_file(directory.file(name), vtu);
    series.files.emplace_back(time, name);
    write_series(series);
  }



  std::string
  FieldOutput::file_name(const Series &series, const unsigned int number) const
  {
    return series.name + "-" + dealii::Utilities::int_to_string(number, 4) +
           ".vtu";
  }



  void
  FieldOutput::write_series(const Series &series) const
  {
    // deal.II's write_pvd_record() would add the date
    std::ostringstream record;
    record.precision(12);
    record << "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\">\n"
              "  <Collection>\n";
    for (const auto &[file_time, file] : series.files)
      record << "    <DataSet timestep=\"" << file_time << "\" file=\"" << file
             << "\"/>\n";
    record << "  </Collection>\n"
              "</VTKFile>\n";
    write_file(directory.file(series.name + ".pvd"), record.str());
  }



  std::string
  FieldOutput::forget_later_files()
  {
    std::string missing;
    for (const Series *series : {&bulk_series, &interface_series})
      {
        unsigned int    number = series->files.size();
        std::error_code none;
        while (
          std::filesystem::remove(directory.file(file_name(*series, number)),
                                  none))
          ++number;
        write_series(*series);
        for (const auto &file : series->files)
          if (!std::filesystem::exists(directory.file(file.second)))
            missing += (missing.empty() ? "" : ", ") + file.second;
      }
    n_on_disk = bulk_series.files.size();
    return missing.empty() ?
             "" :
             "VTU files from before the checkpoint are missing, "
             "and are not written again: " +
               missing;
  }



  void
  FieldOutput::put_on_disk()
  {
    for (; n_on_disk < bulk_series.files.size(); ++n_on_disk)
      for (const Series *series : {&bulk_series, &interface_series})
        Debond::put_on_disk(directory.file(series->files[n_on_disk].second));
  }



  namespace
  {
    // ---------------------------------------------------------------- the bulk

    /** The four bilinear functions on [0,1]^2, lexicographic. */
    std::array<double, 4>
    bilinear(const double s, const double t)
    {
      return {{(1. - s) * (1. - t), s * (1. - t), (1. - s) * t, s * t}};
    }



    /**
     * Values of the shape functions of a cell, in the order of its nodes, at a
     * point of [0,1]^3 in the order of its *vertices* (so that all cells are
     * right-handed). No derivatives: they do not exist at the disk's corners.
     */
    std::vector<double>
    shape_values(const BodyMesh        &mesh,
                 const BodyMesh::Cell  &cell,
                 const Eigen::Vector3d &point)
    {
      std::vector<double> N;
      const auto          L     = bilinear(point[0], point[1]);
      const double        upper = point[2], lower = 1. - point[2];
      if (!cell.enriched)
        {
          for (const double z : {lower, upper})
            for (const double value : L)
              N.push_back(z * value);
          return N;
        }
      const auto bounds = mesh.surface().element_bounds(cell.surface_element);
      const Eigen::Vector2d xi(between(bounds[0][0], bounds[1][0], point[0]),
                               between(bounds[0][1], bounds[1][1], point[1]));
      SurfaceBasis          basis;
      mesh.surface().evaluate_in_element(cell.surface_element,
                                         xi,
                                         basis,
                                         false);
      // the contact face is on top of the bone, at the implant's bottom
      const bool on_top = mesh.side() == BodySide::bone;
      for (unsigned int a = 0; a < basis.size; ++a)
        N.push_back((on_top ? upper : lower) * basis.N[a]);
      for (const double value : L)
        N.push_back((on_top ? lower : upper) * value);
      return N;
    }



    /** Draws one body. */
    class BulkPatches
    {
    public:
      BulkPatches(Body &body, const Chuck &chuck, PatchSet<3> &output)
        : mesh(body.mesh())
        , is_implant(mesh.side() == BodySide::implant)
        , chuck(chuck)
        , v(body.full_displacement())
        , stress(vertex_stress(body, v))
        , output(output)
      {
        // A surface of degree one makes its cells trilinear.
        const unsigned int n_enriched =
          mesh.surface().degree() == 1 ? 1 : n_pieces(mesh.surface(), 24, 2, 8);
        for (const BodyMesh::Cell &cell : mesh.cells())
          draw(cell, cell.enriched ? n_enriched : 1);
      }

    private:
      void
      draw(const BodyMesh::Cell &cell, const unsigned int n)
      {
        output.add_patch(n);
        for (unsigned int k = 0; k <= n; ++k)
          for (unsigned int j = 0; j <= n; ++j)
            for (unsigned int i = 0; i <= n; ++i)
              draw(cell, Eigen::Vector3d(i, j, k) / n);
      }

      void
      draw(const BodyMesh::Cell &cell, const Eigen::Vector3d &point)
      {
        const std::vector<double> N = shape_values(mesh, cell, point);
        Eigen::Vector3d           X = Eigen::Vector3d::Zero(), v_point = X;
        for (unsigned int a = 0; a < N.size(); ++a)
          {
            X += N[a] * mesh.reference_position(cell.nodes[a]);
            v_point += N[a] * v.segment<3>(3 * cell.nodes[a]);
          }
        const auto      L     = bilinear(point[0], point[1]);
        Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero();
        for (unsigned int a = 0; a < 8; ++a)
          sigma += (a < 4 ? 1. - point[2] : point[2]) * L[a % 4] *
                   stress[cell.vertices[a]];
        const Eigen::Matrix3d Q =
          is_implant ? chuck.rotation() : Eigen::Matrix3d::Identity();

        values.clear();
        append_values(values, is_implant ? chuck.map(X, v_point) - X : v_point);
        append_values(values, v_point);
        append_values(values, (Q * sigma * Q.transpose()).eval());
        values.push_back(von_mises(sigma));
        values.push_back(is_implant ? 1. : 0.);
        output.add_point(X, values);
      }

      const BodyMesh                    &mesh;
      const bool                         is_implant;
      const Chuck                       &chuck;
      const Eigen::VectorXd              v;
      const std::vector<Eigen::Matrix3d> stress;
      PatchSet<3>                       &output;
      std::vector<double>                values;
    };
  } // namespace



  std::string
  FieldOutput::bulk_vtu() const
  {
    PatchSet<3> output({{"displacement", vector},
                        {"displacement_in_frame", vector},
                        {"stress_MPa", tensor},
                        {"von_Mises_MPa", scalar},
                        {"body", scalar}});
    for (Body *const body : bodies)
      BulkPatches(*body, chuck, output);
    return output.vtu();
  }



  namespace
  {
    // ----------------------------------------------------------- the interface

    /** The quadrature points of a surface as one tensor grid over the patch. */
    class QuadratureGrid
    {
    public:
      QuadratureGrid(const ContactInterface &interface,
                     const NurbsSurface     &surface)
        : points(interface.get_points())
        , n(interface.get_parameters().quadrature_points)
        , n_elements_1(surface.n_elements_per_direction()[0])
      {
        for (unsigned int d = 0; d < 2; ++d)
          for (unsigned int i = 0;
               i < n * surface.n_elements_per_direction()[d];
               ++i)
            coordinates[d].push_back(
              points[d == 0 ? index(i, 0) : index(0, i)].xi[d]);
      }

      /** Numbers of four points and their weights, and of the nearest point. */
      struct Stencil
      {
        std::array<unsigned int, 4> point;
        std::array<double, 4>       weight;
        unsigned int                nearest;
      };

      /** For fields that are continuous over the whole patch. */
      Stencil
      across_elements(const Eigen::Vector2d &xi) const
      {
        const std::array<std::size_t, 2> ends{
          {coordinates[0].size(), coordinates[1].size()}};
        return stencil(xi, {{0, 0}}, ends);
      }

      /** For fields that may jump at its borders: points of @p element only. */
      Stencil
      within(const unsigned int element, const Eigen::Vector2d &xi) const
      {
        const std::size_t i = n * (element % n_elements_1);
        const std::size_t j = n * (element / n_elements_1);
        return stencil(xi, {{i, j}}, {{i + n, j + n}});
      }

    private:
      /** Between the points from @p begin to before @p end in each direction;
       *  constant beyond these. */
      Stencil
      stencil(const Eigen::Vector2d            &xi,
              const std::array<std::size_t, 2> &begin,
              const std::array<std::size_t, 2> &end) const
      {
        std::array<unsigned int, 2> first, second;
        std::array<double, 2>       share; // of the second
        for (unsigned int d = 0; d < 2; ++d)
          {
            const auto       &x     = coordinates[d];
            const std::size_t upper = std::upper_bound(x.begin() + begin[d],
                                                       x.begin() + end[d],
                                                       xi[d]) -
                                      x.begin();
            first[d]  = std::max(upper, begin[d] + 1) - 1;
            second[d] = std::min(upper, end[d] - 1);
            share[d]  = first[d] == second[d] ?
                          0. :
                          (xi[d] - x[first[d]]) / (x[second[d]] - x[first[d]]);
          }
        Stencil result;
        result.weight = bilinear(share[0], share[1]);
        for (unsigned int a = 0; a < 4; ++a)
          result.point[a] = index(a % 2 == 0 ? first[0] : second[0],
                                  a / 2 == 0 ? first[1] : second[1]);
        result.nearest = index(share[0] < 0.5 ? first[0] : second[0],
                               share[1] < 0.5 ? first[1] : second[1]);
        return result;
      }

      /** Points are numbered element by element, the first parameter fastest in
       *  both; @p i and @p j count over the whole patch. */
      unsigned int
      index(const unsigned int i, const unsigned int j) const
      {
        const unsigned int element = i / n + n_elements_1 * (j / n);
        return n * n * element + i % n + n * (j % n);
      }

      const std::vector<SlavePoint>     &points;
      const unsigned int                 n, n_elements_1;
      std::array<std::vector<double>, 2> coordinates;
    };



    /** Gap of a point that faces the master, 0 of one that does not: the
     *  distance to the nearest border is no gap. An open point with a negative
     *  gap is beyond the border, too. */
    double
    gap_to_partner(const ContactPointResult &result)
    {
      const bool is_open = (result.state.status == PointStatus::open);
      return is_open && (!result.state.has_partner || result.normal_gap < 0.) ?
               0. :
               result.normal_gap;
    }



    /** Fields of a quadrature point that are continuous over the patch, one
     *  after the other. */
    std::vector<double>
    continuous_values(const SlavePoint &point)
    {
      std::vector<double> values{point.trial.pressure};
      append_values(values, -point.trial.tangential_traction);
      values.push_back(gap_to_partner(point.trial));
      values.push_back(point.trial.state.slip);
      return values;
    }



    /** Sliding distance [mm] from those points that face the implant: the
     *  others of a bone have never slid and would heal its bond at the rim. */
    double
    slip_under_implant(const ContactInterface        &interface,
                       const QuadratureGrid::Stencil &stencil)
    {
      double slip = 0., weight = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        {
          const auto &point = interface.get_points()[stencil.point[a]];
          if (!point.faces_implant)
            continue;
          slip += stencil.weight[a] * point.trial.state.slip;
          weight += stencil.weight[a];
        }
      return weight > 0. ? slip / weight : 0.;
    }



    /**
     * phi_0, phi and mu at a point of @p element. Patterns jump from element to
     * element, so phi_0 is that of the element's own points; phi and mu follow
     * from it and the sliding distance, which does not jump, by the friction
     * law: they are as sharp as the pattern where it jumps, smooth elsewhere.
     */
    std::array<double, 3>
    bonding_values(const ContactInterface &interface,
                   const QuadratureGrid   &grid,
                   const unsigned int      element,
                   const Eigen::Vector2d  &xi)
    {
      const QuadratureGrid::Stencil own = grid.within(element, xi);
      double phi_0 = 0., phi_0_left = 0.; // without bonds that opening broke
      for (unsigned int a = 0; a < 4; ++a)
        {
          const auto  &point = interface.get_points()[own.point[a]];
          const double part  = own.weight[a] * point.phi_0;
          phi_0 += part;
          if (!point.trial.state.broken)
            phi_0_left += part;
        }
      const FrictionCoefficient friction =
        friction_coefficient(interface.get_parameters().friction,
                             phi_0_left,
                             slip_under_implant(interface,
                                                grid.across_elements(xi)));
      return {{phi_0, friction.phi, friction.mu}};
    }



    /** x - X of the control points of a body's contact surface. */
    ControlNet
    control_point_displacement(const Body &body, const Chuck &chuck)
    {
      const ControlNet &X = body.surface().control_points();
      ControlNet        u = body.contact_displacement();
      if (body.mesh().side() == BodySide::implant)
        for (unsigned int A = 0; A < u.cols(); ++A)
          u.col(A) = chuck.map(X.col(A), u.col(A)) - X.col(A);
      return u;
    }
  } // namespace



  std::string
  FieldOutput::interface_vtu() const
  {
    PatchSet<2> output({{"pressure_MPa", scalar},
                        {"traction_MPa", vector},
                        {"gap_mm", scalar},
                        {"slip_mm", scalar},
                        {"phi_0", scalar},
                        {"phi", scalar},
                        {"mu", scalar},
                        {"state", scalar},
                        {"displacement", vector}});

    const Body          &slave   = *bodies[interface.slave_side()];
    const NurbsSurface  &surface = slave.surface();
    const ControlNet     u       = control_point_displacement(slave, chuck);
    const QuadratureGrid grid(interface, surface);
    std::vector<std::vector<double>> at_points;
    for (const auto &point : interface.get_points())
      at_points.push_back(continuous_values(point));

    const unsigned int  n = n_pieces(surface, 96, 4, 16);
    SurfaceBasis        basis;
    SurfaceGeometry     position, displacement;
    std::vector<double> values;
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      {
        const auto bounds = surface.element_bounds(element);
        output.add_patch(n);
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            {
              const Eigen::Vector2d xi(
                between(bounds[0][0], bounds[1][0], double(i) / n),
                between(bounds[0][1], bounds[1][1], double(j) / n));
              surface.evaluate_in_element(element, xi, basis, false);
              contract(basis, surface.control_points(), false, position);
              contract(basis, u, false, displacement);

              const QuadratureGrid::Stencil stencil = grid.across_elements(xi);
              values.assign(at_points[0].size(), 0.);
              for (unsigned int a = 0; a < 4; ++a)
                for (unsigned int f = 0; f < values.size(); ++f)
                  values[f] +=
                    stencil.weight[a] * at_points[stencil.point[a]][f];
              const auto bonding = bonding_values(interface, grid, element, xi);
              values.insert(values.end(), bonding.begin(), bonding.end());
              values.push_back(static_cast<double>(
                interface.get_points()[stencil.nearest].trial.state.status));
              append_values(values, displacement.y);
              output.add_point(position.y, values);
            }
      }
    return output.vtu();
  }
} // namespace Debond
