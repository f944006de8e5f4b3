// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains_io/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>

namespace polargrain {
namespace {

using Words = std::set<std::string>;

/// The commands that a cell needs and that can do nothing else. Those whose words decide what happens are looked at below.
const Words kAllowed{
    "atom_modify",    "atom_style",     "boundary",   "communicate",   "dimension",    "echo",     "fix",
    "group",          "hard_particles", "if",         "mass",          "neigh_modify", "neighbor", "newton",
    "pair_coeff",     "pair_modify",    "pair_style", "print",         "read_data",    "region",   "set",
    "soft_particles", "special_bonds",  "thermo",     "thermo_modify", "thermo_style", "timestep", "unfix",
    "units",          "variable",       "velocity"};

/// The engine's other commands: known, so that messages can name them.
const Words kKnown{"box",
                   "change_box",
                   "clear",
                   "compute",
                   "compute_modify",
                   "create_atoms",
                   "create_box",
                   "delete_atoms",
                   "delete_bonds",
                   "dielectric",
                   "displace_atoms",
                   "dump",
                   "dump_modify",
                   "fix_modify",
                   "force_dt_reset",
                   "include",
                   "info",
                   "jump",
                   "kspace_modify",
                   "kspace_style",
                   "label",
                   "lattice",
                   "log",
                   "min_modify",
                   "min_style",
                   "minimize",
                   "modify_timing",
                   "next",
                   "package",
                   "partition",
                   "pair_write",
                   "processors",
                   "quit",
                   "read_dump",
                   "read_restart",
                   "replicate",
                   "reset_timestep",
                   "restart",
                   "rotate",
                   "run",
                   "run_style",
                   "run_time",
                   "shell",
                   "suffix",
                   "thermo_log",
                   "uncompute",
                   "undump",
                   "write_data",
                   "write_dump",
                   "write_restart",
                   "write_restart_on_signal"};

const Words kFixes{"property/global",    "property/atom", "nve/sphere", "nve",
                   "enforce2d",          "viscous",       "gravity",    "freeze",
                   "setforce",           "addforce",      "momentum",   "wall/gran",
                   "check/timestep/gran"};
const Words kRegions{"block",  "cone",  "cylinder", "plane",     "prism",
                     "sphere", "wedge", "union",    "intersect", "delete"};
const Words kVariables{"index", "loop", "string", "equal", "atom", "delete"};

/// The commands that make loops and jumps.
const Words kFlow{"jump", "label", "next"};

constexpr const char* kAdvice = "; remove it, or give --trust-scripts if you have read this script";

struct Word {
  std::string text;
  bool quoted = false;
  /// Whether the engine puts the value of a variable in here, which may be several words.
  [[nodiscard]] bool varies() const { return text.find('$') != std::string::npos; }
};

bool is_space(char c) {
  return std::string_view(" \t\n\v\f\r").find(c) != std::string_view::npos;
}

/// The words as the engine takes them, up to a comment. Nothing for lines with quotation marks that the engine reads in
/// ways of its own: both kinds, one in the middle of a word, one that is never closed.
std::optional<std::vector<Word>> words_of(const std::string& text) {
  std::vector<Word> words;
  char kind = '\0';
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    if (text[at] == '#') break;
    if (text[at] == '"' || text[at] == '\'') {
      if (kind != '\0' && kind != text[at]) return std::nullopt;
      kind = text[at];
      const std::size_t end = text.find(kind, at + 1);
      if (end == std::string::npos) return std::nullopt;
      words.push_back({text.substr(at + 1, end - at - 1), true});
      if (words.back().text.find_first_of("\"'") != std::string::npos) return std::nullopt;
      at = end + 1;
      if (at < text.size() && !is_space(text[at])) return std::nullopt;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !is_space(text[end]) && text[end] != '#') ++end;
    words.push_back({text.substr(at, end - at), false});
    if (words.back().text.find_first_of("\"'") != std::string::npos) return std::nullopt;
    at = end;
  }
  return words;
}

/// Whether one of the first so many words, which decide what a command does, is left to a variable.
bool any_varies(const std::vector<Word>& words, std::size_t count) {
  return std::any_of(words.begin(),
                     words.begin() + static_cast<std::ptrdiff_t>(std::min(count, words.size())),
                     [](const Word& word) { return word.varies(); });
}

/// Looks at one command. @returns its fault; nothing when it has no fault
class Judge {
 public:
  explicit Judge(const ScriptRules& rules) : rules_(rules) {}

  std::string fault(const std::string& text) const {
    const auto words = words_of(text);
    if (!words) {
      return fmt::format("quotation marks that can be read in two ways{}", kAdvice);
    }
    if (words->empty()) return {};
    const std::string& command = words->front().text;
    if (rules_.more_commands.contains(command)) return {};
    if (words->front().varies()) {
      return fmt::format(
          "a variable stands in the place of a command, which nobody can judge before it runs{}", kAdvice);
    }
    if (kFlow.contains(command)) {
      return fmt::format(
          "'{}' makes loops and jumps, and the script of a cell is read once, from its first line to its last: "
          "write the lines out one by one",
          command);
    }
    if (kKnown.contains(command)) {
      return fmt::format("the command '{}' is not among those that set up a cell{}", command, kAdvice);
    }
    if (!kAllowed.contains(command)) {
      return "expected a command that sets up a cell (docs/user_guide.md); LIGGGHTS has no command of this name";
    }
    return fault_of_words(command, *words);
  }

 private:
  std::string fault_of_words(const std::string& command, const std::vector<Word>& words) const {
    if (command == "fix") return style(words, 3, kFixes, "fix");
    if (command == "region") return style(words, 2, kRegions, "region");
    if (command == "variable") return variable(words);
    if (command == "pair_style") return style(words, 1, {"gran", "none"}, "pair_style");
    if (command == "print") return print(words);
    if (command == "if") return branches(words);
    if (command == "read_data" && (words.size() != 2 || words[1].text != "${packing}")) {
      return fmt::format("read_data may read ${{packing}} only{}", kAdvice);
    }
    return {};
  }

  static std::string style(const std::vector<Word>& words, std::size_t place, const Words& styles,
                           const std::string& command) {
    if (any_varies(words, place + 1)) {
      return fmt::format("{}: a variable stands where the style is chosen{}", command, kAdvice);
    }
    if (words.size() <= place || styles.contains(words[place].text))
      return {};  // too short: the engine says so
    return fmt::format("{}: this style is not among those that set up a cell{}", command, kAdvice);
  }

  static std::string variable(const std::vector<Word>& words) {
    if (words.size() > 2 && words[1].text == "packing" && words[2].text != "index") {
      return "variable packing: it is the program that sets it; a default may be given with 'index'";
    }
    return style(words, 2, kVariables, "variable");
  }

  /// print "text" screen yes: it could write to a file.
  static std::string print(const std::vector<Word>& words) {
    for (std::size_t k = 2; k < words.size(); k += 2) {
      const bool known = words[k].text == "screen" || words[k].text == "newline";
      if (!known || (k + 1 < words.size() && words[k + 1].varies())) {
        return fmt::format("print: only its text and 'screen' or 'newline' may follow{}", kAdvice);
      }
    }
    if (words.size() > 1 && !words[1].quoted && words[1].varies()) {
      return fmt::format("print: put the text into quotation marks{}", kAdvice);
    }
    return {};
  }

  /// if CONDITION then "COMMAND" ... elif CONDITION "COMMAND" ... else "COMMAND" ...
  std::string branches(const std::vector<Word>& words) const {
    for (std::size_t k = 1; k < words.size(); ++k) {
      if (!words[k].quoted && words[k].varies()) {
        return fmt::format("if: put words with a variable into quotation marks{}", kAdvice);
      }
    }
    for (std::size_t k = 3; k < words.size(); ++k) {
      if (words[k].text == "else") continue;
      if (words[k].text == "elif") {
        ++k;
        continue;
      }
      if (std::string inner = fault(words[k].text); !inner.empty()) return inner;
    }
    return {};
  }

  const ScriptRules& rules_;
};

bool is_command_of_the_engine(const std::string& text, const ScriptRules& rules) {
  const std::string word = text.substr(0, text.find_first_of(" \t\r"));
  return kAllowed.contains(word) || kKnown.contains(word) || rules.more_commands.contains(word);
}

}  // namespace

std::vector<ScriptCommand> commands_of_script(const std::string& text, const std::string& file) {
  std::vector<ScriptCommand> commands;
  std::istringstream lines(text);
  ScriptCommand command{file, 0, {}};
  for (std::string line; std::getline(lines, line);) {
    ++command.line;
    const std::size_t last = line.find_last_not_of(" \t\r");
    if (last != std::string::npos && line[last] == '&') {
      command.text += line.substr(0, last);
      continue;
    }
    command.text += line;
    const std::size_t first = command.text.find_first_not_of(" \t\r");
    if (first != std::string::npos && command.text[first] != '#') {
      commands.push_back({command.file, command.line, command.text.substr(first)});
    } else if (const std::size_t colon = command.text.rfind(':');
               command.text.starts_with(kScriptMark) && colon != std::string::npos) {
      const std::size_t begin = std::string_view(kScriptMark).size();
      command.file = command.text.substr(begin, colon - begin);
      command.line = std::atoi(command.text.c_str() + colon + 1) - 1;
    }
    command.text.clear();
  }
  return commands;
}

std::vector<Fault> script_faults(const std::string& text, const std::string& file, const ScriptRules& rules) {
  std::vector<Fault> faults;
  const std::vector<ScriptCommand> commands = commands_of_script(text, file);
  const bool is_script =
      text.find('\0') == std::string::npos &&
      (commands.empty() || std::any_of(commands.begin(), commands.end(), [&](const ScriptCommand& command) {
         return is_command_of_the_engine(command.text, rules);
       }));
  if (!is_script) return {{file, 0, "this is not a LIGGGHTS input script: it holds no command of LIGGGHTS"}};
  if (rules.trusted) return faults;
  const Judge judge(rules);
  for (const ScriptCommand& command : commands) {
    if (std::string message = judge.fault(command.text); !message.empty()) {
      faults.push_back({command.file, command.line, std::move(message)});
    }
  }
  return faults;
}

}  // namespace polargrain
