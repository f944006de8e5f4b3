// SPDX-License-Identifier: GPL-2.0-or-later
// From an engine that has read a script and a packing to a box of discs.
#include <cmath>
#include <string>

#include "common/error.hpp"
#include "dem/box/engine_grains.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/laws/law_settings.hpp"

namespace polargrain::dem {

namespace {

/// Places of the springs in the engine's history of a contact: three values each, in the order in which the
/// models ask for them (ours ask for the rolling displacement last).
struct HistoryPlaces {
  int tangential = 0;
  int rolling = 3;
  int rolling_force = 3;

  explicit HistoryPlaces(const LawCombination& combination)
      : rolling_force(combination.rolling == RollingLaw::off ? 3 : 6) {}
};

/// Springs of the loop over discs from the engine's history, which holds vectors as the first disc sees them.
void read_springs(const double* history, const LawCombination& combination, const Eigen::Vector2d& normal,
                  double* springs) {
  const HistoryPlaces places(combination);
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const auto component = [&](int place) {
    return history[place] * along.x() + history[place + 1] * along.y();
  };
  if (combination.tangential == TangentialLaw::history) {
    springs[0] = history[places.tangential];
    springs[1] = history[places.tangential + 1];
  } else {
    springs[0] = component(places.tangential);
    springs[1] = combination.settings.rolling_force && !combination.settings.symmetric
                     ? component(places.rolling_force)
                     : 0.0;
  }
  if (combination.rolling != RollingLaw::off) springs[kRollingSpring] = history[places.rolling + 2];
}

/// The opposite of read_springs.
void write_springs(const double* springs, const LawCombination& combination, const Eigen::Vector2d& normal,
                   double* history) {
  const HistoryPlaces places(combination);
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const auto put = [&](int place, const Eigen::Vector2d& vector) {
    history[place] = vector.x();
    history[place + 1] = vector.y();
  };
  if (combination.tangential == TangentialLaw::history) {
    put(places.tangential, {springs[0], springs[1]});
  } else {
    put(places.tangential, springs[0] * along);
    if (combination.settings.rolling_force && !combination.settings.symmetric)
      put(places.rolling_force, springs[1] * along);
  }
  if (combination.rolling != RollingLaw::off) history[places.rolling + 2] = springs[kRollingSpring];
}

/// The image of the second disc that is nearest to the first.
LatticeVector nearest_image(const Eigen::Vector2d& between, const Eigen::Matrix2d& base) {
  const auto q = static_cast<std::int32_t>(std::lround(between.y() / base(1, 1)));
  LatticeVector nearest;
  double least = 1e300;
  for (std::int32_t row = q - 1; row <= q + 1; ++row) {
    const double left = between.x() - base(0, 1) * row;
    const auto p = static_cast<std::int32_t>(std::lround(left / base(0, 0)));
    const double square = std::pow(left - base(0, 0) * p, 2) + std::pow(between.y() - base(1, 1) * row, 2);
    if (!(square < least)) continue;
    least = square;
    nearest = {p, row};
  }
  return nearest;
}

}  // namespace

DiscBox::Definition disc_definition(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination,
                                    double thickness) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  DiscBox::Definition definition;
  definition.combination = combination;
  definition.thickness = thickness;
  definition.time_step = lammps.update->dt;
  for (int k = 0; k < atom.nlocal; ++k) {
    definition.radii.push_back(atom.radius[k]);
    definition.masses.push_back(atom.rmass[k]);
    definition.types.push_back(atom.type[k] - 1);
  }
  return definition;
}

Snapshot<2> disc_snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<2>& box,
                          std::span<const double> rotations) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  Snapshot<2> snapshot;
  snapshot.box = box;
  snapshot.code = combination.code();
  snapshot.springs = spring_count(combination.rolling);
  snapshot.grains = motions_of<2>(atom, rotations);
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (history == nullptr) return snapshot;
  history->pre_exchange();  // from the neighbour list to the grains
  const Eigen::Matrix2d base = box.base;
  std::vector<double> springs(static_cast<std::size_t>(snapshot.springs));
  for (int i = 0; i < atom.nlocal; ++i)
    for (int n = 0; n < history->n_partner(i); ++n) {
      const int j = atom.map(history->partner(i, n));
      if (j <= i || j >= atom.nlocal) continue;  // the other disc tells of it
      const Eigen::Vector2d between(atom.x[i][0] - atom.x[j][0], atom.x[i][1] - atom.x[j][1]);
      const LatticeVector image = nearest_image(between, base);
      const Eigen::Vector2d branch = between - image.p * base.col(0) - image.q * base.col(1);
      read_springs(history->contacthistory(i, n), combination, branch.normalized(), springs.data());
      snapshot.contacts.push_back({i, j, {image.p, image.q}});
      snapshot.values.insert(snapshot.values.end(), springs.begin(), springs.end());
    }
  return snapshot;
}

void put_discs(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Snapshot<2>& snapshot) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (snapshot.grains.size() != static_cast<std::size_t>(atom.nlocal) ||
      snapshot.code != combination.code() || snapshot.springs != spring_count(combination.rolling) ||
      history == nullptr)
    throw RunError("this state belongs to a cell of another packing or another input script");
  history->pre_exchange();
  put_motions(lammps, snapshot);
  const Eigen::Matrix2d base = snapshot.box.base;
  const auto values = static_cast<std::size_t>(history->get_dnum());
  ContactHistories histories(atom, values);
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const Snapshot<2>::Springs& contact = snapshot.contacts[c];
    const Eigen::Vector2d branch(
        atom.x[contact.first][0] - atom.x[contact.second][0] - base(0, 0) * contact.image[0] -
            base(0, 1) * contact.image[1],
        atom.x[contact.first][1] - atom.x[contact.second][1] - base(1, 1) * contact.image[1]);
    std::vector<double> seen(values, 0.0);
    write_springs(&snapshot.values[c * static_cast<std::size_t>(snapshot.springs)], combination,
                  branch.normalized(), seen.data());
    histories.add(contact.first, contact.second, seen);
    for (double& value : seen) value = -value;
    histories.add(contact.second, contact.first, seen);
  }
  histories.put(*history);
  atom.nghost = 0;
}

}  // namespace polargrain::dem
