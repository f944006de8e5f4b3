// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// Counts the points of a material that are at a limit of their grains, at the end of each step:
///
///     points_parted      the grains carry no pressure that counts (PackingAtStart)
///     at_skew_limit      the skew stress is as large as the grains bear
///     at_couple_limit    the couple stress is
///     rotation_held      nothing resists the micro-rotation but a numerical stiffness
class PointsAtLimits {
 public:
  /// @param has_part whether skew and couple stress are the case's: else points can only have parted
  explicit PointsAtLimits(bool has_part) : has_part_(has_part) {}

  /// At the end of a step. @param points one a point
  void count(const std::vector<LimitsReached>& points);
  /// The counts of the last step, and the largest of any step (NAME_most).
  [[nodiscard]] std::vector<fem::Figure> figures() const;
  /// The same of the last step in a sentence; empty where no point is at any limit, nor has been.
  [[nodiscard]] std::string text() const;

  void save(ArchiveWriter& archive) const;
  /// @throws RunError where the archive holds something else
  void restore(ArchiveReader& archive);

 private:
  static constexpr std::size_t kCounts = 4;
  bool has_part_;
  std::int64_t points_ = 0;
  std::array<std::int64_t, kCounts> now_{};
  std::array<std::int64_t, kCounts> most_{};
};

/// Fields of a point: parted (0 or 1), and, where skew and couple stress are the case's, skew_mobilisation and
/// couple_mobilisation, the stress over its limit.
std::vector<std::string> names_of_limit_fields(bool has_part);
/// @param cosserat nothing where the cells give everything @param to gets the values in that order
template <int dim>
void write_limit_fields(const LimitsReached& reached, const std::optional<CosseratParameters>& cosserat,
                        const CosseratPart<dim>& part, std::span<double>::iterator to);

}  // namespace polargrain::coupler
