// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packing_data.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <numbers>

#include "common/error.hpp"

namespace polargrain::dem {

std::string packing_data(const Packing& packing) {
  const Box box = Box::from_base_vectors(packing.box).reduced();
  const Eigen::Matrix2d to_box_frame = box.frame().transpose();
  std::string text =
      "packing of polargrain: grains of one type, density chosen so that a sphere has the grain's mass\n\n";
  text += fmt::format("{} atoms\n1 atom types\n\n", packing.grains.size());
  text += fmt::format(
      "0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n{:.17g} {:.17g} zlo zhi\n{:.17g} 0 0 xy xz yz\n\nAtoms\n\n",
      box.length_x, box.length_y, -0.5 * packing.thickness, 0.5 * packing.thickness, box.tilt);
  for (const Grain& grain : packing.grains) {
    const Eigen::Vector2d position = to_box_frame * grain.position;
    const double sphere = 4.0 / 3.0 * std::numbers::pi * grain.radius * grain.radius * grain.radius;
    text += fmt::format("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} 0\n", grain.id + 1, 2.0 * grain.radius,
                        grain.mass / sphere, position.x(), position.y());
  }
  return text;
}

PackingDataFile::PackingDataFile(const Packing& packing) : descriptor_(memfd_create("packing", MFD_CLOEXEC)) {
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

}  // namespace polargrain::dem
