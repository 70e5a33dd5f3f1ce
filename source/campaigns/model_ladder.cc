#include <debond/campaigns/model_choice.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/system/memory_estimate.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Adaptive steps take this part of the tolerance. */
    constexpr double       share_of_steps = 0.1;
    constexpr unsigned int largest_mesh   = 4; // doublings



    void
    refuse_what_has_no_curve(const Scene &scene)
    {
      constexpr auto z         = ChuckComponent::rotation_z;
      const bool     is_loaded = scene.chuck.component[z].loaded;
      // expressions may do anything between planned steps
      ReferenceCurve turned;
      for (const double angle : scene.sampled_values(z))
        turned.emplace_back(angle, 0.);
      const Rotation rotation(turned);
      if (is_loaded || rotation.direction == 0. || rotation.reverses)
        throw EntryError(
          scene.chuck.entry_name(z, is_loaded ? "Control" : "Value"),
          "Model = auto compares torques over the angle: "
          "expected a rotation that is prescribed and goes on "
          "in one direction");
      for (unsigned int k = 0; k < z; ++k)
        {
          const std::vector<double> values = scene.sampled_values(k);
          const Eigen::Map<const Eigen::ArrayXd> q(values.data(),
                                                   values.size());
          const double rounding = 1e-12 * q.abs().maxCoeff();
          for (std::size_t i = rotation.first_row + 1; i < values.size(); ++i)
            if (std::abs(turned[i].first - turned[i - 1].first) <=
                  rotation.tolerance &&
                std::abs(q[i] - q[i - 1]) > rounding)
              throw EntryError(scene.chuck.entry_name(k, "Value"),
                               "Model = auto compares torques over the angle: "
                               "expected no change while the rotation about z "
                               "pauses or has ended");
        }
    }



    bool
    can_be_halved(const BodyParameters &body, const unsigned int fewest_across)
    {
      const auto &n = body.cells;
      return body.cells_under_implant == 0 && !body.is_fitted() &&
             n[0] % 2 == 0 && n[1] % 2 == 0 && n[2] % 2 == 0 &&
             std::min(n[0], n[1]) >= 2 * fewest_across && n[2] >= 4;
    }
  } // namespace



  std::string
  name_of(const Material material)
  {
    constexpr std::array<const char *, 3> names{
      {"rigid", "linear", "neo-hookean"}};
    return names[static_cast<unsigned int>(material)];
  }



  std::string
  in_words(const BodyParameters &body)
  {
    const auto &n = body.is_fitted() ? body.fitted_cells : body.cells;
    Text        text;
    text << (body.is_fitted() ? "fitted " : "") << n[0] << " x " << n[1];
    if (body.is_fitted() && n[2] > 0) // of a bone
      text << " x " << n[2];
    return text << " x " << body.cells[2];
  }



  std::string
  ModelLevel::model() const
  {
    return is_foundation() ?
             "foundation" :
             name_of(std::max(scene.bone.material, scene.implant.material));
  }



  std::string
  ModelLevel::description() const
  {
    return model() + ", " + in_words(scene.bone) + " and " +
           in_words(scene.implant) + " cells";
  }



  double
  ModelLevel::unknowns() const
  {
    double sum = 0.;
    for (const BodyParameters *const body : {&scene.bone, &scene.implant})
      if (!is_foundation() && !body->is_rigid())
        sum += n_unknowns_of(*body);
    return sum;
  }



  ModelLadder::ModelLadder(const Scene &scene)
  {
    refuse_what_has_no_curve(scene);
    ModelLevel level;
    level.scene       = scene;
    level.scene.model = ModelKind::finite_elements;
    level.scene.changed_entries.clear();
    level.scene.load_steps.adaptive = true;
    level.scene.load_steps.tolerance *= share_of_steps;
    level.scene.output.quiet                   = true;
    level.scene.output.overwrite_other_results = true;
    level.scene.output.resumable               = false;
    BodyParameters &bone = level.scene.bone, &implant = level.scene.implant;
    const auto      limit_materials = [&](const Material richest) {
      bone.material    = std::min(scene.bone.material, richest);
      implant.material = std::min(scene.implant.material, richest);
    };
    while (can_be_halved(bone, 15) && can_be_halved(implant, 3))
      for (BodyParameters *const body : {&bone, &implant})
        for (unsigned int &n : body->cells)
          n /= 2;

    limit_materials(Material::linear); // as in the linear solution
    levels.push_back(level);
    levels[0].scene.model       = ModelKind::foundation;
    levels[0].scene.closed_form = ClosedFormParameters(); // of the bodies
    for (const Material richest :
         {Material::rigid,
          Material::linear,
          std::max(scene.bone.material, scene.implant.material)})
      {
        limit_materials(richest);
        if (levels.size() == 1 ||
            level.materials() != levels.back().materials())
          levels.push_back(level);
      }
    for (level.mesh = 1; level.mesh <= largest_mesh; ++level.mesh)
      {
        for (BodyParameters *const body : {&bone, &implant})
          {
            body->cells_under_implant *= 2;
            for (auto *const numbers : {&body->cells, &body->fitted_cells})
              for (unsigned int &n : *numbers)
                n *= 2;
          }
        if (level.unknowns() > scene.largest_number_of_unknowns)
          {
            why_no_further = Text() << "the next mesh has " << level.unknowns()
                                    << " unknowns, more than "
                                    << scene.largest_number_of_unknowns
                                    << " (Auto / Largest number of unknowns)";
            return;
          }
        levels.push_back(level);
      }
    why_no_further = Text() << "the mesh has been refined " << largest_mesh
                            << " times";
  }



  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference)
  {
    // two polygons differ most at a corner of one of them
    const ReferenceCurve own   = curve_of(fine_curve(rows)),
                         other = curve_of(fine_curve(reference));
    const CurveComparison there(own, other), back(other, own);
    const auto            torque = &ReferenceCurve::value_type::second;
    const double          difference_back =
      back.difference_max * largest(own, torque) / largest(other, torque);
    return std::isnan(difference_back) ?
             difference_back :
             std::max(difference_back, there.difference_max);
  }



  double
  discretisation_error(const std::vector<double> &differences)
  {
    constexpr double reserve = 1.25, lowest_order = 0.5, highest_order = 2.;
    const double     last = differences.back();
    if (last == 0.)
      return 0.;
    double order = 1.;
    if (differences.size() > 1)
      order = std::min(std::log2(differences[differences.size() - 2] / last),
                       highest_order);
    if (!(order >= lowest_order))
      return ModelLevel::undefined;
    return reserve * last / (std::exp2(order) - 1.);
  }
} // namespace Debond
