#include <debond/system/load_step_parameters.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  bool
  ModelParameters::needs_matrix() const
  {
    return load_steps.follow_path ||
           std::any_of(chuck.component.begin(),
                       chuck.component.end(),
                       [](const ChuckComponentParameters &component) {
                         return component.loaded || component.stiffness != 0.;
                       });
  }



  namespace
  {
    /** Half the width of what the implant passes over on its way [mm]. */
    double
    reach_of_implant(const ModelParameters &model, const unsigned int direction)
    {
      const unsigned int c = ChuckComponent::translation_x + direction;
      const auto         function =
        model.chuck.value_over_time(c, model.implant.characteristic_radius());
      double way = 0.;
      for (const double time : model.load_steps.sample_times())
        way = std::max(way, std::abs(function(time)));
      // a block may turn
      return way + (model.implant.is_round() ?
                      model.implant.radius :
                      std::hypot(0.5 * model.implant.size[0],
                                 0.5 * model.implant.size[1]));
    }
  } // namespace



  std::string
  ModelParameters::why_direct() const
  {
    if (bone.material != Material::linear)
      return "the bone is not linear";
    if (!bone.has_equal_splines())
      return "the bone's cells are not splines of equal width";
    if (needs_matrix())
      return "a load or a spring on the chuck, or a path, takes the stiffness "
             "as a matrix";
    // contact elements reach two control points beyond themselves
    for (const unsigned int d : {0, 1})
      if (reach_of_implant(*this, d) >
          (0.5 - 3. / bone.cells[d]) * bone.size[d])
        return std::string("the implant comes to the sides of the bone in ") +
               "xy"[d];
    return "";
  }



  bool
  ModelParameters::is_on_lattice() const
  {
    return bone.bulk_solver != BulkSolver::direct && why_direct().empty();
  }



  std::string
  ModelParameters::bulk_solver_in_words() const
  {
    if (is_on_lattice())
      return "bulk solver of the bone: lattice, for cells of equal width";
    return "bulk solver: direct" + (bone.bulk_solver == BulkSolver::direct ?
                                      std::string(", as asked for") :
                                      ", as " + why_direct());
  }
} // namespace Debond
