// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/sources_elsewhere.hpp"

#include <fmt/format.h>

#include "app/run/result_directory.hpp"
#include "common/error.hpp"
#include "coupler/case/case_identity.hpp"
#include "coupler/case/document_kind.hpp"

namespace polargrain::app {
namespace {

/// A run that starts from its own result directory would erase its start.
void check_start_is_elsewhere(const RunOptions& options, const coupler::Case& the_case,
                              const std::filesystem::path& directory) {
  std::error_code error;
  if (the_case.start_from.empty() || !std::filesystem::equivalent(the_case.start_from, directory, error))
    return;
  throw InputError(
      {options.case_file.string(), 0,
       fmt::format("start_from: {} is the result directory of this run too, which would erase it; "
                   "give another one with -o DIR",
                   directory.string())});
}

/// The same of a file that the case is read with. A run that goes on erases nothing.
void check_files_are_elsewhere(const RunOptions& options, const std::filesystem::path& directory) {
  if (options.resume) return;
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, options.case_file, options.settings);
  for (const std::filesystem::path& file : coupler::files_named_in(document, options.case_file.parent_path()))
    if (std::error_code error; std::filesystem::exists(file, error) && is_of_a_run(file, directory))
      throw InputError(
          {options.case_file.string(), 0,
           fmt::format("{} lies in the result directory of this run, which would erase it; give another "
                       "directory with -o DIR",
                       file.string())});
}

}  // namespace

void check_sources_are_elsewhere(const RunOptions& options, const coupler::Case& the_case,
                                 const std::filesystem::path& directory) {
  check_start_is_elsewhere(options, the_case, directory);
  check_files_are_elsewhere(options, directory);
}

}  // namespace polargrain::app
