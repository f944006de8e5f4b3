// SPDX-License-Identifier: GPL-2.0-or-later
// From an engine that has read a script and a packing to a box of spheres, and back.
#include <bit>
#include <cmath>
#include <string>
#include <tuple>

#include "common/error.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {

/// Which of the engine's values of a contact a spring of the loop is, in the order in which the models ask for them:
/// sliding, rolling, then a rolling displacement, then a torsion. -1: the engine has none.
std::array<int, kSphereSprings> history_places(const DiscCombination& laws) {
  std::array<int, kSphereSprings> places{};
  places.fill(-1);
  int next = 0;
  const auto put = [&places, &next](int spring, int count) {
    for (int k = 0; k < count; ++k) places[spring + k] = next++;
  };
  put(kSliding, 3);
  if (laws.rolling != RollingLaw::off) put(kBending, 3);
  if (laws.settings.rolling_force && !laws.settings.symmetric) put(kRollingDisplacement, 3);
  if (laws.rolling == RollingLaw::li_chu && laws.settings.torsion) put(kTorsion, 1);
  return places;
}

int history_values(const DiscCombination& laws) {
  int values = 0;
  for (const int place : history_places(laws)) values = std::max(values, place + 1);
  return values;
}

/// The engine's record of one grain's contacts: partners and, for each, the values of its history.
struct GrainHistories {
  std::vector<int> partners;
  std::vector<double> values;
};

/// A whole number as the engine hides it among doubles.
double bits_of(std::int64_t number) {
  return std::bit_cast<double>(number);
}

/// In the form in which the engine passes them from process to process.
std::vector<double> packed(const GrainHistories& grain, std::size_t values) {
  std::vector<double> buffer{bits_of(static_cast<std::int64_t>(grain.partners.size()))};
  for (std::size_t n = 0; n < grain.partners.size(); ++n) {
    buffer.push_back(bits_of(grain.partners[n]));
    buffer.insert(buffer.end(), grain.values.begin() + static_cast<std::ptrdiff_t>(n * values),
                  grain.values.begin() + static_cast<std::ptrdiff_t>((n + 1) * values));
  }
  return buffer;
}

/// The image of the second sphere that is nearest to the first. @param base upper triangular
SpaceLattice nearest_image(const Eigen::Vector3d& between, const Eigen::Matrix3d& base) {
  SpaceLattice nearest;
  double least = 1e300;
  const auto r = static_cast<std::int32_t>(std::lround(between.z() / base(2, 2)));
  for (std::int32_t layer = r - 1; layer <= r + 1; ++layer) {
    const Eigen::Vector3d in_layer = between - layer * base.col(2);
    const auto q = static_cast<std::int32_t>(std::lround(in_layer.y() / base(1, 1)));
    for (std::int32_t row = q - 1; row <= q + 1; ++row) {
      const Eigen::Vector3d in_row = in_layer - row * base.col(1);
      const auto p = static_cast<std::int32_t>(std::lround(in_row.x() / base(0, 0)));
      const double square = (in_row - p * base.col(0)).squaredNorm();
      if (!(square < least)) continue;
      least = square;
      nearest = {p, row, layer};
    }
  }
  return nearest;
}

LAMMPS_NS::FixContactHistory* history_of(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& laws) {
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (history == nullptr || history->get_dnum() != history_values(laws))
    throw RunError("the contact models keep other values than the loop over spheres knows");
  return history;
}

Eigen::Vector3d place_of(const LAMMPS_NS::Atom& atom, int k) {
  return Eigen::Map<const Eigen::Vector3d>(atom.x[k]);
}

}  // namespace

Spheres spheres_of(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  Spheres spheres;
  spheres.combination = combination;
  for (int k = 0; k < atom.nlocal; ++k) {
    spheres.radii.push_back(atom.radius[k]);
    spheres.masses.push_back(atom.rmass[k]);
    spheres.types.push_back(atom.type[k] - 1);
  }
  return spheres;
}

SphereSnapshot sphere_snapshot(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination,
                               const SpaceBox& box, std::span<const double> rotations) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  SphereSnapshot snapshot;
  snapshot.box = box;
  snapshot.code = combination.code();
  snapshot.springs = sphere_spring_count(combination);
  for (int k = 0; k < atom.nlocal; ++k) {
    SphereSnapshot::Motion& sphere = snapshot.spheres.emplace_back();
    std::copy_n(atom.x[k], 3, sphere.place.data());
    std::copy_n(atom.v[k], 3, sphere.velocity.data());
    std::copy_n(atom.omega[k], 3, sphere.spin.data());
    if (!rotations.empty()) std::copy_n(&rotations[3 * static_cast<std::size_t>(k)], 3, sphere.turned.data());
  }
  LAMMPS_NS::FixContactHistory* const history = history_of(lammps, combination);
  history->pre_exchange();  // from the neighbour list to the grains
  const std::array<int, kSphereSprings> places = history_places(combination);
  for (int i = 0; i < atom.nlocal; ++i)
    for (int n = 0; n < history->n_partner(i); ++n) {
      const int j = atom.map(history->partner(i, n));
      if (j <= i || j >= atom.nlocal) continue;  // the other sphere tells of it
      const SpaceLattice image = nearest_image(place_of(atom, i) - place_of(atom, j), box.base);
      snapshot.contacts.push_back({i, j, {image.p, image.q, image.r}, 0});
      const double* const values = history->contacthistory(i, n);
      for (int k = 0; k < snapshot.springs; ++k)
        snapshot.values.push_back(places[k] < 0 ? 0.0 : values[places[k]]);
    }
  return snapshot;
}

void put_spheres(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination,
                 const SphereSnapshot& snapshot) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  if (snapshot.spheres.size() != static_cast<std::size_t>(atom.nlocal) ||
      snapshot.code != combination.code() || snapshot.springs != sphere_spring_count(combination))
    throw RunError("this state belongs to a cell of another packing or another input script");
  LAMMPS_NS::FixContactHistory* const history = history_of(lammps, combination);
  const std::vector<double> radii(atom.radius, atom.radius + atom.nlocal);
  if (const std::string fault = snapshot_fault(snapshot, radii, lammps.update->dt); !fault.empty())
    throw RunError(fault);
  history->pre_exchange();
  for (int k = 0; k < atom.nlocal; ++k) {
    const SphereSnapshot::Motion& sphere = snapshot.spheres[static_cast<std::size_t>(k)];
    std::copy_n(sphere.place.data(), 3, atom.x[k]);
    std::copy_n(sphere.velocity.data(), 3, atom.v[k]);
    std::copy_n(sphere.spin.data(), 3, atom.omega[k]);
  }
  const std::array<int, kSphereSprings> places = history_places(combination);
  const auto values = static_cast<std::size_t>(history->get_dnum());
  std::vector<GrainHistories> grains(snapshot.spheres.size());
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const SphereSnapshot::Springs& contact = snapshot.contacts[c];
    for (const auto& [me, other, sign] :
         {std::tuple(contact.first, contact.second, 1.0), std::tuple(contact.second, contact.first, -1.0)}) {
      std::vector<double> seen(values, 0.0);
      for (int k = 0; k < snapshot.springs; ++k)
        if (places[k] >= 0)  // a torsion looks alike from either side
          seen[static_cast<std::size_t>(places[k])] =
              (k == kTorsion ? 1.0 : sign) *
              snapshot.values[c * static_cast<std::size_t>(snapshot.springs) + k];
      GrainHistories& grain = grains[static_cast<std::size_t>(me)];
      grain.partners.push_back(atom.tag[other]);
      grain.values.insert(grain.values.end(), seen.begin(), seen.end());
    }
  }
  for (int k = 0; k < atom.nlocal; ++k) {
    std::vector<double> buffer = packed(grains[static_cast<std::size_t>(k)], values);
    history->unpack_exchange(k, buffer.data());
  }
  atom.nghost = 0;
}

}  // namespace polargrain::dem
