#include <debond/models/simulation.h>

// How far the faces have moved along each other between the times of a scene.
namespace Debond
{
  // The first of `Output / Motion between' that is after a time; none: the last
  // one is reached.
  std::optional<double>
  Simulation::next_mark(const double time) const
  {
    const std::vector<double>  marks = scene.motion_times();
    const std::vector<double> &times = scene.load_steps.times;
    const double tolerance           = 1e-9 * (times.back() - times.front());
    for (const double mark : marks)
      if (mark > time + tolerance)
        return mark;
    return {};
  }



  // A motion begins with the row that has come to its first time, and is marked
  // when the next step is accepted: maps of that row show the motion before.
  void
  Simulation::mark_motion()
  {
    if (motion_goes_on || all_rows.empty())
      return;
    const double time = all_rows.back().time,
                 last = all_motions.empty() ? scene.motion_times().front() :
                                              all_motions.back().to;
    if (next_mark(time) == next_mark(last))
      {
        motion_goes_on = true;
        motion_begins  = time;
        coupled_system.interface.mark_motion();
      }
  }



  void
  Simulation::add_motion(const double time)
  {
    if (!motion_goes_on || next_mark(time) == next_mark(motion_begins))
      return;
    RelativeMotion motion = coupled_system.interface.relative_motion();
    motion.from           = motion_begins;
    motion.to             = time;
    all_motions.push_back(motion);
    motion_goes_on = false;
  }



  std::vector<RelativeMotion>
  Simulation::motions() const
  {
    std::vector<RelativeMotion> result = all_motions;
    if (scene.output.motion_between.empty() && motion_goes_on)
      {
        result.push_back(coupled_system.interface.relative_motion());
        result.back().from = motion_begins;
        result.back().to   = all_rows.back().time;
      }
    return result;
  }
} // namespace Debond
