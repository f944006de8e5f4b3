// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/archive.hpp"

namespace polargrain {

/// Puts a prefix before every name, so that several parts of one kind can write to one archive.
class PrefixedWriter : public ArchiveWriter {
 public:
  /// @param archive must outlive this object
  PrefixedWriter(ArchiveWriter& archive, std::string prefix)
      : archive_(archive), prefix_(std::move(prefix)) {}
  void write(const std::string& name, std::span<const double> values) override {
    archive_.write(prefix_ + name, values);
  }
  void write(const std::string& name, std::span<const std::int64_t> values) override {
    archive_.write(prefix_ + name, values);
  }
  void write(const std::string& name, std::span<const StatePointer> states) override {
    archive_.write(prefix_ + name, states);
  }

 private:
  ArchiveWriter& archive_;
  std::string prefix_;
};

/// The other side of PrefixedWriter.
class PrefixedReader : public ArchiveReader {
 public:
  /// @param archive must outlive this object
  PrefixedReader(ArchiveReader& archive, std::string prefix)
      : archive_(archive), prefix_(std::move(prefix)) {}
  [[nodiscard]] std::vector<double> doubles(const std::string& name) override {
    return archive_.doubles(prefix_ + name);
  }
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) override {
    return archive_.integers(prefix_ + name);
  }
  [[nodiscard]] std::vector<StatePointer> states(const std::string& name) override {
    return archive_.states(prefix_ + name);
  }

 private:
  ArchiveReader& archive_;
  std::string prefix_;
};

}  // namespace polargrain
