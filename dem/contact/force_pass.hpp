// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
class PairGran;
}  // namespace LAMMPS_NS

namespace polargrain::dem {

/// A quicker way through all contacts of an engine than its loops over pairs. It may keep the springs of contacts from
/// one pass to the next.
class ForcePass {
 public:
  virtual ~ForcePass() = default;
  /// Adds the forces and torques of all contacts to those of the grains; springs go on by a step outside of set-ups.
  virtual void add_forces() = 0;
  /// Writes the springs where the engine keeps them: for all who read, move or change its contact histories.
  virtual void hand_back() = 0;
};

/// The part of an engine that knows how to make such a pass, and the pass in use.
struct ForcePasses {
  /// Makes one for the contacts of an engine that is being initialised, and tells the user. @returns null where the contacts
  /// are of other kinds
  std::function<std::unique_ptr<ForcePass>(LAMMPS_NS::LAMMPS&, LAMMPS_NS::PairGran&)> make;
  ForcePass* in_use = nullptr;
  std::string told;  ///< to the user last
};

}  // namespace polargrain::dem
