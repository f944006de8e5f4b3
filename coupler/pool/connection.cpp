// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/connection.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "common/error.hpp"
#include "coupler/pool/descriptors.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {
namespace {
constexpr const char* kMonitorUrl = "inproc://connection";

/// For the connection, and for what the engine opens at a time.
constexpr std::size_t kDescriptors = 8;
}  // namespace

Connection::Connection(const std::string& url, const std::optional<WorkerKey>& key) {
  if (url.rfind("tcp://", 0) == 0 && !key) {
    throw InputError(
        {"", 0,
         fmt::format("{}: a worker that connects over TCP needs --key FILE, made by 'polargrain keys'; "
                     "it takes scripts from nobody who cannot prove to be its coordinator",
                     url)});
  }
  require_descriptors(kDescriptors, "a worker");
  // Messages still unsent when a worker is told to stop are of no use to anybody.
  socket_.set(zmq::sockopt::linger, 0);
  socket_.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kLongestMessage));
  socket_.set(zmq::sockopt::reconnect_ivl, 200);
  socket_.set(zmq::sockopt::reconnect_ivl_max, 2000);
  if (key && url.rfind("tcp://", 0) == 0) {
    socket_.set(zmq::sockopt::curve_publickey, key->public_key);
    socket_.set(zmq::sockopt::curve_secretkey, key->secret_key);
    socket_.set(zmq::sockopt::curve_serverkey, key->coordinator_key);
    socket_.set(zmq::sockopt::heartbeat_ivl, 2000);
    socket_.set(zmq::sockopt::heartbeat_timeout, 10000);
  }
  zmq_socket_monitor(socket_.handle(), kMonitorUrl,
                     ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED |
                         ZMQ_EVENT_HANDSHAKE_FAILED_AUTH | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
                         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL);
  monitor_.set(zmq::sockopt::linger, 0);
  monitor_.connect(kMonitorUrl);
  socket_.connect(url);
}

void Connection::send(const std::string& bytes) {
  // A full queue is like a lost message: the coordinator asks again.
  socket_.send(zmq::buffer(bytes), zmq::send_flags::dontwait);
}

bool Connection::receive(zmq::message_t& bytes, std::chrono::milliseconds timeout) {
  std::array<zmq::pollitem_t, 2> items{
      {{socket_.handle(), 0, ZMQ_POLLIN, 0}, {monitor_.handle(), 0, ZMQ_POLLIN, 0}}};
  zmq::poll(items, timeout);
  if (items[1].revents != 0) note_events();
  return items[0].revents != 0 && socket_.recv(bytes, zmq::recv_flags::dontwait).has_value();
}

double Connection::lost_seconds() const {
  if (!lost_) return 0.0;
  return seconds_since(*lost_);
}

void Connection::note_events() {
  for (zmq::message_t part; monitor_.recv(part, zmq::recv_flags::dontwait);) {
    std::uint16_t event = 0;
    std::memcpy(&event, part.data(), std::min(part.size(), sizeof event));
    if (part.more()) static_cast<void>(monitor_.recv(part));  // the endpoint
    if (event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
      lost_.reset();
      renewed_ = true;
      stranger_ = false;
      continue;
    }
    if (!lost_) lost_ = Clock::now();
    if (event == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH) refused_ = true;
    if (event == ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL || event == ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL) {
      stranger_ = true;
    }
  }
}

}  // namespace polargrain::coupler
