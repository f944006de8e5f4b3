// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "common/cell_increment.hpp"

namespace polargrain::coupler {

/// The steps that resident boxes have gone since they were read out, to be gone again. Of each step only the components
/// are kept that are not zero for all boxes: 4 of 21 for discs with free rotations.
class ResidentRecord {
 public:
  /// @param increments one a box
  void add(int dem_steps, std::span<const CellIncrement> increments);
  void clear();
  [[nodiscard]] std::size_t count() const { return steps_.size(); }
  [[nodiscard]] int dem_steps(std::size_t step) const { return steps_[step].dem_steps; }
  /// The increments of a step, with the bits that they came with.
  [[nodiscard]] std::vector<CellIncrement> increments(std::size_t step) const;
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Step {
    int dem_steps = 0;
    std::size_t boxes = 0;
    std::vector<std::size_t> places;  ///< components kept, counted as they lie in memory
    std::vector<double> values;       ///< of each box, box after box
  };
  std::vector<Step> steps_;
  std::size_t bytes_ = 0;
};

}  // namespace polargrain::coupler
