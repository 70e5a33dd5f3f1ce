// What Accuracy chooses of cells, elements and steps, for scenes of all shapes;
// the cells of the coarser run, which tells the error, and of a finer one;
// parameters that hold what was chosen choose nothing, and what they say was
// chosen is chosen again.

#include <debond/input/entry_table.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;
using Changes = std::vector<std::string>;



Changes
operator+(Changes list, const Changes &more)
{
  list.insert(list.end(), more.begin(), more.end());
  return list;
}



Scene
scene_of(const Changes &changes)
{
  return coin_scene(pressed_and_turned, Changes{"Accuracy=1 %"} + changes);
}



void
test_numbers_of_cells()
{
  bool is_opposite = true, is_more = true, is_fewer = true;
  for (unsigned int n = 1; n <= 1000; ++n)
    {
      is_opposite = is_opposite && fewer_cells(more_cells(n)) == n;
      is_more     = is_more && std::abs(more_cells(n) - 1.5 * n) < 1.;
      is_fewer    = is_fewer && std::abs(fewer_cells(n) - n / 1.5) < 1. &&
                 fewer_cells(n) > 0;
    }
  report("fewer cells are the opposite of more", is_opposite);
  report("more are half as many again, to a cell", is_more);
  report("fewer are two thirds, to a cell, and not none", is_fewer);
}



/** All numbers that cells are made of. */
std::vector<unsigned int>
cells_of(const Scene &scene)
{
  std::vector<unsigned int> numbers{scene.bone.cells_under_implant};
  for (const BodyParameters *const body : {&scene.bone, &scene.implant})
    for (const auto &cells : {body->cells, body->fitted_cells})
      numbers.insert(numbers.end(), cells.begin(), cells.end());
  return numbers;
}



/** Whether all numbers of cells but those around an axis, of files and of rigid
 *  bodies differ in the same way. */
bool
differ_in_all(const Scene &scene, const Scene &other)
{
  bool fewer = true, more = true;
  for (const auto &[own, others] : {std::pair(&scene.bone, &other.bone),
                                    std::pair(&scene.implant, &other.implant)})
    {
      const auto numbers = [](const BodyParameters &body) {
        std::vector<unsigned int> n(body.cells.begin(), body.cells.end());
        if (body.is_fitted())
          n.insert(n.begin(),
                   body.fitted_cells.begin(),
                   body.fitted_cells.end());
        return n;
      };
      const auto before = numbers(*own), after = numbers(*others);
      const bool has_a_bond_each =
        own == &scene.implant &&
        scene.interface.bonding.pattern == BondingPatternKind::random &&
        scene.interface.bonding.correlation_length == 0.;
      if (own->is_rigid() || own->shape == BodyShape::file || has_a_bond_each)
        continue;
      for (unsigned int k = scene.is_axisymmetric() ? 1 : 0; k < before.size();
           ++k)
        if (before[k] > 0)
          {
            fewer = fewer && after[k] < before[k];
            more  = more && after[k] > before[k];
          }
    }
  return fewer || more;
}



bool
has(const std::vector<std::string> &names, const SceneEntry &entry)
{
  return std::count(names.begin(), names.end(), entry.full_name()) > 0;
}



/** The same as report(), also where the work is refused. */
void
report_work(const std::string &what, const std::function<bool()> &work)
{
  try
    {
      report(what, work());
    }
  catch (const InputError &error)
    {
      std::cout << what << ": NO, " << error.what() << std::endl;
    }
}



/** The parameters of a scene that says itself what was chosen. */
void
test_parameters(const Scene &scene)
{
  const std::string &parameters = scene.completed_parameters;
  report_work("  its parameters choose nothing", [&] {
    const Scene again = Scene::from_text(parameters);
    return again.chosen.empty() && !again.completed_parameters.empty() &&
           parameters.rfind(again.completed_parameters, 0) == 0;
  });
  report("  what was chosen is named there",
         choices_in(parameters) == scene.chosen);
  report_work("  left open, it is chosen again", [&] {
    return Scene::from_entries(open_choices(parameters), "open")
             .completed_parameters == parameters;
  });
}



void
test_choices(const Changes &changes)
{
  const Scene scene = scene_of(changes);
  for (const SceneEntry &entry : scene.completed_entries())
    if (has(scene.chosen, entry))
      std::cout << "  " << entry.full_name() << " = " << entry.value
                << std::endl;
  test_parameters(scene);

  const auto coarser = coarser_scene(scene), finer = finer_scene(scene);
  if (!coarser)
    {
      std::cout << "  there is no coarser one" << std::endl;
      return;
    }
  std::cout << "  coarser: " << cells_in_words(*coarser) << std::endl
            << "  finer: " << (finer ? cells_in_words(*finer) : "none")
            << std::endl;
  report("  the coarser one chooses nothing", coarser->chosen.empty());
  report("  it has fewer cells in each direction, or more",
         differ_in_all(scene, *coarser));
  if (!finer)
    return;
  report("  the finer one has the same choices", finer->chosen == scene.chosen);
  report("  and is the same scene",
         is_same_scene(scene.completed_parameters,
                       finer->completed_parameters) &&
           scene.completed_parameters != finer->completed_parameters);
  report("  whose cells are taken",
         with_choices_of(scene, finer->completed_parameters)
             .completed_parameters == finer->completed_parameters);
  if (has(scene.chosen, {{"Bone"}, "Cells", "", ""}) &&
      has(scene.chosen, {{"Implant"}, "Cells", "", ""}))
    report("  the coarser of the finer one has its cells",
           cells_of(coarser_scene(*finer).value()) == cells_of(scene));
}



void
test_scene(const std::string &name, const Changes &changes)
{
  std::cout << name << std::endl;
  try
    {
      test_choices(changes);
    }
  catch (const InputError &error)
    {
      std::cout << "  NO, " << error.what() << std::endl;
    }
}


void
test_scenes()
{
  const Changes stiff{"Interface/Normal stiffness=1e5"},
    twisted{"Chuck/Press/Value=0",
            "Chuck/Rotation z/Value=4 * t",
            "Load steps/Times=0, 1"},
    in_sleeve = twisted + Changes{"Bone/Shape=sleeve",
                                  "Bone/Outer radius=6",
                                  "Implant/Radius=2",
                                  "Interface/Interference=0.02"};
  test_scene("Coin on a soft interface", {});
  test_scene("Coin on a stiff one", stiff);
  test_scene("Cap", stiff + Changes{"Implant/Shape=cap"});
  const Changes block{"Implant/Shape=block"},
    ring{"Implant/Shape=ring", "Implant/Inner radius=1"};
  test_scene("Block", block);
  test_scene("Block on a stiff interface", stiff + block);
  test_scene("Ring", ring);
  test_scene("Ring on a stiff interface", stiff + ring);
  test_scene("Pin in a sleeve",
             in_sleeve + Changes{"Implant/Shape=pin", "Implant/Height=5"});
  test_scene("Pin that is levered, on a stiff interface",
             stiff + in_sleeve +
               Changes{"Implant/Shape=pin",
                       "Implant/Height=5",
                       "Chuck/Rotation x/Value=0.01 * t"});
  test_scene("Pin whose fit becomes tighter",
             in_sleeve + Changes{"Implant/Shape=pin",
                                 "Implant/Height=5",
                                 "Interface/Interference=0.02 * t"});
  test_scene("Screw",
             in_sleeve + Changes{"Implant/Shape=screw", "Implant/Height=3"});
  test_scene("Cup in a cavity",
             twisted + Changes{"Bone/Shape=cavity",
                               "Bone/Outer radius=36",
                               "Implant/Shape=cup",
                               "Implant/Radius=26",
                               "Implant/Height=26",
                               "Interface/Interference=0.02"});
  const std::string meshes = DEBOND_SOURCE_DIR "/prm/meshes/";
  test_scene("Meshes from files",
             {"Bone/Shape=file",
              "Bone/Mesh file=" + meshes + "stem_bone.msh",
              "Bone/Element=quadratic",
              "Implant/Shape=file",
              "Implant/Mesh file=" + meshes + "stem.msh",
              "Implant/Element=quadratic",
              "Interface/Law=adhesive"});
  test_scene("A bond for each element",
             {"Interface/Bonding/Pattern=random",
              "Interface/Bonding/Bonded fraction=0.5"});
  test_scene("Along a path", stiff + Changes{"Load steps/Path following=slip"});
  const std::string sideways = "Chuck/Translation x/Value=";
  test_scene("Moved sideways",
             stiff + Changes{sideways + "0.5 * max(t - 1, 0)"});
  test_scene("Moved sideways and back, in a third phase",
             stiff + Changes{sideways + "0.5 * sin(pi * max(t - 2, 0))",
                             "Load steps/Times=0, 1, 2, 3"});
  test_scene("A phase alone",
             stiff + Changes{"Chuck/Rotation z/Value=4 * t",
                             "Load steps/Times=0, 1"});
  test_scene("Cells of the scene",
             stiff + Changes{"Bone/Cells=20, 20, 4", "Implant/Cells=4, 3"});
  test_scene("Cells of the bone alone", {"Bone/Cells=20, 20, 4"});
  test_scene("One layer of cells, which cannot be fewer",
             stiff + Changes{"Bone/Cells=20, 20, 1"});
  test_scene("Trilinear cells",
             stiff +
               Changes{"Bone/Element=trilinear", "Implant/Element=trilinear"});
  test_scene("Nothing to choose",
             {"Bone/Cells=20, 20, 4",
              "Bone/Element=spline",
              "Bone/Material=linear",
              "Implant/Cells=4, 3",
              "Implant/Element=spline",
              "Implant/Material=linear",
              "Load steps/Steps=2, 30",
              "Load steps/Adaptive=true",
              "Load steps/Tolerance=0.01"});
}



// Loads of caps for which an independent solution, rings of pressure on a half
// space with springs on it, has the contact end at 1.5 mm: depths over a^2/R
// and forces over E* a^3/R, by k = eps_n a/E*.
void
test_contact_radius()
{
  struct Reference
  {
    double k, depth, force;
  };
  std::cout << "Where the contact of a cap ends" << std::endl;
  const double nu = 0.25, E_star = 9000. / (1. - nu * nu), a = 1.5, R = 40.;
  for (const Reference &at : {Reference{1., 0.6711, 0.4720},
                              {10., 0.8992, 1.0829},
                              {100., 0.9821, 1.2915}})
    for (const bool is_force : {false, true})
      {
        const double load =
          a * a / R * (is_force ? E_star * a * at.force : at.depth);
        const Scene scene = scene_of(
          {"Implant/Shape=cap",
           "Implant/Cap radius=" + std::to_string(R),
           "Implant/Material=rigid",
           "Bone/Young modulus=9000",
           "Bone/Poisson ratio=" + std::to_string(nu),
           "Interface/Normal stiffness=" + std::to_string(at.k * E_star / a),
           std::string("Chuck/Press/Control=") +
             (is_force ? "force" : "displacement"),
           "Chuck/Press/Value=" + std::to_string(load) + " * min(t, 1)"});
        report("  within 3 %",
               scene.bone.is_fitted() && scene.implant.is_fitted() &&
                 std::abs(scene.implant.contact_radius / a - 1.) < 0.03);
      }
}



// Half the planned steps; and where its results are.
void
test_coarser_scene()
{
  std::cout << "The coarser scene" << std::endl;
  const Scene scene   = scene_of({"Load steps/Steps=2, 31",
                                  "Load steps/Adaptive=false",
                                  "Output/Directory=results/numerics",
                                  "Output/Fields every=5",
                                  "Expert/Output/Profile angles=1"}),
              coarser = coarser_scene(scene).value();
  report("  half the planned steps, or one more",
         coarser.load_steps.steps == std::vector<unsigned int>{1, 16} &&
           !coarser.load_steps.adaptive);
  report("  in a folder of the same directory",
         coarser.output.directory == "results/numerics/coarser");
  report("  without pictures, page and profiles",
         coarser.output.fields_every == 0 && !coarser.output.report &&
           coarser.output.quiet && coarser.output.profile_angles.empty());
  const Scene adaptive = scene_of({"Load steps/Steps=2, 31"});
  report("  adaptive steps of the same tolerance",
         coarser_scene(adaptive).value().load_steps.steps ==
             std::vector<unsigned int>{2, 31} &&
           coarser_scene(adaptive).value().load_steps.tolerance == 0.0025);

  // where each element draws its own bond, other elements would have another
  for (const std::string length : {"0", "0.5"})
    {
      const Scene drawn =
        scene_of({"Interface/Bonding/Pattern=random",
                  "Interface/Bonding/Bonded fraction=0.5",
                  "Interface/Bonding/Correlation length=" + length});
      report("  a correlation length of " + length +
               (length == "0" ? ", the same implant" : ", fewer of its cells"),
             (coarser_scene(drawn).value().implant.cells ==
              drawn.implant.cells) == (length == "0"));
    }
}



void
test_same_scenes()
{
  std::cout << "Another scene" << std::endl;
  const auto is_same =
    [own = scene_of({}).completed_parameters](const std::string &other) {
      return is_same_scene(own, other);
    };
  const auto parameters = [](const Changes &changes) {
    return scene_of(changes).completed_parameters;
  };
  report("  itself is none", is_same(parameters({})));
  report("  another friction coefficient",
         !is_same(parameters({"Interface/Friction coefficient broken=0.3"})));
  report("  another accuracy", !is_same(parameters({"Accuracy=2 %"})));
  report("  cells that were not chosen",
         !is_same(parameters({"Bone/Cells=20, 20, 4"})));
  report("  a text that is no scene",
         !is_same(parameters({}) + "subsection Bone\n"));
  report("  cells of scenes that choose none",
         !is_same_scene(parameters({"Accuracy=none", "Bone/Cells=20, 20, 4"}),
                        parameters({"Accuracy=none", "Bone/Cells=21, 21, 4"})));
}



// Linear bodies that were chosen, and no others.
void
test_large_strains()
{
  std::cout << "Strains that are too large" << std::endl;
  const Scene scene =
    scene_of({"Bone/Young modulus=30", "Implant/Material=linear"});
  const auto richer = with_large_strains(scene);
  report("  of the bone",
         richer && richer->bone.material == Material::neo_hookean &&
           richer->implant.material == Material::linear);
  report("  it is the same scene",
         richer && is_same_scene(scene.completed_parameters,
                                 richer->completed_parameters));
  report("  there is nothing richer", richer && !with_large_strains(*richer));
  report("  not of bodies that the scene has chosen",
         !with_large_strains(
           scene_of({"Bone/Material=linear", "Implant/Material=rigid"})));
}



// Without an accuracy `auto' is what it was before there was one.
void
test_none()
{
  std::cout << "Without an accuracy" << std::endl;
  const Scene scene = scene_of({"Accuracy=none",
                                "Bone/Cells=auto",
                                "Bone/Material=auto",
                                "Load steps/Steps=auto"});
  for (const auto &[section, names] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
         {"Bone", {"Cells", "Element", "Material"}},
         {"Implant", {"Cells", "Element", "Material"}},
         {"Expert / Bone", {"Layer grading"}},
         {"Expert / Implant", {"Layer grading"}},
         {"Load steps", {"Steps", "Adaptive", "Tolerance"}}})
    for (const std::string &name : names)
      if (!default_entries().has({{section}, name, "auto", ""}))
        std::cout << "  NO, " << section << " / " << name
                  << " is not auto by default" << std::endl;
  report("  nothing is chosen", scene.chosen.empty());
  report("  cells of the paper",
         cells_of(scene) == cells_of(Scene()) &&
           scene.bone.cells == std::array<unsigned int, 3>{{15, 15, 2}} &&
           scene.implant.cells == std::array<unsigned int, 3>{{3, 3, 2}});
  report("  elements, bodies and steps, too",
         scene.bone.element == ElementKind::trilinear &&
           scene.bone.material == Material::neo_hookean &&
           !scene.load_steps.adaptive &&
           scene.load_steps.steps == std::vector<unsigned int>{1, 1000});
}



int
main()
{
  set_up_libraries();
  test_numbers_of_cells();
  test_scenes();
  test_contact_radius();
  test_coarser_scene();
  test_same_scenes();
  test_large_strains();
  test_none();
}
