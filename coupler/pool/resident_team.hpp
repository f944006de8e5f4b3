// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/resident_boxes.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

/// The resident boxes of a definition, spread over the workers of a pool: each worker has an even share of boxes that
/// follow each other, and gets one message a step. Numbers of boxes count over all workers; their bits do not depend on
/// who has them.
///
/// Order of calls: move_in, then any number of go_on and read_out. A definition has one team. Answers are not checked
/// by second workers (PoolOptions::check_share).
///
/// @throws ResidentsLost when a worker is lost that has boxes: move_in is then to be called again. @throws RunError when
/// a worker refuses its boxes, in its words; the pool can then only be destroyed
class ResidentTeam {
 public:
  /// @param pool must outlive the team @param definition from Pool::define
  ResidentTeam(Pool& pool, std::uint32_t definition) : pool_(pool), definition_(definition) {}

  /// Spreads boxes over the workers there are; boxes that moved in before go. @param starts their states have bytes
  void move_in(std::span<const ResidentStart> starts);
  /// Carries each box along its increment; see ResidentBoxes::go_on. @returns an answer a box
  std::vector<ResidentAnswer> go_on(int dem_steps, std::span<const CellIncrement> increments);
  /// Everything about each box, with the bytes of its state; see ResidentBoxes::read_out.
  std::vector<ResidentReadOut> read_out();
  /// Whether there are workers now that boxes could have moved to as well.
  [[nodiscard]] bool could_spread() const;
  /// Duration of a DEM step of the packing at rest, s, as the workers have told it (ResidentBoxes::time_step).
  [[nodiscard]] double time_step() const { return time_step_; }
  /// Boxes that have moved in.
  [[nodiscard]] std::size_t count() const;

 private:
  struct Share {
    std::uint64_t worker = 0;
    std::size_t first = 0;
    std::size_t count = 0;
  };
  /// One message for so many boxes of a share, counted from its first one.
  template <class Request>
  [[nodiscard]] ResidentWork work_for(const Share& share, std::size_t first, std::size_t count,
                                      Request request) const;
  void serve(std::vector<ResidentWork>& works);

  Pool& pool_;
  std::uint32_t definition_;
  std::vector<Share> shares_;
  std::size_t workers_ = 0;  ///< there were when the boxes moved in
  double time_step_ = 0.0;
};

}  // namespace polargrain::coupler
