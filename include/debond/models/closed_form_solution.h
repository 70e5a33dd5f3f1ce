#ifndef debond_models_closed_form_solution_h
#define debond_models_closed_form_solution_h

#include <debond/models/closed_forms.h>
#include <debond/models/foundation.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** The name of a closed form: the value of the entry `Model`. */
  std::string
  name_of_closed_form(ModelKind model);



  /**
   * A scene solved with the closed form that it asks for instead of finite
   * elements. Closed forms know one loading, a coin that is pressed down and
   * then turned, ever further, under constant pressure; scenes that ask for
   * more are refused. Nothing is written and nothing is printed.
   */
  class ClosedFormSolution
  {
  public:
    /** Throws InputError, beginning with the name of the entry, if the closed
     *  form does not apply to the scene. */
    explicit ClosedFormSolution(const Scene &scene);

    /** A row per planned step or, with adaptive steps, as many as the tolerance
     *  needs. What a closed form does not know is NaN. */
    const std::vector<TorqueRow> &
    rows() const
    {
      return all_rows;
    }

    const TorsionModel &
    model() const
    {
      return *torsion;
    }
    /** What the machine has jumped over at the end; empty if it is rigid. */
    std::vector<CompliantMachineTorsion::Jump>
    jumps() const;

    const Scene scene;
    /** Those of the foundation [MPa/mm], 0 where the model needs none. */
    double normal_stiffness = 0, torsional_stiffness = 0;
    /** The linear solution that they are from, if one was needed. */
    FoundationStiffness linear_solution;

  private:
    struct Load
    {
      double time  = 0;
      double push  = 0; ///< depth [mm] or force [N], positive downwards
      double angle = 0; ///< [rad]
    };

    Load
    load_at(double time) const;
    void
    check_loads() const;
    void
    refine_loads();
    void
    find_stiffness();
    double
    pressure(const Load &load) const;
    void
    make_model();
    std::unique_ptr<TorsionModel>
    make_foundation(const TorsionModel::Disk &disk);
    /** Of the disk [rad], where the load's is that of the machine. */
    double
    angle_of_disk(const Load &load) const;
    TorqueRow
    row(unsigned int step) const;
    void
    add_rows();

    std::vector<Load>                        loads; ///< one per row
    std::unique_ptr<TorsionModel>            torsion;
    std::unique_ptr<CompliantMachineTorsion> machine; ///< if it is compliant
    std::vector<TorqueRow>                   all_rows;
  };
} // namespace Debond
#endif
