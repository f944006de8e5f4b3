// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/sealed_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include "common/error.hpp"
#include "common/regular_file.hpp"

namespace polargrain {
namespace {

constexpr std::array<char, 16> kMark{'p', 'o', 'l', 'a', 'r', 'g', 'r', 'a',
                                     'i', 'n', ' ', 'x', 'x', 'h', '3', '\n'};

struct Trailer {
  std::array<char, 16> mark;
  XXH128_canonical_t hash;
};
static_assert(sizeof(Trailer) == 32);

[[noreturn]] void fail(const char* what) {
  throw RunError(fmt::format("{}: {}", what, std::strerror(errno)));
}

/// An open file, closed when it goes.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : id_(open(file.c_str(), flags | O_CLOEXEC)) {
    if (id_ < 0) fail("it cannot be opened");
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(id_); }
  operator int() const { return id_; }  // NOLINT: it stands for the system's own number

 private:
  int id_;
};

off_t size_of(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0) fail("its size cannot be found");
  return status.st_size;
}

/// Hash of the first bytes of a file.
XXH128_canonical_t hash_of(int file, off_t bytes) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> block(1 << 20);
  for (off_t place = 0; place < bytes;) {
    const auto wanted =
        static_cast<std::size_t>(std::min<off_t>(bytes - place, static_cast<off_t>(block.size())));
    const ssize_t count = pread(file, block.data(), wanted, place);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("it cannot be read");
    if (count == 0) throw RunError("it became shorter while it was read");
    XXH3_128bits_update(state.get(), block.data(), static_cast<std::size_t>(count));
    place += count;
  }
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state.get()));
  return canonical;
}

}  // namespace

std::string seal_of(std::string_view bytes) {
  Trailer trailer{kMark, {}};
  XXH128_canonicalFromHash(&trailer.hash, XXH3_128bits(bytes.data(), bytes.size()));
  return {reinterpret_cast<const char*>(&trailer), sizeof trailer};
}

void check_seal(const std::filesystem::path& file) {
  if (const std::string reason = why_no_input(file); !reason.empty()) throw RunError("it " + reason);
  const Descriptor descriptor(file, O_RDONLY);
  const off_t bytes = size_of(descriptor) - static_cast<off_t>(sizeof(Trailer));
  Trailer trailer{};
  if (bytes < 0 ||
      pread(descriptor, &trailer, sizeof trailer, bytes) != static_cast<ssize_t>(sizeof trailer) ||
      trailer.mark != kMark) {
    throw RunError("the file is truncated, or it is not a polargrain file: the mark at its end is missing");
  }
  const XXH128_canonical_t hash = hash_of(descriptor, bytes);
  if (std::memcmp(&hash, &trailer.hash, sizeof hash) != 0) {
    throw RunError("it is damaged: its content does not match the hash at its end");
  }
}

}  // namespace polargrain
