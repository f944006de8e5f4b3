// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "app/remarks/remark.hpp"
#include "common/packing.hpp"
#include "coupler/case/document.hpp"

namespace polargrain::app {

/// A remark on a box that is narrow or has fewer grains than `least`; nothing for others.
/// @param place of the packing in its file @param whose begins the finding: "material 'sand'"
std::optional<Remark> remark_on_grains(const Packing& packing, const coupler::Entry& place,
                                       const std::string& whose, int least);

}  // namespace polargrain::app
