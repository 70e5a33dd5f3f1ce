// The lattice solver of a bone of equal splines is exact: it is that of the
// whole stiffness, condensed here as a dense matrix, of motions without slope
// at the sides.

#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/neo_hookean.h>
#include <debond/support/input_error.h>

#include <Eigen/LU>

#include <algorithm>
#include <string>
#include <vector>

#include "checks.h"
#include "stiffness_at_rest.h"
#include "vectors.h"

using namespace Debond;

/** What all degrees of freedom do as the free ones away from the sides move:
 *  control points at a side move along it with their neighbours. @p free: the
 *  latter. */
Eigen::MatrixXd
mirrored_motions(const BulkSpace &mesh, std::vector<unsigned int> &free)
{
  // level by level, that of the contact face last
  const unsigned int n   = 3 * mesh.n_nodes(),
                     n_1 = mesh.parameters().cells[0] + 2,
                     n_2 = mesh.parameters().cells[1] + 2;
  const auto column      = [&](const unsigned int dof) {
    const unsigned int A = dof / 3 % (n_1 * n_2);
    return std::array<unsigned int, 2>{{A % n_1, A / n_1}};
  };
  const auto key = [&](const unsigned int dof) {
    const auto [i, j] = column(dof);
    return std::array<unsigned int, 4>{{std::clamp(i, 1u, n_1 - 2),
                                        std::clamp(j, 1u, n_2 - 2),
                                        dof / 3 / (n_1 * n_2),
                                        dof % 3}};
  };
  std::vector<unsigned int> all;
  for (unsigned int dof = 0; dof < n; ++dof)
    if (!mesh.is_fixed(dof / 3, dof % 3))
      {
        const auto [i, j] = column(dof);
        all.push_back(dof);
        if (i % (n_1 - 1) != 0 && j % (n_2 - 1) != 0)
          free.push_back(dof);
      }
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    for (const unsigned int dof : all)
      if (key(dof) == key(free[k]))
        T(dof, k) = 1.;
  return T;
}



void
check(const std::string &name, BodyParameters parameters)
{
  parameters.element     = ElementKind::spline;
  parameters.material    = Material::linear;
  parameters.bulk_solver = BulkSolver::lattice;
  const BulkSpace mesh(parameters, Side::bone);
  const auto      bulk = make_lattice_bulk(
    mesh,
    EnrichedCells(mesh,
                  NeoHookean::from_young(parameters.young_modulus,
                                         parameters.poisson_ratio)));
  std::vector<bool> contact(mesh.surface().n_control_points(), false);
  contact[parameters.cells[0] + 3]  = true; // not at a side
  const std::vector<unsigned int> c = bulk->set_contact(contact);
  const Eigen::VectorXd at_rest     = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  std::cout << name << std::endl;
  report("  linearised", bulk->linearise(at_rest));

  std::vector<unsigned int> free, face, interior; // places among the free ones
  const Eigen::MatrixXd     T = mirrored_motions(mesh, free);
  for (unsigned int k = 0; k < free.size(); ++k)
    (free[k] / 3 >= mesh.n_inner_nodes() ? face : interior).push_back(k);
  report("  unknowns are those of the face", c.size() == face.size());
  const Eigen::MatrixXd K    = T.transpose() * stiffness_at_rest(mesh) * T,
                        K_cc = K(face, face), K_ic = K(interior, face),
                        K_ii = K(interior, interior);
  const Eigen::PartialPivLU<Eigen::MatrixXd> inverse(K_ii);
  const Eigen::MatrixXd S = K_cc - K_ic.transpose() * inverse.solve(K_ic);

  const Eigen::VectorXd x = random_vector(c.size());
  report("  S x", deviation(bulk->product(x), S * x), 1e-11);
  report("  S^-1 b", deviation(bulk->solve(S * x), x), 1e-11);

  const Eigen::VectorXd r   = random_vector(3 * mesh.n_nodes());
  const Eigen::VectorXd r_t = T.transpose() * r, r_i = r_t(interior),
                        r_c = r_t(face);
  const auto folded         = bulk->condense(r);
  report("  condensed residual",
         deviation(folded.condensed,
                   r_c - K_ic.transpose() * inverse.solve(r_i)),
         1e-11);
  report("  its norm",
         std::abs(folded.norm_squared / r_t.squaredNorm() - 1.),
         1e-13);
  report("  that of the interior",
         std::abs(folded.interior_squared / r_i.squaredNorm() - 1.),
         1e-12);
  const Eigen::VectorXd dv = bulk->correction(x, folded);
  Eigen::VectorXd       expected(free.size());
  expected(face)     = x;
  expected(interior) = -inverse.solve(r_i + K_ic * x);
  report("  correction, sides too", deviation(dv, T * expected), 1e-11);

  contact[0] = true;
  try
    {
      bulk->set_contact(contact);
      report("  contact at a side is refused", false);
    }
  catch (const EntryError &error)
    {
      report("  contact at a side is refused",
             error.entry == "Expert / Bone / Solver");
    }
}



int
main()
{
  BodyParameters block;
  block.size          = {{5., 4., 2.}};
  block.cells         = {{5, 4, 3}};
  block.layer_grading = 1.5;
  check("Odd and even numbers of cells", block);
  block.cells         = {{6, 3, 1}};
  block.poisson_ratio = 0.45;
  check("A single layer, nearly incompressible", block);
  block.cells         = {{2, 1, 2}};
  block.poisson_ratio = 0.;
  check("Hardly any cells", block);
}
