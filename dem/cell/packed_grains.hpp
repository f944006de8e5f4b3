// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/state.hpp"
#include "dem/box/box.hpp"

namespace polargrain::dem {

/// A state of the engine's general loop: the box, and each grain as the engine packs one that leaves for
/// another process, a record of doubles (whole numbers among them by their bits) that begins with its length:
///
///     length | place, motion, tag, type, ... | partners and springs of its contacts | more values
///
/// The engine believes every length and every partner in it. A record unpacked there has to pass both checks
/// below.
struct PackedGrains {
  Box<2> box;                       ///< of a plane state
  std::size_t history_values = 0;   ///< springs of a contact
  std::vector<double> values;       ///< the records
  std::vector<std::size_t> starts;  ///< where each record begins, and where the last ends
  std::vector<double> rotations;    ///< rad, one a grain or, in space, three; or empty
  std::optional<Box<3>> space;      ///< the box of a state in space; nothing: a plane state

  [[nodiscard]] std::size_t grains() const { return starts.size() - 1; }
  [[nodiscard]] std::span<const double> record(std::size_t grain) const {
    return std::span(values).subspan(starts[grain], starts[grain + 1] - starts[grain]);
  }
};

/// The first bytes are not looked at: a state of other grains than discs (is_snapshot<2>).
/// @throws RunError when lengths do not fit each other or a number is not finite
PackedGrains decode_grains(const State& state);
/// The opposite. `starts` is not needed.
StatePointer encode(const PackedGrains& state, std::size_t grains);

/// How an engine packs its grains, and which members of them never change.
struct GrainLayout {
  static constexpr std::size_t kPlace = 1;  ///< x, y, z; then the velocity; then the tag
  static constexpr std::size_t kVelocity = 4;
  static constexpr std::size_t kTag = 7;

  std::size_t head = 0;            ///< values before the contacts, the length among them
  std::size_t tail = 0;            ///< values behind them
  bool has_history = true;         ///< contacts are packed
  std::size_t history_values = 0;  ///< springs of a contact
  std::size_t spin = 0;            ///< where the spin begins
  std::vector<std::size_t> fixed;  ///< places in the head that hold the bits of the engine's own grain
  std::vector<std::vector<double>> heads;  ///< of the engine's own grains, by their tags
  std::vector<double> radii;               ///< m, by tags
  bool space = false;                      ///< spheres in a box that is periodic in x3 too
  double time_step = 0.0;                  ///< s
};

/// @throws RunError when a record does not fit this engine: other grains, lengths that do not fit, partners
/// that are no grains, a place outside of the box
void check_records(const PackedGrains& state, const GrainLayout& layout);

}  // namespace polargrain::dem
