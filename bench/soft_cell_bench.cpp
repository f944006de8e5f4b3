// SPDX-License-Identifier: GPL-2.0-or-later
// How a cell has to be loaded where the stress falls far below that of its packing (docs/hard_cells.md): 100
// discs from 100 kPa to 1 kPa of all-round pressure with several settings, and what these settings miss at 16
// kPa.
//
//   build/release/bench/soft_cell_bench > soft.log   from the root of the project; the tables go to standard
//   error
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "bench/driven_cell.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain {
namespace {

struct Setting {
  int ramp = 20;  ///< DEM steps of an increment, at least
  double damping = 0.12;
  double tolerance = 5e-3;
};

CellDefinition cell_of(const Setting& setting) {
  CellDefinition definition = test::demo_cell();
  definition.packing = read_packing("cases/footing_cells/packing100.h5");
  definition.control.least_steps = setting.ramp;
  definition.control.damping = setting.damping;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = setting.tolerance;
  definition.control.most_relaxation_steps = 200000;
  return definition;
}

/// Brings the cell under an all-round pressure, in steps of a fifth of what it is under, cut six times at
/// most; each is balanced to 1 % of its pressure. @returns the pressure it got to, Pa
double unload(DrivenCell& cell, double pressure) {
  double now = 1e5;
  double factor = 0.8;
  for (int cuts = 0; now > 1.0001 * pressure && cuts <= 6;) {
    const double next = std::max(pressure, now * factor);
    if (cell.go({-next, -next, 0.0}, {true, true, true}, {0.01 * next})) {
      now = next;
      cuts = 0;
      factor = 0.8;
    } else {
      ++cuts;
      factor = std::sqrt(factor);
    }
  }
  return now;
}

std::string ways_down() {
  std::string text = fmt::format("{:>6} {:>8} {:>10} {:>14} {:>12} {:>10}\n", "ramp", "damping", "tolerance",
                                 "gets to, kPa", "evaluations", "DEM steps");
  for (const Setting& setting :
       {Setting{20, 0.12, 5e-3}, Setting{400, 0.12, 5e-3}, Setting{20, 0.12, 1e-3}, Setting{400, 0.12, 1e-3},
        Setting{20, 0.12, 1e-4}, Setting{400, 0.12, 1e-4}, Setting{20, 0.06, 1e-4}, Setting{400, 0.06, 1e-4},
        Setting{950, 0.06, 1e-4}}) {
    DrivenCell cell(cell_of(setting));
    const double reached = unload(cell, 1e3);
    text += fmt::format("{:>6} {:>8} {:>10.0e} {:>14.2f} {:>12} {:>10}\n", setting.ramp, setting.damping,
                        setting.tolerance, 1e-3 * reached, cell.evaluations(), cell.dem_steps());
  }
  return text;
}

struct Strain {
  const char* name;
  DrivenCell::Vector value;
};

std::string errors() {
  const Setting careful{950, 0.06, 1e-4};
  DrivenCell way(cell_of(careful));
  const double reached = unload(way, 16e3);
  const auto& contacts = way.at().diagnostics;
  std::string text = fmt::format(
      "at {:.2f} kPa, {:.2f} contacts a grain: errors of the change of stress and of the "
      "derivative along the strain\n{:>16} {:>6} {:>8} {:>10} {:>8} {:>10} {:>10}\n",
      1e-3 * reached, contacts.coordination_number, "strain", "ramp", "damping", "tolerance", "change",
      "derivative", "DEM steps");
  const double half = 1.0 / std::sqrt(2.0);
  for (const Strain& strain : {Strain{"deviatoric 1e-5", 1e-5 * DrivenCell::Vector(half, -half, 0.0)},
                               Strain{"shear 1e-5", 1e-5 * DrivenCell::Vector(0.0, 0.0, half)},
                               Strain{"deviatoric 1e-4", 1e-4 * DrivenCell::Vector(half, -half, 0.0)},
                               Strain{"volume 1e-4", 1e-4 * DrivenCell::Vector(-half, -half, 0.0)}}) {
    const DrivenCell::Vector before = DrivenCell::stress(way.at().response);
    const Response<2> truth =
        DrivenCell(cell_of({10000, 0.06, 1e-6}), way.at()).answer(strain.value).response;
    const DrivenCell::Vector change = DrivenCell::stress(truth) - before;
    const DrivenCell::Vector derivative = DrivenCell::tangent(truth) * strain.value;
    for (const Setting& setting :
         {Setting{20, 0.12, 5e-3}, Setting{20, 0.12, 1e-4}, Setting{20, 0.12, 1e-6}, Setting{400, 0.12, 1e-4},
          Setting{400, 0.06, 1e-4}, Setting{950, 0.06, 1e-4}}) {
      const coupler::PlaneReply reply = DrivenCell(cell_of(setting), way.at()).answer(strain.value);
      text += fmt::format(
          "{:>16} {:>6} {:>8} {:>10.0e} {:>8.3f} {:>10.3f} {:>10}\n", strain.name, setting.ramp,
          setting.damping, setting.tolerance,
          (DrivenCell::stress(reply.response) - before - change).norm() / change.norm(),
          (DrivenCell::tangent(reply.response) * strain.value - derivative).norm() / derivative.norm(),
          reply.diagnostics.dem_steps);
    }
  }
  return text;
}

/// Contacts a grain on the way down, and the tangent of a cell at rest against differences of the cell.
std::string tangents() {
  const Setting careful{950, 0.06, 1e-4};
  std::string text = "contacts a grain:";
  for (const double pressure : {95e3, 20e3, 10e3, 1e3}) {
    DrivenCell cell(cell_of(careful));
    const double reached = unload(cell, pressure);
    text += fmt::format(" {:.2f} at {:.1f} kPa;", cell.at().diagnostics.coordination_number, 1e-3 * reached);
    if (pressure != 10e3) continue;
    DrivenCell still(cell_of({10000, 0.06, 1e-6}), cell.at());
    still.go({-reached, -reached, 0.0}, {true, true, true}, {1e-4 * reached});
    const DrivenCell::Matrix tangent = DrivenCell::tangent(still.at().response);
    for (const double size : {1e-7, 1e-6}) {
      text += fmt::format("\n  difference over {:.0e} against column of the tangent:", size);
      for (int i = 0; i < 3; ++i) {
        const DrivenCell::Vector strain = size * DrivenCell::Vector::Unit(i);
        const DrivenCell::Vector change =
            DrivenCell::stress(still.answer(strain).response) - DrivenCell::stress(still.at().response);
        text += fmt::format(" {:.3f}", (change / size - tangent.col(i)).norm() / tangent.col(i).norm());
      }
    }
    text += '\n';
  }
  return text + '\n';
}

}  // namespace
}  // namespace polargrain

int main() {
  polargrain::dem::start_engine_process();
  const std::string text =
      polargrain::ways_down() + "\n" + polargrain::errors() + "\n" + polargrain::tangents();
  std::fputs(text.c_str(), stderr);  // the engine talks on standard output
}
