// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "common/hdf5_file.hpp"

namespace polargrain::hdf5 {

/// A new file of HDF5 in memory, held once: checkpoints come to gigabytes. The library is never let write to a disk: when
/// that is full it crashes at the end of the program.
class FileInMemory {
 public:
  /// @param expected bytes, for which memory is taken at once: to grow, large memory is copied
  /// @throws RunError as all of hdf5
  explicit FileInMemory(std::size_t expected = 0);
  ~FileInMemory();
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

  [[nodiscard]] hid_t file() const { return *file_; }
  /// The end of all writing. @returns the bytes of the file, which last as long as this
  std::string_view close();

 private:
  struct Image;  // memory that the library asks for, and leaves here
  std::unique_ptr<Image> image_;
  std::optional<Handle> file_;
};

}  // namespace polargrain::hdf5
