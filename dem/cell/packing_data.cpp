// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packing_data.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "common/error.hpp"
#include "dem/engine/engine.hpp"
#include "grains_io/neighbour_distance.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

PackingDataFile::PackingDataFile(const Packing& packing)
    : neighbour_distance_(neighbour_distance(packing)), descriptor_(memfd_create("packing", MFD_CLOEXEC)) {
  const std::string text = packing_data(packing);
  std::size_t written = 0;
  while (descriptor_ >= 0 && written < text.size()) {
    const ssize_t count = write(descriptor_, text.data() + written, text.size() - written);
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  if (written < text.size()) throw RunError("no memory for the packing's data file");
}

PackingDataFile::~PackingDataFile() {
  close(descriptor_);
}

std::string PackingDataFile::path() const {
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

void PackingDataFile::define_variables(Engine& engine) const {
  engine.command(fmt::format("variable packing index {}", path()));
  engine.command(fmt::format("variable neighbour_distance index {}", neighbour_distance_));
}

}  // namespace polargrain::dem
