#include <debond/campaigns/accurate_run.h>
#include <debond/campaigns/run_scene.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/output/curve_comparison.h>
#include <debond/scene/finer_scenes.h>
#include <debond/scene/scene.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>
#include <debond/system/memory_estimate.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/timer.h>

#include <regex>
#include <thread>

namespace Debond
{
  void
  run_scene(const Scene              &scene,
            std::shared_ptr<BodyPair> bodies,
            std::ostream *const       plan)
  {
    const dealii::Timer clock;
    scene.require_same_on_all_ranks();
    if (plan != nullptr && scene.model != ModelKind::finite_elements)
      for (const Warning &warning : scene.warnings())
        *plan << "warning: " << warning.text << '\n';
    try
      {
        if (plan != nullptr)
          for (const std::string &doubt : doubts_of_reference(scene))
            *plan << "warning: " << doubt << '\n';
        if (scene.model == ModelKind::finite_elements)
          {
            if (plan != nullptr)
              {
                print_choices(scene, *plan);
                DebondingProblem(scene, std::move(bodies)).check(*plan);
              }
            else
              run_to_accuracy(scene, std::move(bodies));
          }

        else
          {
            const ClosedFormSolution solution(scene);
            plan != nullptr ? describe(solution, *plan) :
                              write_results(solution, clock);
          }
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error); // what is said of the scene gets a place
      }
  }



  std::string
  what_bodies_depend_on(const Scene &scene)
  {
    // a process that has begun with MPI may not fork
    if (scene.model != ModelKind::finite_elements ||
        (Ranks::number() == 1 && scene.bulk_solver() == BulkSolver::multigrid))
      return "";
    static const std::regex of_bodies("(Expert / )?((Bone|Implant) / [^/]*|"
                                      "Interface / (Slave|Quadrature points))");
    std::string             text;
    Chuck                   chuck(scene.chuck,
                scene.chuck.place(scene.implant.geometry().chuck_height),
                scene.implant.characteristic_radius());
    chuck.place(scene.load_steps.times.front());
    for (const double q : chuck.position())
      text += to_text(q, 17) + " ";
    // which depends on motion, loads and path, too
    text += std::to_string(int(scene.bulk_solver())) + "\n";
    for (const SceneEntry &entry : scene.completed_entries())
      {
        const std::string name = entry.full_name();
        if (std::regex_match(name, of_bodies))
          text += name + " = " + entry.value + "\n";
      }
    if (scene.bone.modulus && scene.bone.modulus->voxels())
      text += scene.bone.modulus->voxels()->identity;
    return text;
  }



  std::shared_ptr<BodyPair>
  condensed_bodies(Scene scene)
  {
    scene.interface.bonding      = {}; // that is not the bodies'
    const unsigned int n_threads = dealii::MultithreadInfo::n_threads();
    set_number_of_threads(1);
    std::shared_ptr<BodyPair> bodies;
    std::thread([&] {
      set_number_of_threads(1);
      try
        {
          require_memory(scene, scene.output.fields_every > 0, false);
          dealii::Timer clock;
          CoupledSystem system(scene);
          system.start(scene.load_steps.times.front());
          system.bodies()->seconds_shared = clock.wall_time();
          bodies                          = system.bodies();
        }
      catch (const std::exception &)
        {} // the variants will meet it again, and say so
    }).join();
    set_number_of_threads(n_threads);
    return bodies;
  }



  void
  run_variant(Scene                            scene,
              const std::shared_ptr<BodyPair> &bodies,
              const bool                       force)
  {
    scene.output.extendable = false;
    scene.changed_entries.clear(); // of the study
    if (!force && scene.model == ModelKind::finite_elements)
      if (const auto checkpoint = find_checkpoint(scene))
        try
          {
            const Scene now = with_choices_of(scene, checkpoint->parameters);
            const bool  has_its_bodies =
              what_bodies_depend_on(now) == what_bodies_depend_on(scene);
            return run_to_accuracy(now,
                                   has_its_bodies ? bodies : nullptr,
                                   &*checkpoint);
          }
        catch (const ForeignCheckpoint &) // of groups, or from before them
          {
            if (bodies)
              bodies->return_to_rest();
          }
    // a checkpoint that is of no use is not kept; the study has made sure
    // that there are no results of another scene
    scene.output.overwrite_other_results = true;
    run_scene(scene, bodies);
  }
} // namespace Debond
