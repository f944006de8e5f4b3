// SPDX-License-Identifier: GPL-2.0-or-later
// An adaptive material in a checkpoint: cells, what is known of them, who follows whom, and what was
// measured.
#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "common/record_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::size_t kCurvature = 6;  ///< numbers of a Curvature
constexpr std::size_t kPoint = 8;      ///< numbers of a point beside its path
constexpr std::size_t kPlace = 4;

void append(std::vector<double>& values, const Eigen::Matrix2d& matrix) {
  values.insert(values.end(), matrix.data(), matrix.data() + kPlace);
}

Eigen::Matrix2d matrix_at(const double* values) {
  return Eigen::Map<const Eigen::Matrix2d>(values);
}

[[noreturn]] void report_mismatch() {
  throw RunError("the checkpoint of an adaptive material does not fit the case");
}

}  // namespace

void AdaptiveMaterial::save(ArchiveWriter& archive) const {
  std::vector<CellReply> answers;
  std::vector<double> curvatures;
  for (const Cell& cell : cells_) {
    answers.push_back(cell.answer);
    curvatures.insert(curvatures.end(), {cell.curvature.error, cell.curvature.length});
    append(curvatures, cell.curvature.direction);
  }
  std::vector<double> numbers;
  std::vector<double> paths;
  std::vector<std::int64_t> whole;
  for (const Point& point : points_) {
    append(numbers, point.offset);
    numbers.insert(numbers.end(), {point.cosserat.skew_stress, point.cosserat.couple_stress(0),
                                   point.cosserat.couple_stress(1), point.estimate});
    for (const Eigen::Matrix2d& place : point.path) append(paths, place);
    whole.insert(whole.end(), {static_cast<std::int64_t>(point.cell), static_cast<std::int64_t>(point.source),
                               static_cast<std::int64_t>(point.path.size())});
  }
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
  write_records(archive, "cells", std::span<const CellReply>(answers));
  archive.write("curvatures", std::span<const double>(curvatures));
  archive.write("points", std::span<const double>(numbers));
  archive.write("sources", std::span<const std::int64_t>(whole));
  archive.write("paths", std::span<const double>(paths));
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
  std::vector<CellReply> answers = read_records<CellReply>(archive, "cells", cells);
  const std::vector<double> curvatures = read_lists(archive, "curvatures", cells, kCurvature);
  cells_.assign(cells, Cell{});
  for (std::size_t c = 0; c < cells; ++c) {
    const double* values = curvatures.data() + c * kCurvature;
    cells_[c] = {std::move(answers[c]), {values[0], values[1], matrix_at(values + 2)}};
  }
  const std::vector<double> numbers = read_lists(archive, "points", points_.size(), kPoint);
  const std::vector<std::int64_t> whole = archive.integers("sources");
  const std::vector<double> paths = archive.doubles("paths");
  if (whole.size() != 3 * points_.size()) report_mismatch();
  std::size_t place = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const double* values = numbers.data() + p * kPoint;
    const std::int64_t* shares = whole.data() + 3 * p;
    const auto length = static_cast<std::size_t>(shares[2]);
    if (shares[0] < 0 || static_cast<std::size_t>(shares[0]) >= cells || shares[1] < 0 || shares[1] > 2 ||
        place + length * kPlace > paths.size()) {
      report_mismatch();
    }
    Point& point = points_[p];
    point.offset = matrix_at(values);
    point.cosserat = {values[4], {values[5], values[6]}};
    point.estimate = values[7];
    point.cell = static_cast<std::size_t>(shares[0]);
    point.source = static_cast<Source>(shares[1]);
    point.path.clear();
    for (std::size_t k = 0; k < length; ++k, place += kPlace)
      point.path.push_back(matrix_at(paths.data() + place));
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
