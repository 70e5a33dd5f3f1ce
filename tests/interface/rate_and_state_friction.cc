// Rate and state friction against what is known in closed form: steady sliding,
// the relaxation after a jump of the speed, ageing at rest, and the growth of a
// small disturbance of a point that a spring pulls at V >> V_0,
//
//   Re(lambda) = V (k_c - k) / (2 p A),   k_c = p (B - A)/D,
//
// with k that of the spring and of eps_t in series.

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point.h>

#include <array>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"
#include "rectangle_of.h"

using namespace Debond;

const double mu_0 = 0.4, A = 0.01, B = 0.015, V_0 = 1e-6, D = 0.01;

FrictionLawPointer
law_with(const std::string &evolution)
{
  return law_of_text("set Friction law = rate and state\n"
                     "subsection Rate and state\n"
                     "  set Reference coefficient = 0.4\n"
                     "  set Direct effect = 0.01\n"
                     "  set Evolution effect = 0.015\n"
                     "  set Reference speed = 1e-6\n"
                     "  set Sliding distance = 0.01\nend\n"
                     "subsection Expert\nsubsection Rate and state\n"
                     "  set Evolution = " +
                     evolution + "\nend\nend\n");
}

double
steady(const double V)
{
  return mu_0 + A * std::log(1. + V / V_0) - B * std::log(V / V_0);
}



/** A point that is moved. */
struct Slider
{
  FrictionLawPointer law;
  PointStart         state;

  explicit Slider(const FrictionLawPointer &law)
    : law(law)
  {
    state.history.internal = law->initial_variables;
  }

  /** mu at the end of a step. */
  double
  slide(const double distance, const double duration)
  {
    state.duration         = duration;
    const double mu        = law->coefficient(state, distance).mu;
    state.history.internal = law->advance(state, distance);
    state.history.slip += distance;
    return mu;
  }
};



void
check_steady_state(const FrictionLawPointer &law)
{
  double deviation = 0, reported = 0;
  for (const double V : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4})
    for (const double step : {0.03 * D, 0.5 * D, 3. * D})
      {
        Slider slider(law);
        double mu = 0;
        for (double slid = 0; slid < 50. * D; slid += step)
          mu = slider.slide(step, step / V);
        grow(deviation, std::abs(mu - steady(V)));
        slider.state.duration = 0.;
        grow(reported, std::abs(law->coefficient(slider.state, 0.).mu - mu));
      }
  report("steady state over four decades, deviation of mu", deviation, 1e-14);
  report("  and of what is reported", reported, 1e-15);
}



/** From steady sliding at V_1 on with V_2. */
void
check_relaxation(const std::string &evolution)
{
  double deviation = 0;
  for (const double V_2 : {1e-3, 1e-5})
    for (const double step : {0.01 * D, 0.4 * D, 1.7 * D})
      {
        const double V_1 = 1e-4;
        Slider       slider(law_with(evolution));
        slider.slide(60. * D, 60. * D / V_1);
        for (double slid = step; slid < 5. * D; slid += step)
          {
            const double mu    = slider.slide(step, step / V_2);
            const double decay = std::exp(-slid / D);
            // ln(V theta/D), which was ln(V_2/V_1)
            const double state = evolution == "slip" ?
                                   decay * std::log(V_2 / V_1) :
                                   std::log(1. + (V_2 / V_1 - 1.) * decay);
            grow(deviation, std::abs(mu - (steady(V_2) + B * state)));
          }
      }
  report("relaxation after a jump of the speed, deviation of mu",
         deviation,
         1e-14);
}



void
check_rest()
{
  Slider ageing(law_with("ageing")), slip(law_with("slip"));
  double at_rest = 0, unchanged = 0;
  for (unsigned int step = 1; step <= 10; ++step)
    {
      grow(at_rest,
           std::abs(ageing.slide(0., 7.) -
                    (mu_0 + B * std::log(1. + 7. * step * V_0 / D))));
      grow(unchanged, std::abs(slip.slide(0., 7.) - mu_0));
    }
  report("at rest the ageing law strengthens with the time, deviation",
         at_rest,
         1e-15);
  report("  the slip law does not", unchanged == 0.);
  const auto now        = ageing.law->coefficient(ageing.state, 0.);
  ageing.state.duration = 0.;
  report("without time nothing has a speed",
         ageing.law->coefficient(ageing.state, D).mu ==
             ageing.law->coefficient(ageing.state, 0.).mu &&
           now.mu > mu_0);
}



void
check_derivative(const FrictionLawPointer &law)
{
  double slope = 0, work = 0, faster = 0;
  for (const double psi : {-3., 0., 5., 20.})
    for (const double duration : {1e-3, 1., 1e4})
      for (double distance = 1e-9; distance < 10. * D; distance *= 3.)
        {
          PointStart state;
          state.history.internal = {{psi, 0.}};
          state.duration         = duration;
          const auto mu          = [&](const double d) {
            return law->coefficient(state, d).mu;
          };
          grow(faster,
               D * (-law->coefficient(state, distance).dmu -
                    law->steepest_fall(state, 1., distance)));
          const double h = 1e-4 * distance;
          grow(slope,
               std::abs(distance * law->coefficient(state, distance).dmu -
                        (8. * (mu(distance + h) - mu(distance - h)) -
                         mu(distance + 2. * h) + mu(distance - 2. * h)) /
                          (12. * h) * distance));
          double             sum = 0;
          const unsigned int n   = 2000;
          for (unsigned int k = 0; k <= n; ++k)
            {
              PointStart there = state;
              there.duration *= double(k) / n;
              sum +=
                (k == 0 || k == n ? 1. :
                 k % 2 == 1       ? 4. :
                                    2.) *
                (k == 0 ? mu_0 + A * std::log1p(distance / (V_0 * duration)) +
                            B * psi :
                          law->coefficient(there, distance * k / n).mu);
            }
          grow(work,
               std::abs(law->work(state, 1., distance).friction / distance -
                        sum / (3. * n)));
        }
  report("slope and differences, deviation of d dmu/dd", slope, 1e-10);
  report("work and Simpson's rule, deviation per distance", work, 1e-7);
  report("mu falls faster than promised by, per D", faster, 1e-14);
}



/** A slave point over a plane, pulled by a spring whose other end moves with
 *  the speed V; from steady sliding, disturbed by @p kick. */
class PulledPoint
{
public:
  PulledPoint(const std::string &evolution,
              const double       spring,
              const double       kick)
    : surface(rectangle_of(4., 1., 1, 1))
    , positions(surface.control_points())
    , spring(spring)
  {
    law.joint              = friction_under_pressure(500., law_with(evolution));
    law.tangential_penalty = eps_t;
    state.status           = PointStatus::slip;
    state.has_partner      = true;
    state.xi               = Eigen::Vector2d(0.1, 0.5);
    state.internal         = {{-std::log(V / V_0), V}};
    SurfaceBasis    basis;
    SurfaceGeometry geometry;
    surface.evaluate(state.xi, basis);
    contract(basis, positions, geometry);
    x   = geometry.y + Eigen::Vector3d(steady(V) * p / eps_t, 0, -p / 500.);
    end = x[0] + steady(V) * p / spring + kick;
  }

  /** The sliding distance of a step. */
  double
  step(const double duration)
  {
    end += V * duration;
    x[0] += V * duration; // else it would have to leave the sticking branch
    mode.duration = duration;
    ContactPointResult  result;
    const MasterSurface master{&surface, &positions, 1.};
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        update_contact_point(law, state, 1., x, master, mode, result);
        const double residual = spring * (end - x[0]) - result.traction[0];
        if (std::abs(residual) < 1e-13)
          break;
        x[0] += residual /
                (spring + result.dt(0, W::gap) + result.dt(0, W::trial_gap));
      }
    slides =
      slides && !result.failed && result.state.status == PointStatus::slip;
    const double distance = result.slip_increment.norm();
    state                 = result.state;
    return distance;
  }

  static constexpr double V = 1., p = 2., eps_t = 10.;
  bool                    slides = true;

private:
  NurbsSurface      surface;
  ControlNet        positions;
  ContactPointLaw   law;
  ContactPointState state;
  ContactPointMode  mode;
  Eigen::Vector3d   x;
  double            end, spring;
};



/** Growth of exp(a t) cos(w t + c), from samples of it, by the recurrence
 *  s_2 = 2 e^(a dt) cos(w dt) s_1 - e^(2 a dt) s_0. */
double
growth_of(const std::vector<double> &s, const double spacing)
{
  Eigen::Matrix2d N = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i + 2 < s.size(); ++i)
    {
      const Eigen::Vector2d row(s[i + 1], s[i]);
      N += row * row.transpose();
      b += row * s[i + 2];
    }
  const double determinant = N(0, 0) * N(1, 1) - N(0, 1) * N(1, 0);
  const double c           = (N(0, 0) * b[1] - N(1, 0) * b[0]) / determinant;
  return std::log(-c) / (2. * spacing);
}



void
check_growth(const std::string &evolution, const double ratio)
{
  const double V = PulledPoint::V, p = PulledPoint::p;
  const double k_c = p * (B - A) / D, k = ratio * k_c;
  const double spring = 1. / (1. / k - 1. / PulledPoint::eps_t);
  const double exact  = V * (k_c - k) / (2. * p * A);
  double       growth[2];
  bool         slides = true;
  for (const unsigned int refined : {0, 1})
    {
      const unsigned int  per_sample = 50 << refined;
      const double        duration   = D / V / per_sample;
      PulledPoint         point(evolution, spring, 1e-4 * D);
      std::vector<double> samples;
      for (unsigned int step = 1; step <= 20 * per_sample; ++step)
        {
          const double distance = point.step(duration);
          if (step % per_sample == 0)
            samples.push_back(distance / duration - V);
        }
      growth[refined] = growth_of(samples, D / V);
      slides          = slides && point.slides;
    }
  // steps of the first order damp
  std::cout << evolution << ", k = " << ratio << " k_c: a small disturbance "
            << (growth[1] > 0. ? "grows" : "decays") << std::endl;
  report("  deviation of the growth, in V/D",
         std::abs(2. * growth[1] - growth[0] - exact) * D / V,
         2e-4);
  report("  it slides all the time", slides);
  report("  larger steps damp more",
         growth[0] < growth[1] && growth[1] < exact);
}



// A point that has aged far beyond what sliding leaves of its state: mu falls
// more steeply than the point is stiff, and there may be more than one state.
// What is found is never one that slides against the pull or carries more than
// friction allows.
void
check_aged_point()
{
  const NurbsSurface surface   = rectangle_of(4., 1., 1, 1);
  const ControlNet   positions = surface.control_points();
  ContactPointLaw    law;
  law.tangential_penalty = 585.;
  const FrictionLawPointer friction =
    law_of_text("set Friction law = rate and state\n"
                "subsection Rate and state\n"
                "  set Direct effect = 0.02\n"
                "  set Evolution effect = 0.035\n"
                "  set Reference speed = 1e-3\n"
                "  set Sliding distance = 1e-4\n"
                "  set Initial state = 1e3\nend\n");
  law.joint = friction_under_pressure(500., friction);
  ContactPointState state;
  state.status      = PointStatus::stick;
  state.has_partner = true;
  state.xi          = Eigen::Vector2d(0.1, 0.5);
  state.internal    = friction->initial_variables;
  SurfaceBasis    basis;
  SurfaceGeometry geometry;
  surface.evaluate(state.xi, basis);
  contract(basis, positions, geometry);
  const MasterSurface master{&surface, &positions, 1.};
  const double        p      = 2.8665;
  double              beyond = 0, against = 0;
  unsigned int        n_slips = 0;
  for (const double duration : {1., 0.1, 0.01})
    for (double pulled = 1e-4; pulled < 0.02; pulled *= 1.1)
      {
        ContactPointMode mode;
        mode.duration = duration;
        ContactPointResult    result;
        const Eigen::Vector3d x =
          geometry.y + Eigen::Vector3d(pulled, 0, -p / 500.);
        update_contact_point(law, state, 1., x, master, mode, result);
        if (result.failed)
          continue;
        n_slips += result.state.status == PointStatus::slip;
        const double limit =
          p * law.joint->friction
                ->coefficient(law.joint->begin(state, 1., duration), 0.)
                .mu;
        const double direct = p * 0.02 * std::log1p(pulled / (1e-3 * duration));
        grow(beyond, result.tangential_traction.norm() - limit - direct);
        grow(against, -result.tangential_traction.dot(result.slip_increment));
      }
  report("an aged point: more than friction allows by", beyond, 1e-12);
  report("  slides against the pull by", against, 1e-15);
  report("  it slips", n_slips > 50);
}



// In a short step the direct effect makes traction of the rounding of
// positions, A p/(V dt) of it; the point is found all the same.
void
check_short_steps()
{
  double deviation = 0;
  bool   slides    = true;
  for (const double duration : {1e-4, 1e-6, 1e-8})
    {
      PulledPoint point("ageing", 1., 0.);
      grow(deviation, std::abs(point.step(duration) - duration));
      slides = slides && point.slides;
    }
  // some roundings of positions of a few mm
  report("short steps of steady sliding, deviation of the distance [mm]",
         deviation,
         1e-14);
  report("  they slide", slides);
}



int
main()
{
  for (const std::string evolution : {"ageing", "slip"})
    {
      std::cout << evolution << std::endl;
      check_steady_state(law_with(evolution));
      check_relaxation(evolution);
      check_derivative(law_with(evolution));
    }
  check_rest();
  check_short_steps();
  check_aged_point();
  for (const std::string evolution : {"ageing", "slip"})
    for (const double ratio : {0.7, 0.9, 1.1, 1.4})
      check_growth(evolution, ratio);
}
