// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/cell.hpp"
#include "coupler/protocol/array_reader.hpp"
#include "coupler/protocol/array_writer.hpp"

namespace polargrain::coupler {

/// The parts of messages, each a pair of write and read. @throws ProtocolError (all reads) saying what is
/// wrong
void write(ArrayWriter&& writer, const Increment& increment);
void write(ArrayWriter&& writer, const CellDefinition& cell);
void write(ArrayWriter&& writer, const Response& response);
void write(ArrayWriter&& writer, const CellDiagnostics& diagnostics);

Increment read_increment(const msgpack::object& object);
CellDefinition read_definition(const msgpack::object& object);
Response read_response(const msgpack::object& object);
CellDiagnostics read_diagnostics(const msgpack::object& object);

}  // namespace polargrain::coupler
