// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "app/element/read_specification.hpp"
#include "app/remarks/remark.hpp"

namespace polargrain::app {

/// The remarks on a test before it runs, worst first: few grains, units of moduli, the cone of
/// another kind of test, stresses of the wrong sign, a void ratio in per cent.
/// @param document the specifications were read from, one for each pressure
Remarks remarks_on_element(const coupler::Entry& document,
                           std::span<const ElementSpecification> specifications);

}  // namespace polargrain::app
