// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <string>

#include "common/contact_library_file.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Prepares this process for engines: MPI for one process, and standard output unbuffered, because an engine
/// error ends the process at once and its words would be lost in the buffer. Call once, first.
void start_engine_process();

/// One LIGGGHTS instance with this project's contact models, and with its triclinic boxes repaired.
/// Everything it prints goes to standard output. An engine error ends the PROCESS (MPI_Abort): that is
/// LIGGGHTS's way, and the reason why workers are processes.
class Engine {
 public:
  /// @param record_all see register_contact_models
  /// @param contact_library of contact laws of the user's own, or none @throws RunError as add_contact_library
  explicit Engine(bool record_all, const ContactLibraryFile& contact_library = {});
  /// The same with LIGGGHTS's own command line.
  Engine(bool record_all, int argc, char** argv);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  /// Runs one line of an input script.
  void command(const std::string& line);
  /// Runs a script, line by line, continuation lines (&) joined. An error is preceded on standard output by
  /// "polargrain: in SCRIPT_FILE:LINE: the command".
  /// @param script_file the user's name of it, for messages.
  void script(const std::string& text, const std::string& script_file);

  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }

 private:
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

}  // namespace polargrain::dem
