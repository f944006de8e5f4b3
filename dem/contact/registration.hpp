// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// Makes this project's contact models known to the engine by name, and their combinations with the stock
/// ones usable in `pair_style gran` and in walls. Call after every creation of an engine, before its script:
/// the engine registers its own styles anew each time.
/// @param record_all also replace the stock combinations by ones that can be recorded (cells need that; the
/// standalone engine keeps the stock code).
void register_contact_models(bool record_all);

}  // namespace polargrain::dem
