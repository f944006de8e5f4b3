// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/write_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "common/error.hpp"

namespace polargrain {
namespace {

/// @returns 0, or why the file cannot be written (errno)
int try_to_write(const std::filesystem::path& file, const std::string& content, Durability durability) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int reason = 0;
  for (std::size_t place = 0; place < content.size() && reason == 0;) {
    const ssize_t count = write(descriptor, content.data() + place, content.size() - place);
    if (count > 0) place += static_cast<std::size_t>(count);
    if (count < 0 && errno != EINTR) reason = errno;
  }
  if (reason == 0 && durability == Durability::disk && syncfs(descriptor) != 0) reason = errno;
  // Some file systems find out only now that there is no room.
  if (close(descriptor) != 0 && reason == 0) reason = errno;
  return reason;
}

/// The new name of a file is on the disk only when its directory is. Where that cannot be asked for, the file
/// itself is there all the same.
void synchronise(const std::filesystem::path& directory) {
  const int descriptor =
      open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  (void)fsync(descriptor);
  close(descriptor);
}

/// Gives a file a second name, in the place of what has that name. Where the file system knows no second
/// names, the file loses its first one: it is then under one of both at every moment.
void keep_as(const std::filesystem::path& file, const std::filesystem::path& kept) {
  std::filesystem::path second = kept;
  second += ".part";
  std::error_code nothing;
  std::filesystem::remove(second, nothing);
  const bool linked = link(file.c_str(), second.c_str()) == 0;
  if (linked || errno != ENOENT) (void)std::rename(linked ? second.c_str() : file.c_str(), kept.c_str());
}

}  // namespace

void write_file(const std::filesystem::path& file, const std::string& content, Durability durability,
                const std::filesystem::path& keep) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::error_code nothing;
  if (const int reason = try_to_write(temporary, content, durability); reason != 0) {
    std::filesystem::remove(temporary, nothing);
    throw RunError(fmt::format("{} cannot be written: {}", file.string(), std::strerror(reason)));
  }
  if (!keep.empty()) keep_as(file, keep);
  if (std::rename(temporary.c_str(), file.c_str()) != 0) {
    const int reason = errno;
    std::filesystem::remove(temporary, nothing);
    throw RunError(fmt::format("{} cannot be put in place: {}", file.string(), std::strerror(reason)));
  }
  if (durability == Durability::disk) synchronise(file.parent_path());
}

}  // namespace polargrain
