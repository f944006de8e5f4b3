// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/element/element_table.hpp"
#include "common/cell.hpp"
#include "coupler/case/document.hpp"
#include "coupler/case/material_model.hpp"
#include "element/driver.hpp"
#include "element/named_tests.hpp"

namespace polargrain::app {

/// A test of one point as a specification or the command line asks for it, checked.
struct ElementSpecification {
  std::string title;
  element::Room room = element::Room::discs;
  /// One a packing; empty: the material below.
  std::vector<CellDefinition> cells;
  std::vector<std::string> names;  ///< of the packings, or of the model
  std::shared_ptr<const coupler::MaterialRecipe> material;
  double pressure = 0.0;             ///< all-round, before the first stage, Pa
  std::optional<double> void_ratio;  ///< at that pressure, for materials that do not report one
  element::Accuracy accuracy;
  std::vector<element::Stage> stages;  ///< completed; the first is the consolidation
};

/// The form of the tables of a test.
TableForm form_of(const ElementSpecification& specification);

/// Reads and checks the specification of a test (docs/element_tests.md).
/// @param document as loaded, settings put in @param directory of the file: where files are looked for
/// @throws InputError with all faults, in the order of the file
ElementSpecification read_element_specification(const coupler::Entry& document,
                                                const std::filesystem::path& directory,
                                                const ScriptRules& scripts);

}  // namespace polargrain::app
