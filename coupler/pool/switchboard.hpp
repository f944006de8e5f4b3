// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <compare>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "coupler/pool/listening.hpp"

namespace polargrain::coupler {

/// The sender or receiver of a message.
struct Address {
  bool remote = false;
  std::string id = {};
  std::string key = {};  ///< that a remote one has proved to hold
  auto operator<=>(const Address&) const = default;
};

/// The coordinator's sockets. Local workers come by a socket in a directory that only the user can enter; all
/// others by TCP, and there only with a key of the allow list (CURVE, ZAP): a refused connection is counted and
/// reported, and never becomes a message.
class Switchboard {
 public:
  /// @param tell gets a line about peers that were refused
  /// @throws RunError when a socket cannot be opened, in particular when another program holds the port
  Switchboard(const std::filesystem::path& directory, const std::optional<Listening>& listening,
              std::function<void(const std::string&)> tell);
  ~Switchboard();
  Switchboard(const Switchboard&) = delete;
  Switchboard& operator=(const Switchboard&) = delete;

  [[nodiscard]] const std::string& local_url() const { return local_url_; }
  /// Where others may come to, with the port chosen when the URL left it open (tcp://...:*); empty when not
  /// listening.
  [[nodiscard]] std::string remote_url() const;
  /// Nobody comes in with this key any more; who is in stays.
  void shut_out(const std::string& key) { shut_out_.insert(key); }
  /// @returns false when nobody is (any more) at that address
  bool send(const Address& to, const std::string& bytes);
  /// Waits for this descriptor too from now on, until it is closed.
  void watch(int descriptor);
  /// Waits until a message is there, a watched descriptor becomes readable, or the time is over.
  /// @returns whether a watched descriptor is readable
  bool wait(std::chrono::milliseconds timeout);
  /// The next message, if there is one. Does not wait.
  bool receive(Address& from, zmq::message_t& bytes);
  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  void serve_others(const Listening& listening);
  void judge_keys();
  void note_failed_handshakes();
  void note_refusal(const std::string& who);
  static bool receive_from(zmq::socket_t& socket, Address& from, zmq::message_t& bytes);

  std::function<void(const std::string&)> tell_;
  /// The watched descriptors behind a single one, so that waiting costs the same however many there are.
  int watched_ = -1;
  zmq::context_t context_;
  zmq::socket_t local_{context_, zmq::socket_type::router};
  std::optional<zmq::socket_t> gate_;     ///< asked by ZeroMQ whether a key may enter
  std::optional<zmq::socket_t> monitor_;  ///< told by ZeroMQ of handshakes that fail
  std::optional<zmq::socket_t> remote_;
  CoordinatorKeys keys_;
  std::set<std::string> shut_out_;  ///< of the keys
  std::string local_url_;
  std::size_t refused_ = 0;
};

}  // namespace polargrain::coupler
