// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace polargrain::app {

/// A CSV file written row by row, so that a run can be watched and a crash loses nothing. The rows are in
/// memory too: a run that is interrupted takes them along (coupler/checkpoint).
class CsvFile {
 public:
  /// Starts the file with its line of column names. @throws RunError when it cannot be written.
  CsvFile(std::filesystem::path file, const std::vector<std::string>& columns);
  /// Goes on behind `text`, which then is all the file holds. @throws RunError as above.
  CsvFile(std::filesystem::path file, std::string text);
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  /// Adds a row in memory.
  void add(const std::vector<std::string>& cells);
  /// Hands the added rows to the system. @throws RunError when it does not take all of them (a full disk); the
  /// file then ends with the last row that was written before.
  void write();
  /// add and write
  void row(const std::vector<std::string>& cells);

  /// All of the file, lines that are not written yet included.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void open(bool anew);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::string text_;
  std::size_t written_ = 0;
};

/// A row of a CSV file, its line end included. Cells are quoted where they must be (RFC 4180); line ends in them become blanks.
/// The one place where names of the user's become cells.
std::string csv_row(const std::vector<std::string>& cells);

/// A double with 17 digits: enough to get the same bits back.
std::string exact(double value);

}  // namespace polargrain::app
