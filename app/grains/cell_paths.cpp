// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/grains/cell_paths.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <optional>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "common/record_archive.hpp"
#include "coupler/cells/grains_of_points.hpp"
#include "coupler/checkpoint/checkpoint.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCellsFile = "cells.h5";
constexpr const char* kStem = "step-";
/// Numbers of an increment: displacement gradient, rotation, curvature.
constexpr std::size_t kNumbers = 21;

fs::path step_file(const fs::path& folder, int step) {
  return folder / fmt::format("{}{:05}.h5", kStem, step);
}

/// The step of a file of that folder; nothing when it is another file.
std::optional<int> step_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t begin = std::char_traits<char>::length(kStem);
  if (file.extension() != ".h5" || !stem.starts_with(kStem)) return std::nullopt;
  int step = 0;
  const char* const end = stem.data() + stem.size();
  const auto [read_to, error] = std::from_chars(stem.data() + begin, end, step);
  if (error != std::errc() || read_to != end) return std::nullopt;
  return step;
}

std::array<double, kNumbers> numbers_of(const CellIncrement& increment) {
  std::array<double, kNumbers> numbers{};
  Eigen::Map<Eigen::Matrix3d>(numbers.data()) = increment.displacement_gradient;
  Eigen::Map<Eigen::Vector3d>(numbers.data() + 9) = increment.rotation;
  Eigen::Map<Eigen::Matrix3d>(numbers.data() + 12) = increment.curvature;
  return numbers;
}

CellIncrement increment_of(const std::array<double, kNumbers>& numbers) {
  CellIncrement increment;
  increment.displacement_gradient = Eigen::Map<const Eigen::Matrix3d>(numbers.data());
  increment.rotation = Eigen::Map<const Eigen::Vector3d>(numbers.data() + 9);
  increment.curvature = Eigen::Map<const Eigen::Matrix3d>(numbers.data() + 12);
  return increment;
}

/// Names as two whole numbers each.
/// Of the definitions: the run goes on from the end of another one.
constexpr const char* kBeginsInOtherRun = "begins_in_other_run";

class NameList {
 public:
  void add(const ContentName& name) {
    numbers_.push_back(std::bit_cast<std::int64_t>(name.high));
    numbers_.push_back(std::bit_cast<std::int64_t>(name.low));
  }
  void write(ArchiveWriter& archive, const std::string& what) const {
    archive.write(what, std::span<const std::int64_t>(numbers_));
  }

 private:
  std::vector<std::int64_t> numbers_;
};

std::vector<ContentName> read_names(ArchiveReader& archive, const std::string& what) {
  const std::vector<std::int64_t> numbers = archive.integers(what);
  std::vector<ContentName> names;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
    names.push_back({std::bit_cast<std::uint64_t>(numbers[k]), std::bit_cast<std::uint64_t>(numbers[k + 1])});
  return names;
}

/// Of a plane run two thirds of the numbers of an increment are always zero: a column of zeros is not written.
std::string column_name(std::size_t number) {
  return fmt::format("increment_{:02}", number);
}

void write_file_of(const fs::path& file, MemoryArchive&& archive) {
  coupler::Checkpoint content;
  content.program = POLARGRAIN_VERSION;
  content.state = std::move(archive);
  coupler::write_checkpoint(file, content, Durability::system);
}

std::map<ContentName, StateOrigin> read_origins(MemoryArchive& archive) {
  const std::vector<ContentName> made = read_names(archive, "made");
  const std::vector<ContentName> starts = read_names(archive, "starts");
  if (starts.size() != made.size()) throw RunError("its lists are of different lengths");
  std::vector<std::array<double, kNumbers>> numbers(made.size());
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const auto column = archive.all_doubles().find(column_name(i));
    if (column == archive.all_doubles().end()) continue;
    if (column->second.size() != made.size()) throw RunError("its lists are of different lengths");
    for (std::size_t k = 0; k < made.size(); ++k) numbers[k][i] = column->second[k];
  }
  std::map<ContentName, StateOrigin> origins;
  for (std::size_t k = 0; k < made.size(); ++k) origins[made[k]] = {starts[k], increment_of(numbers[k])};
  return origins;
}

/// @throws InputError naming the file
template <class Read>
auto read_content(const fs::path& file, Read read) {
  coupler::Checkpoint content = coupler::read_checkpoint(file);
  try {
    return read(content.state);
  } catch (const RunError& error) {
    throw InputError({file.string(), 0, fmt::format("cannot be used: {}", error.what())});
  }
}

}  // namespace

CellPathsRecord::CellPathsRecord(const coupler::Case& the_case, fs::path directory, int from)
    : case_(the_case), directory_(std::move(directory)) {
  if (from < 0) return;
  std::error_code error;
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(directory_ / kCellPathsFolder, error))
    if (const auto step = step_of(entry.path()); step && *step > from) later.push_back(entry.path());
  for (const fs::path& file : later) fs::remove(file, error);
}

void CellPathsRecord::take(std::span<const coupler::PoolRequest> requests,
                           std::span<const CellReply> replies) {
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (!replies[k].state) continue;
    const CellRequest& cell = requests[k].cell;
    const ContentName start = cell.state ? cell.state->name() : ContentName{};
    if (replies[k].state->name() == start) continue;  // nothing has happened to its grains
    origins_.try_emplace(replies[k].state->name(), StateOrigin{start, cell.increment});
  }
}

template <int dim>
void CellPathsRecord::write_cells(const fem::Solver<dim>& solver) {
  std::vector<CellDefinition> cells;
  std::map<const fem::Material<dim>*, std::int64_t> numbers;
  for (const auto& [region, material] : solver.problem().materials) {
    const CellDefinition* const cell = case_.materials.at(case_.regions.at(region))->grains();
    if (cell == nullptr || dynamic_cast<const coupler::GrainsOfPoints*>(material.get()) == nullptr) continue;
    numbers[material.get()] = static_cast<std::int64_t>(cells.size());
    cells.push_back(*cell);
  }
  std::vector<std::int64_t> of_points;
  std::vector<std::int64_t> elements;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto found = numbers.find(solver.material_of_point(point).first);
    of_points.push_back(found == numbers.end() ? -1 : found->second);
    elements.push_back(solver.element_of_point(point));
  }
  MemoryArchive archive;
  const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(cells.size())};
  archive.write("count", std::span<const std::int64_t>(count));
  archive.write("cell_of_point", std::span<const std::int64_t>(of_points));
  archive.write("element_of_point", std::span<const std::int64_t>(elements));
  write_records(archive, "cells", std::span<const CellDefinition>(cells));
  if (!case_.start_from.empty()) archive.write(kBeginsInOtherRun, std::span<const std::int64_t>(count));
  fs::remove(directory_ / kCellPathsFolder / kCellsFile);
  write_file_of(directory_ / kCellPathsFolder / kCellsFile, std::move(archive));
}

template <int dim>
void CellPathsRecord::write(int step, const fem::Solver<dim>& solver,
                            const std::set<std::size_t>& whole_states) {
  if (!case_.needs_workers()) return;
  const fs::path folder = directory_ / kCellPathsFolder;
  std::error_code error;
  fs::create_directory(folder, error);  // write_checkpoint says when it is not there
  if (!cells_are_written_) write_cells(solver);
  cells_are_written_ = true;

  NameList of_points;
  std::vector<StatePointer> whole;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto [material, number] = solver.material_of_point(point);
    const auto* const grains = dynamic_cast<const coupler::GrainsOfPoints*>(material);
    const StatePointer state = grains == nullptr ? nullptr : grains->grains_of(number);
    of_points.add(state ? state->name() : ContentName{});
    if (state && whole_states.count(point) > 0) whole.push_back(state);
  }
  // All that later steps may start from, which is more than the points show: cells that follow points to measure errors.
  MemoryArchive committed;
  solver.save(committed);
  NameList made;
  NameList starts;
  std::array<std::vector<double>, kNumbers> columns;
  const auto add_ways_to = [&](ContentName name) {
    for (auto found = origins_.find(name); found != origins_.end(); found = origins_.find(name)) {
      made.add(name);
      starts.add(found->second.start);
      const std::array<double, kNumbers> numbers = numbers_of(found->second.increment);
      for (std::size_t i = 0; i < kNumbers; ++i) columns[i].push_back(numbers[i]);
      name = found->second.start;
      origins_.erase(found);  // each once
    }
  };
  for (const auto& [what, states] : committed.all_states())
    for (const StatePointer& state : states)
      if (state) add_ways_to(state->name());
  origins_.clear();

  MemoryArchive archive;
  of_points.write(archive, "points");
  made.write(archive, "made");
  starts.write(archive, "starts");
  for (std::size_t i = 0; i < kNumbers; ++i)
    if (std::ranges::any_of(columns[i], [](double value) { return value != 0.0; }))
      archive.write(column_name(i), std::span<const double>(columns[i]));
  archive.write("states", std::span<const StatePointer>(whole));
  write_file_of(step_file(folder, step), std::move(archive));
}

template void CellPathsRecord::write<2>(int step, const fem::Solver<2>& solver,
                                        const std::set<std::size_t>& whole_states);
template void CellPathsRecord::write<3>(int step, const fem::Solver<3>& solver,
                                        const std::set<std::size_t>& whole_states);

CellPaths::CellPaths(const fs::path& directory) : folder_(directory / kCellPathsFolder) {
  if (!fs::exists(directory))
    throw InputError(
        {directory.string(), 0, "there is no such directory; give the result directory of a run"});
  if (!fs::exists(folder_ / kCellsFile))
    throw InputError({directory.string(), 0,
                      "has no records of its cells (cell_paths): its case has no material with "
                      "cells, the run has not committed a step, or an older version made it"});
  read_content(folder_ / kCellsFile, [&](MemoryArchive& archive) {
    const std::vector<std::int64_t> count = archive.integers("count");
    begins_in_other_run_ = archive.all_integers().contains(kBeginsInOtherRun);
    cell_of_point_ = archive.integers("cell_of_point");
    element_of_point_ = archive.integers("element_of_point");
    if (element_of_point_.size() != cell_of_point_.size())
      throw RunError("its lists are of different lengths");
    if (count.size() != 1 || count[0] < 0 || count[0] > static_cast<std::int64_t>(cell_of_point_.size()))
      throw RunError("it does not say how many cells it has");
    cells_ = read_records<CellDefinition>(archive, "cells", static_cast<std::size_t>(count[0]));
    for (const std::int64_t cell : cell_of_point_)
      if (cell < -1 || cell >= count[0]) throw RunError("a point has a cell that is not there");
  });
  for (const auto& entry : fs::directory_iterator(folder_))
    if (const auto step = step_of(entry.path())) steps_.insert(*step);
}

std::vector<int> CellPaths::steps() const {
  return {steps_.begin(), steps_.end()};
}

const CellDefinition* CellPaths::cell(std::size_t point) const {
  const std::int64_t number = cell_of_point_.at(point);
  return number < 0 ? nullptr : &cells_[static_cast<std::size_t>(number)];
}

CellPaths::Ways CellPaths::ways(std::span<const std::size_t> points, const std::set<int>& steps) const {
  Ways ways;
  ways.begin_in_other_run = begins_in_other_run_;
  std::set<ContentName> wanted;  // whose origin stands in an earlier file
  std::set<ContentName> asked_for;
  for (int step = *steps.rbegin(); step >= 0; --step) {
    const bool is_asked_for = steps.count(step) > 0;
    if (steps_.count(step) == 0 || (!is_asked_for && wanted.empty())) continue;
    read_content(step_file(folder_, step), [&](MemoryArchive& archive) {
      if (is_asked_for) {
        const std::vector<ContentName> of_points = read_names(archive, "points");
        if (of_points.size() != cell_of_point_.size()) throw RunError("it is of another number of points");
        for (const std::size_t point : points) {
          ways.states[step].push_back(of_points[point]);
          wanted.insert(of_points[point]);
          asked_for.insert(of_points[point]);
        }
      }
      for (const StatePointer& state : archive.states("states"))
        if (state && wanted.count(state->name()) > 0) ways.kept[state->name()] = state;
      const std::map<ContentName, StateOrigin> origins = read_origins(archive);
      const std::set<ContentName> sought = std::exchange(wanted, {});
      for (ContentName name : sought) {
        for (;;) {
          if (ways.origins.count(name) > 0) break;  // that way is known
          // The last piece of the way to a state that is asked for is always gone: the read-out is at its end.
          if (ways.kept.count(name) > 0 && asked_for.count(name) == 0) break;
          const auto found = origins.find(name);
          if (found == origins.end()) {
            wanted.insert(name);
            break;
          }
          ways.origins.insert(*found);
          name = found->second.start;
        }
      }
    });
  }
  return ways;
}

}  // namespace polargrain::app
