// SPDX-License-Identifier: GPL-2.0-or-later
// How an adaptive material measures its own error, and what it says of it (docs/adaptivity.md, 4).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/record_table.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/adaptivity/error_bound.hpp"
#include "coupler/cells/cell_increment.hpp"

namespace polargrain::coupler {
namespace {

/// Points that are followed at the start, while nothing is known, and at least (docs/adaptivity.md, 4).
constexpr std::size_t kFollowedFirst = 12;
constexpr std::size_t kFollowedLeast = 6;
/// One point less is followed when the bound that the others give is below this share of the tolerance.
constexpr double kMuchRoom = 0.5;
constexpr double kShare = 0.95;

template <int dim>
bool are_equal(const Increment<dim>& a, const Increment<dim>& b) {
  return a.displacement_gradient == b.displacement_gradient && micro_rotation(a) == micro_rotation(b) &&
         a.curvature == b.curvature;
}

}  // namespace

template <int dim>
std::size_t AdaptiveMaterial<dim>::fewest_followed() const {
  const double share = std::ceil(options_.audit * static_cast<double>(points_.size()));
  return std::min(points_.size(), std::max(kFollowedLeast, static_cast<std::size_t>(share)));
}

template <int dim>
void AdaptiveMaterial<dim>::choose_followed() {
  followed_.clear();
  if (!audits()) return;
  constexpr std::uint64_t kEveryStep = ~std::uint64_t{0};
  std::vector<std::size_t> drawn(points_.size());
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  std::ranges::sort(drawn, {},
                    [&](std::size_t point) { return hashed_share(options_.seed, point, kEveryStep); });
  // More of them make the bound smaller, and with it what is paid for; their root of many points still costs little.
  const auto root = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(points_.size()))));
  drawn.resize(std::min(drawn.size(), std::max({kFollowedFirst, root, fewest_followed()})));
  for (const std::size_t point : drawn) followed_.push_back({point, cells_.front().answer.state});
}

template <int dim>
void AdaptiveMaterial<dim>::run_followed() {
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> points;
  std::vector<Followed*> running;
  for (Followed& followed : followed_) {
    const Increment<dim> increment = increment_of_step(followed.point);
    if (followed.reply.state && are_equal(increment, followed.increment)) continue;
    followed.increment = increment;
    requests.push_back(
        {followed.state, increment, &cells_.front().answer.response});  // its tangent is not asked for
    points.push_back(followed.point);
    running.push_back(&followed);
  }
  if (requests.empty()) return;
  std::vector<PointReply<dim>> replies = run(requests, points, costs_.audit_steps);
  costs_.audits += static_cast<std::int64_t>(requests.size());
  for (std::size_t k = 0; k < replies.size(); ++k) running[k]->reply = std::move(replies[k]);
}

template <int dim>
std::vector<double> AdaptiveMaterial<dim>::measured_errors() const {
  std::vector<double> errors;
  for (const Followed& followed : followed_) {
    if (followed.reply.response.quality != Quality::good || !followed.reply.state) continue;
    errors.push_back(share_of(followed.reply.response.stress - stress_of_cells(followed.point)));
  }
  return errors;
}

template <int dim>
double AdaptiveMaterial<dim>::bound_of(std::span<const double> errors) const {
  return mean_at_most(errors, points_.size()) * neglected(errors);
}

template <int dim>
double AdaptiveMaterial<dim>::neglected(std::span<const double> errors) const {
  if (errors.empty()) return 1.0;
  const auto estimate_now = [&](std::size_t point) {
    return estimate(point, branches_[branch_of_point_[point]]) / reference_;
  };
  double all = 0.0;
  for (std::size_t point = 0; point < points_.size(); ++point) all += estimate_now(point);
  all /= static_cast<double>(points_.size());
  double followed = 0.0;
  for (std::size_t k = 0; k < errors.size(); ++k) followed += estimate_now(followed_[k].point);
  followed /= static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  return mean > 0.0 ? std::max(1.0, (all + mean) / (followed + mean)) : 1.0;
}

template <int dim>
std::string AdaptiveMaterial<dim>::reference_name() const {
  return options_.reference_pressure ? fmt::format("{:g} kPa", reference_ / 1e3) : "the confining pressure";
}

template <int dim>
void AdaptiveMaterial<dim>::note_tightening(double bound_before, double bound) {
  notes_.push_back(
      fmt::format("the mean error is at most {:.3g} of {} (95 % confidence, {} points followed), more "
                  "than the tolerance of {:.3g}; with estimates below {:.3g} it is {:.3g}",
                  bound_before, reference_name(), followed_.size(), options_.tolerance,
                  options_.tolerance / tightening_, bound));
}

template <int dim>
void AdaptiveMaterial<dim>::keep_audit() {
  run_followed();
  const std::vector<double> errors = measured_errors();
  for (const double error : errors) errors_.add(error);
  bounds_.last = bound_of(errors);
  bounds_.largest = std::max(bounds_.largest, bounds_.last);
  if (bounds_.last > options_.tolerance) {
    if (bounds_.steps_beyond == 0.0) bounds_.first_beyond = static_cast<double>(step_);
    bounds_.steps_beyond += 1.0;
  }
  // A cell that cannot follow is let go; its point goes on by what serves it.
  std::erase_if(followed_, [](const Followed& item) {
    return item.reply.response.quality != Quality::good || !item.reply.state;
  });
  for (Followed& followed : followed_) followed.state = followed.reply.state;
  if (followed_.size() <= fewest_followed()) return;
  if (bound_of(std::span(errors).first(errors.size() - 1)) < kMuchRoom * options_.tolerance)
    followed_.pop_back();
}

template <int dim>
std::string AdaptiveMaterial<dim>::doubt() const {
  if (options_.tolerance == 0.0 || step_ == 0) return {};
  if (!audits()) return "without audits (audit: 0) the error of its stresses is unknown";
  if (bounds_.steps_beyond == 0.0) return {};
  return fmt::format(
      "its stresses cannot be vouched for: in {:.0f} of {} increments (a step that is cut, or passes jumps, takes several) "
      "the mean error may be above the tolerance of {:.3g} of {}; with 95 % confidence it is at most {:.3g}, at the end "
      "{:.3g}",
      bounds_.steps_beyond, step_, options_.tolerance, reference_name(), bounds_.largest, bounds_.last);
}

template <int dim>
std::vector<fem::Figure> AdaptiveMaterial<dim>::figures() const {
  const auto count = [](auto whole) { return static_cast<double>(whole); };
  std::vector<fem::Figure> figures{
      {"points", count(points_.size())},
      {"cells", count(cells_.size())},
      {"cell_runs", count(costs_.runs)},
      {"cell_runs_unused", count(costs_.unused_runs)},
      {"audit_runs", count(costs_.audits)},
      {"cell_dem_steps", count(costs_.steps)},
      {"cell_dem_steps_unused", count(costs_.unused_steps)},
      {"audit_dem_steps", count(costs_.audit_steps)},
      {"steps_answered_anew", count(costs_.redone)},
      {"decision_seconds", seconds_},
      {"shares", shares_ ? 1.0 : 0.0},
      {"point_steps_by_tangent", count(sources_[0])},
      {"point_steps_by_neighbour", count(sources_[1])},
      {"point_steps_by_own_cell", count(sources_[2])},
      {"tolerance", options_.tolerance},
      {"tolerance_worked_with", options_.tolerance / tightening_},
  };
  const std::vector<fem::Figure> at_limits = at_limits_.figures();
  figures.insert(figures.end(), at_limits.begin(), at_limits.end());
  ground_.add_figures(figures);
  if (!audits()) return figures;
  figures.push_back({"points_followed", count(followed_.size())});
  figures.push_back({"history_errors", count(errors_.count())});
  figures.push_back({"history_error_mean", errors_.mean()});
  figures.push_back({"history_error_95_percent", errors_.percentile(kShare)});
  figures.push_back({"history_error_largest", errors_.largest()});
  figures.push_back({"error_bound", bounds_.largest});
  figures.push_back({"error_bound_last", bounds_.last});
  figures.push_back({"steps_beyond_tolerance", bounds_.steps_beyond});
  figures.push_back({"vouched_for", bounds_.steps_beyond == 0.0 ? 1.0 : 0.0});
  return figures;
}

template <int dim>
std::vector<std::string> AdaptiveMaterial<dim>::take_notes() {
  return std::exchange(notes_, {});
}

template <int dim>
std::vector<std::string> AdaptiveMaterial<dim>::field_names() const {
  return joined_names(joined_names({"source", "cell", "error_estimate"}, names_of_columns<CellDiagnostics>()),
                      names_of_limit_fields(cosserat_.has_value()));
}

template <int dim>
void AdaptiveMaterial<dim>::fields(std::size_t point, std::span<double> values) const {
  values[0] = static_cast<double>(points_[point].source);
  values[1] = static_cast<double>(points_[point].cell);
  values[2] = points_[point].estimate / reference_;
  const auto rest =
      std::ranges::copy(values_of(cells_[points_[point].cell].answer.diagnostics), values.begin() + 3).out;
  write_limit_fields(reached(points_[point]), cosserat_, points_[point].cosserat, rest);
}

template class AdaptiveMaterial<2>;
template class AdaptiveMaterial<3>;

}  // namespace polargrain::coupler
