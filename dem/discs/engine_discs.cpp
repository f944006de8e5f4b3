// SPDX-License-Identifier: GPL-2.0-or-later
// From an engine that has read a script and a packing to a box of discs.
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "common/error.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/discs/laws.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// Places of the springs in the engine's history of a contact: three values each, in the order in which the
/// models ask for them (ours ask for the rolling displacement last).
struct HistoryPlaces {
  int tangential = 0;
  int rolling = 3;
  int rolling_force = 3;

  explicit HistoryPlaces(const DiscCombination& combination)
      : rolling_force(combination.rolling == RollingLaw::off ? 3 : 6) {}
};

/// Springs of the loop over discs from the engine's history, which holds vectors as the first disc sees them.
void read_springs(const double* history, const DiscCombination& combination, const Eigen::Vector2d& normal,
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
void write_springs(const double* springs, const DiscCombination& combination, const Eigen::Vector2d& normal,
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

DiscBox::Definition disc_definition(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination,
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

DiscSnapshot disc_snapshot(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination, const Box& box,
                           std::span<const double> rotations) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  DiscSnapshot snapshot;
  snapshot.box = box;
  snapshot.code = combination.code();
  snapshot.springs = spring_count(combination.rolling);
  for (int k = 0; k < atom.nlocal; ++k)
    snapshot.discs.push_back({atom.x[k][0], atom.x[k][1], atom.v[k][0], atom.v[k][1], atom.omega[k][2],
                              rotations.empty() ? 0.0 : rotations[static_cast<std::size_t>(k)]});
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (history == nullptr) return snapshot;
  history->pre_exchange();  // from the neighbour list to the grains
  const Eigen::Matrix2d base = box.base_vectors();
  std::vector<double> springs(static_cast<std::size_t>(snapshot.springs));
  for (int i = 0; i < atom.nlocal; ++i)
    for (int n = 0; n < history->n_partner(i); ++n) {
      const int j = atom.map(history->partner(i, n));
      if (j <= i || j >= atom.nlocal) continue;  // the other disc tells of it
      const Eigen::Vector2d between(atom.x[i][0] - atom.x[j][0], atom.x[i][1] - atom.x[j][1]);
      const LatticeVector image = nearest_image(between, base);
      const Eigen::Vector2d branch = between - image.p * base.col(0) - image.q * base.col(1);
      read_springs(history->contacthistory(i, n), combination, branch.normalized(), springs.data());
      snapshot.contacts.push_back({i, j, image});
      snapshot.values.insert(snapshot.values.end(), springs.begin(), springs.end());
    }
  return snapshot;
}

void put_discs(LAMMPS_NS::LAMMPS& lammps, const DiscCombination& combination, const DiscSnapshot& snapshot) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  auto* const history = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->get_fix_history();
  if (snapshot.discs.size() != static_cast<std::size_t>(atom.nlocal) || snapshot.code != combination.code() ||
      snapshot.springs != spring_count(combination.rolling) || history == nullptr)
    throw RunError("this state belongs to a cell of another packing or another input script");
  double area = 0.0;
  for (int k = 0; k < atom.nlocal; ++k) area += std::numbers::pi * atom.radius[k] * atom.radius[k];
  if (const std::string fault = box_fault(snapshot.box, area); !fault.empty()) throw RunError(fault);
  history->pre_exchange();
  for (int k = 0; k < atom.nlocal; ++k) {
    const std::string fault =
        motion_fault(snapshot.box, static_cast<std::size_t>(k), snapshot.discs[static_cast<std::size_t>(k)],
                     atom.radius[k], lammps.update->dt);
    if (!fault.empty()) throw RunError(fault);
  }
  for (int k = 0; k < atom.nlocal; ++k) {
    const DiscSnapshot::Motion& disc = snapshot.discs[static_cast<std::size_t>(k)];
    atom.x[k][0] = disc.x;
    atom.x[k][1] = disc.y;
    atom.v[k][0] = disc.vx;
    atom.v[k][1] = disc.vy;
    atom.omega[k][2] = disc.spin;
  }
  const Eigen::Matrix2d base = snapshot.box.base_vectors();
  const auto values = static_cast<std::size_t>(history->get_dnum());
  std::vector<GrainHistories> grains(snapshot.discs.size());
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const DiscSnapshot::Springs& contact = snapshot.contacts[c];
    const Eigen::Vector2d branch(
        atom.x[contact.first][0] - atom.x[contact.second][0] - base(0, 0) * contact.image.p -
            base(0, 1) * contact.image.q,
        atom.x[contact.first][1] - atom.x[contact.second][1] - base(1, 1) * contact.image.q);
    std::vector<double> seen(values, 0.0);
    write_springs(&snapshot.values[c * static_cast<std::size_t>(snapshot.springs)], combination,
                  branch.normalized(), seen.data());
    for (const auto& [me, other, sign] :
         {std::tuple(contact.first, contact.second, 1.0), std::tuple(contact.second, contact.first, -1.0)}) {
      GrainHistories& grain = grains[static_cast<std::size_t>(me)];
      grain.partners.push_back(atom.tag[other]);
      for (const double value : seen) grain.values.push_back(sign * value);
    }
  }
  for (int k = 0; k < atom.nlocal; ++k) {
    std::vector<double> buffer = packed(grains[static_cast<std::size_t>(k)], values);
    history->unpack_exchange(k, buffer.data());
  }
  atom.nghost = 0;
}

}  // namespace polargrain::dem
