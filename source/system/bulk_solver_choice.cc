#include <debond/system/load_step_parameters.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** The largest value of a prescribed component [mm, degrees], also between
     *  the planned times, where adaptive steps may end. */
    double
    largest_value(const ModelParameters &model, const unsigned int component)
    {
      constexpr unsigned int    n_between = 10;
      const std::vector<double> times     = model.load_steps.sample_times();
      const auto                function =
        model.chuck.value_over_time(component,
                                    model.implant.characteristic_radius());
      double largest = std::abs(function(times.front()));
      for (unsigned int i = 1; i < times.size(); ++i)
        for (unsigned int k = 1; k <= n_between; ++k)
          {
            const double time = times[i] - (times[i] - times[i - 1]) *
                                             (n_between - k) / n_between;
            largest = std::max(largest, std::abs(function(time)));
          }
      return largest;
    }



    /** Half the width of what the implant passes over on its way [mm], as far
     *  as that is prescribed. */
    double
    reach_of_implant(const ModelParameters &model, const unsigned int direction)
    {
      const unsigned int c = ChuckComponent::translation_x + direction;
      const double       way =
        model.chuck.component[c].is_unknown() ? 0. : largest_value(model, c);
      // a block may turn
      return way + (model.implant.is_round() ?
                      model.implant.radius :
                      std::hypot(0.5 * model.implant.size[0],
                                 0.5 * model.implant.size[1]));
    }



    /** Whether the implant is pressed and tilted so little that strains, which
     *  are about its way over its radius, are below a hundredth. What friction
     *  does to the bone on the way sideways is in proportion to that. */
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
          if (model.chuck.component[c].is_unknown())
            return false;
          way +=
            largest_value(model, c) * (is_rotation(c) ? R * M_PI / 180. : 1.);
        }
      return way <= largest_strain * R;
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
      if (model.bone.material == Material::neo_hookean &&
          !is_pressed_lightly(model))
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



  std::string
  ModelParameters::why_direct() const
  {
    if (bone.bulk_solver == BulkSolver::direct)
      return "asked for";
    const std::string why = why_not_lattice();
    return why.empty() && bone.bulk_solver != BulkSolver::lattice ?
             why_rather_direct(*this) :
             why;
  }



  bool
  ModelParameters::needs_matrix() const
  {
    const auto &components = chuck.component;
    return load_steps.follow_path ||
           (!is_on_lattice() &&
            std::any_of(components.begin(),
                        components.end(),
                        [](const ChuckComponentParameters &component) {
                          return component.is_unknown();
                        }));
  }



  std::string
  ModelParameters::bulk_solver_in_words() const
  {
    return is_on_lattice() ?
             "bulk solver of the bone: lattice, for cells of equal width" :
             "bulk solver: direct, as " + why_direct();
  }
} // namespace Debond
