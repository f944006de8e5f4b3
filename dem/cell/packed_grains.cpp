// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packed_grains.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "common/error.hpp"
#include "dem/box/state_bounds.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of every state; plain numbers, so that another process of the same machine type reads it. Rotations may
/// follow the values: of all grains or of no grain.
template <int dim>
struct HeaderOfPackedGrains {
  std::uint64_t magic = 0;
  std::uint64_t grains = 0;
  std::uint64_t history_values = 0;  ///< per contact and side
  std::uint64_t values = 0;          ///< doubles of the packed grains
  typename Box<dim>::Numbers box{};
};
template <int dim>
constexpr std::uint64_t kMagicOfPackedGrains = dim == 2 ? 0x31306c6c65636770ULL   // "pgcell01" as bytes
                                                        : 0x3130636170736770ULL;  // "pgspac01"
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

template <int dim>
void check_motion(const PackedGrains& state, const Box<dim>& box, std::size_t grain,
                  const GrainLayout& layout, double radius) {
  constexpr std::size_t rotations = Cosserat<dim>::rotations;
  const auto record = state.record(grain).begin();
  GrainMotion<dim> motion;
  std::copy_n(record + GrainLayout::kPlace, dim, motion.place.begin());
  std::copy_n(record + GrainLayout::kVelocity, dim, motion.velocity.begin());
  std::copy_n(record + static_cast<std::ptrdiff_t>(layout.spin) + Cosserat<dim>::axis(0), rotations,
              motion.spin.begin());
  if (!state.rotations.empty())
    std::copy_n(state.rotations.begin() + static_cast<std::ptrdiff_t>(rotations * grain), rotations,
                motion.turned.begin());
  if (const std::string fault = motion_fault(box, grain, motion, radius, layout.time_step); !fault.empty())
    throw RunError(fault);
}

/// Lengths and box from the first bytes. @returns how many bytes that were
template <int dim>
std::size_t read_header(std::span<const std::byte> bytes, HeaderOfPackedGrains<2>& lengths, Box<dim>& box) {
  HeaderOfPackedGrains<dim> header;
  if (bytes.size() < sizeof header) throw RunError("this is not the state of a cell: it is too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  box = Box<dim>::from_numbers(header.box);
  lengths = {header.magic, header.grains, header.history_values, header.values, {}};
  return sizeof header;
}

template <int dim>
std::vector<std::byte> header_of(const PackedGrains& state, const Box<dim>& box, std::size_t grains) {
  const HeaderOfPackedGrains<dim> header{kMagicOfPackedGrains<dim>, grains, state.history_values,
                                         state.values.size(), box.numbers()};
  std::vector<std::byte> bytes(sizeof header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

std::vector<std::byte>& append(std::vector<std::byte>& bytes, const std::vector<double>& values) {
  const auto more = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), more.begin(), more.end());
  return bytes;
}

}  // namespace

PackedGrains decode_grains(const State& state) {
  HeaderOfPackedGrains<2> header;
  const std::span<const std::byte> bytes = state.bytes();
  PackedGrains packed;
  std::size_t head = read_header(bytes, header, packed.box);
  if (header.magic == kMagicOfPackedGrains<3>) {
    head = read_header(bytes, header, packed.space.emplace());
  } else if (header.magic != kMagicOfPackedGrains<2>) {
    throw RunError("this is not the state of a cell");
  }
  const std::uint64_t doubles = (bytes.size() - head) / sizeof(double);
  const std::uint64_t turns = packed.space ? 3 : 1;
  // Each grain has its length at least, so that sums of these numbers do not run over.
  const bool fits = header.values <= doubles && header.grains <= header.values && header.grains > 0 &&
                    header.history_values <= kMostHistoryValues;
  const bool has_rotations = fits && doubles == header.values + turns * header.grains;
  if (!fits || (doubles != header.values && !has_rotations) ||
      bytes.size() != head + doubles * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
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
  std::vector<std::byte> bytes =
      state.space ? header_of(state, *state.space, grains) : header_of(state, state.box, grains);
  append(append(bytes, state.values), state.rotations);
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
    area += grain_size<2>(radius);
    volume += grain_size<3>(radius);
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
      check_motion(state, *state.space, k, layout, radius);
      continue;
    }
    check_motion(state, state.box, k, layout, radius);
    // The engine looks for grains in x3 too, though discs stay in their plane.
    if (!(std::abs(record[GrainLayout::kPlace + 2] - layout.heads[tag][GrainLayout::kPlace + 2]) <= radius))
      damaged();
  }
}

}  // namespace polargrain::dem
