// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/log_excerpt.hpp"

#include <algorithm>
#include <fstream>
#include <vector>

#include "common/plain_text.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::streamoff kReadAtMost = 64 * 1024;

std::vector<std::string> last_lines(const std::filesystem::path& log, std::uintmax_t from) {
  std::ifstream in(log, std::ios::binary);
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  std::vector<std::string> lines;
  if (!in || size < 0) return lines;
  in.seekg(std::max(static_cast<std::streamoff>(from), size - kReadAtMost));
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  }
  return lines;
}

/// The command of the user's script that was at work when the engine gave up: workers announce each command
/// as "polargrain: FILE:LINE: COMMAND" and the end of the script as "polargrain: FILE: read to its end".
std::string command_at_fault(const std::vector<std::string>& lines) {
  const std::string announcement = "polargrain: ";
  std::string command;
  for (const std::string& line : lines) {
    if (line.find("ERROR") != std::string::npos) break;
    if (line.rfind(announcement, 0) == 0) command = line.substr(announcement.size());
  }
  const bool finished = command.ends_with(": read to its end");
  return command.empty() || finished ? std::string() : plain_text(command) + '\n';
}

}  // namespace

std::string log_excerpt(const std::filesystem::path& log, std::uintmax_t from, std::size_t most_lines) {
  std::vector<std::string> lines = last_lines(log, from);
  std::vector<std::string> errors;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(errors),
               [](const std::string& line) { return line.find("ERROR") != std::string::npos; });
  const std::vector<std::string>& chosen = errors.empty() ? lines : errors;
  std::string text = errors.empty() ? std::string() : command_at_fault(lines);
  for (std::size_t i = chosen.size() - std::min(most_lines, chosen.size()); i < chosen.size(); ++i) {
    text += plain_text(chosen[i]) + '\n';
  }
  return text;
}

}  // namespace polargrain::coupler
