// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "dem/cell/script_time_step.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all time_step/contacts [every N]
///
/// The time step from the contacts, in place of a line `timestep`: kStepShare of the largest stable one
/// (time_step.hpp), taken when the first run starts, with platens and membranes of fix biaxial, which must
/// stand before it. Looked at again when a run starts and every N steps (2000): once it is more than 0.95 of
/// the stable one, because contacts became stiffer or more, a smaller one is taken and said. It never grows.
///
/// A line `timestep` of the script is honoured instead: refused, at the start or later, when it is unstable,
/// with a remark when it wastes more than a factor of three.
///
/// Refused: grains without any contact at the start (contacts set the step) unless the
/// script has a `timestep`, walls of the engine's own (their stiffness is not known here), more than one
/// process. Drags such as fix viscous are not counted: they shorten the stable step by the share of their
/// rate in the frequency, usually 1e-3.
///
/// In restart files: the step in use. `dt` in the script after the first run has started, or after
/// the fix was made from a restart file, is that step.
class FixTimeStep : public LAMMPS_NS::Fix {
 public:
  FixTimeStep(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void pre_force(int vflag) override;
  void post_force(int vflag) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  void start_recording();
  /// The recorded contacts against the step.
  void look();
  void say(const std::string& words) const;

  ContactRecorder& recorder_;
  int every_ = 2000;
  std::optional<ScriptTimeStep> step_;
  double own_ = 0.0;      ///< s, in use while the script gives no time step
  bool settled_ = false;  ///< whether contacts have been looked at
};

}  // namespace polargrain::dem
