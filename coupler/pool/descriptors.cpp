// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/descriptors.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <filesystem>
#include <system_error>

#include "common/error.hpp"

namespace polargrain::coupler {

void allow_many_descriptors() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

void require_descriptors(std::size_t more, const std::string& purpose) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::error_code error;
  std::size_t used = 0;
  for (std::filesystem::directory_iterator file("/proc/self/fd", error), end; !error && file != end;
       file.increment(error))
    ++used;
  // Without a descriptor to spare the list itself cannot be read.
  if (error) used = limit.rlim_cur;
  if (used + more <= limit.rlim_cur) return;
  throw RunError(fmt::format(
      "the limit of open files is {}: {} are in use, and {} needs {} more; raise it with 'ulimit -n {}'",
      limit.rlim_cur, used, purpose, more, 256 + used + more));
}

}  // namespace polargrain::coupler
