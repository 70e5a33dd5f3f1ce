#include <debond/bulk/body.h>
#include <debond/bulk/cell_shape.h>
#include <debond/bulk/chuck.h>
#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_interface.h>
#include <debond/output/field_output.h>
#include <debond/output/vtu_patches.h>

#include <algorithm>

namespace Debond
{
  namespace
  {
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

      /** Four points and their weights, and the nearest point. */
      struct Stencil
      {
        std::array<const SlavePoint *, 4> point;
        std::array<double, 4>             weight;
        const SlavePoint                 *nearest;
      };

      /** For fields that are continuous over the whole patch. */
      Stencil
      across_elements(const Eigen::Vector2d &xi) const
      {
        return stencil(xi,
                       {{0, 0}},
                       {{coordinates[0].size(), coordinates[1].size()}});
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
        result.weight = bilinear(2. * share[0] - 1., 2. * share[1] - 1.);
        for (unsigned int a = 0; a < 4; ++a)
          result.point[a] = &points[index(a % 2 == 0 ? first[0] : second[0],
                                          a / 2 == 0 ? first[1] : second[1])];
        result.nearest = &points[index(share[0] < 0.5 ? first[0] : second[0],
                                       share[1] < 0.5 ? first[1] : second[1])];
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
      values << trial.pressure, -trial.tangential_traction,
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
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      output.add_patch(
        n_pieces(surface, 96, 4, 16),
        [&](const Eigen::Vector2d &point, std::vector<double> &values) {
          const Eigen::Vector2d xi =
            parameters_at(surface.element_bounds(element), point[0], point[1]);
          surface.evaluate_in_element(element, xi, basis, false);
          contract(basis, surface.control_points(), false, position);
          contract(basis, u, false, displacement);

          const auto                  stencil = grid.across_elements(xi);
          Eigen::Matrix<double, 6, 1> continuous =
            Eigen::Matrix<double, 6, 1>::Zero();
          for (unsigned int a = 0; a < 4; ++a)
            continuous +=
              stencil.weight[a] * continuous_values(*stencil.point[a]);
          append_values(values, continuous);
          for (const double value :
               bonding_values(law, stencil, grid.within(element, xi)))
            values.push_back(value);
          values.push_back(
            static_cast<double>(stencil.nearest->trial.state.status));
          append_values(values, displacement.y);
          return position.y;
        });
    return output.vtu();
  }
} // namespace Debond
