// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/commands/pack.hpp"
#include "common/packing_specification.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/document.hpp"

namespace polargrain::app {

/// Packings made for a test: `packing: {specification: FILE, seeds: [...]}` with the void ratio that they are to have
/// (docs/element_tests.md).
struct MadePackings {
  PackingSpecification specification;  ///< of the loosest packing; its pressure is that of the void ratio
  std::vector<int> seeds;
  std::string lowered;  ///< variable of its script that is lowered to make grains denser: their friction
  double void_ratio = 0.0;
  double tolerance = 0.0;           ///< of the void ratio
  double pressure = 0.0;            ///< of the test, which they are brought to afterwards, Pa
  coupler::CellScript script = {};  ///< of the test, under which they are
};

/// Makes them, or says what stands in for them while a specification is checked. @returns a file each seed
using PackingsOf = std::function<std::vector<std::filesystem::path>(const MadePackings&)>;

/// The specification of a test with files in the place of packings to be made; unchanged where there are no such packings.
/// @param directory where files are looked for @throws InputError with the faults of the packings asked for
coupler::Entry with_made_packings(coupler::Entry test, const std::filesystem::path& directory,
                                  const ScriptRules& scripts, const PackingsOf& packings_of);

/// Small files that are read as the packings would be: a specification can be checked before any packing is made.
/// @param folder exists
std::vector<std::filesystem::path> stand_ins(const MadePackings& asked, const std::filesystem::path& folder);

/// Makes the packings that are not in the folder yet. The loosest one of a seed is compressed as `polargrain pack` does;
/// then its friction is lowered in steps, under the same pressure, and between the two steps that enclose the void
/// ratio it is looked for. A packing depends on its seed and its void ratio, not on the others.
/// @param folder is made @param tell a line for each packing that is made; may be empty
/// @throws RunError when a void ratio is out of reach or is not hit, with the one reached
std::vector<std::filesystem::path> make_packings(const MadePackings& asked,
                                                 const std::filesystem::path& folder,
                                                 const PackingTools& tools,
                                                 const std::function<void(const std::string&)>& tell);

}  // namespace polargrain::app
