// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/cell.hpp"
#include "coupler/protocol/array_reader.hpp"
#include "coupler/protocol/array_writer.hpp"

namespace polargrain::coupler {

/// The records in messages, each an array of its own: doubles as one block, whole numbers as one block, texts,
/// states (common/record_values.hpp). The members of a record are given by its description alone; here stands
/// which values may be used.
void write(ArrayWriter&& writer, const CellIncrement& increment);
void write(ArrayWriter&& writer, const CellDefinition& cell);
void write(ArrayWriter&& writer, const CellReply& reply);

/// @throws ProtocolError (all reads) with the fault
CellIncrement read_increment(const msgpack::object& object);
CellDefinition read_definition(const msgpack::object& object);
CellReply read_cell_reply(const msgpack::object& object);

}  // namespace polargrain::coupler
