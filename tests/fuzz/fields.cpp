// SPDX-License-Identifier: GPL-2.0-or-later
// A result directory whose last frame (first byte 0 a field file, 1 a dump of grains, 3 a field of images) or history (2) is made of the bytes.
// Its band is looked for, by what happened since the frame before: refused with an InputError, or a band, or none.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "band/frames.hpp"
#include "band/shear_band.hpp"
#include "common/error.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/output/vtu.hpp"

namespace {

using namespace polargrain;
namespace fs = std::filesystem;

constexpr int kKinds = 4;

/// The fields of 6 elements, 24 places, that a shear has moved a little.
void write_good_fields(const fs::path& file) {
  const fem::Mesh<2> mesh = fem::rectangle({{1.0, 1.5}, {2, 3}}, "Q4");
  fem::Field displacement{"displacement", 3, {}};
  for (const Eigen::Vector2d& node : mesh.nodes)
    displacement.values.insert(displacement.values.end(), {0.01 * node.y(), 0.0, 0.0});
  fem::Fields fields;
  fields.points.push_back(displacement);
  fem::write_vtu(file, mesh, fields);
}

void write_good_grains(const fs::path& file) {
  std::ofstream out(file);
  out << "ITEM: TIMESTEP\n0\nITEM: ATOMS id x y f_turned \n";
  for (int k = 0; k < 25; ++k) out << k << ' ' << k % 5 + 0.1 * (k / 5) << ' ' << k / 5 << " 0.01 \n";
}

void write_good_images(const fs::path& file) {
  std::ofstream out(file);
  out << "x,y,u,v\n";
  for (int k = 0; k < 25; ++k) out << k % 5 + 0.1 * (k / 5) << ',' << k / 5 << ",0.01," << 0.001 * k << '\n';
}

/// Four directories, whole but for what the bytes are to be.
class Place {
 public:
  Place() : path_("/dev/shm/polargrain_fuzz_fields_" + std::to_string(getpid())) {
    for (int kind = 0; kind < kKinds; ++kind) {
      static constexpr const char* kFolders[kKinds] = {"fields", "grains", "fields", "displacements"};
      const fs::path folder = at(kind) / kFolders[kind];
      fs::create_directories(folder);
      for (const int step : {0, 1}) {
        if (kind == 1)
          write_good_grains(folder / fmt::format("step-{}.dump", step));
        else if (kind == 3)
          write_good_images(folder / fmt::format("step-{}.csv", step));
        else
          write_good_fields(folder / fmt::format("step-{}.vtu", step));
      }
      std::ofstream(at(kind) / "history.csv") << "step,axial_strain\n0,0\n1,0.01\n";
    }
  }
  ~Place() {
    std::error_code nothing;
    fs::remove_all(path_, nothing);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  [[nodiscard]] fs::path at(int kind) const { return path_ / std::to_string(kind); }
  [[nodiscard]] fs::path file(int kind) const {
    static constexpr const char* kFiles[kKinds] = {"fields/step-1.vtu", "grains/step-1.dump", "history.csv",
                                                   "displacements/step-1.csv"};
    return at(kind) / kFiles[kind];
  }

 private:
  fs::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  if (size == 0) return 0;
  const int kind = data[0] % kKinds;
  std::ofstream(place.file(kind), std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    const band::Frames frames(place.at(kind), "axial_strain");
    const band::Samples samples = frames.increment(0, frames.nearest(1.0), false);
    const band::BandSearch search = band::find_band(samples);
    if (search.band) (void)band::localisation(samples, *search.band);
  } catch (const InputError&) {  // refused, as it should be
  }
  return 0;
}
