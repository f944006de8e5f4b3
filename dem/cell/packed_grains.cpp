// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packed_grains.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/error.hpp"
#include "dem/cell/state_bounds.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of every state; plain numbers, so that another process of the same machine type reads it.
struct Header {
  std::uint64_t magic = 0;
  std::uint64_t grains = 0;
  std::uint64_t history_values = 0;  ///< per contact and side
  std::uint64_t values = 0;          ///< doubles of the packed grains; rotations may follow, one a grain
  Box box;
};
constexpr std::uint64_t kMagic = 0x31306c6c65636770ULL;  // "pgcell01" as bytes
constexpr std::uint64_t kMostHistoryValues = 64;

[[noreturn]] void damaged() {
  throw RunError("this state of a cell is damaged");
}

/// A whole number that is hidden among doubles.
std::int64_t whole(double value) {
  return std::bit_cast<std::int64_t>(value);
}

/// A number of `count` things counted from 1, as an index; `count` when it is none.
std::size_t index_of(double value, std::size_t count) {
  const std::int64_t number = whole(value);
  return number >= 1 && number <= static_cast<std::int64_t>(count) ? static_cast<std::size_t>(number - 1)
                                                                   : count;
}

void check_contacts(std::span<const double> record, const GrainLayout& layout, std::size_t grains) {
  const std::size_t fixed = layout.head + layout.tail + (layout.has_history ? 1 : 0);
  if (record.size() < fixed || (!layout.has_history && record.size() != fixed)) damaged();
  if (!layout.has_history) return;
  const std::size_t contact = 1 + layout.history_values;
  const std::int64_t contacts = whole(record[layout.head]);
  if (contacts < 0 || static_cast<std::uint64_t>(contacts) > most_state_contacts(grains) ||
      record.size() != fixed + static_cast<std::size_t>(contacts) * contact)
    damaged();
  for (std::size_t c = 0; c < static_cast<std::size_t>(contacts); ++c)
    if (index_of(record[layout.head + 1 + c * contact], grains) == grains) damaged();
}

}  // namespace

PackedGrains decode_grains(const State& state) {
  Header header;
  const std::span<const std::byte> bytes = state.bytes();
  if (bytes.size() < sizeof(Header)) throw RunError("this is not the state of a cell: it is too short");
  std::memcpy(&header, bytes.data(), sizeof(Header));
  const std::uint64_t doubles = (bytes.size() - sizeof(Header)) / sizeof(double);
  if (header.magic != kMagic) throw RunError("this is not the state of a cell");
  // Each grain has its length at least, so that sums of these numbers do not run over.
  const bool fits = header.values <= doubles && header.grains <= header.values && header.grains > 0 &&
                    header.history_values <= kMostHistoryValues;
  const bool has_rotations = fits && doubles == header.values + header.grains;
  if (!fits || (doubles != header.values && !has_rotations) ||
      bytes.size() != sizeof(Header) + doubles * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
  PackedGrains packed;
  packed.box = header.box;
  packed.history_values = header.history_values;
  packed.values.resize(header.values);
  packed.rotations.resize(has_rotations ? header.grains : 0);
  std::memcpy(packed.values.data(), bytes.data() + sizeof(Header), header.values * sizeof(double));
  if (has_rotations)
    std::memcpy(packed.rotations.data(), bytes.data() + sizeof(Header) + header.values * sizeof(double),
                header.grains * sizeof(double));
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(packed.values.begin(), packed.values.end(), finite) ||
      !std::all_of(packed.rotations.begin(), packed.rotations.end(), finite))
    throw RunError("this state of a cell is damaged: it holds a number that is not finite");
  std::size_t place = 0;
  for (std::uint64_t grain = 0; grain < header.grains; ++grain) {
    packed.starts.push_back(place);
    const std::size_t left = packed.values.size() - place;
    const double length = left > 0 ? packed.values[place] : 0.0;
    if (!(length >= 1.0 && length <= static_cast<double>(left)) || length != std::floor(length)) damaged();
    place += static_cast<std::size_t>(length);
  }
  packed.starts.push_back(place);
  if (place != packed.values.size()) damaged();
  return packed;
}

StatePointer encode(const PackedGrains& state, std::size_t grains) {
  Header header;
  header.magic = kMagic;
  header.grains = grains;
  header.history_values = state.history_values;
  header.values = state.values.size();
  header.box = state.box;
  std::vector<std::byte> bytes(sizeof(Header) +
                               (state.values.size() + state.rotations.size()) * sizeof(double));
  std::byte* place = bytes.data();
  std::memcpy(place, &header, sizeof(Header));
  place += sizeof(Header);
  if (!state.values.empty()) std::memcpy(place, state.values.data(), state.values.size() * sizeof(double));
  place += state.values.size() * sizeof(double);
  if (!state.rotations.empty())
    std::memcpy(place, state.rotations.data(), state.rotations.size() * sizeof(double));
  return std::make_shared<const State>(std::move(bytes));
}

void check_records(const PackedGrains& state, const GrainLayout& layout) {
  const std::size_t grains = layout.heads.size();
  if (state.grains() != grains || state.history_values != layout.history_values)
    throw RunError("this state belongs to a cell of another packing or another input script");
  double area = 0.0;
  for (const double radius : layout.radii) area += std::numbers::pi * radius * radius;
  if (const std::string fault = box_fault(state.box, area); !fault.empty()) throw RunError(fault);
  std::vector<bool> seen(grains, false);
  for (std::size_t k = 0; k < grains; ++k) {
    const std::span<const double> record = state.record(k);
    check_contacts(record, layout, grains);
    const std::size_t tag = index_of(record[GrainLayout::kTag], grains);
    if (tag == grains || seen[tag]) damaged();
    seen[tag] = true;
    for (const std::size_t place : layout.fixed)
      if (whole(record[place]) != whole(layout.heads[tag][place]))
        throw RunError("this state belongs to a cell of another packing or another input script");
    const GrainMotion motion{
        record[GrainLayout::kPlace],    record[GrainLayout::kPlace + 1],
        record[GrainLayout::kVelocity], record[GrainLayout::kVelocity + 1],
        record[layout.spin + 2],        state.rotations.empty() ? 0.0 : state.rotations[k]};
    const double radius = layout.radii[tag];
    if (const std::string fault = motion_fault(state.box, k, motion, radius, layout.time_step);
        !fault.empty())
      throw RunError(fault);
    // The engine looks for grains in x3 too, though discs stay in their plane.
    if (!(std::abs(record[GrainLayout::kPlace + 2] - layout.heads[tag][GrainLayout::kPlace + 2]) <= radius))
      damaged();
  }
}

}  // namespace polargrain::dem
