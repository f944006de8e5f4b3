// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/record_values.hpp"

namespace polargrain {

/// Writes the values of records under `name`, states and texts included, costs left out.
void write_values(ArchiveWriter& archive, const std::string& name, const RecordValues& values);
/// @throws RunError when the archive holds no records under that name
RecordValues read_values(ArchiveReader& archive, const std::string& name);

template <Described Record>
void write_records(ArchiveWriter& archive, const std::string& name, std::span<const Record> records) {
  RecordValues values;
  for (const Record& record : records) append(values, record, false);
  write_values(archive, name, values);
}

/// @throws RunError when the archive does not hold `count` records of that kind under that name
template <Described Record>
std::vector<Record> read_records(ArchiveReader& archive, const std::string& name, std::size_t count) {
  const RecordValues values = read_values(archive, name);
  RecordReader reader(values, "'" + name + "'", false);
  std::vector<Record> records;
  records.reserve(count);
  for (std::size_t i = 0; i < count; ++i) records.push_back(reader.read<Record>());
  reader.end();
  return records;
}

}  // namespace polargrain
