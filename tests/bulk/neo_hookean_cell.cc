// Energy, internal forces and tangent of the bulk's cells, ordinary and
// enriched, agree with automatic differentiation of the energy, written here
// anew from the deformation gradient. Small strains cost no digits.

#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/neo_hookean.h>

#include <Eigen/Geometry>

#include <Sacado.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cauchy_stress.h"
#include "checks.h"

using namespace Debond;

// Up to 27 nodes.
constexpr int n_seeds = 81;
using First           = Sacado::Fad::SFad<double, n_seeds>;
using Number          = Sacado::Fad::SFad<First, n_seeds>;

/** The three quadratic splines M on a span between the knots @p u[2] and
 *  @p u[3] at x, and their derivatives, by the recursion of Cox and de Boor. */
std::array<Eigen::Vector2d, 3>
quadratic_splines(const std::array<double, 6> &u, const double x)
{
  const double left = (u[3] - x) / (u[3] - u[2]), right = 1. - left;
  const double a = (x - u[1]) / (u[3] - u[1]), b = (u[4] - x) / (u[4] - u[2]);
  const double slope = 2. / (u[3] - u[1]), next = 2. / (u[4] - u[2]);
  return {{{(1. - a) * left, -slope * left},
           {a * left + b * right, slope * left - next * right},
           {(1. - b) * right, next * right}}};
}

/** Of the triquadratic function of a node of a box, known by its place there,
 *  with respect to the local coordinates at a point of [-1,1]^3. */
Eigen::Vector3d
triquadratic_gradient(const Eigen::Vector3d &place,
                      const Eigen::Vector3d &point)
{
  Eigen::Vector3d N, dN;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const double x = point[d], s = std::round(place[d]);
      N[d]  = s == 0. ? 1. - x * x : 0.5 * x * (x + s);
      dN[d] = s == 0. ? -2. * x : x + 0.5 * s;
    }
  return {dN[0] * N[1] * N[2], N[0] * dN[1] * N[2], N[0] * N[1] * dN[2]};
}

/** Derivatives of all shape functions of a cell with respect to its local
 *  coordinates at a point of [-1,1]^3, the interpolation of the theory. */
std::vector<Eigen::Vector3d>
local_gradients(const BulkSpace       &mesh,
                const BulkSpace::Cell &cell,
                const Eigen::Vector3d &point)
{
  // of quadratic elements the cell is a box, that of its nodes of FE_Q
  const bool   is_quadratic = mesh.degree() == 2 && !mesh.has_splines();
  const double z            = point[2],
               near       = is_quadratic ? 0.5 * z * (z - 1.) : 0.5 * (1. - z),
               slope_near = is_quadratic ? z - 0.5 : -0.5, far = 0.5 * (1. + z);
  std::vector<Eigen::Vector3d> dN;
  if (cell.enriched || mesh.has_splines())
    {
      const auto   bounds = mesh.surface().element_bounds(cell.surface_element);
      const double h_1    = 0.5 * (bounds[1][0] - bounds[0][0]);
      const double h_2    = 0.5 * (bounds[1][1] - bounds[0][1]);
      SurfaceBasis basis;
      mesh.surface().evaluate_in_element(cell.surface_element,
                                         {bounds[0][0] + h_1 * (1. + point[0]),
                                          bounds[0][1] + h_2 * (1. + point[1])},
                                         basis);
      if (mesh.has_splines())
        {
          const auto           &ends = mesh.depth().breakpoints();
          const int             last = ends.size() - 1, layer = cell.layer;
          std::array<double, 6> u;
          for (int i = 0; i < 6; ++i)
            u[i] = ends[std::clamp(layer - 2 + i, 0, last)];
          const double h = u[3] - u[2];
          for (const Eigen::Vector2d &M : quadratic_splines(u, u[2] + far * h))
            for (unsigned int a = 0; a < basis.size; ++a)
              dN.emplace_back(M[0] * basis.N_1[a] * h_1,
                              M[0] * basis.N_2[a] * h_2,
                              M[1] * 0.5 * h * basis.N[a]);
          return dN;
        }
      for (unsigned int a = 0; a < basis.size; ++a)
        dN.emplace_back(near * basis.N_1[a] * h_1,
                        near * basis.N_2[a] * h_2,
                        slope_near * basis.N[a]);
    }
  if (is_quadratic)
    {
      Eigen::Array3d lower = 1e9 * Eigen::Array3d::Ones(), upper = -lower;
      for (const unsigned int vertex : cell.vertices)
        {
          lower = lower.min(mesh.reference_position(vertex).array());
          upper = upper.max(mesh.reference_position(vertex).array());
        }
      for (unsigned int a = dN.size(); a < cell.nodes.size(); ++a)
        {
          const Eigen::Array3d X     = mesh.reference_position(cell.nodes[a]);
          Eigen::Vector3d      place = 2. * (X - lower) / (upper - lower) - 1.;
          place[2] *= -mesh.outward_sign(); // from the contact face, too
          dN.push_back(triquadratic_gradient(place, point));
        }
      return dN;
    }
  // the opposite face of an enriched cell, or both faces of an ordinary one
  for (unsigned int face = (cell.enriched ? 1 : 0); face < 2; ++face)
    for (const double t : {-1., 1.})
      for (const double s : {-1., 1.})
        {
          const double z  = (face == 0 ? near : far);
          const double dz = (face == 0 ? -0.5 : 0.5);
          dN.emplace_back(z * 0.25 * s * (1. + t * point[1]),
                          z * 0.25 * t * (1. + s * point[0]),
                          dz * 0.25 * (1. + s * point[0]) *
                            (1. + t * point[1]));
        }
  return dN;
}



/** W = G/2 (tr C - 3) - G ln J + Lambda/2 (ln J)^2 as it stands in Eq. (1). */
template <typename N>
N
energy_density(const double G, const double Lambda, const N (&F)[3][3])
{
  using std::log;
  N trace_C = 0.;
  for (const auto &row : F)
    for (const N &entry : row)
      trace_C += entry * entry;
  const N J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
              F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
              F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
  const N ln_J = log(J);
  return 0.5 * G * (trace_C - 3.) - G * ln_J + 0.5 * Lambda * ln_J * ln_J;
}



/** The energy of a cell with its first and second derivatives with respect to
 *  the positions of its nodes. */
Number
cell_energy(const BulkSpace       &mesh,
            const BulkSpace::Cell &cell,
            const Eigen::VectorXd &v,
            const double           G,
            const double           Lambda)
{
  const unsigned int  n = cell.nodes.size();
  std::vector<Number> x(3 * n);
  for (unsigned int i = 0; i < 3 * n; ++i)
    {
      const unsigned int node = cell.nodes[i / 3];
      const double       position =
        mesh.reference_position(node)[i % 3] + v[3 * node + i % 3];
      x[i]       = Number(n_seeds, i, First(position));
      x[i].val() = First(n_seeds, i, position);
    }

  // points and weights on [-1,1]
  using Rule        = std::vector<std::pair<double, double>>;
  const Rule rule   = mesh.degree() == 2 && !mesh.has_splines() ?
                        Rule{{-std::sqrt(0.6), 5. / 9.},
                           {0., 8. / 9.},
                           {std::sqrt(0.6), 5. / 9.}} :
                        Rule{{-1. / std::sqrt(3.), 1.}, {1. / std::sqrt(3.), 1.}};
  Number     energy = 0.;
  for (const auto &[z, w_z] : rule)
    for (const auto &[t, w_t] : rule)
      for (const auto &[s, w_s] : rule)
        {
          const auto      dN = local_gradients(mesh, cell, {s, t, z});
          Eigen::Matrix3d dX = Eigen::Matrix3d::Zero();
          for (unsigned int a = 0; a < n; ++a)
            dX += mesh.reference_position(cell.nodes[a]) * dN[a].transpose();
          const Eigen::Matrix3d inverse = dX.inverse();
          Number                F[3][3];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              {
                F[i][j] = 0.;
                for (unsigned int a = 0; a < n; ++a)
                  F[i][j] += Number(x[3 * a + i] * dN[a].dot(inverse.col(j)));
              }
          energy += w_z * w_t * w_s * std::abs(dX.determinant()) *
                    energy_density(G, Lambda, F);
        }
  return energy;
}



struct Deviation
{
  double energy = 0, force = 0, tangent = 0;
};

double
relative_deviation(const Eigen::MatrixXd &ours,
                   const Eigen::MatrixXd &reference)
{
  const double scale = reference.cwiseAbs().maxCoeff();
  double       worst = 0;
  for (unsigned int k = 0; k < ours.size(); ++k)
    grow(worst, std::abs(ours(k) - reference(k)) / scale);
  return worst;
}

/** Compares a whole body whose nodes are displaced at random by @p amplitude
 *  and stretched a little. */
void
check(const std::string    &name,
      const BodyParameters &parameters,
      const Side            side,
      const double          amplitude)
{
  const BulkSpace  mesh(parameters, side);
  const NeoHookean material =
    NeoHookean::from_young(parameters.young_modulus, parameters.poisson_ratio);
  const double nu     = parameters.poisson_ratio;
  const double G      = parameters.young_modulus / (2. + 2. * nu); // Eq. (2)
  const double Lambda = 2. * G * nu / (1. - 2. * nu);

  const EnrichedCells cells(mesh, material);
  Eigen::VectorXd     v(3 * mesh.n_nodes());
  for (double &component : v)
    component = amplitude * random_number(-1., 1.);

  double                        energy = 0, reference_energy = 0;
  Eigen::VectorXd               force = Eigen::VectorXd::Zero(v.size());
  Eigen::VectorXd               reference_force = force;
  Deviation                     deviation;
  unsigned int                  n_enriched = 0, n_ordinary = 0;
  const std::unique_ptr<Number> W = std::make_unique<Number>();
  for (unsigned int c = 0; c < cells.n_cells(); ++c)
    {
      const BulkSpace::Cell &cell = mesh.cells()[c];
      ++(cell.enriched ? n_enriched : n_ordinary);
      *W = cell_energy(mesh, cell, v, G, Lambda);
      reference_energy += W->val().val();
      const unsigned int n = 3 * cell.nodes.size();
      Eigen::MatrixXd    K, reference_K(n, n);
      for (unsigned int i = 0; i < n; ++i)
        {
          reference_force[3 * cell.nodes[i / 3] + i % 3] += W->dx(i).val();
          for (unsigned int j = 0; j < n; ++j)
            reference_K(i, j) = W->dx(i).dx(j);
        }
      cells.tangent(c, v, K);
      grow(deviation.tangent, relative_deviation(K, reference_K));
    }
  const bool valid = cells.internal_forces(v, force, energy);
  grow(deviation.energy, std::abs(energy / reference_energy - 1.));
  grow(deviation.force, relative_deviation(force, reference_force));

  std::cout << name << ", " << n_enriched << " enriched and " << n_ordinary
            << " ordinary cells" << std::endl;
  report("  no cell turned inside out", valid);
  report("  relative deviation of the energy", deviation.energy, 1e-9);
  report("  relative deviation of the forces", deviation.force, 1e-9);
  report("  relative deviation of the tangent", deviation.tangent, 1e-9);

  // strains of 1e-9, where the material is linear
  Eigen::VectorXd linear_force = Eigen::VectorXd::Zero(v.size());
  v *= 1e-9 / amplitude;
  for (unsigned int c = 0; c < cells.n_cells(); ++c)
    {
      Eigen::MatrixXd K;
      cells.tangent(c, Eigen::VectorXd::Zero(v.size()), K);
      const std::vector<unsigned int> &nodes = mesh.cells()[c].nodes;
      for (unsigned int i = 0; i < K.rows(); ++i)
        for (unsigned int j = 0; j < K.cols(); ++j)
          linear_force[3 * nodes[i / 3] + i % 3] +=
            K(i, j) * v[3 * nodes[j / 3] + j % 3];
    }
  force.setZero();
  cells.internal_forces(v, force, energy);
  report("  strains of 1e-9: relative deviation of the forces",
         relative_deviation(force, linear_force),
         1e-6);
  report("  strains of 1e-9: relative deviation of the energy",
         std::abs(2. * energy / v.dot(linear_force) - 1.),
         1e-6);

  // one node pulled through its cell
  v.setZero();
  v[3 * mesh.cells()[0].nodes.back() + 2] = 100. * parameters.thickness();
  v[3 * mesh.cells()[0].nodes[0] + 2]     = -100. * parameters.thickness();
  report("  a cell turned inside out is noticed",
         !cells.internal_forces(v, force, energy) ||
           !cells.internal_forces(-v, force, energy));
}



/** Stresses and energy at strains of 1e-9, where F - F^-T and ln J would have
 *  lost nine digits: there the material is linear. */
void
check_small_strains()
{
  const NeoHookean material = NeoHookean::from_young(18000., 0.3);
  double           piola = 0, energy = 0;
  for (unsigned int trial = 0; trial < 100; ++trial)
    {
      double          H[3][3], P[3][3];
      Eigen::Matrix3d H_matrix, P_matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          H[i][j] = H_matrix(i, j) = 1e-9 * random_number(-1., 1.);
      material.stress(H, P);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          P_matrix(i, j) = P[i][j];
      // Hooke's law
      const Eigen::Matrix3d strain = 0.5 * (H_matrix + H_matrix.transpose());
      const Eigen::Matrix3d hooke =
        18000. / 1.3 *
        (strain + 0.3 / 0.4 * strain.trace() * Eigen::Matrix3d::Identity());
      grow(piola, relative_deviation(P_matrix, hooke));
      grow(energy,
           std::abs(material.energy(H) /
                      (0.5 * hooke.cwiseProduct(strain).sum()) -
                    1.));
    }
  std::cout << "Strains of 1e-9" << std::endl;
  report("  Piola-Kirchhoff stress, deviation from Hooke's law", piola, 1e-7);
  report("  energy, deviation from Hooke's law", energy, 1e-6);
}



/** P F^T / J is the Cauchy stress of Eq. (1). */
void
check_cauchy_stress()
{
  const NeoHookean material  = NeoHookean::from_young(18000., 0.3);
  double           deviation = 0;
  for (unsigned int trial = 0; trial < 100; ++trial)
    {
      double          H[3][3], P[3][3];
      Eigen::Matrix3d F, P_matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            H[i][j] = random_number(-0.2, 0.2);
            F(i, j) = H[i][j] + (i == j ? 1. : 0.);
          }
      material.stress(H, P);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          P_matrix(i, j) = P[i][j];
      grow(deviation,
           relative_deviation(
             P_matrix * F.transpose() / F.determinant(),
             neo_hookean_stress(material, F - Eigen::Matrix3d::Identity())));
    }
  report("Cauchy stress at large strains, deviation from P F^T / J",
         deviation,
         1e-12);
}



int
main()
{
  BodyParameters bone;
  bone.size          = {{2., 3., 1.}};
  bone.cells         = {{2, 1, 2}};
  bone.layer_grading = 1.5;
  BodyParameters coin;
  coin.shape         = BodyShape::coin;
  coin.radius        = 1.2;
  coin.height        = 0.8;
  coin.cells         = {{2, 2, 2}};
  coin.young_modulus = 113000;
  coin.poisson_ratio = 0.34;

  check("Block, large strains", bone, Side::bone, 0.06);
  check("Block, small strains", bone, Side::bone, 1e-3);
  check("Coin, large strains", coin, Side::implant, 0.04);
  check("Coin, small strains", coin, Side::implant, 1e-3);
  bone.element = coin.element = ElementKind::spline;
  bone.cells                  = {{2, 2, 3}};
  check("Block, splines", bone, Side::bone, 0.06);
  check("Coin, splines", coin, Side::implant, 0.04);
  bone.element = ElementKind::quadratic;
  bone.cells   = {{2, 2, 2}};
  check("Block, quadratic", bone, Side::bone, 0.02);
  bone.element = coin.element = ElementKind::trilinear;
  bone.cells                  = {{2, 1, 2}};
  bone.contact_surface        = SurfaceKind::bilinear;
  check("Block, bilinear", bone, Side::bone, 0.06);
  coin.contact_surface = SurfaceKind::bilinear;
  check("Coin, bilinear", coin, Side::implant, 0.04);
  check_small_strains();
  check_cauchy_stress();
}
