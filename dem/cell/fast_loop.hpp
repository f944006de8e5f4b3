// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <string_view>

#include "dem/cell/driver.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

/// The loop of its own that steps the grains of a dimension where it knows the scene: its box, and how an engine that has
/// read script and packing comes to it.
template <int dim>
struct FastLoop;

template <>
struct FastLoop<2> {
  using Grains = DiscBox;
  static constexpr const char* name = "the loop over discs";
  static std::string_view instructions() { return name_of(best_instruction_set()); }
  static LawSelection selection(LAMMPS_NS::LAMMPS& lammps) { return disc_combination(lammps); }
  static std::unique_ptr<DiscBox> make(Driver<2>& driver, const LawCombination& combination, bool plain) {
    DiscBox::Definition discs = disc_definition(driver.lammps(), combination, driver.depth());
    discs.plain = plain;
    return std::make_unique<DiscBox>(std::move(discs));
  }
  static Snapshot<2> snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<2>& box,
                              std::span<const double> rotations) {
    return disc_snapshot(lammps, combination, box, rotations);
  }
};

template <>
struct FastLoop<3> {
  using Grains = SphereBox;
  static constexpr const char* name = "the loop over spheres";
  static std::string_view instructions() { return name_of(best_instruction_set()); }
  static LawSelection selection(LAMMPS_NS::LAMMPS& lammps) { return sphere_combination(lammps); }
  static std::unique_ptr<SphereBox> make(Driver<3>& driver, const LawCombination& combination, bool plain) {
    return std::make_unique<SphereBox>(spheres_of(driver.lammps(), combination),
                                       sphere_kernels(best_instruction_set(), plain));
  }
  static Snapshot<3> snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<3>& box,
                              std::span<const double> rotations) {
    return sphere_snapshot(lammps, combination, box, rotations);
  }
};

}  // namespace polargrain::dem
