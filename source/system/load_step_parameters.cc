#include <debond/input/allowed_values.h>
#include <debond/system/load_step_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace Debond
{
  void
  LoadSteppingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Load steps");
    prm.declare_entry("Times",
                      "0, 1, 2",
                      Allowed::numbers(2, 0, false, "time"),
                      "First time and the ends of the phases, increasing. Time "
                      "is a mere parameter of the load: nothing has inertia.");
    prm.declare_entry(
      "Steps",
      "1, 1000",
      Allowed::whole_numbers(1, 0),
      "Number of planned steps in each phase: one number less "
      "than Times. With Adaptive this sets the largest step. A step that "
      "turns the chuck by more than 5 degrees is divided: "
      "sliding points are pulled along the chords of their "
      "ways.");
    prm.declare_entry("Adaptive",
                      "false",
                      Allowed::yes_or_no(),
                      "Let the program choose the steps of each phase, at most "
                      "as large as the planned ones, such that torque and "
                      "forces drawn as straight lines between the rows keep "
                      "the Tolerance, relative to the largest value of each "
                      "(where the machine holds still to a tenth of the "
                      "largest of all, if that is more); each accepted step "
                      "is a row. The error in time of Interface / Viscosity is "
                      "not covered. A step that does not converge is halved in "
                      "any case.");
    prm.declare_entry("Tolerance",
                      "1e-3",
                      Allowed::number_between(1e-7, 1, ""),
                      "Relative accuracy wanted of the torque curve. With "
                      "Adaptive that of drawing it as straight lines between "
                      "the steps; with Model = auto the largest difference, "
                      "relative to the largest torque, from the curve of the "
                      "scene's bodies on a converged mesh. Else not used.");
    prm.declare_entry("Path following",
                      "none",
                      Allowed::choice("none | slip"),
                      "`none': the program goes through the planned steps of "
                      "the time, and jumps where the path of equilibrium snaps "
                      "back. `slip': it follows that path by prescribing the "
                      "mean sliding distance, while the time, and with it "
                      "everything the chuck prescribes, is found and may fall; "
                      "each accepted step is a row. While everything sticks "
                      "planned steps are taken.");
    prm.declare_entry("Largest slip step",
                      "0",
                      Allowed::number_from(0, "mm"),
                      "With Path following: largest step of the sliding "
                      "distance, averaged over the contact face [mm]. 0: a "
                      "twentieth of the distance over which friction falls, 2 "
                      "a_s b_s, or of a_s if that is less.");
    prm.declare_entry("Path ends at slip",
                      "0",
                      Allowed::number_from(0, "mm"),
                      "With Path following: the run ends when the mean sliding "
                      "distance reaches this [mm], if not at the last time. 0: "
                      "the radius of the implant. A moment larger than the "
                      "interface can carry has no last time: the implant would "
                      "turn for ever.");
    prm.declare_entry("Smallest step fraction",
                      "1e-4",
                      Allowed::number_between_excluding_lower(0, 1, ""),
                      "Smallest step as a fraction of a planned step; if a "
                      "smaller one were needed the run stops with an error.");
    prm.declare_entry("Residual tolerance",
                      "1e-8",
                      Allowed::number_between(1e-14, 0.1, ""),
                      "A step has converged when the residual is below this "
                      "fraction of the contact force.");
    prm.declare_entry(
      "Predictor",
      "extrapolate",
      Allowed::choice("extrapolate | stick first | rigid | none"),
      "What the first iteration of a step starts from. `extrapolate': the "
      "straight line through the last two states where there is one in this "
      "phase; else, and if that fails, as `stick first'. The others are there "
      "to be compared with, and a step that fails with them is halved at once. "
      "`stick first': the last state with the chuck moved, so that the "
      "implant goes along as it is; closed points stick in the first "
      "iteration. `rigid': the same, but every point sticks or slides as it "
      "must from the first iteration on. `none': the implant's deformable "
      "contact face stays where it is in space.");
    prm.leave_subsection();
  }



  void
  LoadSteppingParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Load steps");
    times                  = to_numbers(prm.get("Times"));
    steps                  = to_whole_numbers(prm.get("Steps"));
    smallest_step_fraction = prm.get_double("Smallest step fraction");
    residual_tolerance     = prm.get_double("Residual tolerance");
    adaptive               = prm.get_bool("Adaptive");
    tolerance              = prm.get_double("Tolerance");
    const std::string name = prm.get("Predictor");
    predictor              = name == "stick first" ? Predictor::stick_first :
                             name == "rigid"       ? Predictor::rigid :
                             name == "none"        ? Predictor::none :
                                                     Predictor::extrapolate;
    follow_path            = prm.get("Path following") == "slip";
    largest_slip_step      = prm.get_double("Largest slip step");
    path_ends_at_slip      = prm.get_double("Path ends at slip");
    prm.leave_subsection();
  }
} // namespace Debond
