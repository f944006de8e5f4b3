// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/script_parameters.hpp"

#include <fmt/format.h>

#include <sstream>

namespace polargrain::app {
namespace {

/// Whether a line sets the variable to one word.
bool sets(const std::string& line, const std::string& name) {
  std::istringstream words(line);
  std::string command;
  std::string variable;
  std::string style;
  std::string value;
  return words >> command >> variable >> style >> value && command == "variable" && variable == name &&
         (style == "index" || style == "equal");
}

bool reads(const std::string& line, const std::string& name) {
  const std::string code = line.substr(0, line.find('#'));
  if (code.find("${" + name + "}") != std::string::npos) return true;
  const std::size_t place = code.find("v_" + name);
  if (place == std::string::npos) return false;
  const std::size_t end = place + 2 + name.size();
  return end == code.size() || (std::isalnum(static_cast<unsigned char>(code[end])) == 0 && code[end] != '_');
}

}  // namespace

std::string parameter_fault(const std::string& script, const std::string& name) {
  std::istringstream lines(script);
  bool is_set = false;
  bool is_read = false;
  for (std::string line; std::getline(lines, line);) {
    is_set = is_set || sets(line, name);
    is_read = is_read || reads(line, name);
  }
  if (!is_set)
    return fmt::format(
        "the script has no line 'variable {} index VALUE'; write one, and ${{{}}} where the value stands",
        name, name);
  if (!is_read)
    return fmt::format("the script sets the variable {} but never reads it, as ${{{}}}", name, name);
  return {};
}

std::string with_parameters(const std::string& script,
                            const std::vector<std::pair<std::string, double>>& values) {
  std::istringstream lines(script);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    for (const auto& [name, value] : values)
      if (sets(line, name)) line = fmt::format("variable {} index {:.17g}", name, value);
    text += line + '\n';
  }
  return text;
}

}  // namespace polargrain::app
