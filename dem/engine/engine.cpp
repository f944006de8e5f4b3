// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/engine/engine.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dem/engine/extension.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/engine/quiet_errors.hpp"
#include "grains_io/script.hpp"

namespace polargrain::dem {
namespace {

/// An MPI world of this process alone. Open MPI would start a daemon beside each such world (0.15 s, 20 MB, no start at
/// all where there is no ssh, and an engine that ends in a forked child would wait for ever for the daemon's word); a world
/// that never spawns others needs no daemon. Nor does it need the folder that Open MPI makes below /tmp: such worlds share
/// its name, and one that starts while another removes it fails.
void stay_alone() {
  constexpr int kUsersOwnStays = 0;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", kUsersOwnStays);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", kUsersOwnStays);
  setenv("OMPI_MCA_btl", "self", kUsersOwnStays);  // it speaks to nobody: no sockets, no shared memory
}

/// Makes a process that srun or mpirun has started forget it: every process of ours that runs engines is an MPI world
/// of its own, or its engine would try to share its grains with the others.
void forget_launcher() {
  std::vector<std::string> names;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    for (const char* prefix : {"SLURM_", "PMI_", "PMIX_", "PMI2_", "OMPI_", "ORTE_", "HYDRA_"}) {
      if (text.rfind(prefix, 0) == 0) names.push_back(text.substr(0, text.find('=')));
    }
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

/// Whether mpirun or srun has started this process as one of a world: each numbers its processes by one of these.
bool has_launcher() {
  for (const char* number : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "PMI_FD"}) {
    if (std::getenv(number) != nullptr) return true;
  }
  return false;
}

}  // namespace

void start_engine_process() {
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  int running = 0;
  MPI_Initialized(&running);
  if (!running) {
    forget_launcher();
    stay_alone();
    MPI_Init(nullptr, nullptr);
    std::atexit([] {
      int finalized = 0;
      MPI_Finalized(&finalized);
      if (!finalized) MPI_Finalize();
    });
  }
}

void start_standalone_process(int& argc, char**& argv) {
  if (!has_launcher()) stay_alone();
  MPI_Init(&argc, &argv);
}

/// The engine with what belongs to it.
struct Engine::Instance : LAMMPS_NS::LAMMPS {
  Instance(int argc, char** argv, EngineParts& its_parts)
      : LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD), parts(its_parts) {}
  EngineParts& parts;
};

EngineParts& parts_of(LAMMPS_NS::LAMMPS& lammps) {
  return static_cast<Engine::Instance&>(lammps).parts;
}

namespace {

/// LIGGGHTS 3.8 zeroes the period of the unit box in its constructor, so that triclinic boxes get no ghost
/// grains at all. The members are public.
void repair_triclinic_boxes(LAMMPS_NS::Domain& domain) {
  for (int axis = 0; axis < 3; ++axis) {
    domain.prd_lamda[axis] = 1.0;
    domain.prd_half_lamda[axis] = 0.5;
  }
}

std::vector<std::function<void(LAMMPS_NS::LAMMPS&)>>& extensions() {
  static std::vector<std::function<void(LAMMPS_NS::LAMMPS&)>> all;
  return all;
}

}  // namespace

Extension::Extension(std::function<void(LAMMPS_NS::LAMMPS&)> add) {
  extensions().push_back(std::move(add));
}

Engine::Engine() {
  std::array<std::string, 3> words{"polargrain", "-log", "none"};
  std::array<char*, 3> arguments{};
  for (std::size_t k = 0; k < words.size(); ++k) arguments[k] = words[k].data();
  start(static_cast<int>(arguments.size()), arguments.data());
}

Engine::Engine(int argc, char** argv) {
  start(argc, argv);
}

void Engine::start(int argc, char** argv) {
  {
    const QuietErrors quiet;  // the engine prints every duplicate registration of its own styles
    instance_ = std::make_unique<Instance>(argc, argv, parts_);
  }
  repair_triclinic_boxes(*instance_->domain);
  for (const auto& add : extensions()) add(*instance_);
}

Engine::~Engine() = default;

LAMMPS_NS::LAMMPS& Engine::lammps() {
  return *instance_;
}

void Engine::command(const std::string& line) {
  instance_->input->one(line.c_str());
}

void Engine::script(const std::string& text, const std::string& script_file) {
  for (const ScriptCommand& line : commands_of_script(text, script_file)) {
    std::printf("polargrain: %s:%d: %s\n", line.file.c_str(), line.line, line.text.c_str());
    command(line.text);
  }
  std::printf("polargrain: %s: read to its end\n", script_file.c_str());
}

}  // namespace polargrain::dem
