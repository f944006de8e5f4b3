// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/contact_properties.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "grains_io/script.hpp"

namespace polargrain::app {
namespace {

using Variables = std::map<std::string, std::string>;

struct PropertyReader {
  const char* property;
  std::vector<std::string> models;
};

/// The engine's models and those of this project (dem/contact).
const std::vector<PropertyReader>& readers() {
  static const std::vector<PropertyReader> list{
      {"contactModulus", {"model hooke/radii"}},
      {"tangentialStiffnessRatio", {"model hooke/radii"}},
      {"youngsModulus", {"model hooke", "model hertz"}},
      {"poissonsRatio", {"model hooke", "model hertz"}},
      {"coefficientRestitution", {"model hooke", "model hertz"}},
      {"characteristicVelocity", {"model hooke"}},
      {"coefficientFriction", {"tangential history", "tangential no_history", "tangential li_chu"}},
      {"coefficientRollingFriction",
       {"rolling_friction epsd2", "rolling_friction li_chu", "rolling_friction cdt", "rolling_friction epsd",
        "rolling_friction epsd3"}},
      {"coefficientRollingViscousDamping", {"rolling_friction epsd", "rolling_friction epsd3"}},
      {"rollingStiffnessRatio", {"rolling_friction li_chu"}},
      {"rollingFrictionForceStiffnessRatio", {"rollingFrictionForce on"}},
      {"coefficientRollingFrictionForce", {"rollingFrictionForce on"}},
      {"cohesionEnergyDensity", {"cohesion sjkr", "cohesion sjkr2"}}};
  return list;
}

const std::set<std::string> kKnownModels{"hooke",  "hertz", "hooke/radii", "history", "no_history",
                                         "li_chu", "off",   "on",          "cdt",     "epsd",
                                         "epsd2",  "epsd3", "sjkr",        "sjkr2"};

std::vector<std::string> words_of(const std::string& text, const Variables& variables) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    if (word.starts_with('#')) break;
    if (word.size() > 3 && word.starts_with("${") && word.ends_with('}')) {
      const auto known = variables.find(word.substr(2, word.size() - 3));
      if (known != variables.end()) word = known->second;
    }
    words.push_back(word);
  }
  return words;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

void take(const std::vector<std::string>& words, const Fault& place, ContactScript& script) {
  if (words.front() == "pair_style" && words.size() > 2 && words[1] == "gran") {
    for (std::size_t k = 2; k + 1 < words.size(); k += 2) script.models[words[k]] = words[k + 1];
  } else if (words.front() == "neighbor" && words.size() > 1) {
    script.neighbour_distance = number_of(words[1]);
    script.neighbour_place = place;
  } else if (words.front() == "fix" && words.size() > 5 && words[3] == "property/global") {
    ContactProperty property{place, words[4], {}};
    const bool of_pairs = words[5] == "peratomtypepair";  // the number of types comes first
    for (std::size_t k = of_pairs ? 7 : 6; k < words.size(); ++k)
      if (const auto value = number_of(words[k])) property.values.push_back(*value);
    script.properties.push_back(std::move(property));
  }
}

}  // namespace

ContactScript contact_script_of(const CellDefinition& cell) {
  ContactScript script;
  Variables variables;
  for (const ScriptCommand& command : commands_of_script(cell.script, cell.script_file)) {
    const std::vector<std::string> words = words_of(command.text, variables);
    if (words.empty()) continue;
    const bool is_variable = words.size() > 3 && words[0] == "variable";
    if (is_variable && words[1] != "neighbour_distance") variables.emplace(words[1], words[3]);
    take(words, {command.file, command.line, ""}, script);
  }
  return script;
}

std::vector<std::string> readers_of(const std::string& property) {
  const auto reader = std::ranges::find(readers(), property, &PropertyReader::property);
  return reader == readers().end() ? std::vector<std::string>{} : reader->models;
}

bool knows_models_of(const ContactScript& script) {
  return !script.models.empty() && std::ranges::all_of(script.models, [](const auto& model) {
    return kKnownModels.contains(model.second);
  });
}

}  // namespace polargrain::app
