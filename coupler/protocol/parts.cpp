// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/parts.hpp"

#include <array>
#include <unordered_set>

#include "coupler/protocol/record_message.hpp"

namespace polargrain::coupler {
namespace {

void require_usable(const Packing& packing) {
  if (packing.grains.empty()) throw ProtocolError("a packing has no grains");
  if (packing.dimension != 2 && packing.dimension != 3) throw ProtocolError("a packing has no such dimension");
  if (!(packing.volume() > 0.0) || !(packing.thickness > 0.0)) throw ProtocolError("a packing has no volume");
  if (packing.state && !packing.state->is_here()) throw ProtocolError("a packing comes without its state");
  std::unordered_set<std::int64_t> ids;
  for (const Grain& grain : packing.grains) {
    if (!ids.insert(grain.id).second) throw ProtocolError("two grains of a packing have one id");
    if (!(grain.radius > 0.0) || !(grain.mass > 0.0)) throw ProtocolError("a grain has no size or no mass");
  }
}

/// Of a record without texts and states.
template <Described Record>
void require_finite_fields(const Record& record, const char* what) {
  RecordValues values;
  append(values, record, true);
  require_finite(values.numbers, what);
}

}  // namespace

void write(ArrayWriter&& writer, const Increment& increment) {
  write_record(writer, increment);
}
void write(ArrayWriter&& writer, const CellDefinition& cell) {
  write_record(writer, cell);
}
void write(ArrayWriter&& writer, const CellReply& reply) {
  write_record(writer, reply);
}

Increment read_increment(const msgpack::object& object) {
  const auto increment = read_record<Increment>(object, "an increment");
  require_finite_fields(increment, "an increment");
  return increment;
}

CellDefinition read_definition(const msgpack::object& object) {
  auto cell = read_record<CellDefinition>(object, "a cell definition");
  require_finite_fields(cell, "a cell definition");
  require_usable(cell.packing);
  if (cell.control.least_steps < 0 || cell.control.most_relaxation_steps < 0) {
    throw ProtocolError("a count of a cell's control is out of range");
  }
  return cell;
}

CellReply read_cell_reply(const msgpack::object& object) {
  auto reply = read_record<CellReply>(object, "the answer of a cell");
  const Response& response = reply.response;
  require_finite({&response.step_factor, 1}, "a response");
  // A failed response has no numbers worth anything; all others are going to be used.
  if (response.quality == Quality::failed) return reply;
  require_finite({response.stress.data(), 7}, "a stress");
  require_finite({response.tangent.data(), 49}, "a tangent");
  require_finite_fields(reply.diagnostics, "a cell's diagnostics");
  if (!reply.state) throw ProtocolError("a reply that did not fail has no state");
  return reply;
}

}  // namespace polargrain::coupler
