// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/commands/command.hpp"
#include "app/run/proof.hpp"
#include "app/run/sample.hpp"
#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {
namespace {

/// The findings, and whether all of them are good.
class Findings {
 public:
  void agrees(const std::string& what) { tell(stdout, "  agrees    {}\n", what); }
  void differs(const std::string& what) {
    tell(stdout, "  DIFFERS   {}\n", what);
    good_ = false;
  }
  void missing(const std::string& what) {
    tell(stdout, "  missing   {}\n", what);
    good_ = false;
  }
  void note(const std::string& what) { tell(stdout, "            {}\n", what); }
  [[nodiscard]] bool good() const { return good_; }

 private:
  bool good_ = true;
};

using Summary = nlohmann::ordered_json;

/// The text at a place of a summary ("/proof/case_file"); empty without one.
std::string word_at(const Summary& summary, const char* place) {
  const Summary::json_pointer pointer(place);
  return summary.contains(pointer) && summary.at(pointer).is_string() ? summary.at(pointer).get<std::string>()
                                                                      : std::string();
}

/// @throws InputError when the summary is missing or cannot be read
Summary summary_in(const std::filesystem::path& file, Findings& findings) {
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw InputError({file.string(), 0, reason + "; a run writes it when it ends"});
  std::ifstream in(file, std::ios::binary);
  // Of two values of one key some readers see the first and some the last.
  std::vector<std::set<std::string>> open;
  const auto watch = [&](int, Summary::parse_event_t event, Summary& value) {
    if (event == Summary::parse_event_t::object_start) open.emplace_back();
    if (event == Summary::parse_event_t::object_end && !open.empty()) open.pop_back();
    if (event == Summary::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      findings.differs(fmt::format("summary.json has two values of '{}'", value.get<std::string>()));
    return true;
  };
  Summary summary = Summary::parse(in, watch, false);
  if (!summary.is_object()) throw InputError({file.string(), 0, "is no JSON: it was cut or changed"});
  if (!summary.contains("proof") || !summary["proof"].is_object() || !summary["proof"].contains("results") ||
      !summary["proof"]["results"].is_object())
    throw InputError(
        {file.string(), 0, "holds no proof; it was written by an older version, which cannot be verified"});
  return summary;
}

/// @returns whether all of the results that are here now are under the proof, as this version writes it
bool check_summary(const Summary& summary, Findings& findings) {
  const std::string recorded = word_at(summary, "/proof/summary");
  if (recorded.empty()) {
    // Versions that did not write it are believed to be what they say; this one writes it.
    if (word_at(summary, "/program") == "polargrain " POLARGRAIN_VERSION) {
      findings.differs("summary.json was changed after the run: its own hash is gone");
      return true;
    }
    findings.note(
        "summary.json is of an older version: its figures and some of the files are under no proof");
    return false;
  }
  recorded == name_of_summary(summary) ? findings.agrees("summary.json")
                                       : findings.differs("summary.json was changed after the run");
  return true;
}

void check_results(const Summary& recorded, const std::filesystem::path& directory, bool all_recorded,
                   Findings& findings) {
  const std::map<std::string, std::string> now = names_of_results(directory);
  for (const auto& [name, content] : recorded.items()) {
    const auto found = now.find(name);
    if (found == now.end()) {
      findings.missing(name);
    } else if (found->second != content) {
      findings.differs(name + " was changed after the run");
    } else {
      findings.agrees(name);
    }
  }
  for (const auto& [name, content] : now)
    if (all_recorded && !recorded.contains(name))
      findings.differs(name + " was not there when the run ended");
  if (all_recorded && !recorded.contains(kSampleFile))
    findings.missing(fmt::format("{}: the run could not write it", kSampleFile));
  if (const std::vector<std::string> others = without_proof(directory); !others.empty())
    findings.note(fmt::format("under no proof, since other commands and machines change it: {}",
                              fmt::join(others, ", ")));
}

void check_case(const coupler::Case& now, const coupler::Checkpoint& sample, Findings& findings) {
  const std::vector<std::string> lines = differences(sample.identity, now.identity);
  if (lines.empty()) return findings.agrees(fmt::format("{} and the files it names", now.file.string()));
  for (const std::string& line : lines) findings.differs(line);
}

/// The same where there is no sample, which knows every value: by contents of files alone.
void check_case(const coupler::Case& now, const Summary& summary, Findings& findings) {
  const bool same = word_at(summary, "/proof/case_file") == name_of_file(now.file) &&
                    summary["proof"].value("files", Summary::object()) == Summary(now.identity.files);
  same ? findings.agrees(fmt::format("{} and the files it names", now.file.string()))
       : findings.differs(fmt::format("{} or a file it names was changed after the run", now.file.string()));
}

/// Asks the cells of the sample once more.
void check_cells(const coupler::Case& the_case, const std::vector<SampledAnswer>& answers,
                 const VerifyOptions& options, Findings& findings) {
  coupler::PrivateDirectory logs;
  coupler::PoolOptions pool_options;
  pool_options.directory = logs.path();
  pool_options.workers = options.workers;
  pool_options.trust_scripts = options.scripts.trusted;
  coupler::Pool pool(pool_options);
  // As a run does, so that definitions get the same numbers.
  std::vector<std::shared_ptr<void>> materials;
  the_case.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    for (const auto& [region, material] : problem.materials)
      materials.push_back(the_case.materials.at(the_case.regions.at(region))->template make_for<dim>(&pool));
  });
  std::vector<coupler::PoolRequest> requests;
  for (const SampledAnswer& answer : answers)
    requests.push_back({static_cast<std::uint32_t>(answer.definition), answer.asked});
  const std::vector<CellReply> replies = pool.evaluate(requests);
  std::size_t same = 0;
  for (std::size_t k = 0; k < answers.size(); ++k) same += answers[k].same_answer(replies[k]) ? 1 : 0;
  const std::string text = fmt::format(
      "{} of {} cells, evaluated again from their states: stress, tangent and state have "
      "the same bits",
      same, answers.size());
  same == answers.size() ? findings.agrees(text) : findings.differs(text);
}

}  // namespace

int verify(const VerifyOptions& options) {
  const std::filesystem::path file = options.directory / "summary.json";
  Findings findings;
  const Summary summary = summary_in(file, findings);
  tell(stdout, "{}: {}, {}\n", options.directory.string(), word_at(summary, "/title"),
       word_at(summary, "/status"));
  const bool all_recorded = check_summary(summary, findings);
  const Summary at_limits = summary.value("at_limits", Summary::object());  // items() refers to it
  for (const auto& [region, limits] : at_limits.items())
    if (limits.is_string()) findings.note(fmt::format("region '{}': {}", region, limits.get<std::string>()));
  const Summary& proof = summary["proof"];
  check_results(proof["results"], options.directory, all_recorded, findings);
  std::vector<std::string> settings;
  for (const Summary& setting : proof.value("settings", Summary::array()))
    if (setting.is_string()) settings.push_back(setting.get<std::string>());
  const coupler::Case the_case = coupler::read_case(word_at(summary, "/case"), settings, options.scripts);
  const std::filesystem::path sample_file = options.directory / kSampleFile;
  if (word_at(summary, "/proof/results/sample.h5") != name_of_file(sample_file) ||
      !why_no_input(sample_file).empty()) {
    check_case(the_case, summary, findings);
    findings.note("no cell is evaluated again: there is no sample that the run has left");
  } else {
    coupler::Checkpoint sample = coupler::read_checkpoint(sample_file);
    check_case(the_case, sample, findings);
    if (sample.program != POLARGRAIN_VERSION) {
      findings.note(
          fmt::format("it was written by version {}; the last bits of cells may differ", sample.program));
    }
    const std::vector<SampledAnswer> answers = answers_of(sample);
    if (answers.empty()) findings.note("the run has no cells, so that no answer can be repeated");
    if (!answers.empty() && findings.good()) check_cells(the_case, answers, options, findings);
  }
  tell(stdout, "{}\n", findings.good() ? "all agrees" : "NOT all agrees");
  return findings.good() ? 0 : 1;
}

Command add_verify(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App& command = *program.add_subcommand(
      "verify", "Hold a result against its proof: files, case, and a sample of cells evaluated again");
  command.add_option("DIR", options->directory, "Results of run")->required();
  add_workers(command, options->workers, 1);
  add_trust(command, options->scripts, grains);
  return {&command, [options] { return verify(*options); }};
}

}  // namespace polargrain::app
