// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>

#include "common/cell.hpp"

namespace polargrain::coupler {

/// Most bytes of states a worker keeps, so that they need not be sent again.
inline constexpr std::size_t kWorkerCacheBytes = std::size_t{256} << 20;

/// The life of a worker: connects to a coordinator, says Hello, answers requests one at a time until it is
/// told to stop. Keeps the engines of the definitions it was sent and a bounded cache of states, nothing
/// else.
/// @param url the coordinator's endpoint, for example ipc:///tmp/polargrain-a1b2c3/coordinator
/// @throws ProtocolError when the coordinator sends something that is no message; RunError when the endpoint
/// cannot be used. Exceptions of the service go to the coordinator as refusals and end nothing here.
void serve(const std::string& url, const CellServiceFactory& make_service,
           std::size_t cache_bytes = kWorkerCacheBytes);

}  // namespace polargrain::coupler
