#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/bulk/chuck.h>
#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_interface.h>
#include <debond/output/field_output.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>
#include <tuple>
#include <utility>

namespace Debond
{
  namespace
  {
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

    /**
     * What deal.II's writers ask for: patches (cells or pieces of a surface,
     * each a regular grid of points) and the names of the fields.
     */
    template <int dim>
    class PatchSet
    {
    public:
      /** Names of the fields, and how many values each has: 1, a vector's 3, a
       *  tensor's 9. */
      PatchSet(const std::vector<std::pair<std::string, unsigned int>> &fields)
      {
        using namespace dealii::DataComponentInterpretation;
        for (const auto &[name, n_values] : fields)
          {
            if (n_values > 1)
              ranges.emplace_back(names.size(),
                                  names.size() + n_values - 1,
                                  name,
                                  n_values == 3 ? component_is_part_of_vector :
                                                  component_is_part_of_tensor);
            names.insert(names.end(), n_values, name);
          }
      }

      /** Where the corners of the pieces are in [0, 1]^dim, if there are @p n
       * in each direction; the first coordinate is the fastest. */
      static std::vector<dealii::Point<dim>>
      corners_of_pieces(const unsigned int n)
      {
        return dealii::QIterated<dim>(dealii::QTrapezoid<1>(), n).get_points();
      }

      /** Adds a patch of @p n pieces in each direction. draw(k, values) is
       *  called for their corners k: it appends the values of all fields to an
       *  empty list and returns the position. */
      template <typename Draw>
      void
      add_patch(const unsigned int n, const Draw &draw)
      {
        auto &patch          = patches.emplace_back();
        patch.n_subdivisions = n;
        patch.patch_index    = patches.size() - 1;
        patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim>();
        patch.points_are_available = true;
        const auto n_points        = dealii::Utilities::fixed_power<dim>(n + 1);
        patch.data.reinit(names.size() + 3, n_points);
        std::vector<double> values;
        for (unsigned int p = 0; p < n_points; ++p)
          {
            values.clear();
            const Eigen::Vector3d position = draw(p, values);
            AssertDimension(values.size(), names.size());
            append_values(values, position);
            for (unsigned int i = 0; i < values.size(); ++i)
              patch.data(i, p) = values[i];
          }
      }

      /** Adds the patches of another set with the same fields. */
      void
      add_patches(PatchSet &&other)
      {
        for (auto &patch : other.patches)
          {
            patch.patch_index = patches.size();
            patches.push_back(std::move(patch));
          }
      }

      /** The text of a VTU file; with @p curved_cells a patch is one cell, a
       *  Lagrange polynomial through its points. */
      std::string
      vtu(const bool curved_cells = false) const
      {
        dealii::DataOutBase::VtkFlags flags;
        flags.print_date_and_time      = false;
        flags.compression_level        = flags.best_speed;
        flags.write_higher_order_cells = curved_cells;
        Classic<std::ostringstream> text;
        dealii::DataOutBase::write_vtu(patches, names, ranges, flags, text);
        return text.str();
      }

      /** The text of a file that names others as its pieces. */
      std::string
      list(const std::vector<std::string> &pieces) const
      {
        Classic<std::ostringstream> text;
        dealii::DataOutBase::write_pvtu_record(
          text, pieces, names, ranges, dealii::DataOutBase::VtkFlags());
        // which begins with a comment that holds the date
        std::string list  = text.str();
        const auto  begin = list.find("<!--"), end = list.find("-->");
        if (begin != list.npos && end != list.npos)
          list.erase(begin, end + 4 - begin);
        return list;
      }

    private:
      using Range = std::tuple<
        unsigned int,
        unsigned int,
        std::string,
        dealii::DataComponentInterpretation::DataComponentInterpretation>;

      std::vector<dealii::DataOutBase::Patch<dim, 3>> patches;
      std::vector<std::string>                        names;
      std::vector<Range> ranges; ///< vectors, tensors
    };

    /** Into how many pieces a cell or element is cut in each direction, so that
     *  a patch has about @p pieces of them: the fewer elements a disk has, the
     *  more pieces it takes to look round. */
    unsigned int
    n_pieces(const NurbsSurface &surface,
             const unsigned int  pieces,
             const unsigned int  least,
             const unsigned int  most)
    {
      const unsigned int fewest = surface.n_elements_across();
      return std::clamp((pieces + fewest - 1) / fewest, least, most);
    }



    /** What is drawn of a body: its state, and how finely. */
    struct DrawnBody
    {
      const BulkSpace             &mesh;
      const Chuck                 &chuck;
      Eigen::VectorXd              v; ///< of all nodes, in the body's frame
      std::vector<Eigen::Matrix3d> stress;     ///< at the vertices
      unsigned int                 n_enriched; ///< pieces of a curved cell
      bool                         draws_modulus;
      const Bulk                  *bulk;
      /** Corners of the pieces, and functions of FE_Q there, of ordinary and of
       *  curved cells. */
      std::array<std::vector<dealii::Point<3>>, 2> corners;
      std::array<std::vector<ShapeValues>, 2>      phi;

      DrawnBody(const Body  &body,
                const Chuck &chuck,
                const bool   curved_cells,
                const bool   has_modulus)
        : mesh(body.mesh())
        , chuck(chuck)
        , v(body.full_displacement())
        , stress(body.vertex_stress(v))
        // A surface of degree one makes its cells trilinear.
        , n_enriched(mesh.surface().degree() == 1 ? 1 :
                     curved_cells                 ? 2 :
                                    n_pieces(mesh.surface(), 24, 2, 8))
        , draws_modulus(has_modulus)
        , bulk(body.bulk())
      {
        for (const bool is_curved : {false, true})
          {
            corners[is_curved] =
              PatchSet<3>::corners_of_pieces(is_curved ? n_enriched : 1);
            for (const dealii::Point<3> &corner : corners[is_curved])
              phi[is_curved].push_back(shape_values(mesh.element(), corner));
          }
      }

      void
      draw(const unsigned int number, PatchSet<3> &output) const
      {
        const BulkSpace::Cell &cell = mesh.cells()[number];
        const CellFunctions    functions(mesh, cell);
        const bool             is_implant = mesh.side() == Side::implant;
        const Eigen::Matrix3d  Q =
          is_implant ? chuck.rotation() : Eigen::Matrix3d::Identity();
        const bool is_curved = cell.enriched || mesh.has_splines();
        output.add_patch(
          is_curved ? n_enriched : 1,
          [&](const unsigned int k, std::vector<double> &values) {
            const dealii::Point<3> &point = corners[is_curved][k];
            const ShapeValues       N = functions.at(point, phi[is_curved][k]);
            Eigen::Vector3d         X = Eigen::Vector3d::Zero(), v_point = X;
            for (unsigned int a = 0; a < N.rows(); ++a)
              {
                X += N(a, 0) * mesh.reference_position(cell.nodes[a]);
                v_point += N(a, 0) * v.segment<3>(3 * cell.nodes[a]);
              }
            Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero();
            for (unsigned int a = 0; a < cell.vertices.size(); ++a)
              sigma +=
                dealii::GeometryInfo<3>::d_linear_shape_function(point, a) *
                stress[cell.vertices[a]];

            append_values(values,
                          is_implant ? chuck.map(X, v_point) - X : v_point);
            append_values(values, v_point);
            append_values(values, (Q * sigma * Q.transpose()).eval());
            values.push_back(von_mises(sigma));
            values.push_back(is_implant ? 1. : 0.);
            if (draws_modulus)
              values.push_back(bulk ? bulk->young_modulus(number) : 0.);
            return X;
          });
      }
    };
  } // namespace



  namespace
  {
    bool
    draws_modulus(const std::array<const Body *, 2> &bodies)
    {
      return bodies[0]->mesh().parameters().modulus != nullptr;
    }



    /** A set without patches. */
    PatchSet<3>
    bulk_fields(const std::array<const Body *, 2> &bodies)
    {
      std::vector<std::pair<std::string, unsigned int>> names{
        {"displacement", 3},
        {"displacement_in_frame", 3},
        {"stress_MPa", 9},
        {"von_Mises_MPa", 1},
        {"body", 1}};
      if (draws_modulus(bodies))
        names.emplace_back("young_modulus_MPa", 1);
      return names;
    }
  } // namespace



  std::string
  list_of_pieces(const std::array<const Body *, 2> &bodies,
                 const std::vector<std::string>    &pieces)
  {
    return bulk_fields(bodies).list(pieces);
  }



  // A patch is a cell; those at the curved surface are finely subdivided, or
  // quadratic ones where a body has splines. They are drawn in threads. The
  // file has one piece: ParaView mixes up the points of curved cells in files
  // of several. Of several ranks each draws its part of the bone, and the first
  // one the implant.
  std::string
  bulk_vtu(const std::array<const Body *, 2> &bodies, const Chuck &chuck)
  {
    const bool        has_modulus = draws_modulus(bodies);
    const PatchSet<3> fields      = bulk_fields(bodies);
    PatchSet<3>       output      = fields;
    const bool        curved_cells =
      bodies[0]->mesh().has_splines() || bodies[1]->mesh().has_splines();
    for (const Body *const body : bodies)
      {
        if (body->mesh().side() == Side::implant && !Ranks::is_first())
          continue;
        const DrawnBody          drawn(*body, chuck, curved_cells, has_modulus);
        std::vector<PatchSet<3>> parts(n_chunks, fields);
        for_each_chunk(body->mesh().cells().size(),
                       [&](const unsigned int chunk,
                           const unsigned int first,
                           const unsigned int end) {
                         for (unsigned int k = first; k < end; ++k)
                           drawn.draw(k, parts[chunk]);
                       });
        for (PatchSet<3> &part : parts)
          output.add_patches(std::move(part));
      }
    return output.vtu(curved_cells);
  }



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
        , n(interface.points_per_element())
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
    continuous_values(const SlavePoint &point)
    {
      const ContactPointResult &trial = point.trial;
      const bool                is_beyond =
        trial.state.status == PointStatus::open &&
        (!trial.state.has_partner || trial.normal_gap < 0.);
      Eigen::Matrix<double, 6, 1> values;
      values << trial.state.pressure, -trial.tangential_traction,
        is_beyond ? 0. : trial.normal_gap, trial.state.slip;
      return values;
    }



    /** Sliding distance [mm] and internal variables from those points that face
     *  the implant: the others of a bone have never slid and would heal its
     *  bond at the rim. */
    FrictionState
    state_under_implant(const QuadratureGrid::Stencil &stencil)
    {
      FrictionState state;
      double        weight = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        if (stencil.point[a]->faces_implant)
          weight += stencil.weight[a];
      for (unsigned int a = 0; a < 4; ++a)
        if (stencil.point[a]->faces_implant)
          {
            const auto  &own  = stencil.point[a]->trial.state;
            const double part = stencil.weight[a] / weight;
            state.slip += part * own.slip;
            for (unsigned int i = 0; i < state.internal.size(); ++i)
              state.internal[i] += part * own.internal[i];
          }
      return state;
    }



    /**
     * phi_0, phi and mu at a point of an element. Patterns jump from element to
     * element, so phi_0 is that of the element's own points; phi and mu follow
     * from it and the sliding distance, which does not jump, by the friction
     * law: they are as sharp as the pattern where it jumps, smooth elsewhere.
     */
    std::array<double, 3>
    bonding_values(const FrictionLaw             &law,
                   const QuadratureGrid::Stencil &across_elements,
                   const QuadratureGrid::Stencil &own)
    {
      double        phi_0 = 0.;
      FrictionState state = state_under_implant(across_elements);
      state.phi_0         = 0.; // without bonds that opening broke
      for (unsigned int a = 0; a < 4; ++a)
        {
          const double part = own.weight[a] * own.point[a]->phi_0;
          phi_0 += part;
          if (!own.point[a]->trial.state.broken)
            state.phi_0 += part;
        }
      const FrictionCoefficient friction = law.reported(state);
      return {{phi_0, friction.phi, friction.mu}};
    }



    /** x - X of the control points of a body's contact surface. */
    ControlNet
    control_point_displacement(const Body &body, const Chuck &chuck)
    {
      const ControlNet &X = body.surface().control_points();
      ControlNet        u = body.contact_displacement();
      if (body.mesh().side() == Side::implant)
        for (unsigned int A = 0; A < u.cols(); ++A)
          u.col(A) = chuck.map(X.col(A), u.col(A)) - X.col(A);
      return u;
    }
  } // namespace



  std::string
  interface_vtu(const Body             &slave,
                const ContactInterface &interface,
                const Chuck            &chuck)
  {
    PatchSet<2> output({{"pressure_MPa", 1},
                        {"traction_MPa", 3},
                        {"gap_mm", 1},
                        {"slip_mm", 1},
                        {"phi_0", 1},
                        {"phi", 1},
                        {"mu", 1},
                        {"state", 1},
                        {"displacement", 3}});

    const NurbsSurface  &surface = slave.surface();
    const FrictionLaw   &law     = *interface.get_parameters().friction;
    const ControlNet     u       = control_point_displacement(slave, chuck);
    const QuadratureGrid grid(interface, surface);
    SurfaceBasis         basis;
    SurfaceGeometry      position, displacement;
    const unsigned int   n       = n_pieces(surface, 96, 4, 16);
    const auto           corners = PatchSet<2>::corners_of_pieces(n);
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      output.add_patch(
        n, [&](const unsigned int k, std::vector<double> &values) {
          const Eigen::Vector2d xi =
            parameters_at(surface.element_bounds(element), corners[k]);
          surface.evaluate_in_element(element, xi, basis, false);
          contract(basis, surface.control_points(), false, position);
          contract(basis, u, false, displacement);

          const auto stencil = grid.stencil(element, xi, false);
          Eigen::Matrix<double, 6, 1> continuous =
            Eigen::Matrix<double, 6, 1>::Zero();
          for (unsigned int a = 0; a < 4; ++a)
            continuous +=
              stencil.weight[a] * continuous_values(*stencil.point[a]);
          append_values(values, continuous);
          for (const double value :
               bonding_values(law, stencil, grid.stencil(element, xi, true)))
            values.push_back(value);
          values.push_back(
            static_cast<double>(stencil.nearest->trial.state.status));
          append_values(values, displacement.y);
          return position.y;
        });
    return output.vtu();
  }
} // namespace Debond
