#include <debond/campaigns/fit_statistics.h>
#include <debond/support/number_text.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace Debond
{
  namespace
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();



    /** Of each curve the values that count. */
    std::vector<std::vector<Eigen::Index>>
    curves_with_weight(const Misfit &misfit, const Eigen::VectorXd &weights)
    {
      std::vector<std::vector<Eigen::Index>> result;
      Eigen::Index                           at = 0;
      for (const auto &experiment : misfit.experiments)
        for (const auto &curve : experiment->measured.values.colwise())
          {
            result.emplace_back();
            for (Eigen::Index i = 0; i < curve.size(); ++i, ++at)
              if (weights[at] > 0.)
                result.back().push_back(at);
          }
      return result;
    }

    /** Where an unknown that is searched as it is gets a relative change from:
     *  itself, or a part of its range if it is about zero. */
    double
    size_of(const Unknown &unknown, const double value)
    {
      return std::max(std::abs(value), 0.01 * (unknown.upper - unknown.lower));
    }
  } // namespace



  FitStatistics::FitStatistics(const Misfit          &misfit,
                               const Eigen::VectorXd &best,
                               const Evaluation      &at_best)
  {
    const auto           &list = misfit.unknowns.list;
    const Eigen::VectorXd r    = misfit.residuals(at_best.values);
    const Eigen::Index    n    = r.size();
    jacobian = misfit.weights.asDiagonal() * at_best.derivatives;
    for (std::size_t j = 0; j < list.size(); ++j)
      {
        const Unknown &u  = list[j];
        const double   at = u.to_search(best[j]), lower = u.to_search(u.lower),
                     upper = u.to_search(u.upper),
                     near  = 1e-6 * (upper - lower);
        FittedUnknown one{best[j], best[j], best[j], false};
        one.at_bound = at - lower < near || upper - at < near;
        unknowns.push_back(one);
        is_free.push_back(!one.at_bound);
        jacobian.col(j) *= is_free[j] ? u.per_search(best[j]) : 0.;
      }
    const Eigen::Index n_free =
      std::count(is_free.begin(), is_free.end(), true);
    const double freedom = std::max<Eigen::Index>(1, n - n_free);
    s        = misfit.has_noise() ? 1. : r.norm() / std::sqrt(freedom);
    quantile = boost::math::quantile(
      boost::math::students_t(misfit.has_noise() ? 1e6 : freedom), 0.975);
    judge_unknowns(misfit, best);
    judge_residuals(misfit, at_best.values);

    const Covariance covariance = covariance_of(jacobian);
    half_widths.resize(list.size());
    correlations = Eigen::MatrixXd::Identity(list.size(), list.size());
    for (std::size_t j = 0; j < list.size(); ++j)
      {
        half_widths[j] = covariance.half_width(j, quantile);
        if (!is_free[j])
          half_widths[j] = 0.;
        for (const double sign : {-1., 1.})
          {
            double end = list[j].to_search(best[j]) + sign * half_widths[j];
            if (list[j].logarithmic)
              end = std::exp(end);
            (sign < 0. ? unknowns[j].lower : unknowns[j].upper) = end;
          }
        for (std::size_t i = 0; i < list.size(); ++i)
          if (i != j && is_free[i] && is_free[j])
            correlations(i, j) =
              covariance.whole(i, j) /
              std::sqrt(covariance.whole(i, i) * covariance.whole(j, j));
      }

    if (misfit.measure != MisfitMeasure::least_squares)
      bootstrap(misfit, at_best.values);

    // over the noise, and back to the unit of the curve; flat directions do not
    // move it
    sd_of_values.resize(n);
    for (Eigen::Index i = 0; i < n; ++i)
      sd_of_values[i] =
        std::sqrt(std::max(0.,
                           jacobian.row(i).dot(covariance.finite *
                                               jacobian.row(i).transpose()))) /
        misfit.weights[i];
    band = quantile * sd_of_values;
  }



  // Neighbouring residuals of a curve hang together, so that blocks of them are
  // drawn, from the same curve. The
  // sum of sqrt(r^2 + d^2) is made small by least squares with the weights
  // 1 / sqrt(r^2 + d^2) of the solution before.
  void
  FitStatistics::bootstrap(const Misfit &misfit, const Eigen::VectorXd &values)
  {
    constexpr unsigned int n_samples = 200, n_iterations = 30;
    const Eigen::VectorXd  weights = misfit.weights_of_measure();
    const Eigen::VectorXd  residual =
      weights.cwiseProduct(misfit.measured - values);
    const Eigen::MatrixXd J =
      weights.cwiseQuotient(misfit.weights).asDiagonal() * jacobian;
    const Eigen::Index n = residual.size(), p = J.cols();
    const auto         parts = curves_with_weight(misfit, weights);
    std::mt19937 generator(misfit.experiments.front()->scene.calibration.seed);
    std::vector<std::vector<double>> samples(p);
    for (unsigned int sample = 0; sample < n_samples; ++sample)
      {
        Eigen::VectorXd drawn = Eigen::VectorXd::Zero(n);
        for (const auto &rows : parts)
          {
            const std::size_t block = std::max<std::size_t>(
              1, std::lround(std::cbrt(double(rows.size()))));
            for (std::size_t i = 0; i < rows.size(); i += block)
              {
                const std::size_t from =
                  generator() % (rows.size() - block + 1);
                for (std::size_t k = 0; k < block && i + k < rows.size(); ++k)
                  drawn[rows[i + k]] = residual[rows[from + k]];
              }
          }
        Eigen::VectorXd change = Eigen::VectorXd::Zero(p);
        for (unsigned int iteration = 0; iteration < n_iterations; ++iteration)
          {
            const Eigen::VectorXd root =
              (drawn - J * change).unaryExpr([](const double r) {
                return 1. / std::sqrt(std::hypot(r, 1e-3));
              });
            change = (root.asDiagonal() * J)
                       .completeOrthogonalDecomposition()
                       .solve(root.cwiseProduct(drawn));
          }
        for (Eigen::Index j = 0; j < p; ++j)
          samples[j].push_back(change[j]);
      }
    for (Eigen::Index j = 0; j < p; ++j)
      if (is_free[j] && std::isfinite(half_widths[j]))
        {
          std::sort(samples[j].begin(), samples[j].end());
          const Unknown &u    = misfit.unknowns.list[j];
          const double   best = u.to_search(unknowns[j].best);
          const auto     end  = [&](const double share) {
            const double searched =
              best + samples[j][std::lround(share * (n_samples - 1))];
            return u.logarithmic ? std::exp(searched) : searched;
          };
          unknowns[j].lower = end(0.025);
          unknowns[j].upper = end(0.975);
        }
  }



  // Singular values of the relative changes that the curves show if the
  // unknowns change by parts of themselves. A direction along which unknowns
  // can double without a change that the noise would let see is flat; so is
  // one that is lost beside the others.
  void
  FitStatistics::judge_unknowns(const Misfit          &misfit,
                                const Eigen::VectorXd &best)
  {
    const auto              &list = misfit.unknowns.list;
    Eigen::MatrixXd          scaled(jacobian.rows(), 0);
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < list.size(); ++j)
      if (is_free[j])
        {
          scaled.conservativeResize(Eigen::NoChange, scaled.cols() + 1);
          scaled.rightCols<1>() =
            jacobian.col(j) *
            (list[j].logarithmic ? 1. : size_of(list[j], best[j]));
          columns.push_back(j);
        }
    for (const Unknown &unknown : list)
      if (!is_free[&unknown - list.data()])
        warnings.push_back(
          unknown.name +
          " ends at one of its bounds: the best value may lie beyond");
    if (columns.empty())
      return;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
    const auto                             &sigma   = svd.singularValues();
    const double                            largest = sigma[0];
    flat_limit = std::max(1e-6 * largest, s);
    for (Eigen::Index k = 0; k < sigma.size(); ++k)
      if (sigma[k] < flat_limit)
        {
          FlatDirection direction{Eigen::VectorXd::Zero(list.size()), 0.};
          for (std::size_t i = 0; i < columns.size(); ++i)
            direction.changes[columns[i]] = svd.matrixV()(i, k);
          Eigen::Index most;
          const double size = direction.changes.cwiseAbs().maxCoeff(&most);
          direction.changes /= direction.changes[most];
          direction.effect = (scaled * svd.matrixV().col(k))
                               .cwiseQuotient(misfit.weights)
                               .cwiseQuotient(misfit.scales)
                               .cwiseAbs()
                               .maxCoeff() /
                             size;
          flat.push_back(direction);
          warnings.push_back(text_of(direction, misfit.unknowns));
        }
  }



  // Of fewer rows than unknowns the singular values that are missing are zero.
  FitStatistics::Covariance
  FitStatistics::covariance_of(const Eigen::MatrixXd &J) const
  {
    const Eigen::Index n = J.cols();
    Eigen::VectorXd    scale(n);
    for (Eigen::Index j = 0; j < n; ++j)
      scale[j] = J.col(j).norm() > 0. ? J.col(j).norm() : 1.;
    Eigen::MatrixXd scaled   = Eigen::MatrixXd::Zero(std::max(J.rows(), n), n);
    scaled.topRows(J.rows()) = J * scale.cwiseInverse().asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
    const auto                             &V       = svd.matrixV();
    const double                            largest = svd.singularValues()[0];
    Covariance                              result{Eigen::MatrixXd::Zero(n, n),
                      Eigen::MatrixXd::Zero(n, n),
                      std::vector<bool>(n, true)};
    for (Eigen::Index k = 0; k < n; ++k)
      {
        const double          sigma = svd.singularValues()[k];
        const bool            told  = sigma > 1e-7 * largest;
        const Eigen::VectorXd v  = scale.cwiseInverse().cwiseProduct(V.col(k));
        const double          sd = s / std::max(sigma, 1e-10 * largest);
        result.whole += sd * sd * v * v.transpose();
        if (told)
          result.finite += sd * sd * v * v.transpose();
        for (Eigen::Index j = 0; j < n && !told; ++j)
          if (is_free[j] && std::abs(V(j, k)) > 1e-3)
            result.is_bounded[j] = false;
      }
    return result;
  }



  double
  FitStatistics::Covariance::half_width(const unsigned int j,
                                        const double       quantile) const
  {
    return is_bounded[j] ? quantile * std::sqrt(finite(j, j)) : infinite;
  }



  Eigen::VectorXd
  FitStatistics::intervals_with(const Eigen::MatrixXd &derivatives) const
  {
    Eigen::MatrixXd both(jacobian.rows() + derivatives.rows(), jacobian.cols());
    both << jacobian, derivatives;
    for (Eigen::Index j = 0; j < both.cols(); ++j)
      if (!is_free[j])
        both.col(j).setZero();
    const Covariance covariance = covariance_of(both);
    Eigen::VectorXd  result(both.cols());
    for (Eigen::Index j = 0; j < both.cols(); ++j)
      result[j] = is_free[j] ? covariance.half_width(j, quantile) : 0.;
    return result;
  }



  // Residuals tell whether the model fits. Larger than the noise that was
  // stated, or so smooth that neighbours have the same sign: the curve has a
  // shape that the model has not, and intervals mean less than they say.
  void
  FitStatistics::judge_residuals(const Misfit          &misfit,
                                 const Eigen::VectorXd &values)
  {
    Eigen::Index first = 0;
    for (std::size_t e = 0; e < misfit.experiments.size(); ++e)
      {
        const auto        &experiment = misfit.experiments[e];
        const Measurement &measured   = experiment->measured;
        const Eigen::Index n          = measured.over.size();
        const std::string  which =
          misfit.experiments.size() == 1 ?
             "" :
             " (experiment " + std::to_string(e + 1) + ")";
        if (measured.file.empty())
          continue;
        for (std::size_t c = 0; c < experiment->columns.size(); ++c, first += n)
          {
            const Eigen::VectorXd m          = measured.values.col(c),
                                  difference = values.segment(first, n) - m,
                                  by_noise   = difference.cwiseQuotient(
                                    measured.sd.col(c));
            CurveMisfit curve{
              experiment->columns[c].name + which, 0., 0., 0., 0.};
            const double largest = measured.scale[c];
            unsigned int used    = 0;
            for (Eigen::Index i = 0; i < n; ++i)
              if (std::abs(m[i]) > 0.01 * largest &&
                  measured.sd(i, c) <= largest)
                {
                  curve.e_mp += std::abs(difference[i] / m[i]);
                  curve.e_rel += std::abs(difference[i]) / largest;
                  ++used;
                }
            curve.e_mp /= std::max(1u, used);
            curve.e_rel /= std::max(1u, used);
            curve.rms = difference.norm() / std::sqrt(double(n)) / largest;
            if (n > 2 && curve.rms > 1e-9)
              curve.correlation =
                by_noise.head(n - 1).dot(by_noise.tail(n - 1)) /
                by_noise.squaredNorm();
            curves.push_back(curve);
            e_rel = std::max(e_rel, curve.e_rel);
            if (curve.correlation * std::sqrt(double(n)) > 4. &&
                curve.rms > 1e-5)
              warnings.push_back(
                "neighbouring residuals of " + curve.name +
                " have the same sign (correlation " +
                to_text(curve.correlation, 2) +
                "): the model misses the shape of the curve, or the noise is "
                "smooth. The intervals are too narrow, by some " +
                to_text(std::sqrt((1. + curve.correlation) /
                                  (1. - std::min(0.99, curve.correlation))),
                        2) +
                " times");
          }
      }
    const auto by_rms = [](const CurveMisfit &a, const CurveMisfit &b) {
      return a.rms < b.rms;
    };
    const auto [least, most] =
      std::minmax_element(curves.begin(), curves.end(), by_rms);
    if (!misfit.has_noise() && most->rms > 3. * least->rms && most->rms > 1e-5)
      warnings.push_back(
        "residuals of " + most->name + " are " +
        to_text(most->rms / least->rms, 2) + " times those of " + least->name +
        ", over the largest values: the intervals take one noise for all; "
        "give Calibration / Noise for each curve");
    if (!misfit.has_noise())
      return;
    const double freedom = std::max<double>(
      1., values.size() - std::count(is_free.begin(), is_free.end(), true));
    const boost::math::chi_squared expected(freedom);
    const double                   sum = misfit.residuals(values).squaredNorm();
    if (sum > boost::math::quantile(expected, 0.999) ||
        sum < boost::math::quantile(expected, 0.001))
      warnings.push_back(
        "the residuals are " + to_text(std::sqrt(sum / freedom), 3) +
        " times the noise that Calibration / Noise states: " +
        (sum > freedom ? "the model does not fit, or the noise is more" :
                         "the noise is less") +
        ", and the intervals are wrong by about that");
  }



  std::string
  text_of(const FlatDirection &direction, const Unknowns &unknowns)
  {
    std::vector<std::size_t> parts;
    for (Eigen::Index j = 0; j < direction.changes.size(); ++j)
      if (std::abs(direction.changes[j]) > 0.1)
        parts.push_back(j);
    const auto name = [&](const std::size_t part) {
      return unknowns.list[parts[part]].name;
    };
    const std::string same =
      "the curves then change by " + to_text(direction.effect * 100., 2) +
      " % of their largest value where the unknowns change by 100 %";
    if (parts.size() == 1)
      return "the curves hardly depend on " + name(0) + ": " + same;
    std::string text = "the curves cannot tell ";
    for (std::size_t i = 0; i < parts.size(); ++i)
      text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + name(i);
    text += " apart: ";
    const double a = direction.changes[parts[0]],
                 b = direction.changes[parts[1]];
    if (parts.size() == 2 && std::abs(std::abs(a) - std::abs(b)) < 0.1)
      return text + "they only appear as a " +
             (a * b < 0. ? "product" : "ratio") + "; fix one of them (" + same +
             ")";
    text += "the curves stay the same if they change together,";
    for (std::size_t i = 0; i < parts.size(); ++i)
      text += (i == 0 ? " " : ", ") + name(i) + " by " +
              (direction.changes[parts[i]] > 0. ? "+" : "") +
              to_text(direction.changes[parts[i]], 2) + " %";
    return text + "; fix one of them (" + same + ")";
  }
} // namespace Debond
