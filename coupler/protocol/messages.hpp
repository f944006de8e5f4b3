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
inline constexpr std::uint32_t kProtocolVersion = 3;

/// No message is longer; longer ones are refused before they are read.
inline constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

/// The bytes received are no message of this protocol, or a message that must not be used.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Worker to coordinator, once, as its first message.
struct Hello {
  std::uint32_t version = kProtocolVersion;
  std::int64_t process = 0;  ///< process id of the worker on its machine
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

/// Worker to coordinator: the worker's cache lacks the state a request starts from; send it with its bytes.
struct MissingState {
  std::uint64_t request = 0;
};

/// Worker to coordinator: the request cannot be served, and why.
struct Refusal {
  std::uint64_t request = 0;
  std::string message;
};

/// Coordinator to worker: end.
struct Stop {};

using Message =
    std::variant<Hello, Define, InitialRequest, EvaluateRequest, Reply, MissingState, Refusal, Stop>;

/// @returns the message as msgpack: an array of its kind (its place in Message) and its members.
std::string encode(const Message& message);

/// Takes nothing on trust: kinds, counts, lengths, finite numbers, and that a state's bytes have its name.
/// @throws ProtocolError saying what is wrong
Message decode(std::span<const std::byte> bytes);

}  // namespace polargrain::coupler
