// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <zmq.hpp>

#include "common/seconds.hpp"
#include "coupler/pool/keys.hpp"

namespace polargrain::coupler {

/// A worker's end of the line to its coordinator. Reconnects by itself; knows for how long nobody was there.
class Connection {
 public:
  /// @throws InputError when the URL needs a key and the key is missing; RunError when it cannot be used at all
  Connection(const std::string& url, const std::optional<WorkerKey>& key);

  void send(const std::string& bytes);
  /// Waits so long for a message. @returns whether there is one
  bool receive(zmq::message_t& bytes, std::chrono::milliseconds timeout);

  /// Whether a connection was made since the last call: the first one, or a new one after a loss.
  bool renewed() { return std::exchange(renewed_, false); }
  /// How long there has been no connection, in s; 0 while there is one.
  [[nodiscard]] double lost_seconds() const;
  /// Whether the other side has refused this worker's key.
  [[nodiscard]] bool refused() const { return refused_; }
  /// Whether the last attempt met somebody who could not prove to be the coordinator of the key file.
  [[nodiscard]] bool met_a_stranger() const { return stranger_; }

 private:
  void note_events();

  zmq::context_t context_;
  zmq::socket_t socket_{context_, zmq::socket_type::dealer};
  zmq::socket_t monitor_{context_, zmq::socket_type::pair};
  std::optional<Clock::time_point> lost_ = Clock::now();
  bool renewed_ = false;
  bool refused_ = false;
  bool stranger_ = false;
};

}  // namespace polargrain::coupler
