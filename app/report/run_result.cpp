// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/run_result.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/words.hpp"
#include "coupler/case/columns_of_steps.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

/// A table that may not be there yet, or hold no row yet.
std::optional<CsvTable> table_of(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  std::vector<Fault> of_rows;  // the last row of a run at work may be half written
  CsvTable table(file, &of_rows);
  return table;
}

/// The number that all of a word is; a comma or colon behind it does not count.
template <class Number>
std::optional<Number> number_of(std::string_view word) {
  if (word.ends_with(',') || word.ends_with(':')) word.remove_suffix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// "iteration 3: force residual 1e-2, moment residual 2e-3"
std::optional<LoggedIteration> iteration_of(const std::vector<std::string>& words, int step) {
  if (words.size() != 8 || words[0] != "iteration" || words[2] != "force" || words[5] != "moment")
    return std::nullopt;
  const std::optional<int> number = number_of<int>(words[1]);
  const std::optional<double> force = number_of<double>(words[4]);
  const std::optional<double> moment = number_of<double>(words[7]);
  if (!number || !force || !moment) return std::nullopt;
  return LoggedIteration{step, *number, *force, *moment};
}

/// Takes iterations and warnings out of run.log.
void read_log(const fs::path& file, RunResult& result) {
  const std::string mark = "] [run] [";  // behind the time, before the level
  std::ifstream in(file);
  int step = -1;
  for (std::string line; std::getline(in, line);) {
    const std::size_t level_begin = line.find(mark) + mark.size();
    const std::size_t level_end = line.find("] ", level_begin);
    if (line.rfind('[', 0) != 0 || line.find(mark) == std::string::npos || level_end == std::string::npos) {
      if (!result.warnings.empty() && !line.empty()) result.warnings.back().text += '\n' + line;
      continue;
    }
    const std::string level = line.substr(level_begin, level_end - level_begin);
    const std::string text = line.substr(level_end + 2);
    if (result.head.empty()) result.head = text;
    const std::vector<std::string> words = words_of(text);
    if (words.size() == 2 && words[0] == "step" && number_of<int>(words[1])) {
      step = *number_of<int>(words[1]);
    } else if (const std::optional<LoggedIteration> iteration = iteration_of(words, step)) {
      result.iterations.push_back(*iteration);
    } else if (level != "info") {
      result.warnings.push_back({step, text.substr(std::min(text.find_first_not_of(' '), text.size()))});
    }
  }
}

}  // namespace

std::string RunResult::title() const {
  if (summary.is_object()) return summary.value("title", name);
  const std::size_t colon = head.find(": ");
  return colon == std::string::npos ? name : head.substr(colon + 2, head.rfind(" (") - colon - 2);
}

std::vector<std::string> RunResult::value_names() const {
  if (!history) return {};
  const std::vector<std::string>& all = history->names();
  auto last = std::ranges::find(all, "error_estimate");  // of explicit steps only
  if (last == all.end()) last = std::ranges::find(all, "jump_residual");
  if (last != all.end() && last + 1 != all.end() && *(last + 1) == coupler::kStageColumn) ++last;
  return last == all.end() ? all : std::vector<std::string>(last + 1, all.end());
}

bool is_at_work(const fs::path& directory) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return locked;
}

RunResult read_result(const fs::path& directory) {
  RunResult result;
  result.directory = directory;
  result.name = fs::absolute(directory).lexically_normal().filename().string();
  if (result.name.empty()) result.name = fs::absolute(directory).parent_path().filename().string();
  result.is_at_work = is_at_work(directory);
  std::error_code error;
  if (!fs::exists(directory / "history.csv", error) && !fs::exists(directory / "run.log", error))
    throw InputError(
        {directory.string(), 0,
         "holds no result of `polargrain run` (there is neither history.csv nor run.log); name the "
         "directory that was given to it with -o"});
  result.history = table_of(directory / "history.csv");
  result.costs = table_of(directory / "costs.csv");
  // The summary of a former run, that one at work goes on from, would tell of other steps.
  if (const fs::path file = directory / "summary.json"; why_no_input(file).empty() && !result.is_at_work) {
    std::ifstream in(file);
    result.summary = nlohmann::ordered_json::parse(in, nullptr, false);
    if (result.summary.is_discarded())
      throw InputError({(directory / "summary.json").string(), 0, "is no JSON: it was cut or changed"});
  }
  if (const fs::path log = directory / "run.log"; why_no_input(log).empty()) read_log(log, result);
  for (const auto& entry : fs::directory_iterator(directory / "fields", error)) {
    const std::string stem = entry.path().stem().string();
    int step = 0;
    const char* const end = stem.data() + stem.size();
    if (entry.path().extension() == ".vtu" && stem.rfind("step-", 0) == 0 &&
        std::from_chars(stem.data() + 5, end, step).ptr == end)
      result.fields.emplace_back(step, entry.path());
  }
  std::ranges::sort(result.fields);
  return result;
}

}  // namespace polargrain::app
