// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/messages.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <msgpack.hpp>
#include <unordered_set>

#include "coupler/protocol/array_reader.hpp"
#include "coupler/protocol/array_writer.hpp"
#include "coupler/protocol/numbers.hpp"

namespace polargrain::coupler {
namespace {

// Limits given to the unpacker, so that a length in a message cannot make it reserve memory for nothing. No
// message has more members than kMostMembers or nests deeper than a message and its parts.
constexpr std::size_t kMostMembers = 16;
constexpr std::size_t kLongestText = std::size_t{1} << 24;
constexpr std::size_t kDeepest = 4;

// ---- the parts of messages, each a pair of write and read

ArrayWriter write(const Increment& increment) {
  const auto& h = increment.displacement_gradient;
  const std::array<double, 7> values{h(0, 0),
                                     h(0, 1),
                                     h(1, 0),
                                     h(1, 1),
                                     increment.micro_rotation,
                                     increment.curvature(0),
                                     increment.curvature(1)};
  ArrayWriter writer;
  writer.numbers(values);
  return writer;
}

Increment read_increment(const msgpack::object& object) {
  ArrayReader reader(object, "an increment");
  const std::vector<double> v = reader.finite_numbers(7);
  reader.end();
  Increment increment;
  increment.displacement_gradient << v[0], v[1], v[2], v[3];
  increment.micro_rotation = v[4];
  increment.curvature << v[5], v[6];
  return increment;
}

ArrayWriter write(const Packing& packing) {
  std::vector<std::int64_t> ids;
  std::vector<double> values;
  for (const Grain& grain : packing.grains) {
    ids.push_back(grain.id);
    values.insert(values.end(),
                  {grain.position(0), grain.position(1), grain.radius, grain.mass, grain.moment_of_inertia});
  }
  const std::array<double, 5> box{packing.box(0, 0), packing.box(1, 0), packing.box(0, 1), packing.box(1, 1),
                                  packing.thickness};
  ArrayWriter writer;
  writer.numbers(box).block(std::as_bytes(std::span(ids))).numbers(values).state(packing.state);
  return writer;
}

Packing read_packing_part(const msgpack::object& object) {
  ArrayReader reader(object, "a packing");
  const std::vector<double> box = reader.finite_numbers(5);
  const std::span<const std::byte> id_bytes = reader.block();
  if (id_bytes.size() % sizeof(std::int64_t) != 0)
    throw ProtocolError("the grain ids of a packing are cut short");
  std::vector<std::int64_t> ids(id_bytes.size() / sizeof(std::int64_t));
  if (!ids.empty()) std::memcpy(ids.data(), id_bytes.data(), id_bytes.size());
  const std::vector<double> values = reader.finite_numbers(5 * ids.size());
  StatePointer state = reader.state();
  reader.end();
  if (ids.empty()) throw ProtocolError("a packing has no grains");
  if (std::unordered_set<std::int64_t>(ids.begin(), ids.end()).size() != ids.size()) {
    throw ProtocolError("two grains of a packing have one id");
  }
  Packing packing;
  packing.box << box[0], box[2], box[1], box[3];
  packing.thickness = box[4];
  packing.state = std::move(state);
  if (!(packing.volume() > 0.0) || !(packing.thickness > 0.0)) throw ProtocolError("a packing has no volume");
  packing.grains.resize(ids.size());
  for (std::size_t g = 0; g < ids.size(); ++g) {
    const double* v = &values[5 * g];
    packing.grains[g] = {ids[g], {v[0], v[1]}, v[2], v[3], v[4]};
    if (!(v[2] > 0.0) || !(v[3] > 0.0)) throw ProtocolError("a grain has no size or no mass");
  }
  return packing;
}

ArrayWriter write(const CellControl& control) {
  const std::array<double, 4> values{control.inertial_number, control.unbalanced_force_ratio,
                                     control.unbalanced_moment_ratio, control.damping};
  ArrayWriter writer;
  writer.numbers(values)
      .whole_signed(control.least_steps)
      .whole_signed(control.most_relaxation_steps)
      .whole(static_cast<std::uint64_t>(control.tangent))
      .whole(static_cast<std::uint64_t>(control.rotations));
  return writer;
}

int read_count(ArrayReader& reader) {
  const std::int64_t value = reader.whole_signed();
  if (value < 0 || value > INT32_MAX) throw ProtocolError("a count of a cell's control is out of range");
  return static_cast<int>(value);
}

CellControl read_control(const msgpack::object& object) {
  ArrayReader reader(object, "a cell's control");
  const std::vector<double> v = reader.finite_numbers(4);
  CellControl control{v[0], v[1], v[2], v[3], 0, 0, CellTangent::none, CellRotations::free};
  control.least_steps = read_count(reader);
  control.most_relaxation_steps = read_count(reader);
  const std::uint32_t tangent = reader.whole32();
  if (tangent > static_cast<std::uint32_t>(CellTangent::condensed))
    throw ProtocolError("no such kind of tangent");
  control.tangent = static_cast<CellTangent>(tangent);
  const std::uint32_t rotations = reader.whole32();
  if (rotations > static_cast<std::uint32_t>(CellRotations::controlled))
    throw ProtocolError("no such control of rotations");
  control.rotations = static_cast<CellRotations>(rotations);
  reader.end();
  return control;
}

ArrayWriter write(const CellDefinition& cell) {
  ArrayWriter writer;
  writer.text(cell.name)
      .text(cell.script_file)
      .text(cell.script)
      .part(write(cell.packing))
      .part(write(cell.control));
  return writer;
}

CellDefinition read_definition(const msgpack::object& object) {
  ArrayReader reader(object, "a cell definition");
  CellDefinition cell;
  cell.name = reader.text();
  cell.script_file = reader.text();
  cell.script = reader.text();
  cell.packing = read_packing_part(reader.part());
  cell.control = read_control(reader.part());
  reader.end();
  return cell;
}

ArrayWriter write(const Response& response) {
  ArrayWriter writer;
  writer.numbers({response.stress.data(), 7})
      .numbers({response.tangent.data(), 49})
      .whole_signed(static_cast<int>(response.quality))
      .text(response.message)
      .numbers({&response.step_factor, 1});
  return writer;
}

Response read_response(const msgpack::object& object) {
  ArrayReader reader(object, "a response");
  Response response;
  const std::vector<double> stress = reader.numbers(7);
  const std::vector<double> tangent = reader.numbers(49);
  const std::int64_t quality = reader.whole_signed();
  if (quality < -1 || quality > 1) throw ProtocolError("no such quality of a response");
  response.quality = static_cast<Quality>(quality);
  response.message = reader.text();
  response.step_factor = reader.finite_numbers(1)[0];
  reader.end();
  // A failed response has no numbers worth anything; all others are going to be used.
  if (response.quality != Quality::failed) {
    require_finite(stress, "a stress");
    require_finite(tangent, "a tangent");
  }
  response.stress = Eigen::Map<const Vector7>(stress.data());
  response.tangent = Eigen::Map<const Matrix7>(tangent.data());
  return response;
}

ArrayWriter write(const CellDiagnostics& d) {
  const std::array<double, 14> values{d.unbalanced_force_ratio,
                                      d.unbalanced_moment_ratio,
                                      d.void_ratio,
                                      d.coordination_number,
                                      d.sliding_fraction,
                                      d.multiplier,
                                      d.engine_seconds,
                                      d.rolling_fraction,
                                      d.rattlers,
                                      d.mean_rotation,
                                      d.rotation_spread,
                                      d.fabric[0],
                                      d.fabric[1],
                                      d.fabric[2]};
  ArrayWriter writer;
  writer.numbers(values).whole_signed(d.contacts).whole_signed(d.dem_steps);
  return writer;
}

CellDiagnostics read_diagnostics(const msgpack::object& object) {
  ArrayReader reader(object, "a cell's diagnostics");
  const std::vector<double> v = reader.numbers(14);
  CellDiagnostics d{v[0], v[1], v[2], v[3], v[4], v[5],  0,
                    0,    v[6], v[7], v[8], v[9], v[10], {v[11], v[12], v[13]}};
  d.contacts = reader.whole_signed();
  d.dem_steps = reader.whole_signed();
  reader.end();
  return d;
}

// ---- whole messages

struct Encoder {
  std::size_t kind;
  std::uint64_t session;
  std::string operator()(const Hello& m) const {
    return end(begin().whole(m.version).whole_signed(m.process).text(m.host));
  }
  std::string operator()(const Stop& m) const { return end(begin().text(m.reason)); }
  std::string operator()(const Welcome& m) const { return end(begin().numbers({&m.heartbeat_seconds, 1})); }
  std::string operator()(const Define& m) const {
    return end(begin().whole(m.definition).part(write(m.cell)));
  }
  std::string operator()(const InitialRequest& m) const {
    return end(begin().whole(m.request).whole(m.definition));
  }
  std::string operator()(const EvaluateRequest& m) const {
    return end(begin()
                   .whole(m.request)
                   .whole(m.definition)
                   .truth(m.from_packing)
                   .name(m.base)
                   .state(m.state)
                   .part(write(m.increment)));
  }
  std::string operator()(const Reply& m) const {
    return end(begin()
                   .whole(m.request)
                   .part(write(m.cell.response))
                   .part(write(m.cell.diagnostics))
                   .state(m.cell.state));
  }
  std::string operator()(const Missing& m) const { return end(begin().whole(m.request).truth(m.definition)); }
  std::string operator()(const Working& m) const { return end(begin().whole(m.request)); }
  std::string operator()(const Refusal& m) const { return end(begin().whole(m.request).text(m.message)); }

 private:
  [[nodiscard]] ArrayWriter begin() const {
    ArrayWriter writer;
    writer.whole(kind);
    return writer;
  }
  [[nodiscard]] std::string end(ArrayWriter& writer) const { return writer.whole(session).finish(); }
  [[nodiscard]] std::string end(ArrayWriter&& writer) const { return end(writer); }
};

/// Place of a message type in Message: the number that stands for it on the wire.
template <class T, std::size_t index = 0>
constexpr std::uint64_t kind_of() {
  if constexpr (std::is_same_v<T, std::variant_alternative_t<index, Message>>) {
    return index;
  } else {
    return kind_of<T, index + 1>();
  }
}

EvaluateRequest read_evaluate(ArrayReader& reader) {
  EvaluateRequest m;
  m.request = reader.whole();
  m.definition = reader.whole32();
  m.from_packing = reader.truth();
  m.base = reader.name();
  m.state = reader.state();
  m.increment = read_increment(reader.part());
  if (m.state && m.state->name() != m.base) throw ProtocolError("the bytes of a state do not have its name");
  return m;
}

Reply read_reply(ArrayReader& reader) {
  Reply m;
  m.request = reader.whole();
  m.cell.response = read_response(reader.part());
  m.cell.diagnostics = read_diagnostics(reader.part());
  m.cell.state = reader.state();
  if (!m.cell.state && m.cell.response.quality != Quality::failed) {
    throw ProtocolError("a reply that did not fail has no state");
  }
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
  const Welcome m{reader.finite_numbers(1)[0]};
  if (!(m.heartbeat_seconds > 0.0)) throw ProtocolError("the time between two heartbeats is not positive");
  return m;
}

Message read_message(ArrayReader& reader, std::uint64_t kind) {
  switch (kind) {
    case kind_of<Stop>():
      return Stop{reader.text()};
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
      return Missing{request, reader.truth()};
    }
    case kind_of<Working>():
      return Working{reader.whole()};
    case kind_of<Refusal>(): {
      const std::uint64_t request = reader.whole();
      return Refusal{request, reader.text()};
    }
    default:
      throw ProtocolError("no such kind of message");
  }
}

}  // namespace

std::string encode(const Message& message, std::uint64_t session) {
  return std::visit(Encoder{message.index(), session}, message);
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
    envelope.message = hello;
  } else {
    envelope.message = read_message(reader, kind);
  }
  envelope.session = reader.whole();
  reader.end();
  return envelope;
}

}  // namespace polargrain::coupler
