// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <span>

#include "common/cell.hpp"
#include "common/grain_view.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/engine.hpp"  // start_engine_process

namespace polargrain::dem {

/// A cell whose grains and contacts can be looked at.
class CellOfGrains : public CellService, public ShowsGrains {
 public:
  /// Of the last force pass; valid until the next evaluation.
  [[nodiscard]] virtual std::span<const Contact> contacts() const = 0;
};

/// A LIGGGHTS engine that stands in for the cells of one definition (docs/theory/grains.md, C.6). Several may live in one
/// process, each with an engine of its own; those that the loop over discs steps may be asked from different threads.
std::unique_ptr<CellOfGrains> make_cell_service(const CellDefinition& definition);

}  // namespace polargrain::dem
