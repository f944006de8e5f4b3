// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/pool/pool.hpp"
#include "element/material_point.hpp"

namespace polargrain::coupler {

/// Asks a cell; may be called from the thread of one test (ask_together).
using AskCell = std::function<CellReply(const CellRequest&)>;

/// A cell of grains as the one point of a laboratory test, its rotations free. Increments are about the start of each
/// step: the box follows the deformation whatever its size.
class CellPoint : public element::MaterialPoint {
 public:
  /// @param packing at rest @param dimension of the packing: 2 discs, 3 spheres in space
  CellPoint(AskCell ask, CellReply packing, int dimension)
      : ask_(std::move(ask)),
        room_(dimension == 3 ? element::Room::space : element::Room::discs),
        committed_(std::move(packing)) {}

  [[nodiscard]] element::Room room() const override { return room_; }
  [[nodiscard]] bool is_large() const override { return true; }
  CellResponse initial() override { return committed_.response; }
  CellResponse evaluate(const CellIncrement& increment) override;
  void commit() override { committed_ = trial_; }
  [[nodiscard]] const CellReply& committed() const { return committed_; }
  /// The diagnostics of the cell.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  [[nodiscard]] std::vector<double> fields() const override;

 private:
  AskCell ask_;
  element::Room room_;
  CellReply committed_;
  CellReply trial_;
};

/// Runs several tests side by side over one pool: their requests are put to the pool together, so that its workers share
/// them. Each has a thread, of which one at a time is at work. Results do not depend on how many workers there are.
/// @param definitions of the cells, one a test, from Pool::define
/// @param run called once a test, with its number. An exception of one is thrown on when all have ended
void ask_together(Pool& pool, const std::vector<std::uint32_t>& definitions,
                  const std::function<void(std::size_t test, const AskCell& ask)>& run);

}  // namespace polargrain::coupler
