// A linear body is condensed in four classes of motions, by what two mirrors
// make of them. What comes of it is that of the whole stiffness, condensed
// here as a dense matrix: even and odd numbers of cells, all elements,
// hanging nodes, and contact on a part of the face that is not symmetric
// itself. Bodies whose mesh is not its own mirror image, whatever the shape,
// give that of the whole stiffness, too.

#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/mirror_symmetry.h>
#include <debond/bulk/neo_hookean.h>

#include <Eigen/LU>

#include <algorithm>
#include <string>
#include <vector>

#include "checks.h"
#include "stiffness_at_rest.h"
#include "vectors.h"

using namespace Debond;

void
check(const std::string &name, const BulkSpace &mesh)
{
  const BodyParameters &parameters = mesh.parameters();
  const auto            bulk       = make_condensed_bulk(
    mesh,
    EnrichedCells(mesh,
                  NeoHookean::from_young(parameters.young_modulus,
                                         parameters.poisson_ratio)));
  const unsigned int n_cp = mesh.surface().n_control_points();
  std::vector<bool>  contact(n_cp, false);
  for (unsigned int A = 0; A < n_cp; ++A)
    contact[A] = A % 3 == 0 || A < n_cp / 2;
  const std::vector<unsigned int> c = bulk->set_contact(contact);
  std::cout << name << std::endl;
  report("  linearised",
         bulk->linearise(Eigen::VectorXd::Zero(3 * mesh.n_nodes())));

  std::vector<unsigned int> interior;
  bool                      all_found = true;
  for (unsigned int dof = 0; dof < 3 * mesh.n_nodes(); ++dof)
    if (!mesh.is_tied(dof / 3) && !mesh.is_fixed(dof / 3, dof % 3))
      {
        const bool is_unknown = std::find(c.begin(), c.end(), dof) != c.end();
        if (!is_unknown)
          interior.push_back(dof);
        const unsigned int first = mesh.control_point_node(0);
        all_found = all_found && (is_unknown || dof / 3 < first ||
                                  !contact[dof / 3 - first]);
      }
  report("  all that is asked for is an unknown", all_found);
  const Eigen::MatrixXd K = stiffness_at_rest(mesh), K_cc = K(c, c),
                        K_ic = K(interior, c), K_ii = K(interior, interior);
  const Eigen::PartialPivLU<Eigen::MatrixXd> inverse(K_ii);
  const Eigen::MatrixXd S = K_cc - K_ic.transpose() * inverse.solve(K_ic);

  const Eigen::VectorXd x = random_vector(c.size());
  report("  S", deviation(bulk->dense_stiffness(), S), 1e-11);
  report("  S x", deviation(bulk->product(x), S * x), 1e-11);
  report("  S^-1 b", deviation(bulk->solve(S * x), x), 1e-9);

  const Eigen::VectorXd r   = random_vector(3 * mesh.n_nodes());
  const Eigen::VectorXd r_i = r(interior), r_c = r(c);
  const auto            folded = bulk->condense(r);
  report("  condensed residual",
         deviation(folded.condensed,
                   r_c - K_ic.transpose() * inverse.solve(r_i)),
         1e-11);
  report("  its norm",
         std::abs(
           folded.norm_squared / (r_i.squaredNorm() + r_c.squaredNorm()) - 1.),
         1e-13);
  report("  that of the interior",
         std::abs(folded.interior_squared / r_i.squaredNorm() - 1.),
         1e-12);
  const Eigen::VectorXd dv = bulk->correction(x, folded);
  report("  correction of the interior",
         deviation(dv(interior), -inverse.solve(r_i + K_ic * x)),
         1e-11);
  report("  of the unknowns", deviation(dv(c), x), 1e-14);
}



void
check(const std::string &name, BodyParameters parameters, const Side side)
{
  parameters.material = Material::linear;
  check(name, BulkSpace(parameters, side));
}



/** A block on faces that are no mirror images by what a shape may do wrong:
 *  it lies beside the middle, its cells are graded to one side, or a control
 *  point or a weight is another one. */
void
check_unsymmetric(const ElementKind element, const std::string &name)
{
  BodyParameters block;
  block.material        = Material::linear;
  block.element         = element;
  block.size            = {{5., 4., 2.}};
  block.cells           = {{5, 4, 2}};
  block.lateral_grading = 1.2; // splines are no lattice
  const KnotVector knots_1 =
                     KnotVector::from_breakpoints(2,
                                                  block.lateral_fractions(0)),
                   knots_2 =
                     KnotVector::from_breakpoints(2,
                                                  block.lateral_fractions(1));
  const NurbsSurface face = NurbsSurface::rectangle(5., 4., knots_1, knots_2);
  const auto         changed = [&](const unsigned int     A,
                           const Eigen::Vector3d &motion,
                           const double           weight) {
    ControlNet          points  = face.control_points();
    std::vector<double> weights = face.weights();
    points.col(A) += motion;
    weights[A] = weight;
    return NurbsSurface(knots_1, knots_2, points, weights);
  };
  const auto show = [&](const std::string  &what,
                        const NurbsSurface &surface,
                        const bool          is_mirrored = false) {
    for (const Side side : both_sides)
      {
        const BulkSpace mesh(block, side, surface);
        check(what + " as " + name_of(side) + name, mesh);
        report(is_mirrored ? "  is its own mirror image" :
                             "  is not its own mirror image",
               MirrorSymmetry::of(mesh, EnrichedCells(mesh, NeoHookean()))
                   .has_value() == is_mirrored);
      }
  };
  ControlNet shifted = face.control_points();
  shifted.row(1).array() += 0.5;
  show("Shifted face", NurbsSurface(knots_1, knots_2, shifted, face.weights()));
  show("Graded to one side",
       NurbsSurface::rectangle(
         5.,
         4.,
         KnotVector::from_breakpoints(2, {0., 0.1, 0.25, 0.45, 0.7, 1.}),
         knots_2));
  // the control point i = 2 of 7, j = 1 of 6
  show("One control point", changed(2 + 7 * 1, {0.1, 0.05, 0.}, 1.));
  show("One weight", changed(2 + 7 * 1, Eigen::Vector3d::Zero(), 0.8));
  show("Nothing changed", face, true);
}



/** Cells that follow the rim, in patches that are turned; with a modulus that
 *  differs they are taken as a whole. */
void
check_fitted()
{
  BodyParameters coin, bone;
  coin.shape   = BodyShape::coin;
  coin.element = bone.element = ElementKind::spline;
  coin.fitted_cells           = {{8, 1, 0}};
  coin.cells                  = {{4, 4, 2}};
  bone.fitted_cells           = {{8, 1, 1}};
  bone.cells                  = {{5, 5, 2}};
  bone.size                   = {{9., 8., 3.}};
  bone.rim                    = {{coin.radius, coin.radius}};
  for (const auto &[body, side] :
       {std::pair(&coin, Side::implant), std::pair(&bone, Side::bone)})
    {
      const BulkSpace mesh(*body, side);
      check(std::string("Fitted cells of ") +
              (side == Side::bone ? "bone" : "coin"),
            mesh);
      report("  are their own mirror image",
             MirrorSymmetry::of(mesh, EnrichedCells(mesh, NeoHookean()))
               .has_value());
    }
}



int
main()
{
  check_fitted();
  for (const ElementKind element :
       {ElementKind::trilinear, ElementKind::quadratic, ElementKind::spline})
    {
      const std::string name = element == ElementKind::spline ? ", splines" :
                               element == ElementKind::quadratic ?
                                                                ", quadratic" :
                                                                ", trilinear";
      BodyParameters    block;
      block.element       = element;
      block.size          = {{5., 4., 2.}};
      block.cells         = {{5, 4, 2}};
      block.layer_grading = 1.5;
      check("Block as bone" + name, block, Side::bone);
      check("Block as implant" + name, block, Side::implant);
      if (element != ElementKind::spline)
        {
          block.cells         = {{6, 4, 3}};
          block.coarser_below = true;
          check("Block, coarser below" + name, block, Side::bone);
          block.coarser_below = false;
        }
      BodyParameters coin;
      coin.element = element;
      coin.shape   = BodyShape::coin;
      coin.cells   = {{3, 3, 2}};
      check("Coin" + name, coin, Side::implant);
      coin.shape      = BodyShape::cap;
      coin.cap_radius = 6.;
      coin.cells      = {{4, 4, 2}};
      check("Cap" + name, coin, Side::implant);
      check_unsymmetric(element, name);
    }
}
