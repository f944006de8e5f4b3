// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <memory>

#include "app/grains/cell_paths.hpp"
#include "common/cell.hpp"
#include "common/grain_view.hpp"

namespace polargrain::app {

/// Makes the states of one point again, one after the other, and shows their grains. To the bit: each state must come out
/// with the name that the run gave it. In the process that has the engine.
class GrainReplay {
 public:
  /// @param make of an engine for a definition, whose script is checked already @param ways must outlive this
  GrainReplay(const CellDefinition& cell, CellServiceFactory make, const CellPaths::Ways& ways);

  /// @param state of the ways given @throws RunError when it does not come out as it was, or the engine shows no grains
  GrainView view(const ContentName& state);

 private:
  void start_from_packing();
  void evaluate(const ContentName& from, const ContentName& to);

  CellDefinition cell_;
  CellServiceFactory make_;
  const CellPaths::Ways& ways_;
  std::unique_ptr<CellService> engine_;
  ContentName packing_;
  ContentName shown_;  ///< the state that the engine would show now
  std::map<ContentName, StatePointer> made_;
};

}  // namespace polargrain::app
