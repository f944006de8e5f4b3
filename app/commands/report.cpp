// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "app/commands/command.hpp"
#include "app/report/busiest_grains.hpp"
#include "app/report/report_page.hpp"
#include "app/run/interrupt.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"

namespace polargrain::app {
namespace {

struct ReportOptions {
  std::vector<std::filesystem::path> directories;
  std::vector<std::filesystem::path> compared;
  std::filesystem::path output;
  bool live = false;
  ReportContent content;
  bool no_grains = false;
  ScriptRules scripts;
};

constexpr int kRefreshSeconds = 5;

/// @throws InputError where the page would stand in the place of a result, of the case, or of a file that is no page
void check_page_file(const std::filesystem::path& file, const RunResult& result) {
  check_beside_run("-o", file, result.directory);
  const nlohmann::ordered_json::json_pointer place("/case");
  std::vector<std::filesystem::path> inputs;
  if (result.summary.contains(place) && result.summary.at(place).is_string())
    inputs.emplace_back(result.summary.at(place).get<std::string>());
  check_page("-o", file, inputs);
}

/// @returns whether one of the runs is still at work
bool write_report(const ReportOptions& options, const std::filesystem::path& file) {
  std::vector<RunResult> results;
  bool at_work = false;
  for (const std::filesystem::path& directory : options.directories) {
    results.push_back(read_result(directory));
    at_work = at_work || results.back().is_at_work;
    check_page_file(file, results.back());
  }
  ReportContent content = options.content;
  content.refresh_seconds = options.live && at_work ? kRefreshSeconds : 0;
  try {
    write_file(file, report_page(results, content));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        {"", 0,
         fmt::format("the summary.json of a result was damaged or changed ({}); run the case anew",
                     error.what())});
  }
  return at_work;
}

int report(ReportOptions options) {
  options.directories.insert(options.directories.end(), options.compared.begin(), options.compared.end());
  if (options.directories.empty())
    throw InputError(
        {"", 0, "report: which result? Name the directory that `polargrain run` has written: report DIR"});
  const std::filesystem::path file =
      options.output.empty() ? options.directories.front() / "report.html" : options.output;
  if (options.live)
    note_interrupts();  // before the page is there, which tells others that this command is at work
  bool at_work = write_report(options, file);
  tell(stdout, "{}\n", file.string());
  if (!options.live) return 0;
  while (at_work) {
    for (int k = 0; k < kRefreshSeconds; ++k) {
      stop_if_interrupted();
      std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    at_work = write_report(options, file);
  }
  return 0;
}

}  // namespace

Command add_report(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& command = *program.add_subcommand(
      "report", "One HTML page of a result: curves, fields, convergence, cost, warnings");
  command.add_option("DIR", options->directories, "Result directory of run")->expected(0, 1);
  command.add_option("--compare", options->compared, "Further results, shown in the same charts")
      ->type_name("DIR...");
  command.add_option("-o,--output", options->output, "File to write [report.html in DIR]")->type_name("FILE");
  command
      .add_option("--x", options->content.x,
                  "Value along the curves [the strain or displacement that was moved, or time]")
      ->type_name("NAME");
  command
      .add_option("--field", options->content.fields,
                  "Field to show on the mesh; may be repeated [a usual choice]")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command.add_flag("--live", options->live, "Write the page anew until the runs are done; it reloads itself");
  command.add_flag("--no-grains", options->no_grains, "Do not show the grains of the busiest point");
  add_trust(command, options->scripts, grains);
  return {&command, [options, &engine = grains.engine] {
            if (!options->no_grains)
              options->content.grains = [rules = options->scripts, &engine](const RunResult& result) {
                return busiest_grains(result, rules, engine);
              };
            return report(*options);
          }};
}

}  // namespace polargrain::app
