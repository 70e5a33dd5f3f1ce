#pragma once

#include <debond/input/expression_parser.h>
#include <debond/input/monotone_curve.h>
#include <debond/support/accepted_state.h>

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  class EntryTable;

  /** The six motions of the chuck, and the forces and moments conjugate to
   *  them, in the order of every vector of them. */
  struct ChuckComponent
  {
    enum : unsigned int
    {
      translation_x,
      translation_y,
      translation_z,
      rotation_x,
      rotation_y,
      rotation_z
    };
  };

  /** True if a component is an angle or a moment. */
  constexpr bool
  is_rotation(const unsigned int component)
  {
    return component >= ChuckComponent::rotation_x;
  }

  /** One of the six subsections of `Chuck`. */
  struct ChuckComponentParameters
  {
    bool loaded = false; ///< force or moment instead of displacement or angle
    /** Expression in t (constants pi, R), and in `table` with a file. Units:
     *  mm, degrees, N, N mm. */
    std::string              value = "0";
    std::string              file; ///< with a table of values, or empty
    bool                     over_angle = false; ///< the file; else over time
    std::vector<std::string> columns;            ///< empty: recognised
    double stiffness = 0; ///< of the machine [N/mm or N mm/rad]; 0: rigid
    /** True if value, file and function are those of `Press', positive into the
     *  bone. */
    bool into_bone = false;
    /** Curve of the file, over time or over the angle [deg]; null: none. */
    std::shared_ptr<const MonotoneCurve> table;
    /** Of time, in the same units: if it is set, it counts instead of the
     *  expression. For scenes that a program makes; no entry of a file. */
    std::function<double(double)> function;

    /** True if its place is an unknown: under a load, or on a spring. */
    bool
    is_unknown() const
    {
      return loaded || stiffness != 0.;
    }
  };

  /** The subsection `Chuck`: Translation x, y, z, Rotation x, y, z, and Press,
   *  which is Translation z with the other sign. */
  struct ChuckParameters
  {
    static constexpr unsigned int n_components = 6;
    /** "Translation x" ... "Rotation z". */
    static const std::array<const char *, n_components> names;

    std::array<ChuckComponentParameters, n_components> component;
    /** As a scene gives it; read_tables() puts it in the place of Translation
     *  z. */
    ChuckComponentParameters press;
    /** Where forces act and displacements are measured [mm]; or `auto'. */
    std::string point = "auto";

    /** The same in numbers; @p height: that of `auto', on the axis. */
    Eigen::Vector3d
    place(double height) const;

    /** "Chuck / Rotation z / Value" and the like. */
    std::string
    entry_name(unsigned int component, const std::string &entry) const;
    /** The column of the file of a component that holds its values. */
    std::string
    file_column(unsigned int component) const;

    /** "chuck_Fz_N", "chuck_rz_deg" and the like: what is called so in
     *  torque.csv is positive along or about an axis. @p of_load: force or
     *  moment instead of displacement or angle. */
    static std::string
    column_name(unsigned int component, bool of_load);

    void
    declare(EntryTable &table);

    /** Takes Press for Translation z, if a scene says Press. Throws EntryError
     *  if it says both. */
    void
    take_press();

    /** The same, and reads the tables of all components
     *  that have a file, which scenes made by a program must do as well. Throws
     *  EntryError. */
    void
    read_tables();

    /** Value that the scene prescribes to a component, in the units of its
     * value; @p radius is the `R` of expressions [mm]. */
    TimeFunction
    value_over_time(unsigned int component, double radius) const;

    /** Refuses entries about tables that do not go together. Throws
     *  EntryError. */
    void
    check() const;
    /** Refuses tables that do not hold what is asked for at @p times. Throws
     *  EntryError. */
    void
    check_tables(const std::vector<double> &times, double radius) const;

  private:
    void
    declare_component(unsigned int component,
                      bool         into_bone,
                      EntryTable  &table);

    /** Translation z in the tables of a scene that has Press. */
    ChuckComponentParameters unset;

    /** Time, or angle [deg], that the table of a component is read at. */
    TimeFunction
    abscissa_over_time(unsigned int component, double radius) const;
  };

  /**
   * The rigid top face of the implant, and with it the implant's moving frame:
   *
   *   x = C + u + Q (X - C + v),   Q = exp(skew(a)) R_z(gamma),
   *
   * with six components q = (u, a_x, a_y, gamma): translations [mm], a rotation
   * vector in space and the angle about the implant's own axis [rad]. Each is
   * prescribed, or an unknown with an equation of its own if it is loaded or if
   * the machine that drives it is compliant.
   */
  class Chuck
  {
  public:
    using Vector6 = Eigen::Matrix<double, 6, 1>;

    /** @p centre is C; @p radius the `R` of expressions [mm]. */
    Chuck(const ChuckParameters &parameters,
          const Eigen::Vector3d &centre,
          double                 radius);

    /** Components that are unknowns, in ascending order. */
    const std::vector<unsigned int> &
    unknowns() const
    {
      return unknown_components;
    }

    /** Places the implant where the scene wants it at @p time: all components
     *  but the loaded ones, which start at zero. This is the accepted state. */
    void
    place(const double time)
    {
      target = values(time);
      move_to(loaded.select(q, target));
      accepted = AcceptedState<Vector6>(q);
    }
    /** Sets the prescribed components of the trial state and the loads to
     *  their values at @p time. */
    void
    prescribe(const double time)
    {
      target = values(time);
      move_to(prescribed.select(target, q));
    }
    /** The six values of the scene at a time, in internal units (radians). */
    Vector6
    values(double time) const;

    /** Their rates of change with time up to it, where a phase may end; by
     *  differences, within a fifth of the @p duration of the step. */
    Vector6
    rates(double time, double duration = 1e100) const;
    /** True if the place of a component is prescribed, at any load. */
    bool
    is_prescribed(const unsigned int k) const
    {
      return prescribed[k];
    }
    bool
    is_loaded(const unsigned int k) const
    {
      return loaded[k];
    }

    const Vector6 &
    position() const
    {
      return q;
    }
    /** Position of the machine: the scene's values where the machine is
     *  compliant, else that of the chuck. */
    Vector6
    machine_position() const
    {
      return compliant.select(target, q);
    }
    /** Energy stored in a compliant machine under @p forces [N mm]. */
    double
    machine_energy(const Vector6 &forces) const
    {
      return compliant
        .select(0.5 * forces.array().square() / stiffness.array(), 0.)
        .sum();
    }
    void
    correct(const unsigned int component, const double dq)
    {
      move_to(q + dq * Vector6::Unit(component));
    }
    /** Motion since the accepted state. */
    Vector6
    change() const
    {
      return q - accepted.value;
    }
    /** Places it in the middle of the way from the accepted to the trial state,
     *  on the cubic with these changes at both ends: rates times duration. */
    void
    place_in_middle(const Vector6 &begin, const Vector6 &end)
    {
      move_to((accepted.value + q) / 2. + (begin - end) / 8.);
    }
    /** Moves components with a compliant machine to where its springs are
     *  relaxed. */
    void
    relax_machine()
    {
      move_to(machine_position());
    }
    bool
    has_compliant_machine() const
    {
      return compliant.any();
    }
    void
    commit(const double time)
    {
      accepted.commit(q, time);
    }
    void
    rollback()
    {
      move_to(accepted.value);
    }
    /** Starts from the accepted state; unknown components are extrapolated
     *  linearly to @p time if asked and if two states are known. */
    void
    predict(const double time, const bool extrapolate)
    {
      move_to(extrapolate ?
                Vector6(prescribed.select(accepted.value,
                                          accepted.extrapolated(time))) :
                accepted.value);
    }

    /** Q of the trial state. */
    const Eigen::Matrix3d &
    rotation() const
    {
      return Q;
    }
    const Eigen::Vector3d &
    reference_centre() const
    {
      return C;
    }
    /** C + u. */
    Eigen::Vector3d
    centre() const
    {
      return C + q.head<3>();
    }
    /** Spatial position of the material point X + v. */
    Eigen::Vector3d
    map(const Eigen::Vector3d &X, const Eigen::Vector3d &v) const
    {
      return centre() + Q * ((X - C) + v);
    }
    /** The same for several points, one in each column. */
    Eigen::Matrix3Xd
    map_points(const Eigen::Matrix3Xd &X, const Eigen::Matrix3Xd &v) const
    {
      return (Q * ((X.colwise() - C) + v)).colwise() + centre();
    }

    /** dx/dq_k of a point at spatial position x: e_k, or b_k x (x - C - u). */
    Eigen::Vector3d
    velocity(const unsigned int k, const Eigen::Vector3d &x) const
    {
      return is_rotation(k) ? axis(k).cross(x - centre()) :
                              Eigen::Vector3d::Unit(k);
    }
    /** d^2 x / dq_k dq_l. */
    Eigen::Vector3d
    second_derivative(unsigned int           k,
                      unsigned int           l,
                      const Eigen::Vector3d &x) const;
    /** Axis b_k of a rotation (k = 3, 4, 5), in space; b_5 is the implant's own
     * axis. */
    const Eigen::Vector3d &
    axis(unsigned int k) const
    {
      return b[k - 3];
    }

    /** Rate of the axis while the chuck moves at @p rates. */
    Eigen::Vector3d
    axis_rate(const unsigned int k, const Vector6 &rates) const
    {
      const auto &by = db[k - 3];
      return rates[3] * by[0] + rates[4] * by[1] + rates[5] * by[2];
    }

    /** Force or moment that the machine applies to component k at its trial
     *  position [N, N mm]: the load, or stiffness times the lag behind the
     *  prescribed value. Only for unknown components. */
    double
    machine_load(const unsigned int k) const
    {
      return loaded[k] ? target[k] : stiffness[k] * (target[k] - q[k]);
    }
    /** d machine_load / d value of the scene. */
    double
    machine_load_per_value(const unsigned int k) const
    {
      return loaded[k] ? 1. : stiffness[k];
    }
    /** d machine_load / dq_k. */
    double
    machine_stiffness(const unsigned int k) const
    {
      return loaded[k] ? 0. : -stiffness[k];
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &q &accepted &target;
      move_to(q);
    }

  private:
    /** Sets q and all that depends on it. */
    void
    move_to(const Vector6 &position);

    const Eigen::Vector3d     C;
    std::vector<TimeFunction> value_functions;
    std::vector<std::string>  value_entries; ///< their names
    std::vector<unsigned int> unknown_components;
    Vector6                   stiffness; ///< of the machine, 0: rigid
    Eigen::Array<bool, ChuckParameters::n_components, 1> loaded, compliant,
      prescribed; ///< neither loaded nor compliant

    Vector6                q = Vector6::Zero(); ///< trial position
    AcceptedState<Vector6> accepted{q};
    Vector6 target = Vector6::Zero(); ///< values of the scene at the trial time

    Eigen::Matrix3d                               Q;
    std::array<Eigen::Vector3d, 3>                b;
    std::array<std::array<Eigen::Vector3d, 3>, 3> db; ///< db[k][l] = db_k/dq_l
  };
} // namespace Debond
