// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/cell.hpp"
#include "common/resident_boxes.hpp"
#include "coupler/protocol/array_reader.hpp"
#include "coupler/protocol/array_writer.hpp"

namespace polargrain::coupler {

/// The records in messages, each an array of its own: doubles as one block, whole numbers as one block, texts,
/// states (common/record_values.hpp). The members of a record are given by its description alone; here stands
/// which values may be used.
void write(ArrayWriter&& writer, const CellIncrement& increment);
void write(ArrayWriter&& writer, const CellDefinition& cell);
void write(ArrayWriter&& writer, const CellReply& reply);
void write(ArrayWriter&& writer, const ResidentStart& start);
void write(ArrayWriter&& writer, const ResidentReadOut& box);

/// @throws ProtocolError (all reads) with the fault
CellIncrement read_increment(const msgpack::object& object);
CellDefinition read_definition(const msgpack::object& object);
CellReply read_cell_reply(const msgpack::object& object);
ResidentStart read_start(const msgpack::object& object);
ResidentReadOut read_read_out(const msgpack::object& object);

/// Increments and answers of many boxes travel as one block of doubles, box after box, without a head for each: 21
/// numbers an increment, 20 an answer, in the order of their descriptions.
void write(ArrayWriter& writer, std::span<const CellIncrement> increments);
void write(ArrayWriter& writer, std::span<const ResidentAnswer> answers);
std::vector<CellIncrement> read_increments(ArrayReader& reader);
std::vector<ResidentAnswer> read_answers(ArrayReader& reader);
/// Wall time of a piece of work, s.
double read_seconds(ArrayReader& reader);

}  // namespace polargrain::coupler
