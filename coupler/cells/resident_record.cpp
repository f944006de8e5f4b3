// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/resident_record.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace polargrain::coupler {
namespace {

constexpr std::size_t kComponents = sizeof(CellIncrement) / sizeof(double);
static_assert(sizeof(CellIncrement) == 21 * sizeof(double) && std::is_standard_layout_v<CellIncrement>,
              "an increment is copied as its doubles");

using Components = std::array<double, kComponents>;

}  // namespace

void ResidentRecord::add(int dem_steps, std::span<const CellIncrement> increments) {
  std::vector<Components> all(increments.size());
  for (std::size_t box = 0; box < all.size(); ++box)
    std::memcpy(all[box].data(), &increments[box], sizeof(Components));
  Step step{dem_steps, increments.size(), {}, {}};
  for (std::size_t place = 0; place < kComponents; ++place) {
    std::uint64_t bits = 0;  // of any box: the sign of a zero counts
    for (const Components& box : all) bits |= std::bit_cast<std::uint64_t>(box[place]);
    if (bits != 0) step.places.push_back(place);
  }
  step.values.reserve(all.size() * step.places.size());
  for (const Components& box : all)
    for (const std::size_t place : step.places) step.values.push_back(box[place]);
  bytes_ += sizeof(Step) + step.values.size() * sizeof(double);
  steps_.push_back(std::move(step));
}

void ResidentRecord::clear() {
  steps_.clear();
  bytes_ = 0;
}

std::vector<CellIncrement> ResidentRecord::increments(std::size_t number) const {
  const Step& step = steps_[number];
  std::vector<CellIncrement> increments(step.boxes);
  auto value = step.values.begin();
  for (CellIncrement& increment : increments) {
    Components box{};
    for (const std::size_t place : step.places) box[place] = *value++;
    std::memcpy(static_cast<void*>(&increment), box.data(), sizeof box);
  }
  return increments;
}

}  // namespace polargrain::coupler
