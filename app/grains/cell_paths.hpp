// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/pool/pool.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Folder of a result directory where it is kept how the cells of all points came to be.
constexpr const char* kCellPathsFolder = "cell_paths";

/// How a state came about: a cell was led along an increment from another one.
struct StateOrigin {
  ContentName start;  ///< of a state that has no origin: the packing at rest
  CellIncrement increment;
};

/// Keeps how each state that a run has committed came about, so that the grains of any point at any step can be made
/// again, to the bit: a hundred bytes a cell and evaluation in the place of its state, which is four hundred times that.
/// Folder cell_paths of docs/file_formats.md.
class CellPathsRecord {
 public:
  /// @param the_case must outlive this. @param from last step of the checkpoint that the run goes on from: records of
  /// later steps are dropped; -1: a new run
  CellPathsRecord(const coupler::Case& the_case, std::filesystem::path directory, int from);

  /// Takes the requests and replies of an evaluation of the pool.
  void take(std::span<const coupler::PoolRequest> requests, std::span<const CellReply> replies);
  /// Records how a committed step came about. @param whole_states points whose states are kept whole
  /// too, which shortens the way to the grains of later steps
  /// @throws RunError when it cannot be written
  template <int dim>
  void write(int step, const fem::Solver<dim>& solver, const std::set<std::size_t>& whole_states = {});

 private:
  template <int dim>
  void write_cells(const fem::Solver<dim>& solver);

  const coupler::Case& case_;
  std::filesystem::path directory_;
  bool cells_are_written_ = false;
  std::unordered_map<ContentName, StateOrigin, ContentNameHash> origins_;  ///< since the last step
};

/// The record left by a CellPathsRecord.
class CellPaths {
 public:
  /// @param directory a result directory @throws InputError when a run has kept nothing there, or it cannot be read
  explicit CellPaths(const std::filesystem::path& directory);

  /// Steps whose grains can be made again, ascending.
  [[nodiscard]] std::vector<int> steps() const;
  [[nodiscard]] std::size_t points() const { return cell_of_point_.size(); }
  /// The cell of a point; null when its material has no cells.
  [[nodiscard]] const CellDefinition* cell(std::size_t point) const;
  /// The element that a point lies in.
  [[nodiscard]] std::int64_t element(std::size_t point) const { return element_of_point_.at(point); }
  /// The names of the states of some points at some steps, and how all of them came about.
  struct Ways {
    std::map<int, std::vector<ContentName>> states;  ///< by step, then as the points were given
    std::map<ContentName, StateOrigin> origins;
    std::map<ContentName, StatePointer> kept;  ///< states on these ways that need not be made again
    /// The run has taken its first states over from another one, which knows how they came to be.
    bool begin_in_other_run = false;
    // A point in neither list is the packing at rest.
  };
  /// @param steps of steps(), at least one @throws InputError when a file of them is missing or cannot be read
  [[nodiscard]] Ways ways(std::span<const std::size_t> points, const std::set<int>& steps) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(int step) const;

  std::filesystem::path folder_;
  std::set<int> steps_;
  bool begins_in_other_run_ = false;
  std::vector<CellDefinition> cells_;
  std::vector<std::int64_t> cell_of_point_;  ///< -1: a point without a cell
  std::vector<std::int64_t> element_of_point_;
};

}  // namespace polargrain::app
