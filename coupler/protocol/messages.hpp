// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "common/cell.hpp"
#include "common/resident_boxes.hpp"

namespace polargrain::coupler {

/// Raised with every change of the messages; peers of different versions refuse each other.
inline constexpr std::uint32_t kProtocolVersion = 12;

/// A request asks for no more cells or states.
inline constexpr std::size_t kMostInRequest = 64;

/// A message moves so many resident boxes in, or reads out so many: their states travel with it.
inline constexpr std::size_t kMostStatesOfBoxes = 16;
static_assert(kMostStatesOfBoxes <= kMostInRequest);

/// No message is longer; longer ones are refused before they are read.
inline constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

/// The bytes received are no message of this protocol, or a message that must not be used.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes are a message of this protocol, but its content cannot be true: no line makes that of an honest
/// message, so its sender is at fault.
class FalseMessage : public ProtocolError {
 public:
  using ProtocolError::ProtocolError;
};

/// Worker to coordinator, again and again until it is welcomed, and whenever it has heard nothing for long.
struct Hello {
  std::uint32_t version = kProtocolVersion;
  std::int64_t process = 0;     ///< process id of the worker on its machine
  std::string host = {};        ///< name of that machine, for messages to the user
  std::string processor = {};   ///< kind of its processor, for the proof of a result
  std::string unconfined = {};  ///< the rights it could not give up (Confinement), for messages to the user
};

/// Coordinator to worker: end, and why when it is not the end of the run.
struct Stop {
  std::string reason = {};
};

/// Coordinator to worker: its Hello was accepted. All that the worker keeps from another session is void.
struct Welcome {
  double heartbeat_seconds = 1.0;  ///< while it works the worker says Working at least so often
};

/// Coordinator to worker: the definition of the cells numbered `definition`. Sent before their first request.
struct Define {
  std::uint32_t definition = 0;
  CellDefinition cell;
};

/// Coordinator to worker: the packing at rest (CellService::initial).
struct InitialRequest {
  std::uint64_t request = 0;  ///< number that the answer repeats
  std::uint32_t definition = 0;
};

/// One of the cells of an EvaluateRequest.
struct CellToEvaluate {
  bool from_packing = false;  ///< start from the packing; `base` and `state` are then unused
  ContentName base;           ///< name of the state to start from
  StatePointer state;         ///< that state when its bytes travel along, else null
  CellIncrement increment;
};

/// Coordinator to worker: CellService::evaluate, for some cells one after the other.
struct EvaluateRequest {
  std::uint64_t request = 0;
  std::uint32_t definition = 0;
  std::uint64_t settled = 0;  ///< answers to requests up to this number have come and need not be kept
  bool bring = false;         ///< the bytes of the new states are wanted with the reply
  std::vector<ContentName> released;  ///< states that nobody is going to name again
  std::vector<CellToEvaluate> cells;
};

/// Worker to coordinator: the answer to an InitialRequest or EvaluateRequest, an answer for each cell. Unless
/// its bytes were wanted, or the worker has no room for it, a new state is given by its name alone: the
/// worker keeps it until it is fetched or released.
struct Reply {
  std::uint64_t request = 0;
  std::vector<CellReply> cells;
};

/// Coordinator to worker: the bytes of states on trial, which have become the start of the next step.
struct FetchRequest {
  std::uint64_t request = 0;
  std::vector<ContentName> names;
};

/// Worker to coordinator: the answer to a FetchRequest, in its order; null for a state the worker does not
/// have.
struct States {
  std::uint64_t request = 0;
  std::vector<StatePointer> states;
};

/// Worker to coordinator: a request cannot be served before the states it names are sent (again).
struct Missing {
  std::uint64_t request = 0;
  bool definition = false;         ///< its Define is missing; else
  std::vector<ContentName> bases;  ///< the bytes of these states that its cells start from
};

/// Worker to coordinator, from inside the engine: the request is being worked on.
struct Working {
  std::uint64_t request = 0;
};

/// Worker to coordinator: one of the cells or boxes of a request cannot be served, and why; the others were not tried
/// or their answers are dropped.
struct Refusal {
  std::uint64_t request = 0;
  std::uint32_t place = 0;  ///< of that cell in the request; their number when any of its boxes may be meant
  std::string message;
};

/// Coordinator to worker: ResidentBoxes::move_in for the cells of a definition.
struct MoveIn {
  std::uint64_t request = 0;
  std::uint32_t definition = 0;
  std::uint64_t settled = 0;          ///< as in EvaluateRequest
  std::uint32_t first = 0;            ///< boxes moved in before these; 0: all that the worker has go first
  std::vector<ResidentStart> starts;  ///< at most kMostStatesOfBoxes
};

/// Coordinator to worker: ResidentBoxes::go_on for all boxes of a definition that the worker has.
struct GoOn {
  std::uint64_t request = 0;
  std::uint32_t definition = 0;
  std::uint64_t settled = 0;
  int dem_steps = 1;
  std::vector<CellIncrement> increments;  ///< one a box
};

/// Coordinator to worker: ResidentBoxes::read_out.
struct ReadOut {
  std::uint64_t request = 0;
  std::uint32_t definition = 0;
  std::uint64_t settled = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;  ///< 1 to kMostStatesOfBoxes
};

/// Worker to coordinator: the answer to a MoveIn (the time step), GoOn (answers) or ReadOut (read-outs, whose states come with
/// their bytes).
struct ResidentReply {
  std::uint64_t request = 0;
  double seconds = 0.0;    ///< of wall time, inside the engine
  double time_step = 0.0;  ///< s, see ResidentBoxes::time_step; 0 but behind a MoveIn
  std::vector<ResidentAnswer> answers;
  std::vector<ResidentReadOut> read_outs;
};

/// Hello and Stop keep their places and their first members for ever: by them versions talk to each
/// other.
using Message = std::variant<Hello, Stop, Welcome, Define, InitialRequest, EvaluateRequest, Reply, Missing,
                             Working, Refusal, FetchRequest, States, MoveIn, GoOn, ReadOut, ResidentReply>;

/// A message and the session it belongs to: a number that each coordinator draws for itself, so that nothing
/// meant for another run, or recorded from one, is taken for an answer. 0 in a Hello, which comes before any
/// session.
struct Envelope {
  std::uint64_t session = 0;
  Message message;
};

/// @returns the message as msgpack: an array of its kind (its place in Message), its members and the session.
std::string encode(const Message& message, std::uint64_t session = 0);

/// Takes nothing on trust: kinds, counts, lengths, finite numbers, and that a state's bytes have its name;
/// words for the user come back as plain text (common/plain_text.hpp). Of a Hello of another version only that
/// version is read.
/// @throws ProtocolError with the fault; FalseMessage when it is an answer that no cell can give
Envelope decode(std::span<const std::byte> bytes);

}  // namespace polargrain::coupler
