// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/messages.hpp"

#include <fmt/format.h>

#include <limits>
#include <msgpack.hpp>

#include "common/plain_text.hpp"
#include "coupler/protocol/parts.hpp"

namespace polargrain::coupler {
namespace {

// Limits given to the unpacker, so that a length in a message cannot make it reserve memory for nothing. No
// message nests deeper than a request, its cells and their increments.
constexpr std::size_t kMostMembers = kMostInRequest;
constexpr std::size_t kLongestText = std::size_t{1} << 24;
constexpr std::size_t kDeepest = 5;

// ---- writing: the members of each message between its kind and its session

void write(ArrayWriter& writer, const Hello& m) {
  writer.whole(m.version).whole_signed(m.process).text(m.host).text(m.processor).text(m.unconfined);
}
void write(ArrayWriter& writer, const Stop& m) {
  writer.text(m.reason);
}
void write(ArrayWriter& writer, const Welcome& m) {
  writer.numbers({&m.heartbeat_seconds, 1});
}
void write(ArrayWriter& writer, const Define& m) {
  writer.whole(m.definition);
  write(writer.part(), m.cell);
}
void write(ArrayWriter& writer, const InitialRequest& m) {
  writer.whole(m.request).whole(m.definition);
}
void write(ArrayWriter&& writer, const CellToEvaluate& cell) {
  writer.truth(cell.from_packing).name(cell.base).state(cell.state);
  write(writer.part(), cell.increment);
}
void write(ArrayWriter& writer, const EvaluateRequest& m) {
  writer.whole(m.request).whole(m.definition).whole(m.settled).truth(m.bring).names(m.released);
  ArrayWriter cells = writer.part();
  for (const CellToEvaluate& cell : m.cells) write(cells.part(), cell);
}
void write(ArrayWriter& writer, const Reply& m) {
  writer.whole(m.request);
  ArrayWriter cells = writer.part();
  for (const CellReply& cell : m.cells) write(cells.part(), cell);
}
void write(ArrayWriter& writer, const FetchRequest& m) {
  writer.whole(m.request).names(m.names);
}
void write(ArrayWriter& writer, const States& m) {
  writer.whole(m.request);
  ArrayWriter states = writer.part();
  for (const StatePointer& state : m.states) states.state(state);
}
void write(ArrayWriter& writer, const Missing& m) {
  writer.whole(m.request).truth(m.definition).names(m.bases);
}
void write(ArrayWriter& writer, const Working& m) {
  writer.whole(m.request);
}
void write(ArrayWriter& writer, const Refusal& m) {
  writer.whole(m.request).whole(m.place).text(m.message);
}
void write(ArrayWriter& writer, const MoveIn& m) {
  writer.whole(m.request).whole(m.definition).whole(m.settled).whole(m.first);
  ArrayWriter starts = writer.part();
  for (const ResidentStart& start : m.starts) write(starts.part(), start);
}
void write(ArrayWriter& writer, const GoOn& m) {
  writer.whole(m.request).whole(m.definition).whole(m.settled).whole(static_cast<std::uint64_t>(m.dem_steps));
  write(writer, std::span(m.increments));
}
void write(ArrayWriter& writer, const ReadOut& m) {
  writer.whole(m.request).whole(m.definition).whole(m.settled).whole(m.first).whole(m.count);
}
void write(ArrayWriter& writer, const ResidentReply& m) {
  writer.whole(m.request).numbers({&m.seconds, 1}).numbers({&m.time_step, 1});
  write(writer, std::span(m.answers));
  ArrayWriter boxes = writer.part();
  for (const ResidentReadOut& box : m.read_outs) write(boxes.part(), box);
}

/// Bytes of the states in a message, and of the numbers of boxes, so that the memory for it is taken once.
template <class T>
std::size_t bytes_of_states(const T&) {
  return 0;
}
std::size_t bytes_of(const StatePointer& state) {
  return state && state->is_here() ? state->size() : 0;
}
std::size_t bytes_of_states(const EvaluateRequest& m) {
  std::size_t bytes = 0;
  for (const CellToEvaluate& cell : m.cells) bytes += bytes_of(cell.state);
  return bytes;
}
std::size_t bytes_of_states(const Reply& m) {
  std::size_t bytes = 0;
  for (const CellReply& cell : m.cells) bytes += 1024 + bytes_of(cell.state);
  return bytes;
}
std::size_t bytes_of_states(const States& m) {
  std::size_t bytes = 0;
  for (const StatePointer& state : m.states) bytes += 16 + bytes_of(state);
  return bytes;
}
std::size_t bytes_of_states(const MoveIn& m) {
  std::size_t bytes = 0;
  for (const ResidentStart& start : m.starts) bytes += 128 + bytes_of(start.state);
  return bytes;
}
std::size_t bytes_of_states(const GoOn& m) {
  return m.increments.size() * sizeof(CellIncrement);
}
std::size_t bytes_of_states(const ResidentReply& m) {
  std::size_t bytes = m.answers.size() * sizeof(ResidentAnswer);
  for (const ResidentReadOut& box : m.read_outs) bytes += 4096 + bytes_of(box.reply.state);
  return bytes;
}

// ---- reading

/// Place of a message type in Message: the number that stands for it on the wire.
template <class T, std::size_t index = 0>
constexpr std::uint64_t kind_of() {
  if constexpr (std::is_same_v<T, std::variant_alternative_t<index, Message>>) {
    return index;
  } else {
    return kind_of<T, index + 1>();
  }
}

/// The members of an array of at most kMostInRequest (the limit of the unpacker), one after the other.
template <class Item, class Read>
std::vector<Item> read_list(const msgpack::object& object, const char* what, const Read& read) {
  ArrayReader reader(object, what);
  std::vector<Item> items;
  while (!reader.at_end()) items.push_back(read(reader));
  return items;
}

CellToEvaluate read_cell_to_evaluate(ArrayReader& cells) {
  ArrayReader reader(cells.part(), "a cell to evaluate");
  CellToEvaluate cell;
  cell.from_packing = reader.truth();
  cell.base = reader.name();
  cell.state = reader.state();
  cell.increment = read_increment(reader.part());
  reader.end();
  if (cell.state && cell.state->name() != cell.base) {
    throw ProtocolError("the bytes of a state do not have its name");
  }
  return cell;
}

/// The numbers that every request for cells or boxes begins with.
template <class Request>
void read_head(ArrayReader& reader, Request& m) {
  m.request = reader.whole();
  m.definition = reader.whole32();
  m.settled = reader.whole();
}

EvaluateRequest read_evaluate(ArrayReader& reader) {
  EvaluateRequest m;
  read_head(reader, m);
  m.bring = reader.truth();
  m.released = reader.names();
  m.cells = read_list<CellToEvaluate>(reader.part(), "a list of cells", read_cell_to_evaluate);
  return m;
}

Reply read_reply(ArrayReader& reader) {
  const std::uint64_t request = reader.whole();
  return {request, read_list<CellReply>(reader.part(), "a list of answers",
                                        [](ArrayReader& cells) { return read_cell_reply(cells.part()); })};
}

States read_states(ArrayReader& reader) {
  const std::uint64_t request = reader.whole();
  return {request, read_list<StatePointer>(reader.part(), "a list of states",
                                           [](ArrayReader& states) { return states.state(); })};
}

MoveIn read_move_in(ArrayReader& reader) {
  MoveIn m;
  read_head(reader, m);
  m.first = reader.whole32();
  m.starts = read_list<ResidentStart>(reader.part(), "a list of boxes",
                                      [](ArrayReader& starts) { return read_start(starts.part()); });
  return m;
}

GoOn read_go_on(ArrayReader& reader) {
  GoOn m;
  read_head(reader, m);
  const std::uint64_t dem_steps = reader.whole();
  if (dem_steps < 1 || dem_steps > std::numeric_limits<int>::max())
    throw ProtocolError("a count of DEM steps is out of range");
  m.dem_steps = static_cast<int>(dem_steps);
  m.increments = read_increments(reader);
  return m;
}

ReadOut read_read_out_request(ArrayReader& reader) {
  ReadOut m;
  read_head(reader, m);
  m.first = reader.whole32();
  m.count = reader.whole32();
  if (m.count < 1 || m.count > kMostStatesOfBoxes)
    throw ProtocolError("a count of boxes to read out is out of range");
  return m;
}

ResidentReply read_resident_reply(ArrayReader& reader) {
  ResidentReply m;
  m.request = reader.whole();
  m.seconds = read_seconds(reader);
  m.time_step = read_seconds(reader);
  m.answers = read_answers(reader);
  m.read_outs = read_list<ResidentReadOut>(reader.part(), "a list of boxes",
                                           [](ArrayReader& boxes) { return read_read_out(boxes.part()); });
  return m;
}

/// A name that goes into messages to the user and into file names.
std::string read_host(ArrayReader& reader) {
  std::string host = reader.text();
  if (host.size() > 255) throw ProtocolError("the name of a host has more than 255 characters");
  for (const char c : host) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '-' || c == '.' || c == '_';
    if (!plain) throw ProtocolError("the name of a host has characters that no host name has");
  }
  return host;
}

Welcome read_welcome(ArrayReader& reader) {
  const Welcome m{reader.finite_numbers<1>()[0]};
  if (!(m.heartbeat_seconds > 0.0)) throw ProtocolError("the time between two heartbeats is not positive");
  return m;
}

Message read_message(ArrayReader& reader, std::uint64_t kind) {
  switch (kind) {
    case kind_of<Stop>():
      return Stop{reader.words()};
    case kind_of<Welcome>():
      return read_welcome(reader);
    case kind_of<Define>(): {
      const std::uint32_t definition = reader.whole32();
      return Define{definition, read_definition(reader.part())};
    }
    case kind_of<InitialRequest>(): {
      const std::uint64_t request = reader.whole();
      return InitialRequest{request, reader.whole32()};
    }
    case kind_of<EvaluateRequest>():
      return read_evaluate(reader);
    case kind_of<Reply>():
      return read_reply(reader);
    case kind_of<Missing>(): {
      const std::uint64_t request = reader.whole();
      const bool definition = reader.truth();
      return Missing{request, definition, reader.names()};
    }
    case kind_of<Working>():
      return Working{reader.whole()};
    case kind_of<Refusal>(): {
      const std::uint64_t request = reader.whole();
      const std::uint32_t place = reader.whole32();
      return Refusal{request, place, reader.words()};
    }
    case kind_of<FetchRequest>(): {
      const std::uint64_t request = reader.whole();
      return FetchRequest{request, reader.names()};
    }
    case kind_of<States>():
      return read_states(reader);
    case kind_of<MoveIn>():
      return read_move_in(reader);
    case kind_of<GoOn>():
      return read_go_on(reader);
    case kind_of<ReadOut>():
      return read_read_out_request(reader);
    case kind_of<ResidentReply>():
      return read_resident_reply(reader);
    default:
      throw ProtocolError("no such kind of message");
  }
}

}  // namespace

std::string encode(const Message& message, std::uint64_t session) {
  std::string bytes;
  bytes.reserve(256 + std::visit([](const auto& m) { return bytes_of_states(m); }, message));
  ArrayWriter writer(bytes);
  writer.whole(message.index());
  std::visit([&](const auto& m) { write(writer, m); }, message);
  writer.whole(session);
  return bytes;
}

Envelope decode(std::span<const std::byte> bytes) {
  const msgpack::unpack_limit limits(kMostMembers, 0, kLongestText, kLongestMessage, 0, kDeepest);
  msgpack::object_handle handle;
  std::size_t end = 0;
  try {
    const auto refer = [](msgpack::type::object_type, std::size_t, void*) { return true; };
    msgpack::unpack(handle, reinterpret_cast<const char*>(bytes.data()), bytes.size(), end, refer, nullptr,
                    limits);
  } catch (const std::exception& error) {
    throw ProtocolError(fmt::format("not a message: {}", error.what()));
  }
  if (end != bytes.size()) throw ProtocolError("bytes follow the end of a message");
  ArrayReader reader(handle.get(), "a message");
  const std::uint64_t kind = reader.whole();
  Envelope envelope;
  if (kind == kind_of<Hello>()) {
    Hello hello{reader.whole32()};
    if (hello.version != kProtocolVersion) return {0, hello};
    hello.process = reader.whole_signed();
    hello.host = read_host(reader);
    hello.processor = plain_text(reader.text());
    hello.unconfined = plain_text(reader.text());
    envelope.message = hello;
  } else {
    envelope.message = read_message(reader, kind);
  }
  envelope.session = reader.whole();
  reader.end();
  return envelope;
}

}  // namespace polargrain::coupler
