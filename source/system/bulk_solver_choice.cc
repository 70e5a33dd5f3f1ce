#include <debond/system/load_step_parameters.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Whether a component of the chuck is an unknown. */
    bool
    is_free(const ModelParameters &model, const unsigned int component)
    {
      const auto &parameters = model.chuck.component[component];
      return parameters.loaded || parameters.stiffness != 0.;
    }



    /** The largest value of a prescribed component [mm, rad]. */
    double
    largest_value(const ModelParameters &model, const unsigned int component)
    {
      const auto function =
        model.chuck.value_over_time(component,
                                    model.implant.characteristic_radius());
      double largest = 0.;
      for (const double time : model.load_steps.sample_times())
        largest = std::max(largest, std::abs(function(time)));
      return largest;
    }



    /** Half the width of what the implant passes over on its way [mm], as far
     *  as that is prescribed. */
    double
    reach_of_implant(const ModelParameters &model, const unsigned int direction)
    {
      const unsigned int c   = ChuckComponent::translation_x + direction;
      const double       way = is_free(model, c) ? 0. : largest_value(model, c);
      // a block may turn
      return way + (model.implant.is_round() ?
                      model.implant.radius :
                      std::hypot(0.5 * model.implant.size[0],
                                 0.5 * model.implant.size[1]));
    }



    /** Whether the implant is pressed and tilted so little that strains, which
     *  are about its way over its radius, are below a hundredth. */
    bool
    is_pressed_lightly(const ModelParameters &model)
    {
      constexpr double largest_strain = 0.01;
      const double     R              = model.implant.characteristic_radius();
      double           way            = 0.;
      for (const unsigned int c : {ChuckComponent::translation_z,
                                   ChuckComponent::rotation_x,
                                   ChuckComponent::rotation_y})
        {
          if (is_free(model, c))
            return false;
          way += largest_value(model, c) * (is_rotation(c) ? R : 1.);
        }
      return way <= largest_strain * R;
    }
  } // namespace



  std::string
  ModelParameters::why_direct() const
  {
    if (bone.material == Material::rigid)
      return "the bone is rigid";
    if (!bone.has_equal_splines())
      return "the bone's cells are not splines of equal width";
    if (load_steps.follow_path)
      return "a path takes the stiffness as a matrix";
    // contact elements reach two control points beyond themselves
    for (const unsigned int d : {0, 1})
      if (reach_of_implant(*this, d) >
          (0.5 - 3. / bone.cells[d]) * bone.size[d])
        return std::string("the implant comes to the sides of the bone in ") +
               "xy"[d];
    return "";
  }



  // What is possible may still end badly: on the lattice the implant must not
  // come to the sides, and the stiffness of a Neo-Hookean bone stays that at
  // rest, which Newton's method gets along with as long as strains are small.
  std::string
  ModelParameters::why_rather_direct() const
  {
    for (const unsigned int d : {0, 1})
      if (is_free(*this, ChuckComponent::translation_x + d))
        return std::string("the implant may go anywhere in ") + "xy"[d];
    if (bone.material == Material::neo_hookean && !is_pressed_lightly(*this))
      return "strains of the Neo-Hookean bone may be large";
    return "";
  }



  bool
  ModelParameters::is_on_lattice() const
  {
    return bone.bulk_solver != BulkSolver::direct && why_direct().empty() &&
           (bone.bulk_solver == BulkSolver::lattice ||
            why_rather_direct().empty());
  }



  bool
  ModelParameters::needs_matrix() const
  {
    if (load_steps.follow_path)
      return true;
    bool has_unknowns = false;
    for (unsigned int c = 0; c < ChuckParameters::n_components; ++c)
      has_unknowns = has_unknowns || is_free(*this, c);
    return has_unknowns && !is_on_lattice();
  }



  std::string
  ModelParameters::bulk_solver_in_words() const
  {
    if (is_on_lattice())
      return "bulk solver of the bone: lattice, for cells of equal width";
    if (bone.bulk_solver == BulkSolver::direct)
      return "bulk solver: direct, as asked for";
    return "bulk solver: direct, as " +
           (why_direct().empty() ? why_rather_direct() : why_direct());
  }
} // namespace Debond
