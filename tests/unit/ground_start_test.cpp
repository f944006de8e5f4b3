// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes that begin in level ground, with boxes whose law is known: linear elasticity, whose K0 is nu / (1 - nu) of what is
// added, and one that stiffens with pressure and hardly answers to small strains of rest.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "coupler/cells/ground_start.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kPressureOfGroundStart = 100e3;
constexpr double kYoung = 50e6;
constexpr double kPoisson = 0.25;

/// s = -p 1 + C(e), e the sum of the strains; stiffer under more strain by `hardening`. The state is the strain.
class KnownBoxes {
 public:
  explicit KnownBoxes(bool discs, double hardening = 0.0) : discs_(discs), hardening_(hardening) {}
  int asked = 0;
  double fails_below = 0.0;  ///< vertical stress, Pa

  [[nodiscard]] CellReply at(const Eigen::Matrix3d& strain) const {
    const double shear = kYoung / (2.0 * (1.0 + kPoisson));
    const double lame = kYoung * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
    const double factor = 1.0 - hardening_ * strain.trace();
    const Eigen::Matrix3d linear = lame * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * shear * strain;
    CellReply reply;
    CellResponse& r = reply.response;
    r.known = discs_ ? KnownComponents::plane : KnownComponents::all;
    r.stress = factor * linear - kPressureOfGroundStart * Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k)
          r.tangent(3 * i + j, 3 * k + k) += -hardening_ * linear(i, j) + (i == j ? factor * lame : 0.0);
        r.tangent(3 * i + j, 3 * i + j) += factor * shear;
        r.tangent(3 * i + j, 3 * j + i) += factor * shear;
      }
    const auto bytes = std::as_bytes(std::span(strain.data(), 9));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }

  CellCalls<2> calls() {
    CellCalls<2> calls;
    calls.initial_box = [this] { return at(Eigen::Matrix3d::Zero()); };
    calls.ask_boxes = [this](std::span<const CellRequest> requests, std::span<const std::size_t>) {
      std::vector<CellReply> replies;
      for (const CellRequest& request : requests) {
        ++asked;
        Eigen::Matrix3d strain;
        std::memcpy(strain.data(), request.state->bytes().data(), 9 * sizeof(double));
        const Eigen::Matrix3d& h = request.increment.displacement_gradient;
        replies.push_back(at(strain + 0.5 * (h + h.transpose())));
        if (-replies.back().response.stress(1, 1) < fails_below) {
          replies.back().response.quality = Quality::failed;
          replies.back().response.message = "the grains part";
        }
      }
      return replies;
    };
    return calls;
  }

 private:
  bool discs_;
  double hardening_;
};

Vector7 ground(double vertical, double ratio) {
  Vector7 stress = Vector7::Zero();
  stress(k22) = -vertical;
  stress(k11) = stress(k33) = -ratio * vertical;
  return stress;
}

/// Depths of Gauss points of a column, in pairs that differ by rounding.
std::vector<double> column(double top, double bottom) {
  std::vector<double> vertical;
  for (int k = 0; k < 8; ++k) {
    const double one = top + (bottom - top) * k / 7.0;
    vertical.insert(vertical.end(), {one, one * (1.0 + 1e-15)});
  }
  return vertical;
}

std::vector<CellReply> started(GroundStart<2>& start, const CellCalls<2>& calls,
                               const std::vector<double>& vertical, double ratio) {
  for (std::size_t point = 0; point < vertical.size(); ++point)
    start.set(point, ground(vertical[point], ratio));
  EXPECT_TRUE(start.is_due());
  start.lead(calls);
  std::vector<std::size_t> points(vertical.size());
  std::iota(points.begin(), points.end(), std::size_t{0});
  std::vector<CellReply> boxes = start.boxes(calls, points);
  for (std::size_t point = 0; point < points.size(); ++point)
    start.judge(point, of_dimension<2>(boxes[point]).response.stress);
  return boxes;
}

double figure(const GroundStart<2>& start, const std::string& name) {
  std::vector<fem::Figure> figures;
  start.add_figures(figures);
  for (const fem::Figure& figure : figures)
    if (figure.name == name) return figure.value;
  ADD_FAILURE() << name;
  return NAN;
}

TEST(GroundStart, BoxesHaveTheStressOfTheirDepthAbovePackingAndBelow) {
  for (const bool discs : {true, false}) {
    KnownBoxes known(discs, 40.0);
    GroundStart<2> start;
    const std::vector<double> vertical = column(20e3, 300e3);
    const std::vector<CellReply> boxes = started(start, known.calls(), vertical, 0.6);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      // Corrections stop within 1e-4 of the vertical stress.
      EXPECT_NEAR(boxes[k].response.stress(1, 1), -vertical[k], 1e-4 * vertical[k]);
      EXPECT_NEAR(boxes[k].response.stress(0, 0), -0.6 * vertical[k], 1e-4 * vertical[k]);
      if (!discs) {
        EXPECT_NEAR(boxes[k].response.stress(2, 2), -0.6 * vertical[k], 1e-4 * vertical[k]);
      }
    }
    EXPECT_LE(figure(start, "start_stress_off_share"), 1e-4);
    EXPECT_EQ(figure(start, "start_points_above_table"), 0.0);
    // ln 3 / ln 1.095 upwards, ln 5 / ln 1.095 downwards, and the packing at K0.
    EXPECT_EQ(figure(start, "start_levels"), 13.0 + 18.0 + 1.0);
    EXPECT_NEAR(figure(start, "start_K0_least"), 0.6, 5e-3);
    EXPECT_TRUE(start.notes().empty());
    // Points of one depth share a box.
    for (std::size_t k = 0; k < boxes.size(); k += 2) EXPECT_EQ(boxes[k].state, boxes[k + 1].state);
  }
}

TEST(GroundStart, MeasuredK0IsThatOfCompressionWithoutStrainAcross) {
  KnownBoxes known(false);
  GroundStart<2> start;
  const std::vector<CellReply> boxes = started(start, known.calls(), {400e3, 800e3}, NAN);
  for (const auto& [box, vertical] : {std::pair(boxes[0], 400e3), std::pair(boxes[1], 800e3)}) {
    const double across =
        kPressureOfGroundStart + kPoisson / (1.0 - kPoisson) * (vertical - kPressureOfGroundStart);
    EXPECT_NEAR(box.response.stress(1, 1), -vertical, 1e-4 * vertical);
    EXPECT_NEAR(box.response.stress(0, 0), -across, 1e-4 * vertical);
    EXPECT_NEAR(box.response.stress(2, 2), -across, 1e-4 * vertical);
  }
  // Of the nearest levels.
  EXPECT_NEAR(figure(start, "start_K0_largest"), 0.5, 0.01);
}

TEST(GroundStart, PointsAboveTheTableAreToldAndKeepItsLowestStress) {
  KnownBoxes known(true);
  known.fails_below = 30e3;
  GroundStart<2> start;
  const std::vector<CellReply> boxes = started(start, known.calls(), {5e3, 80e3}, 0.7);
  EXPECT_GT(-boxes[0].response.stress(1, 1), 30e3);
  EXPECT_LT(-boxes[0].response.stress(1, 1), 30e3 * 1.11);
  EXPECT_EQ(figure(start, "start_points_above_table"), 1.0);
  ASSERT_EQ(start.notes().size(), 1u);
  EXPECT_NE(start.notes()[0].find("the grains part"), std::string::npos) << start.notes()[0];
}

TEST(GroundStart, SaysWhatCannotBe) {
  KnownBoxes known(true);
  known.fails_below = 1e9;
  GroundStart<2> start;
  EXPECT_THROW(started(start, known.calls(), {80e3}, 0.7), RunError);
  GroundStart<2> two;
  two.set(0, ground(50e3, 0.5));
  EXPECT_THROW(two.set(1, ground(50e3, 0.6)), RunError);
}

TEST(GroundStart, ARunThatGoesOnKeepsTheReportAndLeadsNothing) {
  KnownBoxes known(true);
  GroundStart<2> start;
  started(start, known.calls(), {80e3, 120e3}, 0.7);
  MemoryArchive archive;
  start.save(archive);
  GroundStart<2> again;
  again.set(0, ground(80e3, 0.7));
  again.set(1, ground(120e3, 0.7));
  again.restore(archive);
  EXPECT_FALSE(again.is_due());
  std::vector<fem::Figure> kept;
  start.add_figures(kept);
  for (const fem::Figure& one : kept) EXPECT_EQ(figure(again, one.name), one.value);
}

}  // namespace
}  // namespace polargrain::coupler
