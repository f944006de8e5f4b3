// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "coupler/pool/keys.hpp"

namespace polargrain::coupler {

/// Where workers of other machines may come to.
struct Listening {
  std::string url;  ///< tcp://HOST:PORT, tcp://*:PORT for all interfaces
  CoordinatorKeys keys;
};

}  // namespace polargrain::coupler
