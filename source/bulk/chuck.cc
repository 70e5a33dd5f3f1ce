#include <debond/bulk/chuck.h>
#include <debond/input/entry_table.h>
#include <debond/support/input_error.h>
#include <debond/support/skew.h>

#include <Eigen/Geometry>

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
  ChuckParameters::entry_name(const unsigned int component,
                              const std::string &entry)
  {
    return std::string("Chuck / ") + names[component] + " / " + entry;
  }



  void
  ChuckParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Chuck");
    for (unsigned int c = 0; c < n_components; ++c)
      {
        const bool        rotation = is_rotation(c);
        const std::string axis(1, "xyz"[c % 3]);
        table.enter_subsection(names[c]);
        table.add("Control",
                  component[c].loaded,
                  Allowed::choice(rotation ? "angle | moment" :
                                             "displacement | force"),
                  rotation ?
                    "What Value means: `angle' [deg] or `moment' [N mm] of the "
                    "chuck, positive about +" +
                      axis + "." :
                    "What Value means: `displacement' [mm] or `force' [N] of "
                    "the chuck, positive along +" +
                      axis + ".");
        table.add("Value",
                  component[c].value,
                  Allowed::text(std::string("an expression in t, in ") +
                                (rotation ? "degrees or N mm" : "mm or N")),
                  std::string("Expression in the time t (muParser; constants "
                              "pi and R [mm]), in ") +
                    (rotation ? "degrees for angle, N mm for moment" :
                                "mm for displacement, N for force") +
                    ". Note that sin and cos expect radians: sin(2 * pi * t).");
        table.add("File",
                  "",
                  nullptr,
                  Allowed::reserved(""),
                  "Reserved: a CSV table instead of Value.");
        table.add(
          "Stiffness",
          component[c].stiffness,
          Allowed::number_between(1e-9, 1e18, rotation ? "N mm/rad" : "N/mm")
            .or_number(0),
          std::string("Stiffness ") + (rotation ? "[N mm/rad]" : "[N/mm]") +
            " of the machine in series with this component; 0: a rigid "
            "machine.");
        table.leave_subsection();
      }
    table.leave_subsection();
  }
} // namespace Debond

namespace Debond
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;

    // sin t / t, (1 - cos t)/t^2, (t - sin t)/t^3 and their derivatives divided
    // by t, all even functions of t.
    struct RotationCoefficients
    {
      std::array<double, 3> c, dc;

      explicit RotationCoefficients(const double t)
      {
        const double t2 = t * t;
        if (t < 0.3)
          {
            // power series: c_j = sum_m (-1)^m t^2m / (2m + 1 + j)!
            for (unsigned int j = 0; j < 3; ++j)
              {
                double factorial = (j == 2 ? 6. : j == 1 ? 2. : 1.);
                double power = 1., previous = 0.;
                c[j] = dc[j] = 0.;
                for (unsigned int m = 0; m < 10; ++m)
                  {
                    c[j] += power / factorial;
                    dc[j] += 2. * m * previous / factorial;
                    factorial *= (2. * m + 2. + j) * (2. * m + 3. + j);
                    previous = -power;
                    power *= -t2;
                  }
              }
            return;
          }
        const double s = std::sin(t), k = std::cos(t);
        c  = {{s / t, (1. - k) / t2, (t - s) / (t2 * t)}};
        dc = {{(k - s / t) / t2,
               (s * t - 2. * (1. - k)) / (t2 * t2),
               ((1. - k) * t - 3. * (t - s)) / (t2 * t2 * t)}};
      }
    };
  } // namespace



  Chuck::Chuck(const ChuckParameters &parameters,
               const Vector3d        &centre,
               const double           radius)
    : C(centre)
  {
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const auto &component = parameters.component[k];
        value_functions.push_back(component.value_over_time(radius));
        stiffness[k]  = component.stiffness;
        loaded[k]     = component.loaded;
        compliant[k]  = stiffness[k] > 0.;
        prescribed[k] = !loaded[k] && !compliant[k];
        if (!prescribed[k])
          unknown_components.push_back(k);
      }
    update_frame();
  }



  Chuck::Vector6
  Chuck::values(const double time) const
  {
    Vector6 result;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const bool is_angle = is_rotation(k) && !loaded[k];
        try
          {
            result[k] =
              value_functions[k](time) * (is_angle ? M_PI / 180. : 1.);
          }
        catch (const InputError &error)
          {
            throw EntryError(ChuckParameters::entry_name(k, "Value"),
                             error.what());
          }
      }
    return result;
  }



  Chuck::Vector6
  Chuck::rates(const double time) const
  {
    const double h = 1e-6 * std::max(1., std::abs(time));
    return (values(time + h) - values(time - h)) / (2. * h);
  }



  void
  Chuck::prescribe(const double time)
  {
    target = values(time);
    q      = prescribed.select(target, q);
    update_frame();
  }



  void
  Chuck::place(const double time)
  {
    target   = values(time);
    q        = loaded.select(q, target);
    accepted = AcceptedState<Vector6>(q);
    update_frame();
  }



  void
  Chuck::correct(const unsigned int component, const double dq)
  {
    q[component] += dq;
    update_frame();
  }



  void
  Chuck::relax_machine()
  {
    q = compliant.select(target, q);
    update_frame();
  }



  void
  Chuck::rollback()
  {
    q = accepted.value;
    update_frame();
  }



  void
  Chuck::predict(const double time, const bool extrapolate)
  {
    q = accepted.value;
    if (extrapolate)
      q = prescribed.select(q, accepted.extrapolated(time));
    update_frame();
  }



  // Q = exp(skew(a)) R_z(gamma). A change of the rotation vector a turns space
  // about b = J(a) da with J = c_0 I + c_1 skew(a) + c_2 a a^T, a change of
  // gamma about the implant's own axis exp(skew(a)) e_z.
  void
  Chuck::update_frame()
  {
    const Vector3d             a(q[ChuckComponent::rotation_x],
                     q[ChuckComponent::rotation_y],
                     0.);
    const RotationCoefficients r(a.norm());
    const Matrix3d             A = skew(a);
    const Matrix3d tilt = Matrix3d::Identity() + r.c[0] * A + r.c[1] * (A * A);
    const double   s    = std::sin(q[ChuckComponent::rotation_z]),
                 k      = std::cos(q[ChuckComponent::rotation_z]);
    Matrix3d spin;
    spin << k, -s, 0, s, k, 0, 0, 0, 1;
    Q = tilt * spin;

    const Matrix3d J =
      r.c[0] * Matrix3d::Identity() + r.c[1] * A + r.c[2] * (a * a.transpose());
    b = {{J.col(0), J.col(1), tilt.col(2)}};
    for (unsigned int l = 0; l < 2; ++l)
      {
        const Vector3d e = Vector3d::Unit(l);
        const Matrix3d dJ =
          a[l] * (r.dc[0] * Matrix3d::Identity() + r.dc[1] * A +
                  r.dc[2] * (a * a.transpose())) +
          r.c[1] * skew(e) + r.c[2] * (e * a.transpose() + a * e.transpose());
        db[0][l] = dJ.col(0);
        db[1][l] = dJ.col(1);
        db[2][l] = b[l].cross(b[2]);
      }
    db[0][2] = db[1][2] = db[2][2] = Vector3d::Zero();
  }



  Vector3d
  Chuck::velocity(const unsigned int k, const Vector3d &x) const
  {
    return is_rotation(k) ? Vector3d(axis(k).cross(x - centre())) :
                            Vector3d(Vector3d::Unit(k));
  }



  Vector3d
  Chuck::velocity_of_direction(const unsigned int k, const Vector3d &d) const
  {
    return is_rotation(k) ? Vector3d(axis(k).cross(d)) :
                            Vector3d(Vector3d::Zero());
  }



  // x - C - u = Q(q) * const and dQ/dq_l = skew(b_l) Q.
  Vector3d
  Chuck::second_derivative(const unsigned int k,
                           const unsigned int l,
                           const Vector3d    &x) const
  {
    if (!is_rotation(k) || !is_rotation(l))
      return Vector3d::Zero();
    const Vector3d r = x - centre();
    return db[k - 3][l - 3].cross(r) + axis(k).cross(axis(l).cross(r));
  }
} // namespace Debond
