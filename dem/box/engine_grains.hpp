// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The grains of an engine as numbers of a snapshot, and back.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.hpp"
#include "dem/box/snapshot.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// Of one grain of the engine, in the frame of the box; without its rotation.
template <int dim>
GrainMotion<dim> motion_of(const LAMMPS_NS::Atom& atom, int grain) {
  GrainMotion<dim> motion;
  std::copy_n(atom.x[grain], dim, motion.place.begin());
  std::copy_n(atom.v[grain], dim, motion.velocity.begin());
  std::copy_n(atom.omega[grain] + Cosserat<dim>::axis(0), Cosserat<dim>::rotations, motion.spin.begin());
  return motion;
}

/// Of all grains. @param rotations in the laboratory, rad, or empty
template <int dim>
std::vector<GrainMotion<dim>> motions_of(const LAMMPS_NS::Atom& atom, std::span<const double> rotations) {
  constexpr int turns = Cosserat<dim>::rotations;
  std::vector<GrainMotion<dim>> motions;
  for (int k = 0; k < atom.nlocal; ++k) {
    motions.push_back(motion_of<dim>(atom, k));
    if (!rotations.empty())
      std::copy_n(rotations.begin() + static_cast<std::ptrdiff_t>(turns) * k, turns,
                  motions.back().turned.begin());
  }
  return motions;
}

/// Puts the motions of a snapshot in place of those of the engine.
/// @throws RunError when box or motions are not sound
template <int dim>
void put_motions(LAMMPS_NS::LAMMPS& lammps, const Snapshot<dim>& snapshot) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  const std::vector<double> radii(atom.radius, atom.radius + atom.nlocal);
  if (const std::string fault = snapshot_fault(snapshot, radii, lammps.update->dt); !fault.empty())
    throw RunError(fault);
  for (int k = 0; k < atom.nlocal; ++k) {
    const GrainMotion<dim>& motion = snapshot.grains[static_cast<std::size_t>(k)];
    std::ranges::copy(motion.place, atom.x[k]);
    std::ranges::copy(motion.velocity, atom.v[k]);
    std::ranges::copy(motion.spin, atom.omega[k] + Cosserat<dim>::axis(0));
  }
}

/// The engine's record of the contacts of all grains: for each its partners and, for each of these, the values of its
/// history.
class ContactHistories {
 public:
  /// @param values of a contact
  ContactHistories(const LAMMPS_NS::Atom& atom, std::size_t values)
      : atom_(atom), values_(values), grains_(static_cast<std::size_t>(atom.nlocal)) {}

  /// Appends a contact to those of one of its grains. @param seen its values as that grain has them
  void add(int grain, int partner, const std::vector<double>& seen) {
    Grain& to = grains_[static_cast<std::size_t>(grain)];
    to.partners.push_back(atom_.tag[partner]);
    to.values.insert(to.values.end(), seen.begin(), seen.end());
  }

  /// Puts them in place of those that the engine has.
  void put(LAMMPS_NS::FixContactHistory& history) const {
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      std::vector<double> buffer = packed(grains_[k]);
      history.unpack_exchange(static_cast<int>(k), buffer.data());
    }
  }

 private:
  struct Grain {
    std::vector<int> partners;
    std::vector<double> values;
  };

  /// A whole number as the engine hides it among doubles.
  static double bits_of(std::int64_t number) { return std::bit_cast<double>(number); }

  /// In the form in which the engine passes them from process to process.
  [[nodiscard]] std::vector<double> packed(const Grain& grain) const {
    std::vector<double> buffer{bits_of(static_cast<std::int64_t>(grain.partners.size()))};
    auto from = grain.values.begin();
    for (const int partner : grain.partners) {
      buffer.push_back(bits_of(partner));
      buffer.insert(buffer.end(), from, from + static_cast<std::ptrdiff_t>(values_));
      from += static_cast<std::ptrdiff_t>(values_);
    }
    return buffer;
  }

  const LAMMPS_NS::Atom& atom_;
  std::size_t values_ = 0;
  std::vector<Grain> grains_;
};

}  // namespace polargrain::dem
