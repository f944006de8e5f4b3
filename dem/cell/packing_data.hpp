// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"

namespace polargrain::dem {

class Engine;

/// The data file of a packing (grains_io/packing_data.hpp) that exists in memory only, for `read_data
/// ${packing}`: an engine error ends the process on the spot, and must leave no file behind.
class PackingDataFile {
 public:
  /// @throws RunError when the system gives no such file.
  explicit PackingDataFile(const Packing& packing);
  PackingDataFile(const PackingDataFile&) = delete;
  PackingDataFile& operator=(const PackingDataFile&) = delete;
  ~PackingDataFile();
  /// Path that this process can open.
  [[nodiscard]] std::string path() const;
  /// Gives the engine the variables that scripts ask of a packing: ${packing}, that path, and ${neighbour_distance}
  /// (grains_io/neighbour_distance.hpp).
  void define_variables(Engine& engine) const;

 private:
  std::string neighbour_distance_;
  int descriptor_ = -1;
};

}  // namespace polargrain::dem
