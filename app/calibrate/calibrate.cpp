// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

#include "common/mean_and_interval.hpp"

namespace polargrain::app {
namespace {

/// First way of the search from its start, of the way between the bounds.
constexpr double kFirstStep = 0.15;
/// How far a profile goes, in half intervals, and the first way of its searches.
constexpr double kProfileReach = 2.0;
constexpr double kProfileStep = 0.05;
/// So often derivatives are taken where they, too, find better places; the search is content before the last digits are told.
constexpr int kRounds = 3;
/// Steepness below this share of the largest tells nothing.
constexpr double kFlat = 1e-10;

class Search {
 public:
  Search(const Calibration& calibration, const std::function<Answer(const std::vector<double>&)>& evaluate,
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
    Answer answer = evaluate_(made.values);
    made.differences = std::move(answer.differences);
    made.left_out = std::move(answer.left_out);
    for (const double difference : made.differences)
      made.misfit += difference * difference / static_cast<double>(made.differences.size());
    on_new_(made);
    record_.push_back(std::move(made));
    return record_.back();
  }

  [[nodiscard]] const std::vector<Evaluation>& record() const { return record_; }

 private:
  const Calibration& calibration_;
  const std::function<Answer(const std::vector<double>&)>& evaluate_;
  const std::vector<Evaluation>& known_;
  const std::function<void(const Evaluation&)>& on_new_;
  std::vector<Evaluation> record_;
};

/// The misfit as a function of some of the places; the others are held.
struct Objective {
  Search* search;
  std::vector<double> places;
  std::vector<std::size_t> free;
  std::exception_ptr failure = {};  ///< of an evaluation: the optimiser would make "nlopt failure" of it

  double operator()(const std::vector<double>& values) {
    for (std::size_t k = 0; k < free.size(); ++k) places[free[k]] = values[k];
    return search->at(places).misfit;
  }
};

double misfit_at(const std::vector<double>& values, std::vector<double>&, void* objective) {
  Objective& asked = *static_cast<Objective*>(objective);
  try {
    return asked(values);
  } catch (...) {
    asked.failure = std::current_exception();
    throw nlopt::forced_stop();
  }
}

/// Seeks the least misfit over the free places, from where they are; the evaluations are in the record of the search.
nlopt::result seek(Objective& objective, double first_step, double tolerance, int evaluations) {
  std::vector<double> values;
  for (const std::size_t k : objective.free) values.push_back(objective.places[k]);
  // BOBYQA wants two parameters at least; of one, the simplex method finds the least.
  nlopt::opt optimiser(values.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_SBPLX,
                       static_cast<unsigned>(values.size()));
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_min_objective(misfit_at, &objective);
  optimiser.set_initial_step(first_step);
  optimiser.set_xtol_abs(tolerance);
  optimiser.set_maxeval(evaluations);
  double least = 0.0;
  try {
    return optimiser.optimize(values, least);
  } catch (...) {
    if (objective.failure) std::rethrow_exception(objective.failure);
    throw;
  }
}

/// d differences / d places by central differences, one-sided at a bound or beside an evaluation that was left out.
Eigen::MatrixXd slopes(Search& search, const std::vector<double>& places, double difference) {
  Eigen::MatrixXd result;
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<double> below = places;
    std::vector<double> above = places;
    below[k] = std::max(0.0, below[k] - difference);
    above[k] = std::min(1.0, above[k] + difference);
    if (!search.at(below).left_out.empty()) below = places;
    if (!search.at(above).left_out.empty()) above = places;
    const std::vector<double> low = search.at(below).differences;
    const std::vector<double> high = search.at(above).differences;
    if (k == 0)
      result.resize(static_cast<Eigen::Index>(low.size()), static_cast<Eigen::Index>(places.size()));
    for (std::size_t p = 0; p < low.size(); ++p)
      result(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(k)) =
          above[k] > below[k] ? (high[p] - low[p]) / (above[k] - below[k]) : 0.0;
  }
  return result;
}

/// Judges how well the data fix the parameters, from the slopes at the best ones.
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
  result.threshold = result.best.misfit + width * width * variance / static_cast<double>(slopes.rows());
  result.correlations = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index p = 0; p < count; ++p) {
    result.half_width.push_back(is_open[static_cast<std::size_t>(p)] ? kInfinite
                                                                     : width * std::sqrt(covariance(p, p)));
    for (Eigen::Index q = 0; q < count; ++q)
      if (const double both = std::sqrt(covariance(p, p) * covariance(q, q)); p != q && both > 0.0)
        result.correlations(p, q) = covariance(p, q) / both;
  }
}

/// Holds one parameter at places around its best one and seeks the others, each time from where they were found last.
void add_profile(CalibrationResult& result, Search& search, const Calibration& calibration,
                 const std::vector<double>& best, std::size_t held) {
  const double reach = std::min(1.0, kProfileReach * result.half_width[held]);
  const int each_side = (calibration.profile + 1) / 2;
  std::vector<std::pair<double, ProfilePoint>> points;
  points.push_back({best[held], {held, result.best.values, result.best.misfit}});
  for (const double side : {-1.0, 1.0}) {
    const double end = std::clamp(best[held] + side * reach, 0.0, 1.0);
    Objective objective{&search, best, {}};
    for (std::size_t k = 0; k < best.size(); ++k)
      if (k != held) objective.free.push_back(k);
    for (int step = 1; step <= each_side && end != best[held]; ++step) {
      objective.places[held] = best[held] + (end - best[held]) * step / each_side;
      search.at(objective.places);
      if (!objective.free.empty()) try {
          seek(objective, kProfileStep, 2.0 * calibration.tolerance, calibration.profile_evaluations);
        } catch (const nlopt::roundoff_limited&) {
          // The misfit is too rough to go on: the least so far counts.
        }
      const double value = calibration.parameters[held].value_at(objective.places[held]);
      const Evaluation* least = nullptr;
      for (const Evaluation& one : search.record())
        if (one.values[held] == value && (least == nullptr || one.misfit < least->misfit)) least = &one;
      points.push_back({objective.places[held], {held, least->values, least->misfit}});
      for (std::size_t k = 0; k < best.size(); ++k)
        if (k != held) objective.places[k] = calibration.parameters[k].place_of(least->values[k]);
    }
  }
  std::ranges::sort(points, {}, [](const auto& point) { return point.first; });
  for (auto& point : points) result.profile.push_back(std::move(point.second));
}

}  // namespace

CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<Answer(const std::vector<double>&)>& evaluate,
                            const std::vector<Evaluation>& known,
                            const std::function<void(const Evaluation&)>& on_new) {
  Search search(calibration, evaluate, known, on_new);
  std::vector<double> places;
  for (const Parameter& parameter : calibration.parameters)
    places.push_back(parameter.place_of(parameter.start));
  const std::size_t count = places.size();
  Objective whole{&search, places, {}};
  for (std::size_t k = 0; k < count; ++k) whole.free.push_back(k);
  CalibrationResult result;
  try {
    const nlopt::result end = seek(whole, kFirstStep, calibration.tolerance, calibration.evaluations);
    result.converged = end != nlopt::MAXEVAL_REACHED;
    result.end = result.converged
                     ? fmt::format("the last changes of the parameters were below {:.3g} of their ranges",
                                   calibration.tolerance)
                     : fmt::format("not converged: {} evaluations were made", calibration.evaluations);
  } catch (const nlopt::roundoff_limited&) {
    result.end = "not converged: the misfit is too rough for the search to go on";
  }
  // Takes over the best so far. @returns whether it is another one
  const auto take_best = [&] {
    const Evaluation& best = *std::ranges::min_element(search.record(), {}, &Evaluation::misfit);
    if (best.values == result.best.values) return false;
    result.best = best;
    for (std::size_t k = 0; k < count; ++k)
      places[k] = calibration.parameters[k].place_of(result.best.values[k]);
    return true;
  };
  Eigen::MatrixXd around_best;
  for (int round = 0; take_best() && round < kRounds; ++round)
    around_best = slopes(search, places, calibration.difference);
  judge(result, around_best);
  if (calibration.profile > 0)
    for (std::size_t k = 0; k < count; ++k) add_profile(result, search, calibration, places, k);
  result.record = search.record();
  return result;
}

}  // namespace polargrain::app
