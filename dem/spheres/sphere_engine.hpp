// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "common/cell.hpp"
#include "dem/cell/grain_engine.hpp"
#include "dem/cell/state_bounds.hpp"
#include "dem/spheres/fix_space_strain.hpp"

namespace polargrain::dem {

/// One engine with a packing of spheres in a box that is periodic in space.
class SphereEngine : public GrainEngine {
 public:
  /// With the contacts of the packing, where it has any. @throws RunError when its state does not belong to it
  explicit SphereEngine(const CellDefinition& definition);
  /// Without them. @param after_script see GrainEngine
  SphereEngine(const Packing& packing, const std::string& script, const std::string& script_file,
               const ContactLibraryFile& contact_library,
               const std::function<void(Engine&)>& after_script = {});
  FixSpaceStrain& strain() { return *strain_; }
  [[nodiscard]] const FixSpaceStrain& strain() const { return *strain_; }

  /// @throws RunError when the state is not one of these grains and models
  void restore(const State& state);
  /// The grains folded back into their box, which is reduced.
  StatePointer save();

  /// In the frame of the box, three a grain, m.
  [[nodiscard]] std::span<const double> places();
  /// Of one grain, in the frame of the box; without its rotation.
  [[nodiscard]] SpaceMotionOfGrain motion(int grain);

 private:
  FixSpaceStrain* strain_;
};

}  // namespace polargrain::dem
