#include <debond/bulk/dof_classes.h>

#include <algorithm>
#include <cmath>

// Mirror symmetry of a body: all that this program makes have it, blocks, coins
// and caps, as long as strains are small. The stiffness then falls into four
// parts of a quarter of the size, whose dense parts take a quarter of the
// memory together, and whose factorisations a tenth of the time.
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
