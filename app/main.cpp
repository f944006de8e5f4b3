// SPDX-License-Identifier: GPL-2.0-or-later
// The program `polargrain`: the coupler's commands, with LIGGGHTS as the engine of its workers.
#include "app/commands/command_line.hpp"
#include "common/standard_streams.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/state_fault.hpp"
#include "dem/pack/prepare.hpp"

int main(int count, char** arguments) {
  using namespace polargrain;
  open_standard_streams();
  return app::command_line(count, arguments,
                           {dem::start_engine_process, dem::make_cell_service, {}, dem::state_fault},
                           {dem::start_engine_process, dem::prepare_packing, dem::settle_packing});
}
