// SPDX-License-Identifier: GPL-2.0-or-later
// The program with the fake engine in the place of LIGGGHTS.
#include "app/commands/command_line.hpp"
#include "common/standard_streams.hpp"
#include "tests/integration/fake_engine.hpp"

int main(int count, char** arguments) {
  polargrain::open_standard_streams();
  return polargrain::app::command_line(
      count, arguments,
      {[] {}, polargrain::testing::make_fake_engine, polargrain::testing::fake_commands(),
       polargrain::testing::fake_state_fault},
      {[] {},
       [](const auto& specification, const auto&) {
         return polargrain::testing::make_fake_packing(specification);
       },
       [](const auto& specification, const auto& packing, const auto&) {
         return polargrain::testing::settle_fake_packing(specification, packing);
       }});
}
