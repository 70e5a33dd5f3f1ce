#include <debond/campaigns/model_ladder.h>

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



    bool
    can_be_halved(const Cells &cells, const unsigned int fewest_across)
    {
      return cells[0] % 2 == 0 && cells[1] % 2 == 0 && cells[2] % 2 == 0 &&
             std::min(cells[0], cells[1]) >= 2 * fewest_across && cells[2] >= 4;
    }



    double
    number_of_unknowns(const BodyParameters &body)
    {
      if (body.material == Material::rigid)
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
    return std::to_string(cells[0]) + " x " + std::to_string(cells[1]) + " x " +
           std::to_string(cells[2]);
  }



  std::string
  Rung::model() const
  {
    return is_foundation() ? "foundation" :
                             name_of(std::max(materials[0], materials[1]));
  }



  std::string
  Rung::description() const
  {
    return model() + ", " + in_words(scene.bone.cells) + " and " +
           in_words(scene.implant.cells) + " cells";
  }



  double
  Rung::unknowns() const
  {
    return is_foundation() ?
             0. :
             number_of_unknowns(scene.bone) + number_of_unknowns(scene.implant);
  }



  ModelLadder::ModelLadder(const Scene &scene, const double step_tolerance)
    : scene(scene)
    , step_tolerance(step_tolerance)
    , coarsest{{scene.bone.cells, scene.implant.cells}}
  {
    for (const Material limit :
         {Material::rigid, Material::linear, Material::neo_hookean})
      if (const Materials next = limited_to(limit);
          all_materials.empty() || next != all_materials.back())
        all_materials.push_back(next);
    while (can_be_halved(coarsest[0], 15) && can_be_halved(coarsest[1], 3))
      for (Cells &cells : coarsest)
        for (unsigned int &n : cells)
          n /= 2;
  }



  Materials
  ModelLadder::limited_to(const Material limit) const
  {
    return {{std::min(scene.bone.material, limit), // in the order of their cost
             std::min(scene.implant.material, limit)}};
  }



  Rung
  ModelLadder::finite_elements(const unsigned int number,
                               const Materials   &materials,
                               const unsigned int mesh) const
  {
    Rung rung;
    rung.materials     = materials;
    rung.mesh          = mesh;
    rung.scene         = scene;
    rung.scene.model   = ModelKind::finite_elements;
    unsigned int which = 0;
    for (BodyParameters *const body : {&rung.scene.bone, &rung.scene.implant})
      {
        body->material = materials[which];
        body->cells    = coarsest[which++];
        for (unsigned int &n : body->cells)
          n <<= mesh;
      }
    rung.scene.load_steps.adaptive  = true;
    rung.scene.load_steps.tolerance = step_tolerance;
    OutputParameters &output        = rung.scene.output;
    output.console                  = ConsoleKind::quiet;
    output.directory += "/rung-" + std::to_string(number);
    output.overwrite_other_results = true;
    output.resumable               = false;
    return rung;
  }



  Rung
  ModelLadder::foundation(const unsigned int number) const
  {
    Rung rung        = finite_elements(number, all_materials.back(), 0);
    rung.materials   = linear_materials(); // those of the linear solution
    rung.scene.model = ModelKind::foundation;
    // the bodies' own, whatever the scene says
    rung.scene.closed_form.pressure            = 0.;
    rung.scene.closed_form.normal_stiffness    = 0.;
    rung.scene.closed_form.torsional_stiffness = 0.;
    return rung;
  }



  Scene
  ModelLadder::below_coarsest(double &ratio) const
  {
    Scene        result = scene;
    unsigned int which  = 0;
    ratio               = 2.;
    for (BodyParameters *const body : {&result.bone, &result.implant})
      {
        const Cells &cells = coarsest[which++];
        for (unsigned int d = 0; d < 3; ++d)
          {
            body->cells[d] = std::max(d < 2 ? 2U : 1U, (cells[d] + 1) / 2);
            if (body->material != Material::rigid || d < 2)
              ratio = std::min(ratio, double(cells[d]) / body->cells[d]);
          }
      }
    return result;
  }



  std::string
  ModelLadder::limit(const Materials &materials, const unsigned int mesh) const
  {
    if (mesh > largest_mesh)
      return "the mesh has been refined " + std::to_string(largest_mesh) +
             " times";
    const Rung   next     = finite_elements(0, materials, mesh);
    const double unknowns = next.unknowns();
    double       n_cells = 0., contact_unknowns = 0.;
    for (const BodyParameters *const body :
         {&next.scene.bone, &next.scene.implant})
      {
        const double on_face = double(body->cells[0]) * body->cells[1];
        double       share   = 1.; // of it that contact reaches
        for (const unsigned int d : {0, 1})
          share *= scene.implant.width(d) / body->width(d);
        n_cells += on_face * body->cells[2];
        if (body->material != Material::rigid)
          contact_unknowns += 3. * share * on_face;
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
