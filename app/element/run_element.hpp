// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/element/element_table.hpp"
#include "app/element/read_specification.hpp"
#include "common/error.hpp"

namespace polargrain::app {

/// The curves of all specimens of a test, in their order, the same whatever the number of workers.
struct ElementResult {
  std::vector<std::string> columns;
  std::vector<ElementCurve> curves;
  std::vector<element::Stage> stages = {};  ///< the first is the consolidation
};

/// The rows of a curve without those of the consolidation; all where the test did not come further.
std::span<const std::vector<double>> rows_of_test(const ElementResult& result, const ElementCurve& curve);

/// A packing that is not at rest under its script, or cells that cannot be set up with it, in the engine's words.
class NotAtRest : public RunError {
 public:
  using RunError::RunError;
};

/// Several tests; all that ask cells share the workers.
/// @param trust_scripts of cells @throws NotAtRest @throws RunError when no worker can be started
std::vector<ElementResult> run_elements(std::span<const ElementSpecification> specifications, int workers,
                                        bool trust_scripts);

/// The result for the terminal: peak, dilatancy, end of each specimen and their mean.
std::string summary_of(const ElementResult& result);

}  // namespace polargrain::app
