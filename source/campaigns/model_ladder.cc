#include <debond/campaigns/model_ladder.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  namespace
  {
    constexpr unsigned int largest_mesh            = 4; // doublings
    constexpr double       largest_number_of_cells = 1e6;
    /** The coupled system is a dense matrix of this size, 0.8 GB. */
    constexpr double largest_number_of_contact_unknowns = 1e4;

    using Cells = std::array<unsigned int, 3>;



    /** The value of an entry `Cells`. */
    std::string
    entry_of(const Cells &cells, const BodyParameters &body)
    {
      std::ostringstream text;
      if (!body.is_round())
        text << cells[0] << ", ";
      text << cells[1] << ", " << cells[2];
      return text.str();
    }



    std::string
    in_words(const Cells &cells)
    {
      std::ostringstream text;
      text << cells[0] << " x " << cells[1] << " x " << cells[2];
      return text.str();
    }



    bool
    can_be_halved(const Cells &cells, const unsigned int fewest_across)
    {
      return cells[0] % 2 == 0 && cells[1] % 2 == 0 && cells[2] % 2 == 0 &&
             std::min(cells[0], cells[1]) >= 2 * fewest_across && cells[2] >= 4;
    }

  } // namespace



  std::string
  name_of(const Material material)
  {
    return material == Material::rigid  ? "rigid" :
           material == Material::linear ? "linear" :
                                          "neo-hookean";
  }



  double
  predicted_unknowns(const BodyParameters &body)
  {
    if (body.material == Material::rigid)
      return 0.;
    const double x = body.cells[0], y = body.cells[1], z = body.cells[2];
    const double more = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.;
    return 3. * ((x + 1.) * (y + 1.) * z + (x + more) * (y + more));
  }



  std::string
  Rung::description() const
  {
    return model + ", " + in_words(scene.bone.cells) + " and " +
           in_words(scene.implant.cells) + " cells";
  }



  double
  Rung::unknowns() const
  {
    return model == "foundation" ?
             0. :
             predicted_unknowns(scene.bone) + predicted_unknowns(scene.implant);
  }



  ModelLadder::ModelLadder(const Scene &scene)
    : scene(scene)
    , coarsest{{scene.bone.cells, scene.implant.cells}}
  {
    const auto poorer = [](const Material material, const Material limit) {
      return std::min(material, limit); // in the order of their cost
    };
    for (const Material limit :
         {Material::rigid, Material::linear, Material::neo_hookean})
      {
        const Materials next{{poorer(scene.bone.material, limit),
                              poorer(scene.implant.material, limit)}};
        if (all_materials.empty() || next != all_materials.back())
          all_materials.push_back(next);
      }
    while (can_be_halved(coarsest[0], 15) && can_be_halved(coarsest[1], 3))
      for (Cells &cells : coarsest)
        for (unsigned int &n : cells)
          n /= 2;
  }



  Materials
  ModelLadder::linear_materials() const
  {
    return {{std::min(scene.bone.material, Material::linear),
             std::min(scene.implant.material, Material::linear)}};
  }



  Scene
  ModelLadder::with(const std::vector<std::string> &overrides,
                    const unsigned int              number) const
  {
    std::vector<std::string> all{"Output/Console=quiet",
                                 "Output/Directory=" + scene.output.directory +
                                   "/rung-" + std::to_string(number)};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Scene result =
      Scene::from_entries(with_overrides(scene.entries, all), scene.name);
    result.output.overwrite_other_results = true;
    result.output.resumable               = false;
    return result;
  }



  std::vector<std::string>
  ModelLadder::cells(const unsigned int mesh) const
  {
    std::array<Cells, 2> refined = coarsest;
    for (Cells &cells : refined)
      for (unsigned int &n : cells)
        n <<= mesh;
    return {"Bone/Cells=" + entry_of(refined[0], scene.bone),
            "Implant/Cells=" + entry_of(refined[1], scene.implant)};
  }



  Rung
  ModelLadder::finite_elements(const unsigned int number,
                               const Materials   &materials,
                               const unsigned int mesh,
                               const double       step_tolerance) const
  {
    std::vector<std::string> overrides = cells(mesh);
    overrides.insert(overrides.end(),
                     {"Model=finite elements",
                      "Load steps/Adaptive=true",
                      "Load steps/Tolerance=" + to_text(step_tolerance, 17),
                      "Bone/Material=" + name_of(materials[0]),
                      "Implant/Material=" + name_of(materials[1])});
    Rung rung;
    rung.model     = name_of(std::max(materials[0], materials[1]));
    rung.materials = materials;
    rung.mesh      = mesh;
    rung.scene     = with(overrides, number);
    return rung;
  }



  Rung
  ModelLadder::foundation(const unsigned int number,
                          const double       step_tolerance) const
  {
    std::vector<std::string> overrides = cells(0);
    overrides.insert(overrides.end(),
                     {"Model=foundation",
                      "Load steps/Adaptive=true",
                      "Load steps/Tolerance=" + to_text(step_tolerance, 17),
                      "Closed form/Pressure=0",
                      "Closed form/Normal stiffness=0",
                      "Closed form/Torsional stiffness=0"});
    Rung rung;
    rung.model     = "foundation";
    rung.materials = linear_materials();
    rung.scene     = with(overrides, number);
    return rung;
  }



  Scene
  ModelLadder::below_coarsest(double &ratio) const
  {
    Scene result = scene;
    ratio        = 2.;
    for (BodyParameters *const body : {&result.bone, &result.implant})
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int n = coarsest[body == &result.bone ? 0 : 1][d];
          body->cells[d]       = std::max(d < 2 ? 2U : 1U, (n + 1) / 2);
          if (body->material != Material::rigid || d < 2)
            ratio = std::min(ratio, double(n) / body->cells[d]);
        }
    return result;
  }



  std::string
  ModelLadder::limit(const Materials &materials, const unsigned int mesh) const
  {
    if (mesh > largest_mesh)
      return "the mesh has been refined " + std::to_string(largest_mesh) +
             " times";
    const bool   is_round = scene.implant.is_round();
    const double share    = // of the bone's face that contact reaches
      is_round ? 4. * std::pow(scene.implant.radius, 2) /
                   (scene.bone.size[0] * scene.bone.size[1]) :
                    scene.implant.size[0] * scene.implant.size[1] /
                   (scene.bone.size[0] * scene.bone.size[1]);
    double unknowns = 0., n_cells = 0., contact_unknowns = 0.;
    for (unsigned int b = 0; b < 2; ++b)
      {
        BodyParameters body = b == 0 ? scene.bone : scene.implant;
        body.material       = materials[b];
        body.cells          = coarsest[b];
        for (unsigned int &n : body.cells)
          n <<= mesh;
        unknowns += predicted_unknowns(body);
        if (body.material != Material::rigid)
          contact_unknowns +=
            3. * (b == 0 ? share : 1.) * body.cells[0] * double(body.cells[1]);
        n_cells += double(body.cells[0]) * body.cells[1] * body.cells[2];
      }
    std::ostringstream text;
    if (unknowns > scene.automatic.largest_number_of_unknowns)
      text << "the next mesh has " << unknowns << " unknowns, more than "
           << scene.automatic.largest_number_of_unknowns
           << " (Auto / Largest number of unknowns)";
    else if (contact_unknowns > largest_number_of_contact_unknowns)
      text << "the next mesh has some " << contact_unknowns
           << " unknowns on the contact surfaces, more than "
           << largest_number_of_contact_unknowns;
    else if (n_cells > largest_number_of_cells)
      text << "the next mesh has " << n_cells << " cells";
    return text.str();
  }
} // namespace Debond
