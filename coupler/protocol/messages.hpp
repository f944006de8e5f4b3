// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "common/cell.hpp"

namespace polargrain::coupler {

/// Raised with every change of the messages; peers of different versions refuse each other.
inline constexpr std::uint32_t kProtocolVersion = 4;

/// No message is longer; longer ones are refused before they are read.
inline constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

/// The bytes received are no message of this protocol, or a message that must not be used.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Worker to coordinator, again and again until it is welcomed, and whenever it has heard nothing for long.
struct Hello {
  std::uint32_t version = kProtocolVersion;
  std::int64_t process = 0;  ///< process id of the worker on its machine
  std::string host = {};     ///< name of that machine, for messages to the user
};

/// Coordinator to worker: end, and why when it is not the end of the run.
struct Stop {
  std::string reason = {};
};

/// Coordinator to worker: its Hello was accepted. Whatever the worker keeps from another session is void.
struct Welcome {
  double heartbeat_seconds = 1.0;  ///< while it works the worker says Working at least so often
};

/// Coordinator to worker: what the cells numbered `definition` are. Sent before their first request.
struct Define {
  std::uint32_t definition = 0;
  CellDefinition cell;
};

/// Coordinator to worker: the packing at rest (CellService::initial).
struct InitialRequest {
  std::uint64_t request = 0;  ///< number that the answer repeats
  std::uint32_t definition = 0;
};

/// Coordinator to worker: CellService::evaluate.
struct EvaluateRequest {
  std::uint64_t request = 0;
  std::uint32_t definition = 0;
  bool from_packing = false;  ///< start from the packing; `base` and `state` are then unused
  ContentName base;           ///< name of the state to start from
  StatePointer state;         ///< that state when its bytes travel along, else null
  Increment increment;
};

/// Worker to coordinator: the answer to an InitialRequest or EvaluateRequest.
struct Reply {
  std::uint64_t request = 0;
  CellReply cell;
};

/// Worker to coordinator: a request cannot be served before what it names is sent (again).
struct Missing {
  std::uint64_t request = 0;
  bool definition = false;  ///< its Define is missing; else the bytes of the state it starts from
};

/// Worker to coordinator, from inside the engine: the request is being worked on.
struct Working {
  std::uint64_t request = 0;
};

/// Worker to coordinator: the request cannot be served, and why.
struct Refusal {
  std::uint64_t request = 0;
  std::string message;
};

/// Hello and Stop keep their places and their first members for ever: they are what versions say to each
/// other.
using Message = std::variant<Hello, Stop, Welcome, Define, InitialRequest, EvaluateRequest, Reply, Missing,
                             Working, Refusal>;

/// A message and the session it belongs to: a number that each coordinator draws for itself, so that nothing
/// meant for another run, or recorded from one, is taken for an answer. 0 in a Hello, which comes before any
/// session.
struct Envelope {
  std::uint64_t session = 0;
  Message message;
};

/// @returns the message as msgpack: an array of its kind (its place in Message), its members and the session.
std::string encode(const Message& message, std::uint64_t session = 0);

/// Takes nothing on trust: kinds, counts, lengths, finite numbers, and that a state's bytes have its name. Of
/// a Hello of another version only that version is read.
/// @throws ProtocolError saying what is wrong
Envelope decode(std::span<const std::byte> bytes);

}  // namespace polargrain::coupler
