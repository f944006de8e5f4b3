// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/write_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>

#include "common/error.hpp"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using Parts = std::span<const std::string_view>;

/// The place that a name stands for: where a link leads, though nothing may be there yet. Renaming onto a link would take the
/// link away, and leave what it led to as it was. @returns nothing when links lead round in circles
std::optional<fs::path> place_of(const fs::path& file) {
  constexpr int kMostLinks = 40;  // as the system has it
  fs::path place = file;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    const fs::path target = fs::read_symlink(place, error);
    if (error) return place;
    place = place.parent_path() / target;  // an absolute one stands alone
  }
  return std::nullopt;
}

/// Whether a name stands for something that takes bytes but is no file: a device, a pipe, a socket.
bool is_stream(const fs::path& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

/// @returns 0, or why the bytes cannot be written (errno)
int write_all(int descriptor, Parts parts) {
  int reason = 0;
  for (const std::string_view part : parts)
    for (std::size_t place = 0; place < part.size() && reason == 0;) {
      const ssize_t count = write(descriptor, part.data() + place, part.size() - place);
      if (count > 0) place += static_cast<std::size_t>(count);
      if (count < 0 && errno != EINTR) reason = errno;
    }
  return reason;
}

/// Into what is there already: nothing takes its place. A pipe that nobody reads is an error, not something to wait for.
int write_into_stream(const fs::path& stream, Parts parts) {
  const int descriptor = open(stream.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  const int reason = write_all(descriptor, parts);
  return close(descriptor) != 0 && reason == 0 ? errno : reason;
}

/// @returns 0, or why the file cannot be written (errno)
int try_to_write(const std::filesystem::path& file, Parts parts, Durability durability) {
  // A file of that name is ours, or it is an error: no link is followed, no pipe waited for.
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int reason = write_all(descriptor, parts);
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

void write_file(const std::filesystem::path& file, std::string_view content, Durability durability,
                const std::filesystem::path& keep) {
  write_file(file, Parts(&content, 1), durability, keep);
}

void write_file(const std::filesystem::path& file, Parts parts, Durability durability,
                const std::filesystem::path& keep) {
  const auto fail = [&file](const char* what, int reason) {
    throw RunError(fmt::format("{} cannot be {}: {}", file.string(), what, std::strerror(reason)));
  };
  if (file.native().find('\0') != std::string::npos) fail("written", EINVAL);  // it would be another file
  if (is_stream(file)) {
    if (const int reason = write_into_stream(file, parts); reason != 0) fail("written", reason);
    return;
  }
  const std::optional<fs::path> place = place_of(file);
  if (!place) fail("written", ELOOP);
  std::filesystem::path temporary = *place;
  temporary += ".part";
  std::error_code nothing;
  if (const int reason = try_to_write(temporary, parts, durability); reason != 0) {
    std::filesystem::remove(temporary, nothing);
    fail("written", reason);
  }
  if (!keep.empty()) keep_as(*place, keep);
  if (std::rename(temporary.c_str(), place->c_str()) != 0) {
    const int reason = errno;
    std::filesystem::remove(temporary, nothing);
    fail("put in place", reason);
  }
  if (durability == Durability::disk) synchronise(place->parent_path());
}

}  // namespace polargrain
