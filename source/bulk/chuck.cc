#include <debond/bulk/chuck.h>
#include <debond/geometry/surface_geometry.h>
#include <debond/input/entry_table.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  const std::array<const char *, ChuckParameters::n_components>
    ChuckParameters::names{{"Translation x",
                            "Translation y",
                            "Translation z",
                            "Rotation x",
                            "Rotation y",
                            "Rotation z"}};



  std::string
  ChuckParameters::entry_name(const unsigned int k,
                              const std::string &entry) const
  {
    return std::string("Chuck / ") +
           (component[k].into_bone ? "Press" : names[k]) + " / " + entry;
  }



  std::string
  ChuckParameters::column_name(const unsigned int component, const bool of_load)
  {
    const bool rotation = is_rotation(component);
    return std::string("chuck_") +
           (of_load ? (rotation ? 'M' : 'F') : (rotation ? 'r' : 'u')) +
           "xyz"[component % 3] +
           (of_load ? (rotation ? "_Nmm" : "_N") : (rotation ? "_deg" : "_mm"));
  }



  // What presses has no column of torque.csv, whose forces are along z.
  std::string
  ChuckParameters::file_column(const unsigned int k) const
  {
    const bool loaded = component[k].loaded;
    return !component[k].into_bone ? column_name(k, loaded) :
           loaded                  ? "press_N" :
                                     "press_mm";
  }



  namespace
  {
    void
    declare_file(ChuckComponentParameters &component,
                 const std::string        &columns,
                 EntryTable               &table)
    {
      table.add(
        "File",
        component.file,
        Allowed::text("the name of a CSV file", false).or_word_for("none", ""),
        "Table of values over time or angle: a file from an instrument or "
        "spreadsheet, or the torque.csv or reactions.csv of a run, relative to "
        "the working directory. It needs two rows at least, and must cover all "
        "times, or angles, of the scene; between rows there are monotone "
        "cubics. With an angle (deg, rad) in place of the time, values are "
        "over the angle that Rotation z prescribes. `none': no table.");
      table.add(
        "Expert / File columns",
        component.columns,
        Allowed::text("two columns, the time or angle and the value", false)
          .or_word_for("auto", ""),
        "Columns of File with time or angle, and with the value: each by "
        "name or by number from 1, with a unit if the file has none: 1 "
        "[deg], force [kN], or 1 [s], torque [N m]; a minus before the unit, "
        "[-kN], turns the sign. `auto': time, or else angle_deg, and " +
          columns + " as Control says, else the only columns with such units.");
    }



    // C_k = 1/k! - t^2/(k + 2)! + t^4/(k + 4)! - ...: C_0 = cos t, C_1 = sin t
    // / t, C_2 = (1 - cos t)/t^2, and so on by t^2 C_(k+2) = 1/k! - C_k.
    std::array<double, 6>
    stumpff_functions(const double t)
    {
      std::array<double, 6> C{{std::cos(t), 1., 0., 0., 0., 0.}};
      if (t != 0.)
        C[1] = std::sin(t) / t;
      double factorial = 1.;
      for (unsigned int k = 0; k < 4; factorial *= ++k)
        if (t > 1.)
          C[k + 2] = (1. / factorial - C[k]) / (t * t);
        else
          {
            double term = 1. / factorial;
            for (unsigned int n = k + 1; n < k + 20; n += 2)
              {
                term /= n * (n + 1.);
                C[k + 2] += term;
                term *= -t * t;
              }
          }
      return C;
    }
  } // namespace



  void
  ChuckParameters::declare_component(const unsigned int k,
                                     const bool         into_bone,
                                     EntryTable        &table)
  {
    const bool                rotation = is_rotation(k);
    ChuckComponentParameters &own      = into_bone              ? press :
                                         component[k].into_bone ? unset :
                                                                  component[k];
    table.enter_subsection(into_bone ? "Press" : names[k]);
    table.add(
      "Control",
      own.loaded,
      Allowed::choice(rotation ? "angle | moment" : "displacement | force"),
      std::string("What Value means: ") +
        (rotation ? "`angle' [deg], or the conjugate `moment' [N mm] "
                    "(doc/explanation/bodies.md), of the chuck, positive "
                    "about +" :
                    "`displacement' [mm] or `force' [N] of the chuck, "
                    "positive ") +
        (into_bone ? "into the bone, along -z. Press and Translation z are one "
                     "motion: a scene sets one of them" :
                     std::string(rotation ? "" : "along +") + "xyz"[k % 3]) +
        ".");
    table.add("Value",
              own.value,
              Allowed::text(std::string("an expression in t, in ") +
                              (rotation ? "degrees or N mm" : "mm or N"),
                            false),
              std::string("Expression in the time t (constants pi and R [mm]), "
                          "in ") +
                (rotation ? "degrees for angle, N mm for moment" :
                            "mm for displacement, N for force") +
                ". sin and cos take radians: sin(2 * pi * t). With File the "
                "expression may use table, the value of the table; the "
                "default 0 then means table.");
    declare_file(own,
                 into_bone ?
                   "press_mm or press_N" :
                   column_name(k, false) + " or " + column_name(k, true),
                 table);
    table.add(
      "Stiffness",
      own.stiffness,
      Allowed::number_between(1e-9, 1e18, rotation ? "N mm/rad" : "N/mm")
        .or_word_for("none", "0"),
      std::string("Stiffness ") + (rotation ? "[N mm/rad]" : "[N/mm]") +
        " of the machine in series with this component. `none': a rigid "
        "machine.");
    table.leave_subsection();
  }



  void
  ChuckParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Chuck");
    table.add(
      "Point",
      point,
      Allowed::list(Allowed::number("mm"), 3, 3).or_word("auto"),
      "Point x, y, z [mm] of the implant that is translated, that rotations "
      "are about, and at which forces act, such as the end of a lever. "
      "`auto': the centre of the implant's top.");
    declare_component(ChuckComponent::translation_z, true, table);
    for (unsigned int k = 0; k < n_components; ++k)
      declare_component(k, false, table);
    table.leave_subsection();
  }



  Eigen::Vector3d
  ChuckParameters::place(const double height) const
  {
    std::array<double, 3> x{{0., 0., height}};
    if (point != "auto")
      read_entry(point, x);
    return Eigen::Vector3d(x.data());
  }



  Chuck::Chuck(const ChuckParameters &parameters,
               const Eigen::Vector3d &centre,
               const double           radius)
    : C(centre)
  {
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const auto &component = parameters.component[k];
        value_functions.push_back(parameters.value_over_time(k, radius));
        value_entries.push_back(parameters.entry_name(k, "Value"));
        stiffness[k]  = component.stiffness;
        loaded[k]     = component.loaded;
        compliant[k]  = stiffness[k] > 0.;
        prescribed[k] = !loaded[k] && !compliant[k];
        if (!prescribed[k])
          unknown_components.push_back(k);
      }
    move_to(q);
  }



  Chuck::Vector6
  Chuck::values(const double time) const
  {
    Vector6 result;
    for (unsigned int i = 0; i < 6; ++i)
      {
        // Rotation z first: what is wrong with it is also wrong over its angle
        const unsigned int k        = (i + ChuckComponent::rotation_z) % 6;
        const bool         is_angle = is_rotation(k) && !loaded[k];
        try
          {
            result[k] =
              value_functions[k](time) * (is_angle ? M_PI / 180. : 1.);
          }
        catch (const InputError &error)
          {
            throw EntryError(value_entries[k], error.what());
          }
      }
    return result;
  }



  Chuck::Vector6
  Chuck::rates(const double time, const double duration) const
  {
    const double h =
      std::min(1e-5 * std::max(1., std::abs(time)), 0.1 * duration);
    return (3. * values(time) - 4. * values(time - h) + values(time - 2. * h)) /
           (2. * h);
  }



  // Q = exp(skew(a)) R_z(gamma), exp(skew(a)) = I + C_1 A + C_2 A A with
  // A = skew(a) and the functions above of |a|. A change of the rotation vector
  // a turns space about b = J(a) da with J = C_1 I + C_2 A + C_3 a a^T, a
  // change of gamma about the implant's own axis exp(skew(a)) e_z. With t =
  // |a|, dC_k/dt = t (k C_(k+2) - C_(k+1)).
  void
  Chuck::move_to(const Vector6 &position)
  {
    using Eigen::Matrix3d, Eigen::Vector3d;
    q = position;
    const Vector3d a(q[ChuckComponent::rotation_x],
                     q[ChuckComponent::rotation_y],
                     0.);
    const auto     C = stumpff_functions(a.norm());
    const Matrix3d I = Matrix3d::Identity(), A = skew(a),
                   aa   = a * a.transpose();
    const Matrix3d tilt = I + C[1] * A + C[2] * (A * A);
    Q                   = tilt *
        Eigen::AngleAxisd(q[ChuckComponent::rotation_z], Vector3d::UnitZ());

    const Matrix3d J = C[1] * I + C[2] * A + C[3] * aa;
    b                = {{J.col(0), J.col(1), tilt.col(2)}};
    for (unsigned int l = 0; l < 2; ++l)
      {
        const Vector3d e  = Vector3d::Unit(l);
        const Matrix3d dJ = a[l] * ((C[3] - C[2]) * I + (2. * C[4] - C[3]) * A +
                                    (3. * C[5] - C[4]) * aa) +
                            C[2] * skew(e) +
                            C[3] * (e * a.transpose() + a * e.transpose());
        db[0][l] = dJ.col(0);
        db[1][l] = dJ.col(1);
        db[2][l] = b[l].cross(b[2]);
      }
    db[0][2] = db[1][2] = db[2][2] = Vector3d::Zero();
  }



  // x - C - u = Q(q) * const and dQ/dq_l = skew(b_l) Q.
  Eigen::Vector3d
  Chuck::second_derivative(const unsigned int     k,
                           const unsigned int     l,
                           const Eigen::Vector3d &x) const
  {
    if (!is_rotation(k) || !is_rotation(l))
      return Eigen::Vector3d::Zero();
    const Eigen::Vector3d r = x - centre();
    return db[k - 3][l - 3].cross(r) + axis(k).cross(axis(l).cross(r));
  }
} // namespace Debond
