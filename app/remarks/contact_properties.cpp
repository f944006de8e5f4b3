// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/contact_properties.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "grains_io/contact_models.hpp"
#include "grains_io/script_words.hpp"

namespace polargrain::app {
namespace {

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

std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

void take(const std::vector<std::string>& words, const Fault& place, ContactScript& script) {
  if (words.front() == "neighbor" && words.size() > 1) {
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
  const std::vector<ScriptWords> all = words_of_script(cell.script, cell.script_file);
  script.models = contact_models_of(all);
  for (const ScriptWords& command : all) take(command.words, {command.file, command.line, ""}, script);
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
