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

/// Refuses any URL but tcp://HOST:PORT with a port of 1 to 65535, or * for any that is free: the library of the messages takes
/// the remainder of a larger one, and opens a port that nobody named. @param option that gave it, for the message
/// @throws InputError
void check_tcp_url(const std::string& option, const std::string& url);

}  // namespace polargrain::coupler
