// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.hpp"

namespace polargrain {
namespace {

const std::string kHeader = "# cell base vectors xx=0.2 xy=0.01 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n";

class PackingFile : public ::testing::Test {
 protected:
  std::string file_ =
      (std::filesystem::path(::testing::TempDir()) /
       (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv"))
          .string();
  Packing read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_packing(file_);
  }
  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.substr(message.find(file_) + file_.size());
    }
    return "no fault";
  }
};

TEST_F(PackingFile, IsReadWithItsCell) {
  const Packing packing = read(kHeader + "0,0.01,0.02,0.005,0.02,2.5e-7\n7,0.05,0.02,0.004,0.01,1e-7\n");
  ASSERT_EQ(packing.grains.size(), 2u);
  EXPECT_EQ(packing.grains[1].id, 7);
  EXPECT_EQ(packing.grains[1].radius, 0.004);
  EXPECT_EQ(packing.box(0, 1), 0.01);
  EXPECT_DOUBLE_EQ(packing.volume(), 0.2 * 0.1 * 0.1);
}

TEST_F(PackingFile, FaultsNameTheLineAndWhatIsExpected) {
  EXPECT_EQ(fault("id,x\n"),
            ":1: expected the cell's base vectors as '# cell xx=... xy=... yx=... yy=... z=...' in m; 'xx=' "
            "is missing or not a number");
  EXPECT_EQ(fault("# cell xx=0.2 xy=0 yx=0 yy=0 z=0.1\nid,x,y,r,mass,Izz\n"),
            ":1: the base vectors span no area (or are left-handed)");
  EXPECT_EQ(fault("# cell xx=0.2 xy=0 yx=0 yy=0.2 z=0.1\nx,y\n"),
            ":2: expected the column names 'id,x,y,r,mass,Izz', of spheres in space 'id,x,y,z,r,mass,Izz'");
  EXPECT_EQ(fault(kHeader), ":2: the packing has no grains");
  EXPECT_EQ(fault(kHeader + "0,0.01,0.02,0.005,0.02\n"),
            ":3: a value for each of 6 columns ('id,x,y,r,mass,Izz', line 2) was expected, and 5 are here");
  EXPECT_EQ(fault(kHeader + "0,0.01,0.02,five,0.02,1e-7\n"), ":3: 'five' in column 'r' is not a number");
  EXPECT_EQ(fault(kHeader + "0,0.01,nan,0.005,0.02,1e-7\n"), ":3: 'nan' in column 'y' is not a number");
  EXPECT_EQ(fault(kHeader + "0,0.01,0.02,-0.005,0.02,1e-7\n"), ":3: the radius must be positive");
  EXPECT_EQ(fault(kHeader + "0,0.01,0.02,0.005,0,1e-7\n"), ":3: the mass must be positive");
  EXPECT_EQ(fault(kHeader + "0,0.01,0.02,0.005,0.02,1e-7\n0,0.05,0.02,0.005,0.02,1e-7\n"),
            ":4: grain 0 stands here a second time");
}

TEST_F(PackingFile, SpheresInSpaceHaveThreeBaseVectors) {
  const std::string columns = "\nid,x,y,z,r,mass,Izz\n7,0.01,0.02,0.03,0.005,0.02,2.5e-7\n";
  const Packing packing =
      read("# cell xx=0.2 xy=0.01 xz=0.02 yx=0 yy=0.1 yz=-0.03 zx=0 zy=0 zz=0.3 p=1e5" + columns);
  EXPECT_EQ(packing.dimension, 3);
  EXPECT_EQ(packing.grains.front().height, 0.03);
  EXPECT_EQ(packing.grains.front().radius, 0.005);
  Eigen::Matrix3d base;
  base << 0.2, 0.01, 0.02, 0.0, 0.1, -0.03, 0.0, 0.0, 0.3;
  EXPECT_EQ(packing.base_vectors(), base);
  EXPECT_NEAR(packing.grain_volume(), 5.235987755982988e-7, 1e-21);  // 4/3 pi r^3
  EXPECT_EQ(
      fault("# cell xx=0.2 xy=0 xz=0 yx=0 yy=0.1 yz=0 zx=0.1 zy=0 zz=0.3" + columns),
      ":1: the first two base vectors of a packing in space must lie in the plane of x and y: zx and zy "
      "must be 0; turn the packing");
  EXPECT_EQ(
      fault("# cell xx=0.2 xy=0 yx=0 yy=0.1 z=0.1" + columns),
      ":1: expected the cell's base vectors as '# cell xx=... xy=... xz=... yx=... yy=... yz=... zx=... "
      "zy=... zz=...' in m; 'zz=' is missing or not a number");
}

TEST(Packing, MissingFileIsAFault) {
  EXPECT_THROW(read_packing("no/such/packing.csv"), InputError);
}

TEST_F(PackingFile, MayRecordItsPressure) {
  const std::string grain = "\nid,x,y,r,mass,Izz\n0,0.01,0.02,0.005,0.02,2.5e-7\n";
  EXPECT_EQ(read("# cell xx=0.2 xy=0 yx=0 yy=0.1 z=0.1 p=1e5" + grain).pressure, 1e5);
  EXPECT_EQ(read("# cell xx=0.2 xy=0 yx=0 yy=0.1 z=0.1" + grain).pressure, 0.0);
  EXPECT_EQ(fault("# cell xx=0.2 xy=0 yx=0 yy=0.1 z=0.1 p=-1" + grain),
            ":1: the pressure p must be positive, or left out");
}

}  // namespace
}  // namespace polargrain
