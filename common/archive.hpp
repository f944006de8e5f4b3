// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/state.hpp"

namespace polargrain {

/// Where a part of a run writes what it needs to go on: named arrays and states. Names are unique within one
/// archive; the reader gives back the same bits under the same name. Who keeps the bytes, and how, is the
/// business of the implementation (coupler/checkpoint: HDF5).
class ArchiveWriter {
 public:
  virtual ~ArchiveWriter() = default;
  virtual void write(const std::string& name, std::span<const double> values) = 0;
  virtual void write(const std::string& name, std::span<const std::int64_t> values) = 0;
  /// States are kept once however often they are written; null pointers come back as null.
  virtual void write(const std::string& name, std::span<const StatePointer> states) = 0;
};

/// The other side. @throws RunError when there is no array of that name and kind.
class ArchiveReader {
 public:
  virtual ~ArchiveReader() = default;
  [[nodiscard]] virtual std::vector<double> doubles(const std::string& name) = 0;
  [[nodiscard]] virtual std::vector<std::int64_t> integers(const std::string& name) = 0;
  [[nodiscard]] virtual std::vector<StatePointer> states(const std::string& name) = 0;
};

}  // namespace polargrain
