// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <string>

#include "dem/engine/engine_part.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Prepares this process for engines: MPI for this process alone, whoever started it (srun, mpirun), and standard output unbuffered, because an engine
/// error ends the process at once and its words would be lost in the buffer. Call once, first.
void start_engine_process();

/// Starts MPI for LIGGGHTS's own command line: in the world of a launcher (mpirun, srun) where one has started this
/// process, else for this process alone. The caller ends it by MPI_Finalize.
void start_standalone_process(int& argc, char**& argv);

/// One LIGGGHTS instance with this project's contact models and fixes (extension.hpp), and with its triclinic boxes
/// repaired.
/// Everything it prints goes to standard output. An engine error ends the PROCESS (MPI_Abort): that is
/// LIGGGHTS's way, and the reason why workers are processes.
class Engine {
 public:
  Engine();
  /// The same with LIGGGHTS's own command line.
  Engine(int argc, char** argv);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  /// Runs one line of an input script.
  void command(const std::string& line);
  /// Runs a script, line by line, continuation lines (&) joined. An error is preceded on standard output by
  /// "polargrain: in SCRIPT_FILE:LINE: the command".
  /// @param script_file the user's name of it, for messages.
  void script(const std::string& text, const std::string& script_file);

  LAMMPS_NS::LAMMPS& lammps();

 private:
  struct Instance;
  friend EngineParts& parts_of(LAMMPS_NS::LAMMPS& lammps);
  void start(int argc, char** argv);

  EngineParts parts_;  ///< outlive the models and fixes that use them
  std::unique_ptr<Instance> instance_;
};

}  // namespace polargrain::dem
