// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

struct SafetyOptions {
  std::filesystem::path case_file;
  std::vector<std::string> settings;  ///< of --set
  ScriptRules scripts = {};
  std::string stage;         ///< at the end of which strength is reduced; empty: at the end of the case
  double resolution = 0.01;  ///< largest distance of the factors between which the body fails
  double largest = 10.0;     ///< factor beyond which nothing is tried
  std::filesystem::path file = {};  ///< a table of the trials; empty: no table is written
};

/// One trial: the strength of all materials divided by a factor, from the end of the stage.
struct SafetyTrial {
  double factor = 1.0;
  bool stands = false;  ///< a balance was found
  double displacement =
      0.0;  ///< largest of a node since the end of the stage, m; where it does not stand, up to the last balance
  int iterations = 0;
  std::string reason;  ///< why no balance was found
};

/// Factor of safety by strength reduction (docs/theory/solver.md, factor of safety).
struct Safety {
  std::vector<SafetyTrial> trials;  ///< in their order
  double stands = 1.0;              ///< the largest factor at which the body stands
  double fails = 0.0;  ///< the smallest one at which it does not; 0: it stands at all that were tried
};

/// Takes the steps of the case, then brackets and halves the factor.
/// @throws InputError where a material has no strength that can be reduced; RunError where the case does not stand as it is
Safety factor_of_safety(const coupler::Case& the_case, const SafetyOptions& options);

/// Reads the case, finds the factor and tells it. @returns 0
int safety(const SafetyOptions& options);

}  // namespace polargrain::app
