#include <debond/system/coupled_system.h>

#include <cmath>

// Cyclic symmetry of a scene: whether turns about the z axis leave bodies, bond
// and load as they are. All of it is asked for: places and functions of both
// surfaces (CyclicSymmetry), phi_0 at the points (ContactInterface), and, here,
// load, law and the resistance of the bodies.
namespace Debond
{
  // Other values than those along z and about it are 0 as a number, not as an
  // expression: that might be 0 at some times only.
  bool
  CoupledSystem::is_axial(const ChuckParameters &chuck)
  {
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const auto &component = chuck.component[k];
        if (k != ChuckComponent::translation_z &&
            k != ChuckComponent::rotation_z &&
            (component.is_unknown() || !component.file.empty() ||
             component.function ||
             component.value.find_first_not_of(" -0.") != std::string::npos))
          return false;
      }
    return true;
  }



  // Laws with strength in tension are left out: their uniqueness is asked for
  // among all motions, also those that open the bond on one side only.
  std::optional<SectorsOfSurfaces>
  CoupledSystem::find_sectors(const unsigned int most) const
  {
    if (!load_is_axial || bone.whole() || interface.get_law().pulls() ||
        interface.get_law().cohesion ||
        chuck.reference_centre().head<2>().norm() > 1e-12 * R)
      return {};
    // Of the master a point in each element is enough to know its functions.
    const auto points = [this](const Side side) {
      return surface_quadrature(body[side]->surface(),
                                side == interface.slave_side() ?
                                  interface.points_per_element() :
                                  dealii::QMidpoint<1>());
    };
    const auto of_implant = points(Side::implant);
    for (unsigned int n = most; n > 1; --n)
      if (auto on_implant =
            CyclicSymmetry::of(implant.surface(), of_implant, n))
        if (auto on_bone =
              CyclicSymmetry::of(bone.surface(), points(Side::bone), n))
          {
            ControlNet       outwards = press_fit.direction();
            const ControlNet own      = outwards;
            if (!press_fit.is_none())
              on_implant->average(outwards);
            if ((outwards - own).norm() <= 1e-12 * own.norm())
              return SectorsOfSurfaces{
                {std::move(*on_bone), std::move(*on_implant)}};
          }
    return {};
  }



  // What no plan of a mesh tells, supports and stiffness at every place, shows
  // in the forces of some motion that has the symmetry: they have it, too. So
  // do components that are held on one side and free on its image, which the
  // motion lacks but not the forces. What is not symmetric in them no iteration
  // could remove: it has to be less than any residual that is asked for.
  bool
  CoupledSystem::bodies_have(const SectorsOfSurfaces &sectors_of_surfaces) const
  {
    const FoldedUnknowns folding(sectors_of_surfaces, configuration, unknowns);
    Eigen::VectorXd      y(folding.size());
    for (unsigned int i = 0; i < y.size(); ++i)
      y[i] = std::sin(1. + i * i); // any
    const Eigen::VectorXd forces = matrix.bulk_product(folding.unfold(y));
    const Eigen::VectorXd even =
      folding.unfold(folding.fold(forces).cwiseQuotient(folding.n_images()));
    return (forces - even).norm() <= 1e-12 * forces.norm();
  }



  // The largest number of sectors is a multiple of all others. It may be too
  // large for the bodies: a pin that is solid has a square core.
  void
  CoupledSystem::choose_sectors(std::optional<SectorsOfSurfaces> found)
  {
    while (found && !(bodies_have(*found) && interface.keep_one_sector(*found)))
      found = find_sectors((*found)[Side::bone].n_sectors() - 1);
    if (found)
      number_unknowns();
  }



  // In the unknowns of one sector, where there are sectors.
  Eigen::VectorXd
  CoupledSystem::solve_condensed(const Eigen::VectorXd &b,
                                 const double           relative_tolerance)
  {
    if (!folded)
      return solver.solve(matrix, b, relative_tolerance);
    return folded->unfold(
      solver.solve(FoldedTangent(matrix, *folded, folded_bulk),
                   folded->fold(b),
                   relative_tolerance));
  }
} // namespace Debond
