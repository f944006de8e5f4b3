// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coupler/cells/resident_record.hpp"
#include "coupler/pool/resident_team.hpp"

namespace polargrain::coupler {

/// The resident boxes of one material, whatever becomes of their workers: keeps where they were read out last and the
/// increments since. When a worker is lost all boxes move in there again and repeat those steps, which comes to the
/// same bits; the user is told. When workers have joined, boxes move to them where few steps are to be repeated.
///
/// Order of calls: start, then any number of go_on and read_out; start again at any time.
///
/// @throws RunError when a worker refuses its boxes; ResidentsLost when workers are lost ten times in one call
class ResidentCells {
 public:
  /// Bytes of recorded increments, from which on the boxes are read out to begin a new record.
  static constexpr std::size_t kMostRecorded = std::size_t{1} << 28;

  /// @param pool must outlive the boxes @param definition from Pool::define @param most_recorded see kMostRecorded
  ResidentCells(Pool& pool, std::uint32_t definition, std::size_t most_recorded = kMostRecorded);

  /// The boxes begin there, in the place of any there were. Asks no worker yet. @param starts their states have bytes
  void start(std::span<const ResidentStart> starts);
  /// See ResidentBoxes::go_on. @returns an answer a box
  std::vector<ResidentAnswer> go_on(int dem_steps, std::span<const CellIncrement> increments);
  /// See ResidentBoxes::read_out: all boxes, with the bytes of their states. A replay begins here from now on.
  std::vector<ResidentReadOut> read_out();
  /// See ResidentBoxes::time_step; the boxes move in for it.
  double time_step();

 private:
  /// Calls with all boxes in their place: moved in, and led as far as they were.
  template <class Call>
  auto with_all_there(const Call& call);

  Pool& pool_;
  ResidentTeam team_;
  std::size_t most_recorded_;
  std::vector<ResidentStart> starts_;  ///< of the record
  ResidentRecord record_;
  bool are_there_ = false;
};

}  // namespace polargrain::coupler
