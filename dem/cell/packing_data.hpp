// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"
#include "dem/cell/box.hpp"

namespace polargrain::dem {

/// A packing as the text of an engine data file (read_data, atom_style granular): the box with its tilt, one
/// atom type, and for each grain the density that gives the engine's sphere the grain's own mass. Grain ids
/// are counted from 1, as the engine wants them.
std::string packing_data(const Packing& packing);

/// That text as a file that exists in memory only, for `read_data ${packing}`: an engine error ends the
/// process on the spot, and must leave no file behind.
class PackingDataFile {
 public:
  /// @throws RunError when the system gives no such file.
  explicit PackingDataFile(const Packing& packing);
  PackingDataFile(const PackingDataFile&) = delete;
  PackingDataFile& operator=(const PackingDataFile&) = delete;
  ~PackingDataFile();
  /// Path that this process can open.
  [[nodiscard]] std::string path() const;

 private:
  int descriptor_ = -1;
};

}  // namespace polargrain::dem
