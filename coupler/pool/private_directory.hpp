// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

namespace polargrain::coupler {

/// A new directory for local sockets (and short-lived logs) that nobody but the user can enter (mode 0700),
/// removed with its content at the end. Remains of killed processes are removed when the
/// next one is made. Lies in $TMPDIR or /tmp: a socket's path must be shorter than 108 characters, which a
/// path below the result directory need not be.
class PrivateDirectory {
 public:
  /// @throws RunError when it cannot be made
  PrivateDirectory();
  ~PrivateDirectory();
  PrivateDirectory(const PrivateDirectory&) = delete;
  PrivateDirectory& operator=(const PrivateDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Whether the directory stays at the end, for somebody to read.
  void keep(bool keep = true) { keep_ = keep; }

 private:
  bool keep_ = false;
  int lock_ = -1;  ///< held while this process lives
  std::filesystem::path path_;
};

}  // namespace polargrain::coupler
