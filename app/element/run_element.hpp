// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/element/element_table.hpp"
#include "app/element/read_specification.hpp"

namespace polargrain::app {

/// The curves of all specimens of a test, in their order, the same whatever the number of workers.
struct ElementResult {
  std::vector<std::string> columns;
  std::vector<ElementCurve> curves;
};

/// Several tests; all that ask cells share the workers.
/// @param trust_scripts of cells @throws RunError when no worker can be started, or a packing cannot be brought to rest
std::vector<ElementResult> run_elements(std::span<const ElementSpecification> specifications, int workers,
                                        bool trust_scripts);

/// What came out, for the terminal: peak, dilatancy, end of each specimen and their mean.
std::string summary_of(const ElementResult& result);

}  // namespace polargrain::app
