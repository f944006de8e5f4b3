// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/script_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/plain_text.hpp"
#include "common/words.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {
namespace {

std::string dimension_fault(const std::string& value, int dimension) {
  if ((value != "2" && value != "3") || value == std::to_string(dimension)) return {};
  const bool plane = dimension == 2;
  return fmt::format(
      "the script is for {} (dimension {}), and the packing is one of {}; name a script of dimension {} "
      "(for example cells/{}), or a packing made with 'dimension: {}'",
      plane ? "spheres in space" : "discs in a plane", value, plane ? "discs in a plane" : "spheres in space",
      dimension, plane ? "hooke_radii.in" : "spheres_hooke_radii.in", value);
}

/// Of a command whose words are all known. @returns the fault in words; empty: it is right
std::string scene_fault(const std::vector<std::string>& words, int dimension) {
  if (words.size() == 2 && words[0] == "dimension") return dimension_fault(words[1], dimension);
  if (words.size() == 2 && words[0] == "units" && words[1] != "si")
    return fmt::format(
        "the script is in units {}, and a cell is in SI; write 'units si', and all numbers of the script in SI",
        plain_text(words[1]));
  const auto is_open = [](const std::string& word) {
    return word.find_first_not_of('p') != std::string::npos;
  };
  if (words.size() == 4 && words[0] == "boundary" && std::any_of(words.begin() + 1, words.end(), is_open))
    return fmt::format(
        "the box of a cell is periodic in all directions, and the script has '{}'; write 'boundary p p p'",
        plain_text(fmt::format("{}", fmt::join(words, " "))));
  return {};
}

}  // namespace

std::vector<Fault> scene_faults(const std::string& text, const std::string& file, int dimension) {
  std::vector<Fault> faults;
  for (const ScriptCommand& command : commands_of_script(text, file)) {
    const std::string known = command.text.substr(0, command.text.find('#'));
    if (known.find_first_of("$\"'") != std::string::npos) continue;
    if (std::string message = scene_fault(words_of(known), dimension); !message.empty())
      faults.push_back({command.file, command.line, std::move(message)});
  }
  return faults;
}

}  // namespace polargrain::coupler
