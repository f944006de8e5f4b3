// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/fuzz/files.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/commands/point.hpp"
#include "app/pack/read_specification.hpp"
#include "common/error.hpp"
#include "common/packing_file.hpp"
#include "common/sealed_file.hpp"
#include "coupler/case/case.hpp"
#include "coupler/checkpoint/checkpoint.hpp"

namespace polargrain::testing {
namespace {

/// A directory in memory with the files that cases name.
class Place {
 public:
  Place() : path_("/dev/shm/polargrain_fuzz_" + std::to_string(getpid())) {
    std::filesystem::create_directories(path_);
    std::ofstream(path_ / "fake.in") << "pair_coeff * *\n";
    std::ofstream(path_ / "grains.csv")
        << "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n";
  }
  ~Place() {
    std::error_code nothing;
    std::filesystem::remove_all(path_, nothing);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  [[nodiscard]] std::filesystem::path write(const char* name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

std::string sealed(std::string_view bytes) {
  std::string whole(bytes);
  whole += seal_of(whole);
  return whole;
}

}  // namespace

bool read_as(FileKind kind, std::string_view bytes) {
  static const Place place;
  try {
    switch (kind) {
      case FileKind::case_file:
        (void)coupler::read_case(place.write("case.yaml", bytes));
        break;
      case FileKind::packing_csv:
        (void)read_packing(place.write("packing.csv", bytes));
        break;
      case FileKind::packing_hdf5:
        (void)read_packing(place.write("packing.h5", bytes));
        break;
      case FileKind::path:
        (void)app::read_path(place.write("path.csv", bytes));
        break;
      case FileKind::specification:
        (void)app::read_packing_specification(place.write("specification.yaml", bytes), {});
        break;
      case FileKind::checkpoint:
        (void)coupler::read_checkpoint(place.write("checkpoint.h5", bytes));
        break;
      case FileKind::forged_packing:
        (void)read_packing(place.write("packing.h5", sealed(bytes)));
        break;
      case FileKind::forged_checkpoint:
        (void)coupler::read_checkpoint(place.write("checkpoint.h5", sealed(bytes)));
        break;
    }
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace polargrain::testing
