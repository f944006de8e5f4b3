// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/archive.hpp"

namespace polargrain {

/// An archive in memory: a run at its last step, cheap because states are shared, not copied.
class MemoryArchive : public ArchiveWriter, public ArchiveReader {
 public:
  /// @throws RunError when the name is taken
  void write(const std::string& name, std::span<const double> values) override;
  void write(const std::string& name, std::span<const std::int64_t> values) override;
  void write(const std::string& name, std::span<const StatePointer> states) override;

  [[nodiscard]] std::vector<double> doubles(const std::string& name) override;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) override;
  [[nodiscard]] std::vector<StatePointer> states(const std::string& name) override;

  /// All arrays of each kind, by name.
  [[nodiscard]] const std::map<std::string, std::vector<double>>& all_doubles() const { return doubles_; }
  [[nodiscard]] const std::map<std::string, std::vector<std::int64_t>>& all_integers() const {
    return integers_;
  }
  [[nodiscard]] const std::map<std::string, std::vector<StatePointer>>& all_states() const { return states_; }

 private:
  std::map<std::string, std::vector<double>> doubles_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
  std::map<std::string, std::vector<StatePointer>> states_;
};

}  // namespace polargrain
