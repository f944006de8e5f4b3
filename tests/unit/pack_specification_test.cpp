// SPDX-License-Identifier: GPL-2.0-or-later
// Messages of `polargrain pack` on wrong specifications: file, line, the value expected.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/pack/drawn_sizes.hpp"
#include "app/pack/read_specification.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

const std::string kGood =
    "grains: 400\n"
    "sizes: {law: uniform, radius: [3 mm, 7 mm]}\n"
    "density: 2650\n"
    "thickness: 100 mm\n"
    "script: cells/hooke_radii.in\n"
    "pressure: 100 kPa\n"
    "friction: 0\n"
    "seed: 1\n";

class Specification : public ::testing::Test {
 protected:
  ~Specification() override { std::filesystem::remove(file_); }
  // A name of its own: ctest runs the cases of this file beside each other.
  std::filesystem::path file_ = std::filesystem::path(::testing::TempDir()) /
                                ("pack_specification_" + std::to_string(getpid()) + ".yaml");
  std::string fault(const std::string& from, const std::string& to) {
    std::string text = kGood;
    text.replace(text.find(from), from.size(), to);
    std::ofstream(file_) << text;
    try {
      read_packing_specification(file_, {});
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.substr(message.find(file_.string()) + file_.string().size());
    }
    return "no fault";
  }
};

TEST_F(Specification, IsRead) {
  std::ofstream(file_) << kGood;
  const PackingSpecification read = read_packing_specification(file_, {"seed=7"});
  EXPECT_EQ(read.grains, 400);
  EXPECT_EQ(read.seed, 7u);
  EXPECT_DOUBLE_EQ(read.sizes.radii[1], 7e-3);
  EXPECT_DOUBLE_EQ(read.pressure, 1e5);
  EXPECT_FALSE(read.script.empty());
}

TEST(DrawnSizes, ThatLeaveTheCurveAreTold) {
  PackingSpecification asked;
  asked.sizes = {SizeLaw::Kind::sieve, {1e-3, 2e-3, 4e-3}, {0.0, 0.5, 1.0}};
  Packing packing;
  packing.grains.resize(5);
  for (Grain& grain : packing.grains) grain.radius = 1.5e-3;
  packing.grains.back().radius = 3e-3;
  // Four discs of 1.5 mm weigh as much as one of 3 mm; as spheres they weigh half as much.
  EXPECT_EQ(remark_on_drawn_sizes(asked, packing), "");
  asked.spheres = true;
  EXPECT_NE(remark_on_drawn_sizes(asked, packing)
                .find("33 % of the mass pass the sieve of 4 mm, 50 % were asked for: 5 grains are too few"),
            std::string::npos)
      << remark_on_drawn_sizes(asked, packing);
}

TEST_F(Specification, SpheresInSpaceHaveNoThickness) {
  std::string text = kGood;
  text.replace(text.find("thickness: 100 mm"), 17, "dimension: 3");
  text.replace(text.find("hooke_radii.in"), 14, "spheres_hooke_radii.in");
  std::ofstream(file_) << text;
  const PackingSpecification read = read_packing_specification(file_, {});
  EXPECT_EQ(read.dimension, 3);
  EXPECT_TRUE(read.spheres);
  // The script of discs is a fault too, told behind these.
  const std::string thick = fault("seed: 1", "seed: 1\ndimension: 3");
  EXPECT_EQ(
      thick.find(
          ":4: packing: thickness: leave it out in dimension 3, where the box is compressed in all directions"),
      0U)
      << thick;
  const std::string discs = fault("thickness: 100 mm", "dimension: 3\nshape: discs");
  EXPECT_EQ(discs.find(":5: packing: shape: in dimension 3 grains are spheres"), 0U) << discs;
}

TEST_F(Specification, TellsWhatEachAxisCarries) {
  std::string text = kGood;
  text.replace(text.find("pressure: 100 kPa"), 17, "pressure: [80 kPa, 120 kPa]\nrolling_friction: 0.3");
  std::ofstream(file_) << text;
  const PackingSpecification read = read_packing_specification(file_, {});
  EXPECT_DOUBLE_EQ(read.pressure, 1e5);
  EXPECT_DOUBLE_EQ(read.share_of_axis[0], 0.8);
  EXPECT_DOUBLE_EQ(read.share_of_axis[1], 1.2);
  EXPECT_DOUBLE_EQ(read.rolling_friction.value(), 0.3);
  EXPECT_DOUBLE_EQ(read.damping, kDampingInPlane);
  EXPECT_DOUBLE_EQ(read_packing_specification(file_, {"pressure=100 kPa", "one_dimensional_from=10 kPa"})
                       .one_dimensional_from.value(),
                   1e4);
  EXPECT_EQ(fault("seed: 1", "seed: 1\none_dimensional_from: 200 kPa"),
            ":9: packing: one_dimensional_from: must be less than the pressure");
  EXPECT_EQ(
      fault("pressure: 100 kPa", "pressure: [1 kPa, 2 kPa]\none_dimensional_from: 1 kPa"),
      ":7: packing: one_dimensional_from: the lateral stresses follow from it; give one pressure, for the "
      "last axis");
}

TEST_F(Specification, GrainsFallWhereAsked) {
  std::ofstream(file_) << kGood;
  const PackingSpecification read =
      read_packing_specification(file_, {"deposition={bedding_angle: 90 deg, sides: kept}"});
  ASSERT_TRUE(read.deposition);
  EXPECT_DOUBLE_EQ(read.deposition->bedding_angle, 0.5 * M_PI);
  EXPECT_TRUE(read.deposition->keeps_width);
  EXPECT_FALSE(read_packing_specification(file_, {"deposition={}"}).deposition->keeps_width);
  EXPECT_EQ(fault("seed: 1", "seed: 1\ndeposition: {side: kept}").substr(0, 26),
            ":9: deposition: unknown ke");
  EXPECT_EQ(fault("seed: 1", "seed: 1\ndeposition: {sides: free}").substr(0, 33),
            ":9: deposition: sides: expected o");
  EXPECT_EQ(fault("seed: 1", "seed: 1\ndeposition: {}\none_dimensional_from: 10 kPa").substr(0, 60),
            ":10: packing: one_dimensional_from: grains that fall are com");
  EXPECT_EQ(fault("pressure: 100 kPa", "pressure: [1 kPa, 2 kPa]\ndeposition: {sides: kept}").substr(0, 54),
            ":6: packing: pressure: with 'sides: kept' the lateral ");
}

TEST_F(Specification, FaultsNameTheLine) {
  EXPECT_EQ(fault("grains: 400", "grains: 3"),
            ":1: packing: grains: expected a whole number of at least 4, found '3'");
  EXPECT_EQ(fault("law: uniform", "law: unifrom").substr(0, 40), ":2: sizes: law: expected one of uniform,");
  EXPECT_EQ(fault("[3 mm, 7 mm]", "[7 mm, 3 mm]"), ":2: sizes: radius: the first must be the smaller one");
  EXPECT_EQ(fault("law: uniform", "law: unifrom").find("unknown key"), std::string::npos);
  EXPECT_NE(fault("density: 2650", "density: 2650 kg/m3")
                .find("density: give the number of kg/m3 alone, such as 2650"),
            std::string::npos);
  EXPECT_EQ(fault("density: 2650", "density: 2650 kg/m3").find("lighter"), std::string::npos);
  EXPECT_EQ(fault("pressure: 100 kPa", "pressure: -1 kPa"),
            ":6: packing: pressure: must be greater than zero, found '-1 kPa'");
  EXPECT_EQ(
      fault("pressure: 100 kPa", "pressure: 50"),
      ":6: pressure: '50' without a unit is 50 Pa, the weight of 2.8 mm of soil; write '50 kPa', or with the unit that is meant");
  EXPECT_NE(fault("friction: 0", "friction: 30").find("for an angle of 30 degrees write 0.577"),
            std::string::npos);
  EXPECT_NE(fault("pressure: 100 kPa", "pressure: [80 kPa, 120]").find("'120' without a unit is 120 Pa"),
            std::string::npos);
  EXPECT_EQ(fault("seed: 1", "seeds: 1").substr(0, 45), ":1: packing: the key 'seed' is missing; give ");
  EXPECT_EQ(fault("cells/hooke_radii.in", "cells/nowhere.in").substr(0, 62),
            ":5: packing: script: there is no file 'cells/nowhere.in', neit");
  EXPECT_EQ(fault("{law: uniform, radius: [3 mm, 7 mm]}",
                  "{law: sieve, diameter: [1 mm, 2 mm], passing: [0, 90 %]}"),
            ":2: sizes: passing: must rise from 0 to 100 % (parts of the mass that pass each sieve)");
  EXPECT_EQ(
      fault("{law: uniform, radius: [3 mm, 7 mm]}",
            "{law: sieve, diameter: [1 mm, 2 mm], passing: [0, 100]}"),
      ":2: sizes: passing: must rise from 0 to 100 % (parts of the mass that pass each sieve); '100' is 10000 %, "
      "write '100 %'");
}

}  // namespace
}  // namespace polargrain::app
