// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace polargrain::coupler {

/// A CSV file written row by row; each row is on disk when the call returns, so that a run can be watched and
/// a crash loses nothing.
class CsvFile {
 public:
  /// Starts the file with its line of column names. @throws RunError when it cannot be written.
  CsvFile(std::filesystem::path file, const std::vector<std::string>& columns);
  /// @throws RunError when it cannot be written (a full disk)
  void row(const std::vector<std::string>& cells);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

/// A double with 17 digits: enough to get the same bits back.
std::string exact(double value);

}  // namespace polargrain::coupler
