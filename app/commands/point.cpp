// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/point.hpp"

#include <fmt/format.h>
#include <memory>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/plane_in_space.hpp"
#include "common/record_table.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/pool/private_directory.hpp"
#include "coupler/replay/replay.hpp"

namespace polargrain::app {
namespace {

const std::vector<std::string> kPathColumns = names_of_columns<Increment<2>>();

Increment<2> increment_of(const std::vector<double>& numbers) {
  const RecordValues values{numbers, {}, {}, {}};
  return RecordReader(values, "an increment", true).read<Increment<2>>();
}

/// Where each column of a path file goes in the order of kPathColumns.
std::vector<std::size_t> columns_of(const std::vector<std::string>& names, const Fault& place,
                                    coupler::Faults& faults) {
  std::vector<std::size_t> columns;
  for (const std::string& name : names) {
    const auto known = std::find(kPathColumns.begin(), kPathColumns.end(), name);
    if (known == kPathColumns.end()) {
      faults.push_back({place.file, place.line,
                        fmt::format("there is no column '{}'; expected names out of {}", name,
                                    coupler::listed(kPathColumns))});
    }
    if (std::ranges::count(names, name) > 1 &&
        std::ranges::find(names, name) - names.begin() == static_cast<std::ptrdiff_t>(columns.size()))
      faults.push_back(
          {place.file, place.line, fmt::format("the column '{}' stands there twice; give it once", name)});
    columns.push_back(static_cast<std::size_t>(known - kPathColumns.begin()) % kPathColumns.size());
  }
  return columns;
}

std::string status_of(Quality quality) {
  switch (quality) {
    case Quality::good:
      return "good";
    case Quality::unreliable:
      return "unreliable";
    case Quality::failed:
      break;
  }
  return "failed";
}

/// The answers as CSV, on a file or on standard output.
class AnswerTable {
 public:
  AnswerTable(const std::filesystem::path& file, const std::vector<std::string>& field_names) {
    std::vector<std::string> columns{"increment", "s11", "s22", "s33", "s12", "s21", "m1", "m2", "status"};
    columns.insert(columns.end(), field_names.begin(), field_names.end());
    if (!file.empty()) {
      file_.emplace(file, columns);
    } else {
      row(columns);
    }
  }

  void answer(std::size_t increment, const Response<2>& response, const std::vector<double>& fields) {
    std::vector<std::string> cells{std::to_string(increment)};
    for (const double value : response.stress) cells.push_back(exact(value));
    cells.push_back(status_of(response.quality));
    for (const double value : fields) cells.push_back(exact(value));
    row(cells);
  }

 private:
  void row(const std::vector<std::string>& cells) {
    if (file_) {
      file_->row(cells);
    } else {
      if (!tell(stdout, "{}", csv_row(cells))) throw RunError("standard output takes no more rows");
    }
  }
  std::optional<CsvFile> file_;
};

/// The rows as the case deforms: in large deformation each counts from the shape at its start, and stresses turn.
std::vector<Increment<2>> path_for(const coupler::Case& the_case, const std::filesystem::path& file) {
  std::vector<Increment<2>> path = read_path(file);
  if (the_case.with_problem([](const auto& problem) { return problem.deformation; }) ==
      fem::Deformation::small)
    return path;
  for (Increment<2>& increment : path) increment.configuration = Configuration::start;
  return path;
}

void tell_notes(fem::Material<2>& material) {
  for (const std::string& note : material.take_notes()) tell(stderr, "note: {}\n", note);
}

/// @returns whether every increment was answered
bool follow(fem::Material<2>& material, const std::vector<Increment<2>>& path, AnswerTable& table) {
  material.allocate(1);
  tell_notes(material);
  std::vector<double> fields(material.field_names().size());
  std::size_t unreliable = 0;
  for (std::size_t i = 0; i <= path.size(); ++i) {
    const Increment<2> increment = i == 0 ? Increment<2>{} : path[i - 1];
    Response<2> response;
    material.evaluate({&increment, 1}, {&response, 1});
    if (response.quality != Quality::failed) {
      material.commit();
      material.fields(0, fields);
    }
    tell_notes(material);
    table.answer(i, response, fields);
    if (response.quality == Quality::unreliable) ++unreliable;
    if (response.quality == Quality::failed) {
      tell(stderr, "error: increment {} failed: {}\n", i, response.message);
      return false;
    }
  }
  if (unreliable > 0)
    tell(stderr, "warning: {} of {} answers are unreliable (column status): take smaller increments\n",
         unreliable, path.size() + 1);
  return true;
}

/// The answers of the cell itself along the path, its symmetric or skew stress alone, without the Cosserat part
/// of the case. Ends before an increment that fails.
std::vector<CellResponse> answers_of(coupler::Pool& pool, const CellDefinition& definition,
                                     const std::vector<CellIncrement>& path) {
  const std::uint32_t number = pool.define(definition);
  std::vector<CellResponse> answers;
  StatePointer state;
  for (const CellIncrement& increment : path) {
    const coupler::PoolRequest request{number, {state, increment}};
    const CellReply reply = pool.evaluate({&request, 1}).front();
    if (reply.response.quality == Quality::failed) break;
    state = reply.state;
    answers.push_back(reply.response);
  }
  return answers;
}

/// The case; with a replay the engine's own loop steps the grains, as the replay does, so that both print the same
/// digits.
coupler::Case case_for(const PointOptions& options) {
  coupler::Case plain = coupler::read_case(options.case_file, options.settings, options.scripts);
  const auto recipe = plain.materials.find(options.material);
  if (plain.dimension() == 3 && recipe != plain.materials.end() && recipe->second->cell() == nullptr)
    throw InputError(
        {options.case_file.string(), 0,
         fmt::format(
             "material '{}': 'point' follows paths of the plane, and of a mesh in space it knows 'model: cell' "
             "alone; take 'polargrain element', or a mesh of the plane",
             options.material)});
  if (options.replay.empty() || recipe == plain.materials.end() || recipe->second->cell() == nullptr)
    return plain;
  std::vector<std::string> settings = options.settings;
  settings.push_back(fmt::format("materials.{}.loop=engine", options.material));
  return coupler::read_case(options.case_file, settings, options.scripts);
}

/// A replay has files of usual names: cell.in, README.md. @throws InputError
void check_outputs(const PointOptions& options) {
  std::vector<std::filesystem::path> inputs =
      files_read_with(coupler::DocumentKind::problem, options.case_file, options.settings);
  inputs.push_back(options.path_file);
  check_table("-o", options.output, inputs, "increment,s11,");
  std::error_code error;  // of a folder that does not exist yet
  const bool has_files = std::filesystem::is_directory(options.replay, error) &&
                         !std::filesystem::is_empty(options.replay, error);
  if (has_files && !std::filesystem::exists(options.replay / "in.replay", error))
    throw InputError(
        {"", 0,
         fmt::format("--replay {}: the folder has files in it and no earlier replay; name a new one",
                     plain_text(options.replay.string()))});
}

}  // namespace

std::vector<Increment<2>> read_path(const std::filesystem::path& file) {
  coupler::Faults faults;
  const CsvTable table(file, &faults);
  coupler::Faults of_columns;
  const std::vector<std::size_t> columns =
      columns_of(table.names(), {file.string(), table.line_of_names(), ""}, of_columns);
  if (!of_columns.empty()) throw InputError(of_columns);  // rows of unknown columns say nothing
  std::vector<Increment<2>> increments;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<double> values(kPathColumns.size(), 0.0);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string& cell = table.cell(row, c);
      const auto value = parse_quantity(cell, coupler::Dimension::number);
      if (!value)
        faults.push_back(
            {file.string(), table.line_of(row), fmt::format("expected a number, found '{}'", cell)});
      values[columns[c]] = value.value_or(0.0);
    }
    increments.push_back(increment_of(values));
  }
  if (faults.empty() && increments.empty()) {
    faults.push_back(
        {file.string(), 0,
         fmt::format("holds no increment; expected a line of names out of {} and an increment a line",
                     coupler::listed(kPathColumns))});
  }
  std::ranges::stable_sort(faults, {}, &Fault::line);
  if (!faults.empty()) throw InputError(faults);
  return increments;
}

int point(const PointOptions& options) {
  const coupler::Case the_case = case_for(options);
  check_outputs(options);
  const std::vector<Increment<2>> path = path_for(the_case, options.path_file);
  const auto recipe = the_case.materials.find(options.material);
  if (recipe == the_case.materials.end()) {
    std::vector<std::string> names;
    for (const auto& [name, material] : the_case.materials) names.push_back(name);
    throw InputError(
        {options.case_file.string(), 0,
         fmt::format("has no material '{}'; it has {}", options.material, coupler::listed(names))});
  }
  const CellDefinition* const cell = recipe->second->cell();
  coupler::Replay replay{nullptr, {}, {}, fmt::format("The path {}.", options.path_file.string())};
  for (const Increment<2>& increment : path)
    replay.increments.push_back(in_space(coupler::increment_for_cell(increment)));
  if (!options.replay.empty()) {
    if (cell == nullptr)
      throw InputError(
          {"", 0,
           fmt::format("--replay {}: the material '{}' is not of model cell; there are no grains "
                       "to replay",
                       options.replay.string(), options.material)});
    coupler::write_replay(options.replay, *cell, replay);
  }
  coupler::PrivateDirectory logs;
  std::optional<coupler::Pool> pool;
  if (recipe->second->needs_workers()) {
    coupler::PoolOptions pool_options;
    pool_options.directory = logs.path();
    pool_options.trust_scripts = options.scripts.trusted;
    logs.keep();  // until the end is known: a dead worker's log must be there to be read
    pool.emplace(pool_options);
  }
  const std::shared_ptr<fem::Material<2>> material = recipe->second->make(pool ? &*pool : nullptr);
  AnswerTable table(options.output, material->field_names());
  const bool done = follow(*material, path, table);
  if (!options.replay.empty()) {
    replay.answers = answers_of(*pool, *cell, replay.increments);
    coupler::write_replay(options.replay, *cell, replay);
  }
  logs.keep(false);
  return done ? 0 : 1;
}

Command add_point(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<PointOptions>();
  CLI::App& command = *program.add_subcommand("point", "Take one point of a material along a path");
  add_case(command, options->case_file);
  command.add_option("MATERIAL", options->material, "Name of a material of the case")->required();
  command.add_option("PATH", options->path_file, "CSV: an increment a row, h11,h12,h21,h22,w,k1,k2")
      ->required();
  command.add_option("-o,--output", options->output, "CSV to write [standard output]")->type_name("FILE");
  command
      .add_option("--replay", options->replay,
                  "Also write the path as a folder for polargrain-liggghts (materials of model cell)")
      ->type_name("DIR");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options] { return point(*options); }};
}

}  // namespace polargrain::app
