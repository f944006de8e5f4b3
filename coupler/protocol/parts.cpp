// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/parts.hpp"

#include <fmt/format.h>

#include <array>
#include <unordered_set>

#include "common/plain_text.hpp"
#include "coupler/protocol/record_message.hpp"
#include "coupler/protocol/resident_records.hpp"

namespace polargrain::coupler {
namespace {
/// Contacts or DEM steps, and seconds, of an evaluation: far beyond what there can be, and small enough to be
/// added up.
constexpr std::int64_t kMostCounted = std::int64_t{1} << 40;
constexpr double kMostSeconds = 1e9;

void require_usable(const Packing& packing) {
  if (packing.grains.empty()) throw ProtocolError("a packing has no grains");
  if (packing.dimension != 2 && packing.dimension != 3)
    throw ProtocolError("a packing has no such dimension");
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

void require_possible(const CellDiagnostics& d) {
  require_finite_fields(d, "a cell's diagnostics");
  if (d.contacts < 0 || d.contacts > kMostCounted || d.dem_steps < 0 || d.dem_steps > kMostCounted ||
      !(d.engine_seconds >= 0.0 && d.engine_seconds <= kMostSeconds)) {
    throw FalseMessage("the diagnostics of a cell hold impossible counts");
  }
}

/// Of records that hold doubles alone.
template <Described Record>
void write_numbers(ArrayWriter& writer, std::span<const Record> records) {
  RecordValues values;
  for (const Record& record : records) append(values, record, true);
  writer.numbers(values.numbers);
}

template <Described Record>
std::vector<Record> read_numbers(ArrayReader& reader, const char* what) {
  RecordValues one;
  append(one, Record{}, true);
  RecordValues values;
  values.numbers = reader.all_numbers();
  if (values.numbers.size() % one.numbers.size() != 0) {
    throw ProtocolError(
        fmt::format("{}: {} doubles are no multiple of {}", what, values.numbers.size(), one.numbers.size()));
  }
  require_finite(values.numbers, what);
  RecordReader fields(values, what, true);
  std::vector<Record> records(values.numbers.size() / one.numbers.size());
  for (Record& record : records) record = fields.read<Record>();
  return records;
}

}  // namespace

void write(ArrayWriter&& writer, const CellIncrement& increment) {
  write_record(writer, increment);
}
void write(ArrayWriter&& writer, const CellDefinition& cell) {
  write_record(writer, cell);
}
void write(ArrayWriter&& writer, const CellReply& reply) {
  write_record(writer, reply);
}

void write(ArrayWriter&& writer, const ResidentStart& start) {
  writer.state(start.state);
  write_numbers(writer, std::span(&start.motion, 1));
}
void write(ArrayWriter&& writer, const ResidentReadOut& box) {
  write(writer.part(), box.reply);
  write_numbers(writer, std::span(&box.motion, 1));
}
void write(ArrayWriter& writer, std::span<const CellIncrement> increments) {
  write_numbers(writer, increments);
}
void write(ArrayWriter& writer, std::span<const ResidentAnswer> answers) {
  write_numbers(writer, answers);
}

CellIncrement read_increment(const msgpack::object& object) {
  const auto increment = read_record<CellIncrement>(object, "an increment");
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
  CellResponse& response = reply.response;
  response.message = plain_text(response.message);
  if (!(response.step_factor > 0.0 && response.step_factor <= 1.0))
    throw FalseMessage(fmt::format("step_factor must lie between 0 and 1, found {}", response.step_factor));
  require_possible(reply.diagnostics);
  // A failed response has no numbers worth anything; all others are going to be used.
  if (response.quality == Quality::failed) return reply;
  require_finite({response.stress.data(), 9}, "a stress");
  require_finite({response.couple_stress.data(), 9}, "a couple stress");
  require_finite({response.tangent.data(), 324}, "a tangent");
  if (!reply.state) throw FalseMessage("a reply that did not fail has no state");
  return reply;
}

namespace {
ResidentMotion read_motion(ArrayReader& reader) {
  const std::vector<ResidentMotion> motions = read_numbers<ResidentMotion>(reader, "the motion of a box");
  if (motions.size() != 1) throw ProtocolError("a box does not have one motion");
  return motions.front();
}
}  // namespace

ResidentStart read_start(const msgpack::object& object) {
  ArrayReader reader(object, "the start of a box");
  ResidentStart start;
  start.state = reader.state();
  start.motion = read_motion(reader);
  reader.end();
  return start;
}

ResidentReadOut read_read_out(const msgpack::object& object) {
  ArrayReader reader(object, "the read-out of a box");
  ResidentReadOut box;
  box.reply = read_cell_reply(reader.part());
  box.motion = read_motion(reader);
  reader.end();
  if (box.reply.response.quality == Quality::failed || !box.reply.state || !box.reply.state->is_here())
    throw FalseMessage("the read-out of a box has no state");
  return box;
}

std::vector<CellIncrement> read_increments(ArrayReader& reader) {
  return read_numbers<CellIncrement>(reader, "a list of increments");
}

std::vector<ResidentAnswer> read_answers(ArrayReader& reader) {
  std::vector<ResidentAnswer> answers = read_numbers<ResidentAnswer>(reader, "a list of answers of boxes");
  for (const ResidentAnswer& answer : answers)
    if (answer.coordination_number < 0.0 || answer.unbalanced_force_ratio < 0.0)
      throw FalseMessage("the answer of a box holds an impossible number");
  return answers;
}

double read_seconds(ArrayReader& reader) {
  const double seconds = reader.finite_numbers<1>()[0];
  if (seconds < 0.0 || seconds > kMostSeconds) throw FalseMessage("a reply took an impossible time");
  return seconds;
}

}  // namespace polargrain::coupler
