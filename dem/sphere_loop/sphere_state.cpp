// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_state.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <type_traits>

#include "common/error.hpp"
#include "dem/cell/state_bounds.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of a state; spheres, contacts and values of their springs follow.
struct Header {
  std::uint64_t magic = 0;
  std::uint32_t spheres = 0;
  std::uint32_t contacts = 0;
  std::int32_t code = 0;
  std::int32_t springs = 0;
  std::array<double, 6> base{};   ///< the upper triangle, column after column, m
  std::array<double, 9> frame{};  ///< column after column
};
constexpr std::uint64_t kMagic = 0x3130656870736770ULL;  // "pgsphe01" as bytes
constexpr std::int32_t kMostSprings = 16;
constexpr std::int32_t kMostImages = 1000;

static_assert(std::is_trivially_copyable_v<Header> && std::is_trivially_copyable_v<SphereSnapshot::Motion> &&
              std::is_trivially_copyable_v<SphereSnapshot::Springs>);

template <typename Item>
std::byte* put(std::byte* place, const Item* items, std::size_t count) {
  if (count > 0) std::memcpy(place, items, count * sizeof(Item));
  return place + count * sizeof(Item);
}

template <typename Item>
const std::byte* take(const std::byte* place, Item* items, std::size_t count) {
  if (count > 0) std::memcpy(items, place, count * sizeof(Item));
  return place + count * sizeof(Item);
}

bool is_finite(const std::array<double, 3>& values) {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

void check(const SphereSnapshot& snapshot) {
  bool sound = snapshot.box.base.allFinite() && snapshot.box.frame.allFinite() &&
               snapshot.box.base.diagonal().minCoeff() > 0.0;
  for (const SphereSnapshot::Motion& sphere : snapshot.spheres)
    sound = sound && is_finite(sphere.place) && is_finite(sphere.velocity) && is_finite(sphere.spin) &&
            is_finite(sphere.turned);
  for (const double value : snapshot.values) sound = sound && std::isfinite(value);
  const auto spheres = static_cast<std::int32_t>(snapshot.spheres.size());
  std::int32_t last = 0;
  for (const SphereSnapshot::Springs& contact : snapshot.contacts) {
    sound = sound && contact.first >= last && contact.first < spheres && contact.second >= contact.first &&
            contact.second < spheres;
    for (const std::int32_t copy : contact.image) sound = sound && copy > -kMostImages && copy < kMostImages;
    last = contact.first;
  }
  if (!sound) throw RunError("this state of a cell is damaged");
}

}  // namespace

bool is_sphere_state(const State& state) {
  std::uint64_t magic = 0;
  if (state.bytes().size() < sizeof(Header)) return false;
  std::memcpy(&magic, state.bytes().data(), sizeof magic);
  return magic == kMagic;
}

StatePointer encode(const SphereSnapshot& snapshot) {
  Header header;
  header.magic = kMagic;
  header.spheres = static_cast<std::uint32_t>(snapshot.spheres.size());
  header.contacts = static_cast<std::uint32_t>(snapshot.contacts.size());
  header.code = snapshot.code;
  header.springs = snapshot.springs;
  std::size_t number = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row <= column; ++row) header.base[number++] = snapshot.box.base(row, column);
  Eigen::Map<Eigen::Matrix3d>(header.frame.data()) = snapshot.box.frame;
  std::vector<std::byte> bytes(sizeof(Header) + snapshot.spheres.size() * sizeof(SphereSnapshot::Motion) +
                               snapshot.contacts.size() * sizeof(SphereSnapshot::Springs) +
                               snapshot.values.size() * sizeof(double));
  std::byte* place = put(bytes.data(), &header, 1);
  place = put(place, snapshot.spheres.data(), snapshot.spheres.size());
  place = put(place, snapshot.contacts.data(), snapshot.contacts.size());
  put(place, snapshot.values.data(), snapshot.values.size());
  return std::make_shared<const State>(std::move(bytes));
}

SphereSnapshot decode_spheres(const State& state) {
  if (!is_sphere_state(state))
    throw RunError("this is not the state of a cell of spheres of the loop over spheres");
  Header header;
  const std::byte* place = take(state.bytes().data(), &header, 1);
  if (header.springs < 0 || header.springs > kMostSprings) throw RunError("this state of a cell is damaged");
  if (header.contacts > most_state_contacts(header.spheres))
    throw RunError("this state of a cell is damaged: it has more contacts than its grains can have");
  const std::size_t values = std::size_t{header.contacts} * static_cast<std::size_t>(header.springs);
  if (state.bytes().size() != sizeof(Header) + std::size_t{header.spheres} * sizeof(SphereSnapshot::Motion) +
                                  std::size_t{header.contacts} * sizeof(SphereSnapshot::Springs) +
                                  values * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
  SphereSnapshot snapshot;
  std::size_t number = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row <= column; ++row) snapshot.box.base(row, column) = header.base[number++];
  snapshot.box.frame = Eigen::Map<const Eigen::Matrix3d>(header.frame.data());
  snapshot.code = header.code;
  snapshot.springs = header.springs;
  snapshot.spheres.resize(header.spheres);
  snapshot.contacts.resize(header.contacts);
  snapshot.values.resize(values);
  place = take(place, snapshot.spheres.data(), snapshot.spheres.size());
  place = take(place, snapshot.contacts.data(), snapshot.contacts.size());
  take(place, snapshot.values.data(), values);
  check(snapshot);
  return snapshot;
}

std::string snapshot_fault(const SphereSnapshot& snapshot, const std::vector<double>& radii,
                           double time_step) {
  double volume = 0.0;
  for (const double radius : radii) volume += 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  if (std::string fault = box_fault(snapshot.box, volume); !fault.empty()) return fault;
  for (std::size_t k = 0; k < snapshot.spheres.size(); ++k) {
    const SphereSnapshot::Motion& from = snapshot.spheres[k];
    const SpaceMotionOfGrain motion{Eigen::Vector3d(from.place.data()), Eigen::Vector3d(from.velocity.data()),
                                    Eigen::Vector3d(from.spin.data()), Eigen::Vector3d(from.turned.data())};
    if (std::string fault = motion_fault(snapshot.box, k, motion, radii[k], time_step); !fault.empty())
      return fault;
  }
  return {};
}

}  // namespace polargrain::dem
