// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/engine/engine.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "common/script.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/contact/contact_library.hpp"
#include "dem/contact/registration.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/engine/private_access.hpp"
#include "dem/specimen/registration.hpp"

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

namespace {

LAMMPS_NS::LAMMPS* create(int argc, char** argv) {
  // The engine prints every duplicate registration of its own styles on the error stream.
  std::streambuf* const errors = std::cerr.rdbuf(nullptr);
  auto* lammps = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  std::cerr.rdbuf(errors);
  std::cerr.clear();
  return lammps;
}

LAMMPS_NS::LAMMPS* create() {
  std::array<std::string, 3> words{"polargrain", "-log", "none"};
  std::array<char*, 3> arguments{};
  for (std::size_t k = 0; k < words.size(); ++k) arguments[k] = words[k].data();
  return create(static_cast<int>(arguments.size()), arguments.data());
}

/// LIGGGHTS 3.8 zeroes the period of the unit box in its constructor, so that triclinic boxes get no ghost
/// grains at all. The members are public.
void repair_triclinic_boxes(LAMMPS_NS::Domain& domain) {
  for (int axis = 0; axis < 3; ++axis) {
    domain.prd_lamda[axis] = 1.0;
    domain.prd_half_lamda[axis] = 0.5;
  }
}

void equip(LAMMPS_NS::LAMMPS& lammps, bool record_all) {
  repair_triclinic_boxes(*lammps.domain);
  register_contact_models(record_all);
  register_cell_fixes(*lammps.modify);
  register_specimen_fixes(*lammps.modify);
}

}  // namespace

Engine::Engine(bool record_all, const ContactLibraryFile& contact_library) : lammps_(create()) {
  equip(*lammps_, record_all);
  if (!contact_library.path.empty()) add_contact_library(contact_library);
}

Engine::Engine(bool record_all, int argc, char** argv) : lammps_(create(argc, argv)) {
  equip(*lammps_, record_all);
}

Engine::~Engine() = default;

void Engine::command(const std::string& line) {
  lammps_->input->one(line.c_str());
}

void Engine::script(const std::string& text, const std::string& script_file) {
  for (const ScriptCommand& line : commands_of_script(text, script_file)) {
    std::printf("polargrain: %s:%d: %s\n", line.file.c_str(), line.line, line.text.c_str());
    command(line.text);
  }
  std::printf("polargrain: %s: read to its end\n", script_file.c_str());
}

}  // namespace polargrain::dem
