#include <debond/campaigns/variant_queue.h>
#include <debond/models/memory_estimate.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <iostream>
#include <thread>

namespace Debond
{
  namespace
  {
    /** Where the bodies are when the interface is set up. */
    std::string
    first_placement(const Scene &scene)
    {
      Chuck chuck(scene.chuck,
                  Eigen::Vector3d(0, 0, scene.implant.thickness()),
                  scene.implant.characteristic_radius());
      chuck.place(scene.load_steps.times.front());
      std::string text;
      for (const double q : chuck.position())
        text += to_text(q, 17) + " ";
      return text;
    }



    /** What scenes agree in if they can share bodies; empty if the scene shares
     *  them with none. */
    std::string
    common_part(const Scene &scene)
    {
      if (scene.model != ModelKind::finite_elements)
        return "";
      std::string text = first_placement(scene);
      for (const SceneEntry &entry :
           read_scene_text(scene.completed_parameters, scene.name))
        {
          const std::string name = entry.full_name();
          if (entry.subsections == std::vector<std::string>{"Bone"} ||
              entry.subsections == std::vector<std::string>{"Implant"} ||
              name == "Interface / Slave" ||
              name == "Interface / Quadrature points")
            text += name + " = " + entry.value + "\n";
        }
      return text;
    }



    /** The bodies of a scene, condensed on what contact reaches at first; none
     *  if that is impossible. */
    std::shared_ptr<BodyPair>
    condensed_bodies(Scene scene)
    {
      scene.interface.bonding = {}; // that is not the bodies'
      try
        {
          require_memory(scene);
          dealii::Timer clock;
          CoupledSystem system(scene);
          system.start(scene.load_steps.times.front());
          system.bodies()->seconds_shared = clock.wall_time();
          return system.bodies();
        }
      catch (const std::exception &)
        {
          return nullptr; // the variants will meet it again, and say so
        }
    }



    /** The same in a thread of its own that has ended: what TBB keeps for a
     *  thread, here that there is but one, would stay with this one and go on
     *  in the processes that it starts. */
    std::shared_ptr<BodyPair>
    condensed_bodies_in_one_thread(const Scene &scene)
    {
      const unsigned int n_threads = dealii::MultithreadInfo::n_threads();
      set_number_of_threads(1);
      std::shared_ptr<BodyPair> bodies;
      std::thread([&] {
        set_number_of_threads(1);
        bodies = condensed_bodies(scene);
      }).join();
      set_number_of_threads(n_threads);
      return bodies;
    }
  } // namespace



  void
  VariantQueue::add(const unsigned int variant,
                    const Scene       &scene,
                    const bool         may_share)
  {
    const std::string  key = may_share ? common_part(scene) : "";
    const unsigned int group =
      group_of.emplace(key, group_of.size()).first->second;
    waiting.insert({group, {variant, &scene, !key.empty()}});
  }



  VariantQueue::Next
  VariantQueue::next()
  {
    const auto [group, first] = *waiting.begin();
    if (group != last_group)
      {
        bodies.reset(); // before there are others
        if (first.may_share && waiting.count(group) >= std::max(2U, n_jobs))
          bodies = condensed_bodies_in_one_thread(*first.scene);
        last_group = group;
      }
    waiting.erase(waiting.begin());
    const Next result{first.variant, bodies};
    if (waiting.find(group) == waiting.end())
      bodies.reset();
    return result;
  }
} // namespace Debond
