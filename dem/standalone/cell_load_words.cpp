// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/cell_load_words.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "dem/cell/stock_laws.hpp"

namespace polargrain::dem {

MeanGrain mean_grain_of(LAMMPS_NS::Atom& atom, double (*size)(double radius), double depth) {
  MeanGrain mean;
  double mass = 0.0;
  double sizes = 0.0;
  const int count = atom.nlocal;
  for (int k = 0; k < count; ++k) {
    mean.radius += atom.radius[k] / count;
    mass += atom.rmass[k];
    sizes += size(atom.radius[k]);
  }
  mean.mass = mass / count;
  mean.density = mass / (sizes * depth);
  return mean;
}

void take_packing(LAMMPS_NS::LAMMPS& lammps, QuasiStatic& protocol, const MeanGrain& grain,
                  std::vector<Contact>& at_rest, double pressure, const ScriptTimeStep& time_step) {
  if (!(pressure > 0.0))
    lammps.error->all(
        FLERR,
        "Fix cell/load: the packing carries no pressure at rest: its grains do not touch, or the "
        "packing was made with another stiffness than the script has");
  StockLaws(lammps).complete(at_rest);
  protocol.take_scales(grain, at_rest, pressure);
  const std::string remark =
      time_step.settle(lammps, at_rest, inertia_of(lammps), protocol.damping_rate(), "this script");
  if (!remark.empty() && lammps.screen != nullptr) fmt::print(lammps.screen, "polargrain: {}\n", remark);
}

StatePointer read_state_file(const std::string& file, LAMMPS_NS::Error& error) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    error.all(FLERR, fmt::format("Fix cell/load: there is no file {} to take the state from", file).c_str());
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  const auto view = std::as_bytes(std::span(bytes));
  return std::make_shared<const State>(std::vector<std::byte>(view.begin(), view.end()));
}

CellLoadWords read_cell_load_words(LAMMPS_NS::LAMMPS& lammps, int count, char** words) {
  CellLoadWords read;
  CellControl& control = read.control;
  LAMMPS_NS::Error& error = *lammps.error;
  int at = 3;
  const auto number = [&] {
    if (++at >= count)
      error.all(FLERR, fmt::format("Illegal fix cell/load command: a value is missing at the end").c_str());
    return lammps.force->numeric(FLERR, words[at]);
  };
  const auto positive = [&](const char* what) {
    const double value = number();
    if (!(value > 0.0))
      error.all(FLERR, fmt::format("Illegal fix cell/load command: {} must be positive", what).c_str());
    return value;
  };
  for (; at < count; ++at) {
    const std::string word = words[at];
    if (word == "inertial_number") {
      control.inertial_number = positive("inertial_number");
    } else if (word == "damping") {
      control.damping = number();
      if (!(control.damping >= 0.0 && control.damping < 1.0))
        error.all(FLERR, "Illegal fix cell/load command: damping must be at least 0 and less than 1");
    } else if (word == "least_steps") {
      control.least_steps = static_cast<int>(positive("least_steps"));
    } else if (word == "unbalanced") {
      control.unbalanced_force_ratio = positive("unbalanced");
      control.unbalanced_moment_ratio = positive("unbalanced");
    } else if (word == "most_relaxation_steps") {
      control.most_relaxation_steps = static_cast<int>(positive("most_relaxation_steps"));
    } else if (word == "rotations" && at + 1 < count && std::strcmp(words[at + 1], "free") == 0) {
      control.rotations = CellRotations::free;
      ++at;
    } else if (word == "rotations" && at + 1 < count && std::strcmp(words[at + 1], "controlled") == 0) {
      control.rotations = CellRotations::controlled;
      ++at;
    } else if (word == "mean_grain") {
      read.mean_grain.mass = positive("mean_grain");
      read.mean_grain.radius = positive("mean_grain");
      read.mean_grain.density = positive("mean_grain");
    } else if (word == "turned") {
      read.turned = number();
    } else if (word == "frame") {
      Eigen::Matrix3d frame;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) frame(i, j) = number();
      read.frame = frame;
    } else if (word == "version") {
      if (const double version = number(); version != 1.0 && version != kReplayVersion)
        error.all(FLERR,
                  fmt::format("Fix cell/load: this script is of version {}, and this program reads 1 and {}: "
                              "write the replay anew",
                              version, kReplayVersion)
                      .c_str());
    } else if (word == "packing_state" && at + 1 < count) {
      read.packing_state = words[++at];
    } else {
      error.all(FLERR,
                fmt::format("Illegal fix cell/load command: unknown or incomplete keyword '{}'; "
                            "expected inertial_number, damping, least_steps, unbalanced, "
                            "most_relaxation_steps, rotations free|controlled, mean_grain, turned, frame, "
                            "packing_state or version",
                            word)
                    .c_str());
    }
  }
  return read;
}

}  // namespace polargrain::dem
