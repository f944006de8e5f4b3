// SPDX-License-Identifier: GPL-2.0-or-later
// An adaptive material in a checkpoint: cells, what is known of them, who follows whom, and what was
// measured.
#include "common/error.hpp"
#include "common/record_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"

namespace polargrain::coupler {
namespace {

[[noreturn]] void report_mismatch() {
  throw RunError("the checkpoint of an adaptive material does not fit the case");
}

}  // namespace

void AdaptiveMaterial::save(ArchiveWriter& archive) const {
  std::vector<std::int64_t> followed;
  std::vector<StatePointer> states;
  for (const Followed& item : followed_) {
    followed.push_back(static_cast<std::int64_t>(item.point));
    states.push_back(item.state);
  }
  const std::vector<std::int64_t> counts{static_cast<std::int64_t>(cells_.size()),
                                         step_,
                                         static_cast<std::int64_t>(judged_),
                                         sources_[0],
                                         sources_[1],
                                         sources_[2],
                                         runs_,
                                         audits_};
  archive.write("counts", std::span<const std::int64_t>(counts));
  archive.write("tightening", std::span<const double>(&tightening_, 1));
  write_records(archive, "cells", std::span<const Cell>(cells_));
  write_records(archive, "points", std::span<const Point>(points_));
  archive.write("followed", std::span<const std::int64_t>(followed));
  archive.write("followed_states", std::span<const StatePointer>(states));
  archive.write("offset_errors", std::span<const double>(offset_errors_.all()));
  archive.write("history_errors", std::span<const double>(history_errors_.all()));
}

void AdaptiveMaterial::restore(ArchiveReader& archive) {
  const std::vector<std::int64_t> counts = archive.integers("counts");
  const std::vector<double> tightening = archive.doubles("tightening");
  if (counts.size() != 8 || counts[0] < 1 || tightening.size() != 1) report_mismatch();
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
  offset_errors_ = MeasuredErrors(archive.doubles("offset_errors"));
  history_errors_ = MeasuredErrors(archive.doubles("history_errors"));
  tightening_ = tightening[0];
  step_ = counts[1];
  judged_ = static_cast<std::size_t>(counts[2]);
  std::copy_n(counts.begin() + 3, 3, sources_.begin());
  runs_ = counts[6];
  audits_ = counts[7];
  revert();
}

}  // namespace polargrain::coupler
