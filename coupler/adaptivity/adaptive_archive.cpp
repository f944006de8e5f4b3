// SPDX-License-Identifier: GPL-2.0-or-later
// An adaptive material in a checkpoint: cells, what is known of them, who follows whom, and what was
// measured.
#include <array>

#include "common/error.hpp"
#include "common/record_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"

namespace polargrain::coupler {
namespace {

[[noreturn]] void report_mismatch() {
  throw RunError("the checkpoint of an adaptive material does not fit the case");
}

}  // namespace

template <int dim>
void AdaptiveMaterial<dim>::save(ArchiveWriter& archive) const {
  std::vector<std::int64_t> followed;
  std::vector<StatePointer> states;
  for (const Followed& item : followed_) {
    followed.push_back(static_cast<std::int64_t>(item.point));
    states.push_back(item.state);
  }
  const std::vector<std::int64_t> counts{static_cast<std::int64_t>(cells_.size()),
                                         step_,
                                         shares_ ? 1 : 0,
                                         sources_[0],
                                         sources_[1],
                                         sources_[2],
                                         costs_.runs,
                                         costs_.steps,
                                         costs_.unused_runs,
                                         costs_.unused_steps,
                                         costs_.audits,
                                         costs_.audit_steps,
                                         costs_.redone};
  const std::array<double, 5> bounds{tightening_, bounds_.last, bounds_.largest, bounds_.steps_beyond,
                                     bounds_.first_beyond};
  archive.write("counts", std::span<const std::int64_t>(counts));
  archive.write("bounds", std::span<const double>(bounds));
  write_records(archive, "cells", std::span<const Cell>(cells_));
  write_records(archive, "points", std::span<const Point>(points_));
  archive.write("followed", std::span<const std::int64_t>(followed));
  archive.write("followed_states", std::span<const StatePointer>(states));
  archive.write("history_errors", std::span<const double>(errors_.all()));
  at_limits_.save(archive);
  ground_.save(archive);
}

template <int dim>
void AdaptiveMaterial<dim>::restore(ArchiveReader& archive) {
  const std::vector<std::int64_t> counts = archive.integers("counts");
  const std::vector<double> bounds = archive.doubles("bounds");
  if (counts.size() != 13 || counts[0] < 1 || bounds.size() != 5) report_mismatch();
  const auto cells = static_cast<std::size_t>(counts[0]);
  cells_ = read_records<Cell>(archive, "cells", cells);
  points_ = read_records<Point>(archive, "points", points_.size());
  for (const Point& point : points_) {
    if (point.cell >= cells) report_mismatch();
  }
  const std::vector<std::int64_t> followed = archive.integers("followed");
  const std::vector<StatePointer> states = archive.states("followed_states");
  if (followed.size() != states.size()) report_mismatch();
  followed_.clear();
  for (std::size_t k = 0; k < followed.size(); ++k) {
    if (followed[k] < 0 || static_cast<std::size_t>(followed[k]) >= points_.size()) report_mismatch();
    followed_.push_back({static_cast<std::size_t>(followed[k]), states[k]});
  }
  errors_ = MeasuredErrors(archive.doubles("history_errors"));
  at_limits_.restore(archive);
  ground_.restore(archive);
  tightening_ = bounds[0];
  bounds_ = {bounds[1], bounds[2], bounds[3], bounds[4]};
  step_ = counts[1];
  shares_ = counts[2] != 0;
  std::copy_n(counts.begin() + 3, 3, sources_.begin());
  costs_ = {counts[6], counts[7], counts[8], counts[9], counts[10], counts[11], counts[12]};
  forget_step();
}

template class AdaptiveMaterial<2>;
template class AdaptiveMaterial<3>;

}  // namespace polargrain::coupler
