// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/error.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of a state; grains, contacts and values of their springs follow.
template <int dim>
struct Header {
  std::uint64_t magic = 0;
  std::uint32_t grains = 0;
  std::uint32_t contacts = 0;
  std::int32_t code = 0;
  std::int32_t springs = 0;
  typename Box<dim>::Numbers box{};
};
template <int dim>
constexpr std::uint64_t kMagic = dim == 2 ? 0x3130637369646770ULL   // "pgdisc01" as bytes
                                          : 0x3130656870736770ULL;  // "pgsphe01"
constexpr std::int32_t kMostSprings = 16;
constexpr std::int32_t kMostImages = 1000;

static_assert(std::is_trivially_copyable_v<Header<2>> && std::is_trivially_copyable_v<Header<3>>);
static_assert(std::is_trivially_copyable_v<Snapshot<2>::Springs> && sizeof(Snapshot<2>::Springs) == 16);
static_assert(std::is_trivially_copyable_v<Snapshot<3>::Springs> && sizeof(Snapshot<3>::Springs) == 24);

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

template <class Values>
bool is_finite(const Values& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

template <int dim>
void check(const Snapshot<dim>& snapshot) {
  bool sound = is_finite(snapshot.box.numbers()) && snapshot.box.base.diagonal().minCoeff() > 0.0 &&
               is_finite(snapshot.values);
  for (const GrainMotion<dim>& grain : snapshot.grains)
    sound = sound && is_finite(grain.place) && is_finite(grain.velocity) && is_finite(grain.spin) &&
            is_finite(grain.turned);
  const auto grains = static_cast<std::int32_t>(snapshot.grains.size());
  std::int32_t last = 0;
  for (const typename Snapshot<dim>::Springs& contact : snapshot.contacts) {
    sound = sound && contact.first >= last && contact.first < grains && contact.second >= contact.first &&
            contact.second < grains;
    for (int axis = 0; axis < dim; ++axis)
      sound = sound && contact.image[axis] > -kMostImages && contact.image[axis] < kMostImages;
    last = contact.first;
  }
  if (!sound) throw RunError("this state of a cell is damaged");
}

}  // namespace

template <int dim>
bool is_snapshot(const State& state) {
  std::uint64_t magic = 0;
  if (state.bytes().size() < sizeof(Header<dim>)) return false;
  std::memcpy(&magic, state.bytes().data(), sizeof magic);
  return magic == kMagic<dim>;
}

template <int dim>
StatePointer encode(const Snapshot<dim>& snapshot) {
  const Header<dim> header{kMagic<dim>,
                           static_cast<std::uint32_t>(snapshot.grains.size()),
                           static_cast<std::uint32_t>(snapshot.contacts.size()),
                           snapshot.code,
                           snapshot.springs,
                           snapshot.box.numbers()};
  std::vector<std::byte> bytes(sizeof header + snapshot.grains.size() * sizeof(GrainMotion<dim>) +
                               snapshot.contacts.size() * sizeof(typename Snapshot<dim>::Springs) +
                               snapshot.values.size() * sizeof(double));
  std::byte* place = put(bytes.data(), &header, 1);
  place = put(place, snapshot.grains.data(), snapshot.grains.size());
  place = put(place, snapshot.contacts.data(), snapshot.contacts.size());
  put(place, snapshot.values.data(), snapshot.values.size());
  return std::make_shared<const State>(std::move(bytes));
}

template <int dim>
Snapshot<dim> decode_snapshot(const State& state) {
  if (!is_snapshot<dim>(state))
    throw RunError(dim == 2 ? "this is not the state of a cell of discs"
                            : "this is not the state of a cell of spheres of the loop over spheres");
  Header<dim> header;
  const std::byte* place = take(state.bytes().data(), &header, 1);
  if (header.springs < 0 || header.springs > kMostSprings) throw RunError("this state of a cell is damaged");
  if (header.contacts > most_state_contacts(header.grains))
    throw RunError("this state of a cell is damaged: it has more contacts than its grains can have");
  const std::size_t values = std::size_t{header.contacts} * static_cast<std::size_t>(header.springs);
  if (state.bytes().size() != sizeof header + std::size_t{header.grains} * sizeof(GrainMotion<dim>) +
                                  std::size_t{header.contacts} * sizeof(typename Snapshot<dim>::Springs) +
                                  values * sizeof(double))
    throw RunError("this state of a cell was cut short, or is damaged");
  Snapshot<dim> snapshot;
  snapshot.box = Box<dim>::from_numbers(header.box);
  snapshot.code = header.code;
  snapshot.springs = header.springs;
  snapshot.grains.resize(header.grains);
  snapshot.contacts.resize(header.contacts);
  snapshot.values.resize(values);
  place = take(place, snapshot.grains.data(), snapshot.grains.size());
  place = take(place, snapshot.contacts.data(), snapshot.contacts.size());
  take(place, snapshot.values.data(), values);
  check(snapshot);
  return snapshot;
}

template <int dim>
std::string snapshot_fault(const Snapshot<dim>& snapshot, const std::vector<double>& radii,
                           double time_step) {
  double sizes = 0.0;
  for (const double radius : radii) sizes += grain_size<dim>(radius);
  if (std::string fault = box_fault(snapshot.box, sizes); !fault.empty()) return fault;
  for (std::size_t k = 0; k < snapshot.grains.size(); ++k)
    if (std::string fault = motion_fault(snapshot.box, k, snapshot.grains[k], radii[k], time_step);
        !fault.empty())
      return fault;
  return {};
}

template bool is_snapshot<2>(const State&);
template bool is_snapshot<3>(const State&);
template StatePointer encode(const Snapshot<2>&);
template StatePointer encode(const Snapshot<3>&);
template Snapshot<2> decode_snapshot(const State&);
template Snapshot<3> decode_snapshot(const State&);
template std::string snapshot_fault(const Snapshot<2>&, const std::vector<double>&, double);
template std::string snapshot_fault(const Snapshot<3>&, const std::vector<double>&, double);

}  // namespace polargrain::dem
