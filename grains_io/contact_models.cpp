// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains_io/contact_models.hpp"

namespace polargrain {

std::map<std::string, std::string> contact_models_of(const std::vector<ScriptWords>& script) {
  std::map<std::string, std::string> models;
  for (const ScriptWords& command : script) {
    const std::vector<std::string>& words = command.words;
    if (words.front() != "pair_style" || words.size() < 3 || words[1] != "gran") continue;
    models.clear();
    for (std::size_t k = 2; k + 1 < words.size(); k += 2) models[words[k]] = words[k + 1];
  }
  return models;
}

std::string springs_of_script(const std::string& text) {
  std::string springs;
  for (const auto& [kind, model] : contact_models_of(words_of_script(text, {})))
    if (model != "off" && !kind.ends_with("amping"))
      springs += (springs.empty() ? "" : " ") + kind + " " + model;
  return springs;
}

}  // namespace polargrain
