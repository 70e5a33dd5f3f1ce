#include <debond/input/allowed_values.h>
#include <debond/scene/scene.h>

#include <algorithm>

// Entries that were set, and that nothing reads in this scene.
namespace Debond
{
  namespace
  {
    /** Entries by the beginnings of their names, and what reads them. */
    struct Reader
    {
      bool                     is_there; ///< in the scene
      std::string              name;
      std::vector<std::string> beginnings;

      bool
      reads(const std::string &entry) const
      {
        return std::any_of(beginnings.begin(),
                           beginnings.end(),
                           [&](const std::string &beginning) {
                             return entry.rfind(beginning, 0) == 0 ||
                                    entry.rfind("Expert / " + beginning, 0) ==
                                      0;
                           });
      }
    };



    std::vector<Reader>
    readers_of_bodies(const Scene &scene, const bool laws_of_points)
    {
      const BodyParameters &bone = scene.bone, &implant = scene.implant;
      const bool            are_solved =
        scene.model == ModelKind::finite_elements || scene.asks_bodies();
      return {
        {are_solved,
         "closed forms that ask the bodies for their stiffness",
         {"Bone / Size",
          "Bone / Young",
          "Implant / Height",
          "Implant / Young",
          "Interface / Normal"}},
        {bone.shape != BodyShape::cavity || bone.outer_radius == 0.,
         "a block",
         {"Bone / Size"}},
        {laws_of_points || !bone.is_rigid(),
         "laws of points, and bodies that deform",
         {"Bone / Cells", "Bone / Contact", "Bone / Lateral", "Bone / Size"}},
        {!bone.is_rigid(),
         "bodies that deform",
         {"Bone / Young",
          "Bone / Poisson",
          "Bone / Layer",
          "Bone / Tensile",
          "Bone / Compressive"}},
        {!implant.is_rigid(),
         "bodies that deform",
         {"Implant / Young", "Implant / Poisson", "Implant / Layer"}},
        {implant.shape == BodyShape::cap && implant.is_fitted(),
         "fitted cells of a cap",
         {"Implant / Contact radius"}},
        {!bone.voxel_file.empty(), "a Voxel file", {"Bone / Voxel corner"}},
        {bone.cells_under_implant > 0,
         "Expert / Bone / Cells under implant",
         {"Bone / Rim grading"}}};
    }



    std::vector<Reader>
    readers_of_shapes(const Scene &scene)
    {
      std::vector<Reader> readers;
      for (const auto &[body, name] : {std::pair(&scene.bone, "Bone / "),
                                       std::pair(&scene.implant, "Implant / ")})
        {
          const auto &own = body->shape_row().entries;
          for (const ShapeRow &shape : shape_rows())
            for (const std::string &entry : shape.entries)
              readers.push_back({is_among(own, entry),
                                 "Shape = " + shape.name,
                                 {name + entry}});
        }
      return readers;
    }



    std::vector<Reader>
    readers_of_model(const Scene &scene)
    {
      const ModelKind model    = scene.model;
      const bool      is_crack = model == ModelKind::crack,
                 of_angles     = model == ModelKind::prescribed_angles,

                 of_elements = model == ModelKind::finite_elements,
                 follows     = scene.load_steps.follow_path;
      const auto &changed    = scene.changed_entries;
      return {{of_elements, "finite elements", {"Accuracy"}},
              {scene.accuracy > 0., "an Accuracy", {"Expert / Largest"}},
              {scene.load_steps.adaptive,
               "Adaptive steps",
               {"Load steps / Tolerance"}},
              {follows,
               "Path following = slip",
               {"Load steps / Largest slip", "Load steps / Path ends"}},
              {!of_elements, "closed forms", {"Closed form / "}},
              {!is_crack && !of_angles,
               "Model = foundation",
               {"Closed form / Torsional"}},
              {of_angles,
               "Model = prescribed angles",
               {"Closed form / Linear", "Closed form / Slip"}},
              {is_crack,
               "Model = crack",
               {"Closed form / Shear", "Closed form / Adhesion"}},

              {std::any_of(changed.begin(),
                           changed.end(),
                           [](const SceneEntry &e) {
                             return e.name == "Task";
                           }),
               "Task = calibrate",
               {"Calibration / "}}};
    }



    std::vector<Reader>
    readers_of_interface(const Scene &scene, const bool laws_of_points)
    {
      const InterfaceParameters &interface = scene.interface;
      const FrictionLaw         &law       = *interface.friction;
      const bool                 pulls     = [&] {
        try
          {
            return interface.joint()->pulls();
          }
        catch (const EntryError &) // its numbers do not go together
          {
            return interface.law_choice.law == "mixed mode";
          }
      }();
      const bool is_bonded = law.has_bond() || pulls,
                 rubs      = !law.is_frictionless,
                 has_steps = scene.model == ModelKind::finite_elements,
                 by_slip   = rubs && scene.model != ModelKind::crack &&
                           interface.law_choice.law != "mixed mode",
                 // Largest slip step = auto goes by them, also without a bond
        wears =
          by_slip && (is_bonded || (scene.load_steps.follow_path &&
                                    scene.load_steps.largest_slip_step == 0.));
      return {{interface.bonding.pattern != BondingPatternKind::homogeneous,
               "other patterns",
               {"Interface / Bonding / Resolution"}},
              {rubs && has_steps,
               "laws with friction in finite elements",
               {"Interface / Friction starts at"}},
              {laws_of_points && (rubs || pulls),
               "laws of points that stick",
               {"Interface / Tangential"}},
              {wears,
               "bonds that slip wears",
               {"Interface / Characteristic", "Interface / Transition"}},
              {by_slip,
               "bonds that slip wears",
               {"Interface / Friction coefficient unbroken"}},
              {rubs && has_steps,
               "friction in finite elements",
               {"Expert / Slip"}},
              {rubs,
               "laws with friction",
               {"Interface / Friction exponent",
                "Interface / Friction over",
                "Interface / Bone shear"}},
              {rubs && interface.pressure_dependence.exponent != 1.,
               "a Friction exponent",
               {"Interface / Reference"}},
              {interface.bone_layer.crushes(),
               "a Crushing strength",
               {"Interface / Crushing modulus"}},
              {rubs && interface.bone_layer.shears(),
               "a Bone shear strength",
               {"Interface / Shear in bone"}},
              {is_bonded || law.depends_on_rate,
               "friction that changes",
               {"Expert / Friction update"}},
              {is_bonded,
               "laws with a bond",
               {"Interface / Bonding / ", "Output / Observed bonding"}}};
    }



    /** What reads parameters of a law that is not chosen; else empty. */
    std::string
    other_law(const InterfaceParameters &interface, const std::string &entry)
    {
      const auto joints = interface.law_choice.laws_with(entry),
                 laws   = interface.friction_choice.laws_with(entry);
      if (!laws.empty() && (!is_among(laws, interface.friction_choice.law) ||
                            interface.friction->is_frictionless))
        return "another Friction law";
      return joints.empty() || is_among(joints, interface.law_choice.law) ?
               "" :
               "Law = " + joints.front();
    }
  } // namespace



  std::string
  lacking_reader(const Scene &scene, const std::string &full_name)
  {
    const bool laws_of_points = scene.model != ModelKind::crack &&
                                scene.model != ModelKind::prescribed_angles;
    std::string reader = other_law(scene.interface, full_name);
    for (const auto &readers : {readers_of_model(scene),
                                readers_of_shapes(scene),
                                readers_of_bodies(scene, laws_of_points),
                                readers_of_interface(scene, laws_of_points)})
      for (const Reader &one : readers)
        if (reader.empty() && !one.is_there && one.reads(full_name))
          reader = one.name;
    return reader;
  }



  std::vector<Warning>
  unread_entries(const Scene &scene)
  {
    std::vector<Warning> found;
    for (const SceneEntry &entry : scene.changed_entries)
      {
        // What an included file sets is for several scenes. Only what stands in
        // a file has a line as its place.
        if (entry.place.find(':') != std::string::npos &&
            entry.place.rfind(scene.name + ":", 0) != 0)
          continue;
        const std::string name   = entry.full_name(),
                          reader = lacking_reader(scene, name);
        if (!reader.empty())
          found.push_back({name,
                           name + " = " + shortened(entry.value) +
                             " has no effect in this scene: it is for " +
                             reader});
      }
    return found;
  }
} // namespace Debond
