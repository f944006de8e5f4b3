// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/private_directory.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "common/error.hpp"

namespace polargrain::coupler {

PrivateDirectory::PrivateDirectory() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "polargrain-XXXXXX").string();
  if (error || name.size() > 90) name = "/tmp/polargrain-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) {
    throw RunError(
        fmt::format("cannot make a directory for the sockets of the workers ({}): {}; set TMPDIR to a "
                    "directory you may write to",
                    name, std::strerror(errno)));
  }
  path_ = name;
}

PrivateDirectory::~PrivateDirectory() {
  if (keep_) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace polargrain::coupler
