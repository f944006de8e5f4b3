// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/disc_state.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "common/error.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of a state; discs, contacts and values of their springs follow.
struct Header {
  std::uint64_t magic = 0;
  std::uint32_t discs = 0;
  std::uint32_t contacts = 0;
  std::int32_t code = 0;
  std::int32_t springs = 0;
  Box box;
};
constexpr std::uint64_t kMagic = 0x3130637369646770ULL;  // "pgdisc01" as bytes
constexpr std::int32_t kMostSprings = 16;
constexpr std::int32_t kMostImages = 1000;

static_assert(std::is_trivially_copyable_v<Header> && std::is_trivially_copyable_v<DiscSnapshot::Motion> &&
              std::is_trivially_copyable_v<DiscSnapshot::Springs>);

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

void check(const DiscSnapshot& snapshot) {
  const Box& box = snapshot.box;
  bool sound = std::isfinite(box.length_x) && std::isfinite(box.length_y) && std::isfinite(box.tilt) &&
               std::isfinite(box.rotation) && box.length_x > 0.0 && box.length_y > 0.0;
  for (const DiscSnapshot::Motion& disc : snapshot.discs)
    sound = sound && std::isfinite(disc.x) && std::isfinite(disc.y) && std::isfinite(disc.vx) &&
            std::isfinite(disc.vy) && std::isfinite(disc.spin) && std::isfinite(disc.turned);
  for (const double value : snapshot.values) sound = sound && std::isfinite(value);
  const auto discs = static_cast<std::int32_t>(snapshot.discs.size());
  std::int32_t last = 0;
  for (const DiscSnapshot::Springs& contact : snapshot.contacts) {
    sound = sound && contact.first >= last && contact.first < discs && contact.second >= contact.first &&
            contact.second < discs && std::abs(contact.image.p) < kMostImages &&
            std::abs(contact.image.q) < kMostImages;
    last = contact.first;
  }
  if (!sound) throw RunError("this state of a cell is damaged");
}

}  // namespace

bool is_disc_state(const State& state) {
  std::uint64_t magic = 0;
  if (state.bytes().size() < sizeof(Header)) return false;
  std::memcpy(&magic, state.bytes().data(), sizeof magic);
  return magic == kMagic;
}

StatePointer encode(const DiscSnapshot& snapshot) {
  Header header;
  header.magic = kMagic;
  header.discs = static_cast<std::uint32_t>(snapshot.discs.size());
  header.contacts = static_cast<std::uint32_t>(snapshot.contacts.size());
  header.code = snapshot.code;
  header.springs = snapshot.springs;
  header.box = snapshot.box;
  std::vector<std::byte> bytes(sizeof(Header) + snapshot.discs.size() * sizeof(DiscSnapshot::Motion) +
                               snapshot.contacts.size() * sizeof(DiscSnapshot::Springs) +
                               snapshot.values.size() * sizeof(double));
  std::byte* place = put(bytes.data(), &header, 1);
  place = put(place, snapshot.discs.data(), snapshot.discs.size());
  place = put(place, snapshot.contacts.data(), snapshot.contacts.size());
  put(place, snapshot.values.data(), snapshot.values.size());
  return std::make_shared<const State>(std::move(bytes));
}

DiscSnapshot decode_discs(const State& state) {
  if (!is_disc_state(state)) throw RunError("this is not the state of a cell of discs");
  Header header;
  const std::byte* place = take(state.bytes().data(), &header, 1);
  if (header.springs < 0 || header.springs > kMostSprings) throw RunError("this state of a cell is damaged");
  if (header.contacts > most_state_contacts(header.discs))
    throw RunError("this state of a cell is damaged: it has more contacts than its grains can have");
  const std::size_t values = std::size_t{header.contacts} * static_cast<std::size_t>(header.springs);
  if (state.bytes().size() != sizeof(Header) + std::size_t{header.discs} * sizeof(DiscSnapshot::Motion) +
                                  std::size_t{header.contacts} * sizeof(DiscSnapshot::Springs) +
                                  values * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
  DiscSnapshot snapshot;
  snapshot.box = header.box;
  snapshot.code = header.code;
  snapshot.springs = header.springs;
  snapshot.discs.resize(header.discs);
  snapshot.contacts.resize(header.contacts);
  snapshot.values.resize(values);
  place = take(place, snapshot.discs.data(), snapshot.discs.size());
  place = take(place, snapshot.contacts.data(), snapshot.contacts.size());
  take(place, snapshot.values.data(), values);
  check(snapshot);
  return snapshot;
}

}  // namespace polargrain::dem
