#include <debond/bulk/bulk_space.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/load_step_parameters.h>
#include <debond/system/memory_estimate.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** The largest value that the scene wants of a component, in its units
     *  [mm, degrees; N, N mm of a load], also between the planned times, where
     *  adaptive steps may end. */
    double
    largest_value(const ModelParameters &model, const unsigned int component)
    {
      double largest = 0.;
      for (const double value : model.sampled_values(component))
        largest = std::max(largest, std::abs(value));
      return largest;
    }



    /** The largest way of a component of the chuck at a distance of @p arm [mm]
     *  from its reference point: that of a rotation, or of a translation. A
     *  free rotation is taken for 5 degrees, a free translation for none. */
    double
    largest_way(const ModelParameters &model,
                const unsigned int     component,
                const double           arm)
    {
      const bool is_free = model.chuck.component[component].is_unknown();
      if (!is_rotation(component))
        return is_free ? 0. : largest_value(model, component);
      return arm * M_PI / 180. *
             (is_free ? 5. : largest_value(model, component));
    }



    /** Half the width of what the implant passes over on its way [mm], as far
     *  as that is prescribed. Tilted about the chuck, at its top, the face
     *  moves sideways. */
    double
    reach_of_implant(const ModelParameters &model, const unsigned int direction)
    {
      const unsigned int tilt = direction == 0 ? ChuckComponent::rotation_y :
                                                 ChuckComponent::rotation_x;
      // a block may turn
      return largest_way(model, ChuckComponent::translation_x + direction, 0.) +
             largest_way(model, tilt, model.implant.thickness()) +
             model.implant.geometry().reach;
    }



    /** True if the implant is pressed and tilted so little that strains of the
     *  bone are below a hundredth. They are about its way over its radius or
     *  the thickness of the bone, and of a load the pressure over Young's
     *  modulus; and what friction adds, mu p / G. */
    bool
    is_pressed_lightly(const ModelParameters &model)
    {
      constexpr double largest_strain = 0.01, E_over_G = 3.;
      const double     R  = model.implant.characteristic_radius(),
                   length = std::min(R, model.bone.thickness()),
                   mu     = model.interface.friction->coefficient({}, 0.).mu;
      double strain       = 0.;
      for (const unsigned int c : {ChuckComponent::translation_z,
                                   ChuckComponent::rotation_x,
                                   ChuckComponent::rotation_y})
        if (model.chuck.component[c].loaded)
          strain += largest_value(model, c) / (is_rotation(c) ? R : 1.) /
                    (M_PI * R * R * model.bone.young_modulus);
        else // a spring gives way, and presses no further than its machine
          strain += largest_value(model, c) *
                    (is_rotation(c) ? R * M_PI / 180. : 1.) / length;
      return (1. + E_over_G * mu) * strain <= largest_strain;
    }



    /** Why a bone that the lattice solver could do is better solved directly,
     *  as the rest of a sentence; empty: it is not. A free implant may come to
     *  the sides, where the lattice solver ends the run, and with large strains
     *  its tangent, that at rest, leads Newton's method slowly or not at all.
     */
    std::string
    why_rather_direct(const ModelParameters &model)
    {
      for (const unsigned int d : {0, 1})
        if (model.chuck.component[ChuckComponent::translation_x + d]
              .is_unknown())
          return std::string("the implant may go anywhere in ") + "xy"[d];
      if (model.bone.has_large_strains() && !is_pressed_lightly(model))
        return "strains of the Neo-Hookean bone may be large";
      return "";
    }
  } // namespace



  std::string
  ModelParameters::why_not_lattice() const
  {
    if (bone.material == Material::rigid)
      return "the bone is rigid";
    if (!bone.has_equal_splines())
      return "the bone's cells are not splines of equal width";
    if (bone.modulus && !bone.modulus->is_layered)
      return "Young's modulus of the bone varies across";
    if (load_steps.follow_path)
      return "a path takes the stiffness as a matrix";
    // contact elements reach two control points beyond themselves
    for (const unsigned int d : {0, 1})
      if (reach_of_implant(*this, d) >
          (0.5 - 3. / bone.cells[d]) * bone.size[d])
        return std::string("the implant comes within three cells of the sides "
                           "of the bone in ") +
               "xy"[d];
    return "";
  }



  std::string
  ModelParameters::why_off_lattice() const
  {
    if (bone.bulk_solver == BulkSolver::direct)
      return "asked for";
    const std::string why = why_not_lattice();
    return why.empty() && bone.bulk_solver != BulkSolver::lattice ?
             why_rather_direct(*this) :
             why;
  }



  // Where memory is enough factors mostly win: they are made once, and an
  // iteration with them costs next to nothing.
  std::string
  ModelParameters::why_multigrid() const
  {
    if (Ranks::number() > 1)
      return "for " + std::to_string(Ranks::number()) + " processes";
    if (bone.bulk_solver == BulkSolver::multigrid)
      return "as asked for";
    if (bone.bulk_solver != BulkSolver::automatic)
      return "";
    // What the machine had when it was asked first [GB], so that the choice is
    // the same at all times. CHOLMOD counts entries by int: 17 GB.
    static const double machine = 1e-3 * available_memory_MB();
    const double        most    = std::min(0.9 * machine, 16.),
                 factors =
                   MemoryEstimate(*this, BulkSolver::direct, false).bone;
    return factors <= most ?
             "" :
             "as factors would take some " + to_text(factors, 2) +
               " GB of memory, and may take " + to_text(most, 2);
  }



  void
  ModelParameters::check_ranks() const
  {
    const unsigned int n      = Ranks::number();
    const auto         refuse = [](const std::string &why) {
      throw EntryError("Expert / Bone / Solver", why);
    };
    if (bone.is_rigid())
      return; // nothing is dealt out
    if (n > 1 && bone.is_fitted())
      throw EntryError("Bone / Cells",
                       "cells that are fitted are for one process, and here "
                       "are " +
                         std::to_string(n) + ": expected numbers");
    if (n > 1 && (bone.bulk_solver == BulkSolver::direct ||
                  bone.bulk_solver == BulkSolver::lattice))
      refuse("that solver is for one process, and here are " +
             std::to_string(n) +
             ": expected auto or multigrid, or one process");
  }



  BulkSolver
  ModelParameters::bulk_solver() const
  {
    if (bone.is_rigid())
      return BulkSolver::direct; // there is nothing to solve
    if (Ranks::number() > 1 || bone.bulk_solver == BulkSolver::multigrid)
      return BulkSolver::multigrid;
    if (why_off_lattice().empty())
      return BulkSolver::lattice;
    return why_multigrid().empty() ? BulkSolver::direct : BulkSolver::multigrid;
  }



  std::string
  ModelParameters::bulk_solver_in_words() const
  {
    const std::string whose = "bulk solver of the bone: ";
    switch (bulk_solver())
      {
        case BulkSolver::multigrid:
          return whose + "multigrid, " + why_multigrid();
        case BulkSolver::lattice:
          return whose + "lattice, for cells of equal width";
        default:
          return whose + "direct, as " + why_off_lattice();
      }
  }
} // namespace Debond
