// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/commands/command.hpp"

namespace polargrain::app {

/// Adds a command to the program. One function a command, in the file of the command.
using AddCommand = Command (*)(CLI::App& program, const Grains& grains);

Command add_run(CLI::App& program, const Grains& grains);
Command add_check(CLI::App& program, const Grains& grains);
Command add_new(CLI::App& program, const Grains& grains);
Command add_examples(CLI::App& program, const Grains& grains);
Command add_point(CLI::App& program, const Grains& grains);
Command add_safety(CLI::App& program, const Grains& grains);
Command add_element(CLI::App& program, const Grains& grains);
Command add_calibrate(CLI::App& program, const Grains& grains);
Command add_pack(CLI::App& program, const Grains& grains);
Command add_layer(CLI::App& program, const Grains& grains);
Command add_interface(CLI::App& program, const Grains& grains);
Command add_band(CLI::App& program, const Grains& grains);
Command add_bench(CLI::App& program, const Grains& grains);
Command add_worker(CLI::App& program, const Grains& grains);
Command add_keys(CLI::App& program, const Grains& grains);
Command add_verify(CLI::App& program, const Grains& grains);
Command add_report(CLI::App& program, const Grains& grains);
Command add_grains(CLI::App& program, const Grains& grains);

/// In the order of --help.
inline constexpr AddCommand kCommands[] = {
    add_run,     add_check,     add_safety, add_new,    add_examples,  add_point,
    add_element, add_calibrate, add_pack,   add_layer,  add_interface, add_band,
    add_report,  add_grains,    add_bench,  add_worker, add_keys,      add_verify};

}  // namespace polargrain::app
