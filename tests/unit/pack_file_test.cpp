// SPDX-License-Identifier: GPL-2.0-or-later
// Packing files keep every bit, and damage of any kind is a fault, never a crash or a wrong packing.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/hdf5_file.hpp"
#include "common/packing_file.hpp"
#include "common/sealed_file.hpp"
#include "common/trial.hpp"

namespace polargrain {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

PreparedPacking some_packing() {
  PreparedPacking prepared;
  prepared.packing.box << 0.2, 0.01, 0.0, 0.1;
  prepared.packing.thickness = 0.1;
  for (int k = 0; k < 5; ++k)
    prepared.packing.grains.push_back({k, {0.1 / 3.0 * k, 0.07 / (k + 1)}, 0.003 + 0.001 * k, 0.02, 1e-7});
  prepared.reached.void_ratio = 1.0 / 7.0;
  prepared.specification = "grains: 5\n";
  return prepared;
}

/// The same grains as spheres in space.
PreparedPacking some_packing_in_space() {
  PreparedPacking prepared = some_packing();
  prepared.packing.dimension = 3;
  prepared.packing.box << 0.2, 0.0, 0.0, 0.1;
  prepared.packing.lean << 0.01 / 3.0, -0.02 / 7.0;
  for (Grain& grain : prepared.packing.grains) grain.height = 0.1 / 7.0 * static_cast<double>(grain.id);
  return prepared;
}

class PackingFileTest : public ::testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_pack_file_test.h5");
};

TEST_F(PackingFileTest, KeepsTheHeightsOfGrainsInSpaceAndTheLeanOfTheirBox) {
  const PreparedPacking written = some_packing_in_space();
  write_packing_file(file_, written);
  const Packing read = read_packing_file(file_).packing;
  EXPECT_EQ(read.dimension, 3);
  EXPECT_EQ(read.lean, written.packing.lean);
  for (std::size_t k = 0; k < read.grains.size(); ++k)
    EXPECT_EQ(read.grains[k].height, written.packing.grains[k].height);
  write_packing_file(file_, some_packing());
  EXPECT_EQ(read_packing_file(file_).packing.dimension, 2);
}

TEST_F(PackingFileTest, KeepsEveryBitAndWritesTheSameBytes) {
  PreparedPacking written = some_packing();
  written.packing.state = std::make_shared<const State>(std::vector<std::byte>(100, std::byte{42}));
  write_packing_file(file_, written);
  const std::string once = bytes_of(file_);
  write_packing_file(file_, written);
  EXPECT_EQ(once, bytes_of(file_));
  const PreparedPacking read = read_packing_file(file_);
  EXPECT_EQ(read.packing.box, written.packing.box);
  EXPECT_EQ(read.packing.thickness, written.packing.thickness);
  ASSERT_EQ(read.packing.grains.size(), 5u);
  EXPECT_EQ(read.packing.grains[3].position, written.packing.grains[3].position);
  EXPECT_EQ(read.packing.grains[3].radius, written.packing.grains[3].radius);
  EXPECT_EQ(read.reached.void_ratio, written.reached.void_ratio);
  EXPECT_EQ(read.specification, written.specification);
  ASSERT_TRUE(read.packing.state);
  EXPECT_EQ(read.packing.state->name(), written.packing.state->name());
}

TEST_F(PackingFileTest, ReadPackingTakesBothKinds) {
  write_packing_file(file_, some_packing());
  EXPECT_EQ(read_packing(file_).grains.size(), 5u);
  EXPECT_FALSE(read_packing(file_).state);
}

TEST_F(PackingFileTest, DamageIsAFaultThatNamesTheFile) {
  write_packing_file(file_, some_packing());
  const std::string good = bytes_of(file_);
  std::mt19937 random(12345);
  int refused = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string bad = good;
    if (trial % 3 == 0) {
      bad.resize(random() % bad.size());
    } else {
      bad[random() % bad.size()] ^= static_cast<char>(1 + random() % 255);
    }
    std::ofstream(file_, std::ios::binary) << bad;
    try {
      // A byte that means nothing may have changed; then the content is the same.
      EXPECT_EQ(read_packing_file(file_).packing.grains[4].position,
                some_packing().packing.grains[4].position);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("pack_file_test.h5"), std::string::npos);
    }
  }
  std::printf("[figure] damaged packing files refused: %d of %d, the others read right\n", refused, kTrials);
  EXPECT_GE(refused, kTrials / 3);  // every file cut short at least
}

// HDF5 reads from other files when a file says so: /etc/shadow as the numbers of a packing, with all hashes right.
TEST_F(PackingFileTest, ValuesFromOtherFilesAreRefused) {
  hdf5::silence();
  write_packing_file(file_, some_packing());
  const std::string sealed = bytes_of(file_);
  const std::filesystem::path other = file_.string() + ".other.h5";
  std::ofstream(other, std::ios::binary) << sealed;
  const auto expect_refused = [this](const char* what) {
    std::string bytes = bytes_of(file_);
    bytes += seal_of(bytes);
    std::ofstream(file_, std::ios::binary) << bytes;
    try {
      (void)read_packing_file(file_);
      ADD_FAILURE() << what;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("grain_x_y_radius_mass_inertia"), std::string::npos)
          << error.what();
    }
  };
  const char* const name = "grain_x_y_radius_mass_inertia";
  const auto without_grains = [&] {
    std::ofstream(file_, std::ios::binary) << sealed;
    auto file =
        std::make_unique<hdf5::Handle>(H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "file");
    hdf5::check(H5Ldelete(*file, name, H5P_DEFAULT), "link");
    return file;
  };
  {
    const auto file = without_grains();
    hdf5::check(H5Lcreate_external(other.c_str(), name, *file, name, H5P_DEFAULT, H5P_DEFAULT), "link");
  }
  expect_refused("a link to another file");
  {
    const auto file = without_grains();
    const hsize_t size = 25;
    const hdf5::Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "space");
    const hdf5::Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
    hdf5::check(H5Pset_external(made, other.c_str(), 0, size * sizeof(double)), "external");
    const hdf5::Handle set(H5Dcreate2(*file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT),
                           H5Dclose, "set");
  }
  expect_refused("values in another file");
  std::filesystem::remove(other);
}

TEST(Trial, EndsNoProgramAndLeavesExceptionsToIt) {
  EXPECT_NO_THROW(try_in_own_process([] {}));
  EXPECT_NO_THROW(try_in_own_process([] { throw RunError("said here too"); }));
  for (const auto& [work, words] : std::vector<std::pair<void (*)(), std::string>>{
           {[] { raise(SIGSEGV); }, "ended by signal 11"}, {[] { _exit(3); }, "ended the process"}})
    try {
      try_in_own_process(work);
      ADD_FAILURE() << words;
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST_F(PackingFileTest, ImpossibleValuesAreFaults) {
  PreparedPacking bad = some_packing();
  bad.packing.grains[2].radius = 0.0;
  write_packing_file(file_, bad);
  EXPECT_THROW(read_packing_file(file_), InputError);
  EXPECT_THROW(read_packing_file("no/such/file.h5"), InputError);
  EXPECT_THROW(write_packing_file("no/such/folder/file.h5", bad), RunError);
}

}  // namespace
}  // namespace polargrain
