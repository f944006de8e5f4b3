// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/commands/command.hpp"
#include "app/page/page.hpp"
#include "app/run/result_directory.hpp"
#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/regular_file.hpp"
#include "coupler/case/case_identity.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {

std::string brought_along(const std::string& name) {
  std::error_code
      error;  // of a name that is too long, or links that lead round in circles: who opens it says so
  if (std::filesystem::exists(name, error) || error) return name;
  const auto file = coupler::find_data_file(name, {});
  return file ? file->string() : name;
}

std::vector<std::filesystem::path> files_read_with(coupler::DocumentKind kind,
                                                   const std::filesystem::path& file,
                                                   const std::vector<std::string>& settings) {
  std::vector<std::filesystem::path> files{file};
  const std::vector<std::filesystem::path> named =
      coupler::files_named_in(coupler::load_document_of(kind, file, settings), file.parent_path());
  files.insert(files.end(), named.begin(), named.end());
  return files;
}

namespace {

/// Whether it would replace a case or a script, perhaps of another command.
bool is_written_by_hand(const std::filesystem::path& file) {
  std::error_code error;
  const std::string ending = file.extension().string();
  return (ending == ".yaml" || ending == ".yml" || ending == ".in") && std::filesystem::exists(file, error);
}

void refuse_output(const std::string& option, const std::filesystem::path& output,
                   const std::string& reason) {
  if (!reason.empty())
    throw InputError({"", 0, fmt::format("{} {}: {}", option, plain_text(output.string()), reason)});
}

}  // namespace

void check_output(const std::string& option, const std::filesystem::path& output,
                  const std::vector<std::filesystem::path>& inputs) {
  if (output.empty()) return;
  std::string reason = why_not_over(output, inputs);
  if (reason.empty() && is_written_by_hand(output))
    reason = "there is such a file, of a kind that is written by hand; name another file";
  if (reason.empty()) reason = why_no_output(output);
  refuse_output(option, output, reason);
}

void check_page(const std::string& option, const std::filesystem::path& output,
                const std::vector<std::filesystem::path>& inputs) {
  check_output(option, output, inputs);
  refuse_output(option, output, why_no_page(output));
}

void check_table(const std::string& option, const std::filesystem::path& output,
                 const std::vector<std::filesystem::path>& inputs, const std::string& beginning) {
  check_output(option, output, inputs);
  const std::string reason = why_not_own(output, beginning, "table of this command");
  refuse_output(option, output,
                reason.empty() ? reason : reason + "; name another file to write, or remove this one");
}

void check_beside_run(const std::string& option, const std::filesystem::path& output,
                      const std::filesystem::path& directory) {
  if (output.empty() || !is_of_a_run(output, directory)) return;
  throw InputError({"", 0,
                    fmt::format("{} {}: this is the place of a result of the run; give another name", option,
                                plain_text(output.string()))});
}

void add_case(CLI::App& command, std::filesystem::path& file) {
  command.add_option("CASE", file, "Case file (YAML)")->required()->transform(brought_along);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "Change a value of the case, for example steps.count=10; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_strict(CLI::App& command, bool& strict) {
  command.add_flag("--strict", strict, "Take remarks on the case for faults");
}

void add_trust(CLI::App& command, ScriptRules& rules, const Grains& grains) {
  rules.more_commands = grains.engine.script_commands;
  command.add_flag(
      "--trust-scripts", rules.trusted,
      "Run scripts of cells that can do more than set up a cell (start programs, read and write files), and "
      "libraries of contact laws");
}

CLI::Validator finite_number() {
  // Without a name: help says the bounds.
  return CLI::Validator(
      [](std::string& text) {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        return is_number && std::isfinite(value) ? std::string()
                                                 : fmt::format("'{}' is no finite number", text);
      },
      "");
}

void add_workers(CLI::App& command, int& workers, int least) {
  workers = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.add_option("-w,--workers", workers, "Worker processes [one a core]")
      ->type_name("N")
      ->check(CLI::Range(least, 4096));
}

}  // namespace polargrain::app
