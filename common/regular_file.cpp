// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/regular_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace polargrain {

std::string why_no_input(const std::filesystem::path& file) {
  // The system would read the name to its first NUL, which is the name of another file.
  if (file.native().find('\0') != std::string::npos)
    return "cannot be the name of a file: there is a NUL in it";
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return "there is no such file";
    return fmt::format("cannot be read: {}", std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) return "is a directory; give the name of a file in it";
  if (!S_ISREG(status.st_mode))
    return "is a pipe or a device; write its output into a file, and name that file";
  if (access(file.c_str(), R_OK) != 0) return fmt::format("cannot be read: {}", std::strerror(errno));
  return {};
}

std::string why_no_output(const std::filesystem::path& file) {
  if (file.native().find('\0') != std::string::npos)
    return "cannot be the name of a file: there is a NUL in it";
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) return "is a directory; give the name of a file";
    if (!S_ISREG(status.st_mode)) return {};  // takes bytes, or says why not
  } else if (errno != ENOENT) {
    return fmt::format("cannot be written: {}", std::strerror(errno));
  }
  // It is made beside its place, under a longer name.
  const std::string made = file.string() + ".part";
  if (lstat(made.c_str(), &status) != 0 && errno != ENOENT)
    return fmt::format("cannot be written: {}", std::strerror(errno));
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    return fmt::format("there is no folder {}", folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return fmt::format("cannot be written: {}: {}", folder.string(), std::strerror(errno));
  return {};
}

std::string why_not_over(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code error;  // of a file that does not exist: it is not the other one
    if (!std::filesystem::equivalent(output, input, error) || error) continue;
    const auto plain = [](const std::filesystem::path& file) {
      return std::filesystem::absolute(file).lexically_normal();
    };
    const std::string name = plain(input) == plain(output) ? "this file" : input.string();
    return fmt::format("the command reads {}, and would write over it; name another file", name);
  }
  return {};
}

std::string why_not_own(const std::filesystem::path& file, std::string_view beginning,
                        std::string_view what) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file, error);  // a device takes what comes
  if (!is_file || std::filesystem::file_size(file, error) == 0) return {};
  std::string found(beginning.size(), ' ');
  std::ifstream(file, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  if (found == beginning) return {};
  return fmt::format("this file is there and is no {}", what);
}

}  // namespace polargrain
