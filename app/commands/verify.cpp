// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/verify.hpp"

#include <fmt/format.h>
#include <memory>

#include <string>
#include <vector>

#include "app/commands/command.hpp"
#include "app/run/proof.hpp"
#include "app/run/sample.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/document.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {
namespace {

/// What is said, and whether all of it is good.
class Findings {
 public:
  void agrees(const std::string& what) { tell(stdout, "  agrees    {}\n", what); }
  void differs(const std::string& what) {
    tell(stdout, "  DIFFERS   {}\n", what);
    good_ = false;
  }
  void note(const std::string& what) { tell(stdout, "            {}\n", what); }
  [[nodiscard]] bool good() const { return good_; }

 private:
  bool good_ = true;
};

std::string text_of(const coupler::Entry& summary, const std::string& key) {
  const coupler::Entry* const entry = summary.find(key);
  return entry == nullptr ? std::string() : entry->text;
}

void check_results(const coupler::Entry& recorded, const std::filesystem::path& directory,
                   Findings& findings) {
  const std::map<std::string, std::string> now = names_of_results(directory);
  for (const coupler::Entry::Member& member : recorded.members) {
    const auto found = now.find(member.key);
    if (found == now.end()) {
      findings.differs(member.key + " is not there any more");
    } else if (found->second != member.value.text) {
      findings.differs(member.key + " was changed after the run");
    } else {
      findings.agrees(member.key);
    }
  }
}

void check_case(const coupler::Case& now, const coupler::Checkpoint& sample, Findings& findings) {
  const std::vector<std::string> lines = differences(sample.identity, now.identity);
  if (lines.empty()) return findings.agrees(fmt::format("{} and the files it names", now.file.string()));
  for (const std::string& line : lines) findings.differs(line);
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
  std::vector<std::shared_ptr<fem::Material>> materials;
  for (const auto& [region, material] : the_case.problem.materials)
    materials.push_back(the_case.materials.at(the_case.regions.at(region))->make(&pool));
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
  const coupler::Entry summary = coupler::load_document(file);
  const coupler::Entry* const proof = summary.find("proof");
  const coupler::Entry* const results = proof == nullptr ? nullptr : proof->find("results");
  if (results == nullptr) {
    throw InputError(
        {file.string(), 0, "holds no proof; it was written by an older version, which cannot be verified"});
  }
  tell(stdout, "{}: {}, {}\n", options.directory.string(), text_of(summary, "title"),
       text_of(summary, "status"));
  Findings findings;
  if (const coupler::Entry* const limits = summary.find("at_limits")) {
    for (const coupler::Entry::Member& member : limits->members)
      findings.note(fmt::format("region '{}': {}", member.key, member.value.text));
  }
  check_results(*results, options.directory, findings);
  std::vector<std::string> settings;
  if (const coupler::Entry* const list = proof->find("settings")) {
    for (const coupler::Entry& item : list->items) settings.push_back(item.text);
  }
  coupler::Checkpoint sample = coupler::read_checkpoint(options.directory / kSampleFile);
  const coupler::Case the_case = coupler::read_case(text_of(summary, "case"), settings, options.scripts);
  check_case(the_case, sample, findings);
  if (sample.program != POLARGRAIN_VERSION) {
    findings.note(
        fmt::format("it was written by version {}; the last bits of cells may differ", sample.program));
  }
  const std::vector<SampledAnswer> answers = answers_of(sample);
  if (answers.empty()) findings.note("no cell took part: nothing is evaluated again");
  if (!answers.empty() && findings.good()) check_cells(the_case, answers, options, findings);
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
