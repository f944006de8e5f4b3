// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "common/cell.hpp"
#include "coupler/pool/keys.hpp"

namespace polargrain::coupler {

/// Most bytes of states a worker keeps, so that they need not be sent again.
inline constexpr std::size_t kWorkerCacheBytes = std::size_t{256} << 20;

struct ServeOptions {
  std::size_t cache_bytes = kWorkerCacheBytes;
  /// Needed for tcp:// URLs: the worker talks to the coordinator that proves this key and to nobody else.
  std::optional<WorkerKey> key = {};
  /// Rights that this process could not give up; see Confinement.
  std::string unconfined = {};
  /// A worker without a connection gives up after so long. A coordinator that is killed and resumed within
  /// this time at the same URL finds its workers again.
  double patience_seconds = 60.0;
};

/// The life of a worker: connects to a coordinator, says Hello until it is welcomed, answers requests one at
/// a time until it is told to stop. Keeps the engines of the definitions it was sent, their resident boxes and a bounded
/// cache of states, nothing else. While an engine works it says so at every heartbeat. Messages that are lost,
/// doubled, out of order or broken on their way do no harm: a request is served once, its answer kept and
/// sent again when it is asked again.
/// @param url the coordinator's endpoint, for example ipc:///tmp/polargrain-a1b2c3/coordinator
/// @throws RunError when the endpoint cannot be used, the coordinator refuses this worker or does not come
/// (back). Exceptions of the service go to the coordinator as refusals and end nothing here.
void serve(const std::string& url, const CellServiceFactory& make_service, const ServeOptions& options = {});

}  // namespace polargrain::coupler
