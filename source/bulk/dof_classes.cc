#include <debond/bulk/dof_classes.h>

#include <algorithm>
#include <cmath>

// Mirror symmetry of a body: blocks, coins and caps have it, as long as strains
// are small. The stiffness then falls into four parts of a quarter of the size,
// whose dense parts take a quarter of the memory together, and whose
// factorisations a tenth of the time. Whether a mesh has it is asked, never
// taken for granted.
namespace Debond
{
  Eigen::VectorXd
  DofClass::fold(const Eigen::VectorXd &v) const
  {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (number[dof] >= 0)
        y[number[dof]] += coefficient[dof] * v[dof];
    return y;
  }



  void
  DofClass::unfold(const Eigen::VectorXd &y, Eigen::VectorXd &v) const
  {
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (number[dof] >= 0)
        v[dof] += coefficient[dof] * y[number[dof]];
  }



  namespace
  {
    bool
    is_free(const BodyMesh &mesh, const unsigned int dof)
    {
      return !mesh.is_tied(dof / 3) && !mesh.is_fixed(dof / 3, dof % 3);
    }



    DofClass
    empty_class(const BodyMesh &mesh)
    {
      const unsigned int n_dofs = 3 * mesh.n_nodes();
      return {0, std::vector<int>(n_dofs, -1), std::vector<double>(n_dofs, 0.)};
    }



    // Up to four nodes, mirror images of each other, move alike but for signs:
    // the images of a motion by the mirror d have the sign parity[d], that of
    // the component d across the mirror changed. A node on a mirror is its own
    // image and can only move as its own sign says.
    DofClass
    mirror_class(const BodyMesh &mesh, const std::array<double, 2> &parity)
    {
      const auto      &cells  = mesh.parameters().cells;
      DofClass         result = empty_class(mesh);
      std::vector<int> number_of_place(6UL * (cells[0] + 2) * (cells[1] + 2) *
                                         (cells[2] + 2),
                                       -1);
      for (unsigned int dof = 0; dof < result.number.size(); ++dof)
        {
          if (!is_free(mesh, dof))
            continue;
          const auto  place    = mesh.place_of(dof / 3);
          std::size_t number   = dof / 3 < mesh.n_inner_nodes() ? 0 : 1;
          double      weight   = 1.;
          bool        can_move = true;
          for (unsigned int d = 0; d < 2; ++d)
            {
              const unsigned int i = place.index[d], image = place.last[d] - i;
              const double       sign = parity[d] * (dof % 3 == d ? -1. : 1.);
              if (i == image)
                can_move = can_move && sign > 0.;
              else
                weight *= (i > image ? sign : 1.) * std::sqrt(0.5);
              number = number * (cells[d] + 2) + std::min(i, image);
            }
          if (!can_move)
            continue;
          number = 3 * (number * (cells[2] + 2) + place.index[2]) + dof % 3;
          if (number_of_place[number] < 0)
            number_of_place[number] = result.n++;
          result.number[dof]      = number_of_place[number];
          result.coefficient[dof] = weight;
        }
      return result;
    }
  } // namespace



  namespace
  {
    /** More than rounding of positions, moduli and weights, relative to their
     *  size, and less than what changes a result. */
    constexpr double rounding = 1e-10;



    /** Whether the functions of the face are mirror images of each other, the
     *  parameter of the mirrored direction @p d running backwards. */
    bool
    has_mirrored_functions(const NurbsSurface &face, const unsigned int d)
    {
      const std::vector<double> &knots   = face.knots(d).breakpoints();
      const std::vector<double> &weights = face.weights();
      for (unsigned int k = 0; k < knots.size(); ++k)
        if (std::abs(knots[k] + knots[knots.size() - 1 - k] - 1.) > rounding)
          return false;
      const unsigned int n_1 = face.knots(0).n_basis_functions(),
                         n_2 = face.knots(1).n_basis_functions();
      for (unsigned int j = 0; j < n_2; ++j)
        for (unsigned int i = 0; i < n_1; ++i)
          {
            const double own   = weights[i + n_1 * j],
                         image = weights[d == 0 ? n_1 - 1 - i + n_1 * j :
                                                  i + n_1 * (n_2 - 1 - j)];
            if (std::abs(own - image) > rounding * own)
              return false;
          }
      return true;
    }
  } // namespace



  bool
  is_mirror_image(const BodyMesh &mesh)
  {
    const auto &cells  = mesh.parameters().cells;
    const auto  number = [&](const unsigned int                 node,
                            const std::array<unsigned int, 3> &index) {
      std::size_t result = node < mesh.n_inner_nodes() ? 0 : 1;
      for (unsigned int d = 0; d < 3; ++d)
        result = result * (cells[d] + 2) + index[d];
      return result;
    };
    std::vector<unsigned int> node_at(2UL * (cells[0] + 2) * (cells[1] + 2) *
                                      (cells[2] + 2));
    Eigen::Vector3d           extent = Eigen::Vector3d::Zero();
    for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
      {
        node_at[number(node, mesh.place_of(node).index)] = node;
        extent = extent.cwiseMax(mesh.reference_position(node).cwiseAbs());
      }
    const auto is_image = [&](const unsigned int node, const unsigned int d) {
      BodyMesh::Place place    = mesh.place_of(node);
      place.index[d]           = place.last[d] - place.index[d];
      const unsigned int image = node_at[number(node, place.index)];
      Eigen::Vector3d    X     = mesh.reference_position(image);
      X[d]                     = -X[d];
      for (unsigned int c = 0; c < 3; ++c)
        if (mesh.is_fixed(node, c) != mesh.is_fixed(image, c))
          return false;
      return (X - mesh.reference_position(node)).norm() <=
             rounding * extent.norm();
    };
    for (const unsigned int d : {0, 1})
      {
        if (!has_mirrored_functions(mesh.surface(), d))
          return false;
        for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
          if (!is_image(node, d))
            return false;
      }
    return true;
  }



  DofClass
  free_dofs_of(const BodyMesh &mesh)
  {
    DofClass result = empty_class(mesh);
    for (unsigned int dof = 0; dof < result.number.size(); ++dof)
      if (is_free(mesh, dof))
        {
          result.number[dof]      = result.n++;
          result.coefficient[dof] = 1.;
        }
    return result;
  }



  std::vector<DofClass>
  mirror_classes_of(const BodyMesh &mesh)
  {
    std::vector<DofClass> result;
    for (const double along_x : {1., -1.})
      for (const double along_y : {1., -1.})
        result.push_back(mirror_class(mesh, {{along_x, along_y}}));
    return result;
  }



  std::vector<bool>
  with_mirror_images(const BodyMesh &mesh, std::vector<bool> control_points)
  {
    const unsigned int n_1 = mesh.surface().knots(0).n_basis_functions(),
                       n_2 = mesh.surface().knots(1).n_basis_functions();
    for (unsigned int j = 0; j < n_2; ++j)
      for (unsigned int i = 0; i < n_1; ++i)
        {
          const unsigned int images[]{i + n_1 * j,
                                      n_1 - 1 - i + n_1 * j,
                                      i + n_1 * (n_2 - 1 - j),
                                      n_1 - 1 - i + n_1 * (n_2 - 1 - j)};
          for (const unsigned int image : images)
            control_points[image] =
              control_points[image] || control_points[images[0]];
        }
    return control_points;
  }



  unsigned int
  n_mirror_images(const BodyMesh &mesh, const BodyMesh::Cell &cell)
  {
    const auto        &n = mesh.parameters().cells;
    const unsigned int place[]{cell.surface_element % n[0],
                               cell.surface_element / n[0]};
    unsigned int       result = 1;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int image = n[d] - 1 - place[d];
        result *= place[d] < image ? 2 : place[d] == image ? 1 : 0;
      }
    return result;
  }
} // namespace Debond
