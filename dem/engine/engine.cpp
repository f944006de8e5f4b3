// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/engine/engine.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

#include "dem/engine/extension.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/engine/quiet_errors.hpp"
#include "grains_io/script.hpp"

namespace polargrain::dem {

void start_engine_process() {
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  int running = 0;
  MPI_Initialized(&running);
  if (!running) {
    MPI_Init(nullptr, nullptr);
    std::atexit([] {
      int finalized = 0;
      MPI_Finalized(&finalized);
      if (!finalized) MPI_Finalize();
    });
  }
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
