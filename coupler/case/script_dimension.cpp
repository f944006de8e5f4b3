// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/script_dimension.hpp"

#include <fmt/format.h>

#include <sstream>

#include "grains_io/script.hpp"

namespace polargrain::coupler {

std::vector<Fault> dimension_faults(const std::string& text, const std::string& file, int dimension) {
  for (const ScriptCommand& command : commands_of_script(text, file)) {
    std::istringstream words(command.text);
    std::string name;
    std::string value;
    words >> name >> value;
    if (name != "dimension" || (value != "2" && value != "3") || value == std::to_string(dimension)) continue;
    const bool plane = dimension == 2;
    return {
        {command.file, command.line,
         fmt::format(
             "the script is for {} (dimension {}), and the packing is one of {}; name a script of dimension {} "
             "(for example cells/{}), or a packing made with 'dimension: {}'",
             plane ? "spheres in space" : "discs in a plane", value,
             plane ? "discs in a plane" : "spheres in space", dimension,
             plane ? "hooke_radii.in" : "spheres_hooke_radii.in", value)}};
  }
  return {};
}

}  // namespace polargrain::coupler
