// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packed_grains.hpp"

#include <algorithm>
#include <array>
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

/// The same of spheres in space. Of three rotations a grain there are all or none.
struct SpaceHeader {
  std::uint64_t magic = 0;
  std::uint64_t grains = 0;
  std::uint64_t history_values = 0;
  std::uint64_t values = 0;
  std::array<double, 6> base{};   ///< the upper triangle, column after column, m
  std::array<double, 9> frame{};  ///< column after column
};
constexpr std::uint64_t kSpaceMagic = 0x3130636170736770ULL;  // "pgspac01" as bytes
constexpr std::uint64_t kMostHistoryValues = 64;

[[noreturn]] void damaged() {
  throw RunError("this state of a cell is damaged");
}

/// A whole number that is hidden among doubles.
std::int64_t whole(double value) {
  return std::bit_cast<std::int64_t>(value);
}

/// A number of `count` things counted from 1, as an index; `count` when there is no such thing.
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

void check_in_space(const PackedGrains& state, std::size_t grain, const GrainLayout& layout, double radius) {
  const std::span<const double> record = state.record(grain);
  SpaceMotionOfGrain motion;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    motion.place(k) = record[GrainLayout::kPlace + axis];
    motion.velocity(k) = record[GrainLayout::kVelocity + axis];
    motion.spin(k) = record[layout.spin + axis];
    if (!state.rotations.empty()) motion.turned(k) = state.rotations[3 * grain + axis];
  }
  if (const std::string fault = motion_fault(*state.space, grain, motion, radius, layout.time_step);
      !fault.empty())
    throw RunError(fault);
}

SpaceBox box_of(const SpaceHeader& header) {
  SpaceBox box;
  std::size_t place = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row <= column; ++row) box.base(row, column) = header.base[place++];
  box.frame = Eigen::Map<const Eigen::Matrix3d>(header.frame.data());
  return box;
}

SpaceHeader header_of(const SpaceBox& box) {
  SpaceHeader header;
  header.magic = kSpaceMagic;
  std::size_t place = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row <= column; ++row) header.base[place++] = box.base(row, column);
  Eigen::Map<Eigen::Matrix3d>(header.frame.data()) = box.frame;
  return header;
}

/// Lengths are as in a plane state.
Header lengths_of(const SpaceHeader& header) {
  return {kMagic, header.grains, header.history_values, header.values, {}};
}

}  // namespace

PackedGrains decode_grains(const State& state) {
  Header header;
  const std::span<const std::byte> bytes = state.bytes();
  if (bytes.size() < sizeof(Header)) throw RunError("this is not the state of a cell: it is too short");
  std::memcpy(&header, bytes.data(), sizeof(Header));
  PackedGrains packed;
  std::size_t head = sizeof(Header);
  if (header.magic == kSpaceMagic) {
    SpaceHeader of_space;
    head = sizeof(SpaceHeader);
    if (bytes.size() < head) throw RunError("this is not the state of a cell: it is too short");
    std::memcpy(&of_space, bytes.data(), head);
    packed.space = box_of(of_space);
    header = lengths_of(of_space);
  }
  const std::uint64_t doubles = (bytes.size() - head) / sizeof(double);
  if (header.magic != kMagic) throw RunError("this is not the state of a cell");
  const std::uint64_t turns = packed.space ? 3 : 1;
  // Each grain has its length at least, so that sums of these numbers do not run over.
  const bool fits = header.values <= doubles && header.grains <= header.values && header.grains > 0 &&
                    header.history_values <= kMostHistoryValues;
  const bool has_rotations = fits && doubles == header.values + turns * header.grains;
  if (!fits || (doubles != header.values && !has_rotations) ||
      bytes.size() != head + doubles * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
  packed.box = header.box;
  packed.history_values = header.history_values;
  packed.values.resize(header.values);
  packed.rotations.resize(has_rotations ? turns * header.grains : 0);
  std::memcpy(packed.values.data(), bytes.data() + head, header.values * sizeof(double));
  if (has_rotations)
    std::memcpy(packed.rotations.data(), bytes.data() + head + header.values * sizeof(double),
                packed.rotations.size() * sizeof(double));
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
  const std::size_t head = state.space ? sizeof(SpaceHeader) : sizeof(Header);
  std::vector<std::byte> bytes(head + (state.values.size() + state.rotations.size()) * sizeof(double));
  std::byte* place = bytes.data();
  if (state.space) {
    SpaceHeader of_space = header_of(*state.space);
    of_space.grains = header.grains;
    of_space.history_values = header.history_values;
    of_space.values = header.values;
    std::memcpy(place, &of_space, head);
  } else {
    std::memcpy(place, &header, head);
  }
  place += head;
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
  if (state.space.has_value() != layout.space)
    throw RunError(layout.space
                       ? "this state has no box in space: it is of discs, or lies in a packing of an earlier "
                         "version of this program, which 'polargrain pack --settle' renews"
                       : "this state is of spheres in space, and the cell is plane");
  double area = 0.0;
  double volume = 0.0;
  for (const double radius : layout.radii) {
    area += std::numbers::pi * radius * radius;
    volume += 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  const std::string fault = state.space ? box_fault(*state.space, volume) : box_fault(state.box, area);
  if (!fault.empty()) throw RunError(fault);
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
    const double radius = layout.radii[tag];
    if (state.space) {
      check_in_space(state, k, layout, radius);
      continue;
    }
    const GrainMotion motion{
        record[GrainLayout::kPlace],    record[GrainLayout::kPlace + 1],
        record[GrainLayout::kVelocity], record[GrainLayout::kVelocity + 1],
        record[layout.spin + 2],        state.rotations.empty() ? 0.0 : state.rotations[k]};
    if (const std::string fault = motion_fault(state.box, k, motion, radius, layout.time_step);
        !fault.empty())
      throw RunError(fault);
    // The engine looks for grains in x3 too, though discs stay in their plane.
    if (!(std::abs(record[GrainLayout::kPlace + 2] - layout.heads[tag][GrainLayout::kPlace + 2]) <= radius))
      damaged();
  }
}

}  // namespace polargrain::dem
