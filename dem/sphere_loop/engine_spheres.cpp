// SPDX-License-Identifier: GPL-2.0-or-later
// From an engine that has read a script and a packing to a box of spheres, and back.
#include <cmath>
#include <string>
#include <tuple>

#include "common/error.hpp"
#include "dem/box/engine_grains.hpp"
#include "dem/sphere_loop/engine_histories.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {

using PlaceInEngine = Eigen::Map<const Eigen::Vector3d>;

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

LAMMPS_NS::FixContactHistory* history_of(LAMMPS_NS::LAMMPS& lammps, const LawCombination& laws) {
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (history == nullptr || history->get_dnum() != history_values(laws))
    throw RunError("the contact models keep other values than the loop over spheres knows");
  return history;
}

}  // namespace

Spheres spheres_of(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  Spheres spheres;
  spheres.combination = combination;
  for (int k = 0; k < atom.nlocal; ++k) {
    spheres.radii.push_back(atom.radius[k]);
    spheres.masses.push_back(atom.rmass[k]);
    spheres.inertias.push_back(sphere_inertia(atom.rmass[k], atom.radius[k]));
    spheres.types.push_back(atom.type[k] - 1);
  }
  return spheres;
}

Snapshot<3> sphere_snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<3>& box,
                            std::span<const double> rotations) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  Snapshot<3> snapshot;
  snapshot.box = box;
  snapshot.code = combination.code();
  snapshot.springs = sphere_spring_count(combination);
  snapshot.grains = motions_of<3>(atom, rotations);
  LAMMPS_NS::FixContactHistory* const history = history_of(lammps, combination);
  history->pre_exchange();  // from the neighbour list to the grains
  const std::array<int, kSphereSprings> places = history_places(combination);
  for (int i = 0; i < atom.nlocal; ++i)
    for (int n = 0; n < history->n_partner(i); ++n) {
      const int j = atom.map(history->partner(i, n));
      if (j <= i || j >= atom.nlocal) continue;  // the other sphere tells of it
      const SpaceLattice image = nearest_image(PlaceInEngine(atom.x[i]) - PlaceInEngine(atom.x[j]), box.base);
      snapshot.contacts.push_back({i, j, {image.p, image.q, image.r}});
      const double* const values = history->contacthistory(i, n);
      for (int k = 0; k < snapshot.springs; ++k)
        snapshot.values.push_back(places[k] < 0 ? 0.0 : values[places[k]]);
    }
  return snapshot;
}

void put_spheres(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Snapshot<3>& snapshot) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  if (snapshot.grains.size() != static_cast<std::size_t>(atom.nlocal) ||
      snapshot.code != combination.code() || snapshot.springs != sphere_spring_count(combination))
    throw RunError("this state belongs to a cell of another packing or another input script");
  LAMMPS_NS::FixContactHistory* const history = history_of(lammps, combination);
  history->pre_exchange();
  put_motions(lammps, snapshot);
  const std::array<int, kSphereSprings> places = history_places(combination);
  const auto values = static_cast<std::size_t>(history->get_dnum());
  ContactHistories histories(atom, values);
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const Snapshot<3>::Springs& contact = snapshot.contacts[c];
    for (const auto& [me, other, sign] :
         {std::tuple(contact.first, contact.second, 1.0), std::tuple(contact.second, contact.first, -1.0)}) {
      std::vector<double> seen(values, 0.0);
      for (int k = 0; k < snapshot.springs; ++k)
        if (places[k] >= 0)  // a torsion looks alike from either side
          seen[static_cast<std::size_t>(places[k])] =
              (k == kTorsion ? 1.0 : sign) *
              snapshot.values[c * static_cast<std::size_t>(snapshot.springs) + k];
      histories.add(me, other, seen);
    }
  }
  histories.put(*history);
  atom.nghost = 0;
}

}  // namespace polargrain::dem
