// SPDX-License-Identifier: GPL-2.0-or-later
// The program `polargrain`: the coupler's commands, with LIGGGHTS as the engine of its workers.
#include <string>
#include <vector>

#include "app/commands/command_line.hpp"
#include "common/standard_streams.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/state_fault.hpp"
#include "dem/pack/prepare.hpp"
#include "dem/standalone/standalone.hpp"

namespace {

int run_script(const std::vector<std::string>& words) {
  std::vector<std::string> kept = words;
  std::vector<char*> arguments;
  for (std::string& word : kept) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return polargrain::dem::run_liggghts(static_cast<int>(kept.size()), arguments.data());
}

}  // namespace

int main(int count, char** arguments) {
  using namespace polargrain;
  open_standard_streams();
  return app::command_line(
      count, arguments, {dem::start_engine_process, dem::make_cell_service, {}, dem::state_fault},
      {dem::start_engine_process, dem::prepare_packing, dem::settle_packing, run_script});
}
