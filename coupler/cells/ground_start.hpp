// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/stress_levels.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// The start of a material of boxes in level ground: each point has the stress of its depth, and its box is led there from one
/// packing (docs/theory/solver.md, boxes in level ground).
///
/// The packing goes along the stresses of the ground once, and is kept at a table of levels. A point takes the level nearest to its
/// stress by ratio, and some strains along the tangent lead it to its own. Points of one depth share a box. The mesh
/// does not move for these strains. The stress of a point is what its box says.
///
/// Order of calls: set for all points, then lead, then the others.
template <int dim>
class GroundStart {
 public:
  using Vector = typename Cosserat<dim>::Vector;

  /// See BeginsInGround. @throws RunError when the points have different K0
  void set(std::size_t point, const Vector& stress);
  /// No point has a stress of its own: boxes begin at the packing.
  [[nodiscard]] bool empty() const { return vertical_.empty(); }
  /// Stresses are set, and boxes have neither been led there nor come from a checkpoint.
  [[nodiscard]] bool is_due() const { return !empty() && !is_done_; }

  /// Makes the table. @throws RunError when the packing cannot be led along the stresses of the ground
  void lead(const CellCalls<dim>& calls);
  /// The boxes of these points, each led to its own stress as near as it comes.
  [[nodiscard]] std::vector<CellReply> boxes(const CellCalls<dim>& calls,
                                             std::span<const std::size_t> points) const;
  /// Enters the stress that a point begins with into the report.
  void judge(std::size_t point, const Vector& stress);

  [[nodiscard]] const StressLevels& levels() const { return levels_; }
  [[nodiscard]] std::size_t level_of(std::size_t point) const;
  /// The strains in the plane of the points, from their level to their own stress along its tangent; in space all.
  [[nodiscard]] Increment<dim> offset_of(std::size_t point) const;

  /// Appends start_levels, start_K0_least and _largest, start_stress_off (largest |s - target|, Pa), start_stress_off_share (of the
  /// vertical stress, where the table reaches), start_points_above_table; nothing where the points begin at the packing.
  void add_figures(std::vector<fem::Figure>& figures) const;
  /// Texts for the user on these figures; empty where all is well.
  [[nodiscard]] std::vector<std::string> notes() const;
  void save(ArchiveWriter& archive) const;
  void restore(ArchiveReader& archive);

 private:
  static constexpr int kUp = dim == 2 ? element::k22 : element::k33;
  /// The stress that a point is led to, Pa: the stress of the lowest level where the table does not reach.
  [[nodiscard]] double reached(double vertical) const;

  std::vector<double> vertical_;  ///< by point, Pa, compression positive
  GroundPath path_;
  std::optional<double> ratio_;  ///< of the first point with a stress
  StressLevels levels_;
  bool is_done_ = false;
  struct Report {
    double levels = 0.0;
    double least_ratio = 0.0, largest_ratio = 0.0;
    double off = 0.0, off_share = 0.0;
    double above_table = 0.0;  ///< points
    double lowest = 0.0;       ///< level, Pa
  } report_;
};

}  // namespace polargrain::coupler
