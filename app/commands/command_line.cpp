// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/all_commands.hpp"
#include "app/run/interrupt.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::app {
namespace {

constexpr int kRunFailed = 1;
constexpr int kInputWrong = 2;
constexpr int kStopped = 3;

constexpr const char* kIntroduction = R"(polargrain - granular materials on two scales
A Cosserat finite element model whose material, where you want it, is a box of grains run by LIGGGHTS.)";

constexpr const char* kExamples = R"(
Try:
  polargrain check cases/biaxial/case.yaml          all faults of a case at once, and the moduli of its packings
  polargrain run cases/biaxial/case.yaml -w 2       run it with two workers
  polargrain run cases/biaxial/case.yaml --resume   go on with a run that was stopped or killed
  polargrain examples                               what comes along; examples NAME copies one
  polargrain new biaxial -o mine                    write a case of your own, with its packing: new --help
  polargrain run case.yaml --set steps.count=10     change a value for one run
  polargrain verify results/biaxial                 hold a result against its proof, some cells evaluated again
  polargrain grains results/biaxial --point 12      grains and force chains of a point, for ParaView
  polargrain point case.yaml sand path.csv          one point of the material 'sand' along a path
  polargrain element --help                         laboratory tests of one point: biaxial, triaxial, shear, ...
  polargrain pack cases/packings/dense400.yaml -o dense400.h5   make a packing of grains
  polargrain pack --settle dense400.h5 soft.in -o soft400.h5    bring one to rest under another script
  polargrain bench --quick                          speed against error of the demo, some minutes

A run writes history.csv (a row a step), fields.pvd (open it in ParaView), costs.csv, summary.json and run.log.
Exit status: 0 done, 1 the run failed, 2 the input is wrong (nothing was run or written), 3 stopped by a signal
(go on with --resume).
All keys of a case: docs/user_guide.md. Recipes: docs/howto.
)";

/// The list of commands has one line for each; the help of the command has the rest.
class OneLineEach : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App* command) const override {
    const std::string description = command->get_description();
    std::ostringstream line;
    CLI::detail::format_help(line, command->get_name(), description.substr(0, description.find('\n')),
                             column_width_);
    return line.str();
  }
};

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& error) {
    tell(stderr, "{}\n", error.what());
    return kInputWrong;
  } catch (const Interrupted& error) {
    tell(stderr, "{}\n", error.what());
    return kStopped;
  } catch (const std::filesystem::filesystem_error& error) {
    tell(stderr, "error: {}: {}\n", error.path1().string(), error.code().message());
    return kRunFailed;
  } catch (const std::exception& error) {
    tell(stderr, "error: {}\n", error.what());
    return kRunFailed;
  }
}

std::string guessed(const std::string& word, const std::vector<std::string>& known) {
  const std::string guess = coupler::nearest(word, known);
  return guess.empty() ? "" : "; did you mean '" + guess + "'?";
}

/// Replaces words of CLI11's messages.
std::string in_other_words(std::string text) {
  constexpr std::pair<const char*, const char*> kWords[] = {{" is required", " is missing"},
                                                            {": At Most ", ": expected at most "},
                                                            {": At Least ", ": expected at least "},
                                                            {" required but received ", ", found "},
                                                            {": Value ", ": "},
                                                            {" not in range ", " is not a number from "}};
  for (const auto& [theirs, ours] : kWords)
    if (const std::size_t place = text.find(theirs); place != std::string::npos)
      text.replace(place, std::string_view(theirs).size(), ours);
  // Limits of a number that is only to be positive, digit by digit.
  if (const std::size_t place = text.find(" is not a number from 0.000000 to 17976");
      place != std::string::npos)
    text = text.substr(0, place) + " is not a positive number";
  // "--set: 1 required KEY=VALUE missing"
  constexpr std::string_view kOne = ": 1 required ";
  constexpr std::string_view kMissing = " missing";
  if (const std::size_t place = text.find(kOne); place != std::string::npos && text.ends_with(kMissing))
    text = text.substr(0, text.size() - kMissing.size()).replace(place, kOne.size(), ": give a value, ");
  return text;
}

/// The message on a command line that cannot be understood.
std::string refusal(const CLI::App& app, const CLI::ParseError& error, const std::string& first_word) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  if (parsed.empty() && !first_word.starts_with('-')) {
    std::vector<std::string> names;
    for (const CLI::App* const one : app.get_subcommands({})) names.push_back(one->get_name());
    if (first_word.empty())
      return fmt::format("give a command: {}\nSee polargrain --help", coupler::listed(names));
    const std::string guess = guessed(first_word, names);
    return fmt::format("there is no command '{}'{}", first_word,
                       guess.empty() ? "; there are " + coupler::listed(names) : guess);
  }
  std::vector<std::string> left = app.remaining(true);
  if (left.empty() && parsed.empty()) left.push_back(first_word);
  std::string text = in_other_words(error.what());
  if (!left.empty() && left.front().starts_with('-')) {
    std::vector<std::string> options;
    for (const CLI::Option* const option : command.get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    text = fmt::format("there is no option '{}'{}", left.front(), guessed(left.front(), options));
  } else if (!left.empty()) {
    text = fmt::format("'{}' is one word too many", left.front());
  }
  const std::string name = parsed.empty() ? "polargrain" : "polargrain " + command.get_name();
  return fmt::format("{}: {}\nSee {} --help", name, text, name);
}

}  // namespace

int command_line(int count, char** arguments, const WorkerEngine& engine, const PackingTools& packing_tools) {
  make_signals_of_writes_errors();
  CLI::App app(kIntroduction, "polargrain");
  app.set_version_flag("--version", "polargrain " POLARGRAIN_VERSION);
  app.footer(kExamples);
  app.require_subcommand(1);
  app.formatter(std::make_shared<OneLineEach>());
  const Grains grains{engine, packing_tools};
  std::vector<Command> commands;
  for (const AddCommand add : kCommands) {
    commands.push_back(add(app, grains));
    commands.back().options->footer("");
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    tell(stderr, "{}\n", refusal(app, error, count > 1 ? arguments[1] : ""));
    return kInputWrong;
  }
  const Command& command =
      *std::ranges::find_if(commands, [](const Command& c) { return c.options->parsed(); });
  const int status = guarded(command.call);
  if (status != 0 || !command.is_answer || std::ferror(stdout) == 0) return status;
  tell(stderr, "error: standard output cannot be written\n");
  return kRunFailed;
}

}  // namespace polargrain::app
