// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/switchboard.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

#include "common/error.hpp"
#include "coupler/pool/descriptors.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kSwitchboardMonitorUrl = "inproc://handshakes";

/// Peers refused one by one in the log; of the rest only a count now and then.
constexpr std::size_t kToldSingly = 10;

std::string next_part(zmq::socket_t& socket, bool& more) {
  zmq::message_t part;
  if (!more || !socket.recv(part, zmq::recv_flags::dontwait)) {
    more = false;
    return {};
  }
  more = part.more();
  return part.to_string();
}

}  // namespace

Switchboard::Switchboard(const std::filesystem::path& directory, const std::optional<Listening>& listening,
                         std::function<void(const std::string&)> tell)
    : tell_(std::move(tell)),
      watched_(epoll_create1(EPOLL_CLOEXEC)),
      local_url_("ipc://" + (directory / "coordinator").string()) {
  allow_many_descriptors();  // every worker needs one or two
  local_.set(zmq::sockopt::linger, 0);
  local_.set(zmq::sockopt::router_mandatory, true);
  local_.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kLongestMessage));
  local_.bind(local_url_);
  if (listening) serve_others(*listening);
}

Switchboard::~Switchboard() {
  close(watched_);
}

void check_tcp_url(const std::string& option, const std::string& url) {
  constexpr std::string_view kScheme = "tcp://";
  const std::size_t colon = url.rfind(':');
  const std::string port = colon == std::string::npos ? "" : url.substr(colon + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  const bool is_port = port == "*" || (error == std::errc() && end == port.data() + port.size() &&
                                       number >= 1 && number <= 65535 && port.front() != '-');
  if (url.starts_with(kScheme) && colon != std::string::npos && colon > kScheme.size() && is_port) return;
  throw InputError(
      {"", 0,
       fmt::format("{} {}: expected tcp://HOST:PORT, with a port of 1 to 65535, such as tcp://*:5570", option,
                   url)});
}

void Switchboard::serve_others(const Listening& listening) try {
  check_tcp_url("--listen", listening.url);
  keys_ = listening.keys;
  gate_.emplace(context_, zmq::socket_type::rep);
  gate_->set(zmq::sockopt::linger, 0);
  gate_->bind("inproc://zeromq.zap.01");  // the name is ZeroMQ's own (its RFC 27)
  remote_.emplace(context_, zmq::socket_type::router);
  remote_->set(zmq::sockopt::linger, 5000);  // so that the last Stop goes out, on a busy machine too
  remote_->set(zmq::sockopt::router_mandatory, true);
  remote_->set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kLongestMessage));
  remote_->set(zmq::sockopt::curve_server, true);
  remote_->set(zmq::sockopt::curve_secretkey, keys_.secret_key);
  remote_->set(zmq::sockopt::zap_domain, "polargrain");
  // A machine that falls silent without closing its connections.
  remote_->set(zmq::sockopt::heartbeat_ivl, 2000);
  remote_->set(zmq::sockopt::heartbeat_timeout, 10000);
  remote_->set(zmq::sockopt::backlog, 1024);
  zmq_socket_monitor(remote_->handle(), kSwitchboardMonitorUrl,
                     ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL);
  monitor_.emplace(context_, zmq::socket_type::pair);
  monitor_->set(zmq::sockopt::linger, 0);
  monitor_->connect(kSwitchboardMonitorUrl);
  remote_->bind(listening.url);
} catch (const zmq::error_t& error) {
  throw RunError(fmt::format(
      "cannot listen at {}: {}{}", listening.url, error.what(),
      error.num() == EADDRINUSE ? "; another coordinator or program holds this port, choose another" : ""));
}

std::string Switchboard::remote_url() const {
  return remote_ ? remote_->get(zmq::sockopt::last_endpoint) : std::string();
}

bool Switchboard::send(const Address& to, const std::string& bytes) try {
  zmq::socket_t& socket = to.remote ? *remote_ : local_;
  // A full queue is like a lost message: who is still waited for is sent it again.
  if (!socket.send(zmq::buffer(to.id), zmq::send_flags::sndmore | zmq::send_flags::dontwait)) return true;
  socket.send(zmq::buffer(bytes), zmq::send_flags::dontwait);
  return true;
} catch (const zmq::error_t& error) {
  if (error.num() == EHOSTUNREACH) return false;
  throw RunError(fmt::format("a message to a worker cannot be sent: {}", error.what()));
}

void Switchboard::watch(int descriptor) {
  epoll_event event{};
  event.events = EPOLLIN;
  if (epoll_ctl(watched_, EPOLL_CTL_ADD, descriptor, &event) != 0) {
    throw RunError(fmt::format("cannot watch a worker (epoll_ctl): {}", std::strerror(errno)));
  }
}

bool Switchboard::wait(std::chrono::milliseconds timeout) {
  std::vector<zmq::pollitem_t> items{{nullptr, watched_, ZMQ_POLLIN, 0}, {local_.handle(), 0, ZMQ_POLLIN, 0}};
  if (remote_) {
    for (zmq::socket_t* socket : {&*remote_, &*gate_, &*monitor_}) {
      items.push_back({socket->handle(), 0, ZMQ_POLLIN, 0});
    }
  }
  try {
    zmq::poll(items, timeout);
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw RunError(fmt::format("waiting for the workers failed: {}", error.what()));
    return false;
  }
  if (remote_) {
    judge_keys();
    note_failed_handshakes();
  }
  return items[0].revents != 0;
}

bool Switchboard::receive(Address& from, zmq::message_t& bytes) {
  from.remote = false;
  if (receive_from(local_, from, bytes)) return true;
  from.remote = true;
  return remote_ && receive_from(*remote_, from, bytes);
}

bool Switchboard::receive_from(zmq::socket_t& socket, Address& from, zmq::message_t& bytes) {
  zmq::message_t address;
  if (!socket.recv(address, zmq::recv_flags::dontwait)) return false;
  from.id = address.to_string();
  bytes.rebuild();
  bool more = address.more();
  if (more && socket.recv(bytes)) more = bytes.more();
  // The verdict of judge_keys on the connection.
  const char* const key = from.remote ? zmq_msg_gets(bytes.handle(), "User-Id") : nullptr;
  from.key = key == nullptr ? "" : key;
  while (more) {  // no worker of ours sends a third part; read it away to stay in step
    zmq::message_t rest;
    if (!socket.recv(rest)) break;
    more = rest.more();
  }
  return true;
}

void Switchboard::judge_keys() {
  for (;;) {
    bool more = true;
    const std::string version = next_part(*gate_, more);
    if (version.empty()) return;
    const std::string request = next_part(*gate_, more);
    const std::string domain = next_part(*gate_, more);
    const std::string address = next_part(*gate_, more);
    next_part(*gate_, more);  // the routing id, empty
    const std::string mechanism = next_part(*gate_, more);
    const std::string credentials = next_part(*gate_, more);
    while (more) next_part(*gate_, more);
    std::array<char, 41> key{};
    if (credentials.size() == 32) {
      zmq_z85_encode(key.data(), reinterpret_cast<const std::uint8_t*>(credentials.data()),
                     credentials.size());
    }
    const bool shut_out = shut_out_.contains(key.data());
    const bool welcome = mechanism == "CURVE" && keys_.allowed.contains(key.data()) && !shut_out;
    if (!welcome)
      note_refusal(fmt::format("{}: its key {} is {}", address, key.data(),
                               shut_out ? "shut out of this run" : "not in workers.allowed"));
    const std::array<std::string, 6> answer{"1.0",
                                            request,
                                            welcome ? "200" : "400",
                                            welcome ? "OK" : "this key is not allowed",
                                            welcome ? key.data() : "",
                                            ""};
    for (std::size_t part = 0; part < answer.size(); ++part) {
      gate_->send(zmq::buffer(answer[part]),
                  part + 1 < answer.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
  }
}

void Switchboard::note_failed_handshakes() {
  for (;;) {
    bool more = true;
    const std::string event = next_part(*monitor_, more);
    if (event.empty()) return;
    while (more) next_part(*monitor_, more);
    std::uint16_t kind = 0;
    std::memcpy(&kind, event.data(), std::min(event.size(), sizeof kind));
    note_refusal(
        kind == ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL
            ? "it does not prove a key as this coordinator asks (no key, another coordinator's key, or a "
              "handshake that was recorded)"
            : "it broke off the handshake");
  }
}

void Switchboard::note_refusal(const std::string& who) {
  ++refused_;
  if (refused_ <= kToldSingly)
    tell_(fmt::format("a process that wanted to work for this run was refused: {}", who));
  if (refused_ > kToldSingly && refused_ % 1000 == 0)
    tell_(fmt::format("{} processes were refused", refused_));
}

}  // namespace polargrain::coupler
