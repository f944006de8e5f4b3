// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "app/element/element_table.hpp"

namespace polargrain::app {
namespace {

/// First way of the search from its start, of the way between the bounds.
constexpr double kFirstStep = 0.15;
/// Steepness below this share of the largest tells nothing.
constexpr double kFlat = 1e-10;

class Search {
 public:
  Search(const Calibration& calibration,
         const std::function<std::vector<double>(const std::vector<double>&)>& evaluate,
         const std::vector<Evaluation>& known, const std::function<void(const Evaluation&)>& on_new)
      : calibration_(calibration), evaluate_(evaluate), known_(known), on_new_(on_new) {}

  const Evaluation& at(const std::vector<double>& places) {
    Evaluation made;
    for (std::size_t k = 0; k < places.size(); ++k)
      made.values.push_back(calibration_.parameters[k].value_at(places[k]));
    const auto same = [&](const Evaluation& one) { return one.values == made.values; };
    if (const auto there = std::ranges::find_if(record_, same); there != record_.end()) return *there;
    if (const auto before = std::ranges::find_if(known_, same); before != known_.end()) {
      record_.push_back(*before);
      return record_.back();
    }
    made.differences = evaluate_(made.values);
    for (const double difference : made.differences)
      made.misfit += difference * difference / static_cast<double>(made.differences.size());
    on_new_(made);
    record_.push_back(std::move(made));
    return record_.back();
  }

  [[nodiscard]] const std::vector<Evaluation>& record() const { return record_; }

 private:
  const Calibration& calibration_;
  const std::function<std::vector<double>(const std::vector<double>&)>& evaluate_;
  const std::vector<Evaluation>& known_;
  const std::function<void(const Evaluation&)>& on_new_;
  std::vector<Evaluation> record_;
};

double objective(const std::vector<double>& places, std::vector<double>&, void* search) {
  return static_cast<Search*>(search)->at(places).misfit;
}

/// d differences / d places by central differences, one-sided at a bound.
Eigen::MatrixXd slopes(Search& search, const std::vector<double>& places, double difference) {
  Eigen::MatrixXd result;
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<double> below = places;
    std::vector<double> above = places;
    below[k] = std::max(0.0, below[k] - difference);
    above[k] = std::min(1.0, above[k] + difference);
    const std::vector<double> low = search.at(below).differences;
    const std::vector<double> high = search.at(above).differences;
    if (k == 0)
      result.resize(static_cast<Eigen::Index>(low.size()), static_cast<Eigen::Index>(places.size()));
    for (std::size_t p = 0; p < low.size(); ++p)
      result(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(k)) =
          (high[p] - low[p]) / (above[k] - below[k]);
  }
  return result;
}

/// What the data tell of the parameters, from the slopes at the best ones.
void judge(CalibrationResult& result, const Eigen::MatrixXd& slopes) {
  const Eigen::Index count = slopes.cols();
  const auto freedom = static_cast<int>(slopes.rows() - count);
  // Reading errors are taken at their word, unless the curves are farther off than those allow.
  const double sum = result.best.misfit * static_cast<double>(slopes.rows());
  const double variance = freedom > 0 ? std::max(1.0, sum / freedom) : 1.0;
  const double width = freedom > 0 ? student_95(freedom + 1) : 1.96;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(slopes.transpose() * slopes);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  result.directions = of.eigenvectors();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  std::vector<bool> is_open(static_cast<std::size_t>(count), false);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double steepness = of.eigenvalues()(k);
    const bool tells = steepness > kFlat * of.eigenvalues()(count - 1) && steepness > 0.0;
    result.direction_half_width.push_back(tells ? width * std::sqrt(variance / steepness) : kInfinite);
    if (tells)
      covariance += variance / steepness * of.eigenvectors().col(k) * of.eigenvectors().col(k).transpose();
    else
      for (Eigen::Index p = 0; p < count; ++p)
        if (std::abs(of.eigenvectors()(p, k)) > 1e-6) is_open[static_cast<std::size_t>(p)] = true;
  }
  result.correlations = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index p = 0; p < count; ++p) {
    result.half_width.push_back(is_open[static_cast<std::size_t>(p)] ? kInfinite
                                                                     : width * std::sqrt(covariance(p, p)));
    for (Eigen::Index q = 0; q < count; ++q)
      if (const double both = std::sqrt(covariance(p, p) * covariance(q, q)); p != q && both > 0.0)
        result.correlations(p, q) = covariance(p, q) / both;
  }
}

}  // namespace

CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<std::vector<double>(const std::vector<double>&)>& evaluate,
                            const std::vector<Evaluation>& known,
                            const std::function<void(const Evaluation&)>& on_new) {
  Search search(calibration, evaluate, known, on_new);
  std::vector<double> places;
  for (const Parameter& parameter : calibration.parameters)
    places.push_back(parameter.place_of(parameter.start));
  const std::size_t count = places.size();
  // BOBYQA wants two parameters at least; of one, the simplex method finds the least.
  nlopt::opt optimiser(count > 1 ? nlopt::LN_BOBYQA : nlopt::LN_SBPLX, static_cast<unsigned>(count));
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_min_objective(objective, &search);
  optimiser.set_initial_step(kFirstStep);
  optimiser.set_xtol_abs(calibration.tolerance);
  optimiser.set_maxeval(calibration.evaluations);
  CalibrationResult result;
  double least = 0.0;
  try {
    const nlopt::result end = optimiser.optimize(places, least);
    result.converged = end != nlopt::MAXEVAL_REACHED;
    result.end = result.converged
                     ? fmt::format("the parameters stand still within {:.3g} of the way between their bounds",
                                   calibration.tolerance)
                     : fmt::format("not converged: {} evaluations were made", calibration.evaluations);
  } catch (const nlopt::roundoff_limited&) {
    result.end = "not converged: the misfit is too rough for the search to go on";
  }
  result.best = *std::ranges::min_element(search.record(), {}, &Evaluation::misfit);
  for (std::size_t k = 0; k < count; ++k)
    places[k] = calibration.parameters[k].place_of(result.best.values[k]);
  const Eigen::MatrixXd of = slopes(search, places, calibration.difference);
  result.record = search.record();
  judge(result, of);
  return result;
}

}  // namespace polargrain::app
