// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains_io/script_words.hpp"

#include <map>
#include <sstream>
#include <utility>

#include "grains_io/script.hpp"

namespace polargrain {
namespace {

using Variables = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, const Variables& variables) {
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

}  // namespace

std::vector<ScriptWords> words_of_script(const std::string& text, const std::string& file) {
  std::vector<ScriptWords> all;
  Variables variables;
  for (const ScriptCommand& command : commands_of_script(text, file)) {
    std::vector<std::string> words = split(command.text, variables);
    if (words.empty()) continue;
    const bool is_variable = words.size() > 3 && words[0] == "variable";
    if (is_variable && words[1] != "neighbour_distance") variables.emplace(words[1], words[3]);
    all.push_back({command.file, command.line, std::move(words)});
  }
  return all;
}

}  // namespace polargrain
