#include <debond/campaigns/model_choice.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

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



    double
    number_of_unknowns(const BodyParameters &body)
    {
      if (body.is_rigid())
        return 0.;
      const double x = body.cells[0], y = body.cells[1], z = body.cells[2];
      const double more = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.;
      return 3. * ((x + 1.) * (y + 1.) * z + (x + more) * (y + more));
    }
  } // namespace



  std::string
  name_of(const Material material)
  {
    return material == Material::rigid  ? "rigid" :
           material == Material::linear ? "linear" :
                                          "neo-hookean";
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
    return is_foundation() ?
             0. :
             number_of_unknowns(scene.bone) + number_of_unknowns(scene.implant);
  }



  ModelHierarchy::ModelHierarchy(const Scene &scene,
                                 const double step_tolerance)
    : scene(scene)
    , step_tolerance(step_tolerance)
    , coarsest{{scene.bone.cells, scene.implant.cells}}
  {
    // None richer than a limit, in the order of their cost.
    const auto limited_to = [&](const Material limit) {
      return Materials{{std::min(scene.bone.material, limit),
                        std::min(scene.implant.material, limit)}};
    };
    linear_materials = limited_to(Material::linear);
    for (const Material limit :
         {Material::rigid, Material::linear, Material::neo_hookean})
      if (materials.empty() || limited_to(limit) != materials.back())
        materials.push_back(limited_to(limit));
    while (can_be_halved(coarsest[0], 15) && can_be_halved(coarsest[1], 3))
      for (Cells &cells : coarsest)
        for (unsigned int &n : cells)
          n /= 2;
  }



  ModelLevel
  ModelHierarchy::finite_elements(const Materials   &materials,
                                  const unsigned int mesh) const
  {
    ModelLevel level;
    level.materials    = materials;
    level.mesh         = mesh;
    level.scene        = scene;
    level.scene.model  = ModelKind::finite_elements;
    unsigned int which = 0;
    for (BodyParameters *const body : {&level.scene.bone, &level.scene.implant})
      {
        body->material = materials[which];
        body->cells    = coarsest[which++];
        for (unsigned int &n : body->cells)
          n <<= mesh;
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
    for (BodyParameters *const body : {&result.bone, &result.implant})
      {
        const Cells &cells = coarsest[which++];
        for (unsigned int d = 0; d < 3; ++d)
          {
            body->cells[d] = std::max(d < 2 ? 2U : 1U, (cells[d] + 1) / 2);
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
    const ModelLevel next     = finite_elements(materials, mesh);
    const double     unknowns = next.unknowns();
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
    if (unknowns > scene.largest_number_of_unknowns)
      return Text() << "the next mesh has " << unknowns
                    << " unknowns, more than "
                    << scene.largest_number_of_unknowns
                    << " (Auto / Largest number of unknowns)";
    if (contact_unknowns > largest_number_of_contact_unknowns)
      return Text() << "the next mesh has some " << contact_unknowns
                    << " unknowns on the contact surfaces, more than "
                    << largest_number_of_contact_unknowns;
    if (n_cells > largest_number_of_cells)
      return Text() << "the next mesh has " << n_cells << " cells";
    return "";
  }
} // namespace Debond
