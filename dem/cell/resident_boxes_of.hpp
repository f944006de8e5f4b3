// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/resident_boxes.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/cell/quasi_static.hpp"

namespace polargrain::dem {

/// Mean unbalanced force on the grains over the mean contact force, from sums alone: no list of touched grains is made.
/// @param least_force see unbalanced(), N
template <int dim>
double quick_force_ratio(const Imbalance& imbalance, const ContactSums<dim>& sums, double least_force) {
  if (sums.contacts == 0.0) return 0.0;
  return imbalance.force / imbalance.grains / std::max(sums.forces / sums.contacts, least_force);
}

/// The resident boxes of a cell. `Kind` says how one box is made, led and read:
///   Grains                           the type of a box
///   make()                           a new one
///   put(box, state, motion)          state (null: the packing) and motion in place of what was there, forces set up
///   go_on(box, steps, increment)     see ResidentBoxes
///   alive()                          tells whoever waits that there is work going on
///   time_step()                      see ResidentBoxes
///   answer(box)                      of the step behind it
///   read(box)                        everything, with the state and the motion that belongs to it; the box goes on from there
template <class Kind>
class ResidentBoxesOf final : public ResidentBoxes {
 public:
  explicit ResidentBoxesOf(Kind kind) : kind_(std::move(kind)) {}

  void clear() override { boxes_.clear(); }

  void move_in(std::span<const ResidentStart> starts) override {
    for (const ResidentStart& start : starts) {
      kind_.alive();
      boxes_.push_back(kind_.make());
      kind_.put(*boxes_.back(), start);
    }
  }

  std::vector<ResidentAnswer> go_on(int dem_steps, std::span<const CellIncrement> increments) override {
    if (increments.size() != boxes_.size() || dem_steps < 1)
      throw RunError("resident boxes are asked for another number of increments than there are boxes");
    std::vector<ResidentAnswer> answers;
    answers.reserve(boxes_.size());
    for (std::size_t k = 0; k < boxes_.size(); ++k) try {
        kind_.alive();
        kind_.go_on(*boxes_[k], dem_steps, increments[k]);
        answers.push_back(kind_.answer(*boxes_[k]));
      } catch (const RunError& error) {
        throw RunError(fmt::format("box {} of these {}: {}", k, boxes_.size(), error.what()));
      }
    return answers;
  }

  std::vector<ResidentReadOut> read_out(std::size_t first, std::size_t count) override {
    if (first > boxes_.size() || count > boxes_.size() - first)
      throw RunError("resident boxes are asked for more boxes than there are");
    std::vector<ResidentReadOut> all;
    for (std::size_t k = first; k < first + count; ++k) {
      kind_.alive();
      all.push_back(kind_.read(*boxes_[k]));
    }
    return all;
  }

  [[nodiscard]] std::size_t count() const override { return boxes_.size(); }
  [[nodiscard]] double time_step() const override { return kind_.time_step(); }

 private:
  Kind kind_;
  std::vector<std::unique_ptr<typename Kind::Grains>> boxes_;
};

}  // namespace polargrain::dem
