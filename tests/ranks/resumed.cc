// A run that several ranks have begun goes on with another number of them, from
// what a checkpoint holds: as if it had never stopped, to 1e-9 of the largest
// torque. A checkpoint is the same on all ranks.

#include <debond/models/simulation.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/support/serialization.h>

#include <sstream>

#include "../checks.h"
#include "../pressed_and_turned.h"
#include "../coin_scene.h"

using namespace Debond;



Scene
scene_of(const std::string &change)
{
  return coin_scene(pressed_and_turned + R"(
subsection Bone
  set Cells       = 10, 10, 4
  set Material    = linear
end
subsection Implant
  set Cells    = 3, 2
  set Material = linear
end
subsection Load steps
  set Times = 0, 1, 1.1
  set Steps = 1, 8
end
subsection Expert
  subsection Bone
    set Solver = multigrid
  end
  subsection Load steps
    set Residual tolerance = 1e-11
  end
end
)",
                    {change});
}



std::string
saved(Simulation &simulation)
{
  std::string bytes;
  SavingArchive(bytes) & simulation;
  return bytes;
}



void
go_on_alone(const std::string &change)
{
  Simulation begun(scene_of(change));
  for (unsigned int row = 0; row < 5; ++row)
    begun.advance();
  const std::string checkpoint = saved(begun);
  begun.run();

  double difference = 0., largest = 0.;
  {
    const Ranks::Together alone(MPI_COMM_SELF);
    Simulation            resumed(scene_of(change));
    LoadingArchive(checkpoint) & resumed;
    resumed.run();
    for (unsigned int i = 0; i < begun.rows().size(); ++i)
      {
        grow(difference,
             std::abs(begun.rows()[i].torque_Nmm -
                      resumed.rows()[i].torque_Nmm));
        grow(largest, std::abs(begun.rows()[i].torque_Nmm));
      }
  }
  const double of_all = Ranks::largest(difference / largest);
  if (Ranks::is_first())
    report(change, of_all, 1e-9);
}



int
main()
{
  set_up_libraries();
  Ranks::start();
  go_on_alone("Bone/Material=linear");
  go_on_alone("Bone/Material=neo-hookean");
  go_on_alone("Bone/Element=spline");
  Ranks::finish();
}
