// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/resident_boxes.hpp"

#include "common/error.hpp"

namespace polargrain {

std::unique_ptr<ResidentBoxes> CellService::residents() {
  throw RunError(
      "these cells can only be asked from one state to the next; explicit steps need boxes that stay");
}

}  // namespace polargrain
