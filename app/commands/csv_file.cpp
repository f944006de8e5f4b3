// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/csv_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "common/error.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {

CsvFile::CsvFile(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)) {
  open(true);
  row(columns);
}

CsvFile::CsvFile(std::filesystem::path file, std::string text)
    : file_(std::move(file)), text_(std::move(text)), written_(text_.size()) {
  fem::write_file(file_, text_);
  open(false);
}

CsvFile::~CsvFile() {
  close(descriptor_);
}

void CsvFile::open(bool anew) {
  // A pipe that nobody reads is an error, not something to wait for.
  descriptor_ = ::open(file_.c_str(),
                       O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND | O_NONBLOCK | (anew ? O_TRUNC : 0), 0666);
  if (descriptor_ < 0) {
    throw RunError(fmt::format("{} cannot be written: {}", file_.string(), std::strerror(errno)));
  }
  fcntl(descriptor_, F_SETFL, fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
}

void CsvFile::add(const std::vector<std::string>& cells) {
  text_ += csv_row(cells);
}

void CsvFile::write() {
  for (std::size_t place = written_; place < text_.size();) {
    const ssize_t count = ::write(descriptor_, text_.data() + place, text_.size() - place);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      // Half a row is worse than a row that is missing. Where even this fails nothing more can be done.
      if (ftruncate(descriptor_, static_cast<off_t>(written_)) != 0) {
      }
      throw RunError(fmt::format("{} cannot be written: {}", file_.string(), std::strerror(reason)));
    }
    place += static_cast<std::size_t>(count);
  }
  written_ = text_.size();
}

void CsvFile::row(const std::vector<std::string>& cells) {
  add(cells);
  write();
}

std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) {
    if (&cell != cells.data()) row += ',';
    // Readers trim blanks, and take a row for a comment that begins so.
    const bool is_quoted = cell.find_first_of(",\"\r\n\t") != std::string::npos || cell.starts_with(' ') ||
                           cell.ends_with(' ') || cell.starts_with('#');
    if (!is_quoted) {
      row += cell;
      continue;
    }
    row += '"';
    for (const char c : cell) {
      const bool ends_line = c == '\n' || c == '\r';  // no reader of ours takes a row for two lines
      row += ends_line ? ' ' : c;
      if (c == '"') row += '"';
    }
    row += '"';
  }
  return row + '\n';
}

std::string exact(double value) {
  if (std::isnan(value)) return "nan";  // its sign and payload depend on the processor
  return fmt::format("{:.17g}", value);
}

}  // namespace polargrain::app
