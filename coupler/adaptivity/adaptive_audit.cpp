// SPDX-License-Identifier: GPL-2.0-or-later
// How an adaptive material measures its own error, and what it says of it (docs/adaptivity.md, 4).
#include <fmt/format.h>

#include <algorithm>

#include "common/record_table.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/adaptivity/linearised.hpp"
#include "coupler/cells/cell_increment.hpp"

namespace polargrain::coupler {
namespace {

/// Steps do not count from here, so that a point can be drawn for all of them.
constexpr std::uint64_t kEveryStep = ~std::uint64_t{0};
/// Of fewer audits the 95th percentile is their maximum.
constexpr std::size_t kFewestAudits = 20;
constexpr double kAuditedShare = 0.95;
/// A point that is followed costs a run in every step.
constexpr double kFollowedShare = 0.25;

}  // namespace

void AdaptiveMaterial::choose_followed() {
  followed_.clear();
  if (options_.audit == 0.0 || points_.empty()) return;
  const auto draw = [&](std::size_t point) { return hashed_share(options_.seed, point, kEveryStep); };
  std::size_t lowest = 0;
  for (std::size_t point = 0; point < points_.size(); ++point) {
    if (draw(point) < draw(lowest)) lowest = point;
    if (draw(point) < kFollowedShare * options_.audit)
      followed_.push_back({point, cells_.front().answer.state});
  }
  if (followed_.empty()) followed_.push_back({lowest, cells_.front().answer.state});
}

void AdaptiveMaterial::audit() {
  if (options_.audit == 0.0) return;
  audit_offsets();
  audit_histories();
  tighten();
}

void AdaptiveMaterial::audit_offsets() {
  std::vector<PlaneRequest> requests;
  std::vector<std::size_t> points;
  std::vector<Vector7> given;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    if (is_zero(point.offset)) continue;
    if (hashed_share(options_.seed, p, static_cast<std::uint64_t>(step_)) >= options_.audit) continue;
    const PlaneReply& answer = cells_[point.cell].answer;
    requests.push_back({answer.state, point.offset});
    points.push_back(p);
    given.push_back(linearised_stress(answer.response, point.offset));
  }
  if (requests.empty()) return;
  const std::vector<PlaneReply> replies = run(requests, points);
  audits_ += static_cast<std::int64_t>(requests.size());
  for (std::size_t k = 0; k < replies.size(); ++k) {
    if (replies[k].response.quality != Quality::good) continue;
    offset_errors_.add(share_of(replies[k].response.stress - given[k]));
  }
}

void AdaptiveMaterial::audit_histories() {
  std::vector<PlaneRequest> requests;
  std::vector<std::size_t> points;
  for (const Followed& followed : followed_) {
    requests.push_back({followed.state, increment_of_step(followed.point)});
    points.push_back(followed.point);
  }
  if (std::all_of(requests.begin(), requests.end(),
                  [](const PlaneRequest& request) { return is_zero(request.increment); })) {
    return;
  }
  const std::vector<PlaneReply> replies = run(requests, points);
  audits_ += static_cast<std::int64_t>(requests.size());
  std::vector<Followed> going_on;
  for (std::size_t k = 0; k < replies.size(); ++k) {
    // A cell that cannot follow is let go; its point goes on by what serves it.
    if (replies[k].response.quality != Quality::good) continue;
    const Point& point = points_[followed_[k].point];
    const Vector7 given = linearised_stress(cells_[point.cell].answer.response, point.offset);
    history_errors_.add(share_of(replies[k].response.stress - given));
    going_on.push_back({followed_[k].point, replies[k].state});
  }
  std::vector<StatePointer*> states;
  for (Followed& followed : going_on) states.push_back(&followed.state);
  collect(calls_, states);
  followed_ = std::move(going_on);
}

void AdaptiveMaterial::tighten() {
  const MeasuredErrors fresh = offset_errors_.since(judged_);
  if (fresh.count() < kFewestAudits) return;
  const double measured = fresh.percentile(kAuditedShare);
  if (measured <= options_.tolerance) return;
  tightening_ *= 2.0;
  judged_ = offset_errors_.count();
  notes_.push_back(fmt::format(
      "audits measured an error of {:.3g} of the confining pressure (95th percentile of {}), more than the "
      "tolerance of {:.3g}: from here on estimates must stay below {:.3g}",
      measured, fresh.count(), options_.tolerance, options_.tolerance / tightening_));
}

std::vector<fem::Figure> AdaptiveMaterial::figures() const {
  const auto count = [](auto whole) { return static_cast<double>(whole); };
  std::vector<fem::Figure> figures{
      {"points", count(points_.size())},
      {"cells", count(cells_.size())},
      {"cell_runs", count(runs_)},
      {"point_steps_by_tangent", count(sources_[0])},
      {"point_steps_by_neighbour", count(sources_[1])},
      {"point_steps_by_own_cell", count(sources_[2])},
      {"tolerance", options_.tolerance},
      {"tolerance_worked_with", options_.tolerance / tightening_},
      {"audit_runs", count(audits_)},
  };
  const auto errors = [&](const std::string& what, const MeasuredErrors& measured) {
    figures.push_back({what + "_errors", count(measured.count())});
    figures.push_back({what + "_error_mean", measured.mean()});
    figures.push_back({what + "_error_95_percent", measured.percentile(kAuditedShare)});
    figures.push_back({what + "_error_largest", measured.largest()});
  };
  errors("offset", offset_errors_);
  errors("history", history_errors_);
  return figures;
}

std::vector<std::string> AdaptiveMaterial::take_notes() {
  return std::exchange(notes_, {});
}

std::vector<std::string> AdaptiveMaterial::field_names() const {
  return joined_names({"source", "cell", "error_estimate"}, names_of_columns<CellDiagnostics>());
}

void AdaptiveMaterial::fields(std::size_t point, std::span<double> values) const {
  values[0] = static_cast<double>(points_[point].source);
  values[1] = static_cast<double>(points_[point].cell);
  values[2] = points_[point].estimate / confining_;
  std::ranges::copy(values_of(cells_[points_[point].cell].answer.diagnostics), values.begin() + 3);
}

}  // namespace polargrain::coupler
