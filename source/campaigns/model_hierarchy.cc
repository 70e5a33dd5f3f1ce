#include <debond/campaigns/model_choice.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Debond
{
  namespace
  {
    constexpr unsigned int largest_mesh            = 4; // doublings
    constexpr double       largest_number_of_cells = 1e6;
    /** The coupled system is a dense matrix of this size, 0.8 GB. */
    constexpr double largest_number_of_contact_unknowns = 1e4;

    using Cells = std::array<unsigned int, 3>;



    bool
    can_be_halved(const Cells &cells, const unsigned int fewest_across)
    {
      return cells[0] % 2 == 0 && cells[1] % 2 == 0 && cells[2] % 2 == 0 &&
             std::min(cells[0], cells[1]) >= 2 * fewest_across && cells[2] >= 4;
    }



    /** What the scene prescribes, densely: expressions may do anything between
     *  planned steps. Each phase has at least a thousand points, the ends of
     *  planned steps among them. */
    std::vector<Chuck::Vector6>
    prescribed_values(const Scene &scene)
    {
      const Chuck                 chuck(scene.chuck,
                        Eigen::Vector3d::Zero(),
                        scene.implant.characteristic_radius());
      const std::vector<double>  &times = scene.load_steps.times;
      std::vector<Chuck::Vector6> values{chuck.values(times.front())};
      for (std::size_t p = 0; p + 1 < times.size(); ++p)
        {
          const unsigned int steps = scene.load_steps.steps[p],
                             n     = steps * ((999 + steps) / steps);
          for (double i = 1.; i <= n; ++i)
            values.push_back(
              chuck.values((1. - i / n) * times[p] + i / n * times[p + 1]));
        }
      return values;
    }



    void
    refuse_what_has_no_curve(const Scene &scene)
    {
      constexpr auto    z     = ChuckComponent::rotation_z;
      const std::string entry = "Chuck / Rotation z / ";
      if (scene.chuck.component[z].loaded)
        throw EntryError(entry + "Control",
                         "Model = auto compares torques and takes this "
                         "rotation as prescribed");
      const std::vector<Chuck::Vector6> values = prescribed_values(scene);
      Chuck::Vector6 rounding = Chuck::Vector6::Zero(), moved = rounding;
      for (const Chuck::Vector6 &value : values)
        rounding = rounding.cwiseMax(1e-12 * value.cwiseAbs());
      unsigned int moves_in_hold = z; // another component, if there is one
      for (std::size_t i = 1; i < values.size(); ++i)
        {
          const Chuck::Vector6 change =
            (values[i] - values[i - 1]).cwiseAbs().eval();
          moved += change;
          for (unsigned int k = 0; k < z && moves_in_hold == z; ++k)
            if (moved[z] > rounding[z] && change[z] <= rounding[z] &&
                change[k] > rounding[k])
              moves_in_hold = k;
        }
      if (moved[z] == 0.)
        throw EntryError(entry + "Value",
                         "Model = auto judges a model by its torque curve, and "
                         "nothing rotates about z in this scene: choose a "
                         "model with Model");
      if (moved[z] >
          std::abs(values.back()[z] - values.front()[z]) * (1. + 1e-9))
        throw EntryError(entry + "Value",
                         "Model = auto compares torques over the angle and "
                         "knows no rotation that reverses");
      if (moves_in_hold != z)
        throw EntryError(ChuckParameters::entry_name(moves_in_hold, "Value"),
                         "Model = auto compares torques over the angle and "
                         "would not see what this does while the rotation "
                         "about z pauses or has ended; it may change before "
                         "the rotation begins and during it");
    }
  } // namespace



  std::string
  name_of(const Material material)
  {
    switch (material)
      {
        case Material::rigid:
          return "rigid";
        case Material::linear:
          return "linear";
        case Material::neo_hookean:
          return "neo-hookean";
      }
    AssertThrow(false, dealii::ExcNotImplemented());
    return "";
  }



  std::string
  in_words(const std::array<unsigned int, 3> &cells)
  {
    return Text() << cells[0] << " x " << cells[1] << " x " << cells[2];
  }



  std::string
  ModelLevel::model() const
  {
    return is_foundation() ? "foundation" :
                             name_of(std::max(materials[0], materials[1]));
  }



  std::string
  ModelLevel::description() const
  {
    return model() + ", " + in_words(scene.bone.cells) + " and " +
           in_words(scene.implant.cells) + " cells";
  }



  double
  ModelLevel::unknowns() const
  {
    double sum = 0.;
    for (const BodyParameters *const body : {&scene.bone, &scene.implant})
      if (!is_foundation() && !body->is_rigid())
        {
          const auto  &n = body->cells;
          const double more =
                         body->contact_surface == SurfaceKind::nurbs ? 2. : 1.,
                       on_face = (n[0] + more) * (n[1] + more),
                       p = body->element == ElementKind::quadratic ? 2. : 1.;
          sum +=
            3. * (body->element == ElementKind::spline ?
                    on_face * (n[2] + 2.) :
                    (p * n[0] + 1.) * (p * n[1] + 1.) * p * n[2] + on_face);
        }
    return sum;
  }



  ModelHierarchy::ModelHierarchy(const Scene &scene,
                                 const double step_tolerance)
    : scene(scene)
    , step_tolerance(step_tolerance)
    , coarsest{{scene.bone.cells, scene.implant.cells}}
  {
    refuse_what_has_no_curve(scene);
    // None richer than a limit; at last those of the scene.
    const auto limited_to = [&](const Material limit) {
      return Materials{{std::min(scene.bone.material, limit),
                        std::min(scene.implant.material, limit)}};
    };
    linear_materials = limited_to(Material::linear);
    for (const Materials &next :
         {limited_to(Material::rigid),
          linear_materials,
          Materials{{scene.bone.material, scene.implant.material}}})
      if (materials.empty() || next != materials.back())
        materials.push_back(next);
    while (scene.bone.cells_under_implant == 0 &&
           can_be_halved(coarsest[0], 15) && can_be_halved(coarsest[1], 3))
      for (Cells &cells : coarsest)
        for (unsigned int &n : cells)
          n /= 2;
  }



  ModelLevel
  ModelHierarchy::finite_elements(const Materials   &materials,
                                  const unsigned int mesh) const
  {
    ModelLevel level;
    level.materials   = materials;
    level.mesh        = mesh;
    level.scene       = scene;
    level.scene.model = ModelKind::finite_elements;
    level.scene.changed_entries.clear();
    unsigned int which = 0;
    for (BodyParameters *const body : {&level.scene.bone, &level.scene.implant})
      {
        body->material = materials[which];
        body->cells    = coarsest[which++];
        for (unsigned int &n : body->cells)
          n <<= mesh;
        body->cells_under_implant <<= mesh;
      }
    level.scene.load_steps.adaptive  = true;
    level.scene.load_steps.tolerance = step_tolerance;
    OutputParameters &output         = level.scene.output;
    output.quiet                     = true;
    output.overwrite_other_results   = true;
    output.resumable                 = false;
    return level;
  }



  ModelLevel
  ModelHierarchy::foundation() const
  {
    ModelLevel level  = finite_elements(materials.back(), 0);
    level.materials   = linear_materials; // those of the linear solution
    level.scene.model = ModelKind::foundation;
    // the bodies' own, whatever the scene says
    level.scene.closed_form.pressure            = 0.;
    level.scene.closed_form.normal_stiffness    = 0.;
    level.scene.closed_form.torsional_stiffness = 0.;
    return level;
  }



  std::pair<Scene, double>
  ModelHierarchy::below_coarsest() const
  {
    Scene        result = scene;
    unsigned int which  = 0;
    double       ratio  = 2.;
    const auto   half   = [](const unsigned int n) { return (n + 1) / 2; };
    for (BodyParameters *const body : {&result.bone, &result.implant})
      {
        const Cells       &cells  = coarsest[which++];
        const unsigned int under  = body->cells_under_implant;
        body->cells_under_implant = half(under);
        for (unsigned int d = 0; d < 3; ++d)
          {
            // as many to the left as to the right of those under the implant
            body->cells[d] = d < 2 && under > 0 ?
                               half(under) + 2 * half((cells[d] - under) / 2) :
                               std::max(d < 2 ? 2U : 1U, half(cells[d]));
            if (!body->is_rigid() || d < 2)
              ratio = std::min(ratio, double(cells[d]) / body->cells[d]);
          }
      }
    return {result, ratio};
  }



  std::string
  ModelHierarchy::limit(const Materials   &materials,
                        const unsigned int mesh) const
  {
    if (mesh > largest_mesh)
      return Text() << "the mesh has been refined " << largest_mesh << " times";
    const ModelLevel next    = finite_elements(materials, mesh);
    double           n_cells = 0., contact_unknowns = 0.;
    for (const BodyParameters *const body :
         {&next.scene.bone, &next.scene.implant})
      {
        const double on_face = double(body->cells[0]) * body->cells[1];
        double       share   = 1.; // of it that contact reaches
        for (const unsigned int d : {0, 1})
          share *= scene.implant.width(d) / body->width(d);
        n_cells += on_face * body->cells[2];
        if (!body->is_rigid())
          contact_unknowns += 3. * share * on_face;
      }
    for (const auto &[n, largest, what, entry] :
         {std::make_tuple(next.unknowns(),
                          double(scene.largest_number_of_unknowns),
                          " unknowns",
                          " (Auto / Largest number of unknowns)"),
          std::make_tuple(contact_unknowns,
                          largest_number_of_contact_unknowns,
                          " unknowns on the contact surfaces",
                          ""),
          std::make_tuple(n_cells, largest_number_of_cells, " cells", "")})
      if (n > largest)
        return Text() << "the next mesh has " << n << what << ", more than "
                      << largest << entry;
    return "";
  }



  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference)
  {
    // two polygons differ most at a corner of one of them
    const auto measures = [](const std::vector<TorqueRow> &rows,
                             const std::vector<TorqueRow> &others) {
      CurveSettings settings;
      for (const TorqueRow &row : fine_curve(others))
        settings.reference.emplace_back(row.angle_deg, row.torque_Nmm);
      return measure_torque_curve(rows, settings);
    };
    const auto   there           = measures(rows, reference);
    const auto   back            = measures(reference, rows);
    const double difference_back = back["difference_max"].get<double>() *
                                   there["T_max_Nmm"].get<double>() /
                                   back["T_max_Nmm"].get<double>();
    return std::isnan(difference_back) ?
             difference_back :
             std::max(difference_back, there["difference_max"].get<double>());
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
