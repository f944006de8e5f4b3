// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <iostream>

namespace polargrain::dem {

/// The engine warns on the error stream of every combination of models that is registered twice, although
/// this replaces one: nothing is printed there as long as this lives.
class QuietErrors {
 public:
  QuietErrors() : buffer_(std::cerr.rdbuf(nullptr)) {}
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() {
    std::cerr.rdbuf(buffer_);
    std::cerr.clear();
  }

 private:
  std::streambuf* buffer_;
};

}  // namespace polargrain::dem
