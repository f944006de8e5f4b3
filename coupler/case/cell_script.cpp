// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/cell_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "coupler/case/data_files.hpp"

namespace polargrain::coupler {
namespace {

namespace fs = std::filesystem;

constexpr int kMostIncludes = 100;  ///< files; a script that includes itself ends here

/// With `..` and links resolved, so that a link in the folder does not lead out of it.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path.empty() ? fs::path(".") : path, error);
  return error ? fs::absolute(path, error).lexically_normal() : whole;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path inner = resolved(file);
  const fs::path outer = resolved(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// Whether a script of a case may lie there: beside the case, or with what the program brings along.
bool is_at_home(const fs::path& file, const fs::path& case_directory) {
  const std::vector<fs::path> places = data_places(case_directory);
  if (lies_in(file, places.front())) return true;
  return std::any_of(places.begin() + 1, places.end(),
                     [&](const fs::path& place) { return lies_in(file, place / "liggghts_inputs"); });
}

/// The file that a line includes; empty when it includes no file. A word with a variable is no path that is known.
fs::path included(const std::string& line, const fs::path& from) {
  std::istringstream words(line);
  std::string command;
  std::string name;
  std::string more;
  if (!(words >> command >> name) || command != "include" || name.find('$') != std::string::npos) return {};
  if (words >> more && more.front() != '#') return {};
  if (name.size() > 1 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front()) {
    name = name.substr(1, name.size() - 2);
  }
  const fs::path file = from.parent_path() / name;
  std::error_code error;
  return fs::is_regular_file(file, error) ? file : fs::path();
}

/// Adds a script and what it includes to `text`; `files` gets all of them.
void collect(const fs::path& file, std::string& text, std::vector<fs::path>& files) {
  files.push_back(file);
  std::istringstream lines(content_of(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const fs::path inner = included(line, file);
    if (inner.empty() || static_cast<int>(files.size()) >= kMostIncludes) {
      text += line + '\n';
      continue;
    }
    text += fmt::format("{}{}:1\n", kScriptMark, inner.lexically_normal().string());
    collect(inner, text, files);
    text += fmt::format("{}{}:{}\n", kScriptMark, file.lexically_normal().string(), number + 1);
  }
}

/// A script with all that it includes in it; one that includes nothing as it is, to the byte.
std::string put_together(const fs::path& file, std::vector<fs::path>& files) {
  std::string text;
  collect(file, text, files);
  return files.size() == 1 ? content_of(file) : text;
}

}  // namespace

std::string text_of_script(const fs::path& file) {
  std::vector<fs::path> files;
  return put_together(file, files);
}

std::vector<fs::path> files_of_script(const fs::path& file) {
  std::vector<fs::path> files;
  put_together(file, files);
  return files;
}

CellScript read_cell_script(const std::string& key, Section& section, Faults& faults,
                            const CaseFiles& files) {
  const std::string name = section.text(key, "the path of a LIGGGHTS input script for cells");
  if (name.empty()) return {};
  const auto file = find_data_file(name, files.directory);
  if (!file) {
    section.fault(
        key, fmt::format("{}: there is no file '{}', neither beside the case nor below liggghts_inputs/; "
                         "correct the path or put the file there",
                         key, name));
    return {};
  }
  std::vector<fs::path> parts;
  const std::string text = put_together(*file, parts);
  const Entry* const entry = section.find(key);
  const bool named_by_the_user = entry != nullptr && entry->line == 0;  // with --set
  for (const fs::path& part : parts) {
    if (files.scripts.trusted || is_at_home(part, files.directory)) continue;
    if (named_by_the_user && part == *file) continue;
    section.fault(
        key,
        fmt::format("{}: '{}' lies outside the folder of the case, and a script is a program; put it there, "
                    "or give --trust-scripts if you have read it",
                    key, part.lexically_normal().string()));
    return {};
  }
  const std::string found = file->lexically_normal().string();
  if (text.empty()) {
    section.fault(key, fmt::format("{}: the file is empty or cannot be read", key));
    return {};
  }
  const std::vector<Fault> wrong = script_faults(text, found, files.scripts);
  faults.insert(faults.end(), wrong.begin(), wrong.end());
  return {found, std::move(text)};
}

}  // namespace polargrain::coupler
