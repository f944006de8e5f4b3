// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/error.hpp"
#include "common/record_values.hpp"
#include "coupler/protocol/array_reader.hpp"
#include "coupler/protocol/array_writer.hpp"

namespace polargrain::coupler {

/// Appends a record to an array of its own: a block of its doubles, a block of its whole numbers, its texts, its
/// states.
template <Described Record>
void write_record(ArrayWriter& writer, const Record& record) {
  RecordValues values;
  append(values, record, true);
  writer.numbers(values.numbers).block(std::as_bytes(std::span(values.integers)));
  for (const std::string& text : values.texts) writer.text(text);
  for (const StatePointer& state : values.states) writer.state(state);
}

/// @throws ProtocolError when the object is another kind of value
template <Described Record>
Record read_record(const msgpack::object& object, const char* what) {
  ArrayReader reader(object, what);
  RecordValues values;
  values.numbers = reader.all_numbers();
  values.integers = reader.all_integers();
  while (reader.text_follows()) values.texts.push_back(reader.text());
  while (!reader.at_end()) values.states.push_back(reader.state_or_name());
  try {
    RecordReader fields(values, what, true);
    Record record = fields.read<Record>();
    fields.end();
    return record;
  } catch (const RunError& error) {
    throw ProtocolError(error.what());
  }
}

}  // namespace polargrain::coupler
