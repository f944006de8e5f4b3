// SPDX-License-Identifier: GPL-2.0-or-later
// An adaptive material over cells of a hysteretic law whose exact answer is known: points turn back where their cell has
// not been.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <random>

#include "common/memory_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/linearised.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kConfining = 1e5;
constexpr CosseratParameters kCosserat{16e6, 14e6, 0.02};

using Vector3 = Eigen::Vector3d;

/// Components in which norms of tensors are those of vectors.
Vector3 components(const Eigen::Matrix2d& h) {
  return {h(0, 0), h(1, 1), std::sqrt(0.5) * (h(0, 1) + h(1, 0))};
}

/// A spring and sliders with springs side by side (Iwan 1967): loading is soft, the way back stiff, and a loop closes where
/// it began. On a straight path it is exact for steps of any size.
struct Sliders {
  static constexpr std::size_t kCount = 4;
  static constexpr double kSpring = 4e6;                                         // Pa
  static constexpr std::array<double, kCount> kStiffness{9e6, 8e6, 6e6, 3e6};    // Pa
  static constexpr std::array<double, kCount> kYield{2e-4, 5e-4, 1.2e-3, 4e-3};  // strains
  static constexpr int kParts = 50;  // of a step, for paths that are not straight

  Vector3 strain = Vector3::Zero();
  std::array<Vector3, kCount> slid{Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};

  void follow(const Vector3& increment) {
    for (int part = 0; part < kParts; ++part) {
      strain += increment / kParts;
      for (std::size_t i = 0; i < kCount; ++i) {
        const Vector3 apart = strain - slid[i];
        const double beyond = apart.norm() - kYield[i];
        if (beyond > 0.0) slid[i] += beyond * apart.normalized();
      }
    }
  }

  [[nodiscard]] Vector7 stress() const {
    Vector3 s = kSpring * strain;
    for (std::size_t i = 0; i < kCount; ++i) s += kStiffness[i] * (strain - slid[i]);
    const double shear = std::sqrt(0.5) * s[2];
    Vector7 stress;
    stress << s[0] - kConfining, s[1] - kConfining, -kConfining, shear, shear, 0.0, 0.0;
    return stress;
  }

  [[nodiscard]] Matrix7 tangent() const {
    Eigen::Matrix3d c = kSpring * Eigen::Matrix3d::Identity();
    for (std::size_t i = 0; i < kCount; ++i) {
      const Vector3 apart = strain - slid[i];
      c += kStiffness[i] * Eigen::Matrix3d::Identity();
      if (apart.norm() < (1.0 - 1e-9) * kYield[i]) continue;
      c -= kStiffness[i] * apart.normalized() * apart.normalized().transpose();
    }
    Eigen::Matrix<double, 3, 7> take = Eigen::Matrix<double, 3, 7>::Zero();
    take(0, k11) = take(1, k22) = 1.0;
    take(2, k12) = take(2, k21) = std::sqrt(0.5);
    return take.transpose() * c * take;
  }
};

class SliderCells {
 public:
  int runs = 0;

  static PlaneReply reply(const Sliders& grains) {
    PlaneReply reply;
    reply.response.stress = grains.stress();
    reply.response.tangent = grains.tangent();
    std::vector<double> kept(grains.strain.begin(), grains.strain.end());
    for (const Vector3& slid : grains.slid) kept.insert(kept.end(), slid.begin(), slid.end());
    const auto bytes = std::as_bytes(std::span(kept));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }

  PlaneReply answer(const PlaneRequest& request) {
    ++runs;
    std::array<Vector3, 1 + Sliders::kCount> kept;
    std::memcpy(kept[0].data(), request.state->bytes().data(), sizeof kept);
    Sliders grains;
    grains.strain = kept[0];
    std::copy_n(kept.begin() + 1, Sliders::kCount, grains.slid.begin());
    grains.follow(components(request.increment.displacement_gradient));
    return reply(grains);
  }

  CellCalls<2> calls() {
    return {[] { return reply(Sliders{}); },
            [this](std::span<const PlaneRequest> requests, std::span<const std::size_t>) {
              std::vector<PlaneReply> replies;
              for (const PlaneRequest& request : requests) replies.push_back(answer(request));
              return replies;
            }};
  }
};

/// Compressed by `amount`.
Eigen::Matrix2d gradient(double amount) {
  Eigen::Matrix2d h;
  h << 0.4 * amount, 0.0, 0.0, -amount;
  return h;
}

class AdaptiveTurnTest : public ::testing::Test {
 protected:
  AdaptiveMaterial<2> material(std::size_t points, double tolerance, double audit = 0.0) {
    AdaptiveMaterial<2> made(cells_.calls(), kCosserat, {tolerance, audit, 1});
    made.allocate(points);
    exact_.assign(points, Sliders{});
    return made;
  }

  /// Takes a step. @returns the largest error of a point, a share of the confining pressure
  double step(AdaptiveMaterial<2>& sand, const std::vector<Eigen::Matrix2d>& gradients) {
    std::vector<Increment<2>> increments;
    for (const Eigen::Matrix2d& h : gradients) increments.push_back(increment_of<2>(h));
    std::vector<Response<2>> responses(gradients.size());
    int asked = 0;
    do sand.evaluate(increments, responses);
    while (!sand.confirm() && ++asked < 10);
    EXPECT_LT(asked, 10) << "the material never stands by its answers";
    sand.commit();
    double largest = 0.0;
    for (std::size_t p = 0; p < gradients.size(); ++p) {
      exact_[p].follow(components(gradients[p]));
      largest = std::max(largest, GrainMeasure<2>().stress(responses[p].stress - exact_[p].stress()));
    }
    return largest / kConfining;
  }

  static double figure(const AdaptiveMaterial<2>& sand, const std::string& name) {
    for (const fem::Figure& figure : sand.figures())
      if (figure.name == name) return figure.value;
    ADD_FAILURE() << "no figure " << name;
    return -1.0;
  }

  SliderCells cells_;
  std::vector<Sliders> exact_;
};

/// What a grain answers to a change of direction lies half way between the tangents of sliding and of sticking contacts. A
/// slider sticks at once, so its error is up to twice the estimate.
constexpr double kSticksAtOnce = 2.0;
/// Half of the tolerance, of the estimate, may stay in a history with each turn.
constexpr double kOfATurn = 0.5 * kSticksAtOnce;
/// Gradients of steps that follow each other are multiplied, the law adds strains. Four of 1e-4 differ by 6e-8, and stresses
/// by that times at most 3e7 Pa.
constexpr double kOfProducts = 6e-8 * 3e7 / kConfining;

// The tangent serves a point well as long as it goes on, so its cell stays behind. Whatever of that is taken back must not
// be cancelled against it.
TEST_F(AdaptiveTurnTest, AnExcursionThatIsTakenBackDoesNotHideAnError) {
  for (const double tolerance : {0.01, 0.03, 0.1}) {
    AdaptiveMaterial<2> sand = material(1, tolerance);
    for (int k = 0; k < 4; ++k) step(sand, {gradient(1e-3)});
    double largest = 0.0;
    int carried = 0;
    for (int loop = 0; loop < 3; ++loop) {
      for (int k = 0; k < 5; ++k) {
        const int runs = cells_.runs;
        largest = std::max(largest, step(sand, {gradient(1e-4)}));
        carried += cells_.runs == runs ? 1 : 0;
      }
      for (int k = 0; k < 10; ++k) largest = std::max(largest, step(sand, {gradient(-1e-4)}));
      for (int k = 0; k < 5; ++k) largest = std::max(largest, step(sand, {gradient(1e-4)}));
    }
    std::cout << "[figure] tolerance " << tolerance << ": largest error of three loops " << largest << ", "
              << figure(sand, "cell_runs") << " runs for 64 steps\n";
    EXPECT_GE(carried, 3) << "nothing was carried, the test shows nothing";
    EXPECT_LE(largest, (kSticksAtOnce + kOfATurn) * tolerance);
  }
}

// One long step back, as in a scene that is unloaded in few steps: its offset to the cell is small again.
TEST_F(AdaptiveTurnTest, AStepBackToTheCellsPlaceIsLedByWayOfTheTurn) {
  constexpr double kTolerance = 0.01;
  AdaptiveMaterial<2> sand = material(1, kTolerance);
  for (int k = 0; k < 4; ++k) step(sand, {gradient(1e-3)});
  const int before = cells_.runs;
  for (int k = 0; k < 4; ++k) step(sand, {gradient(1e-4)});
  ASSERT_EQ(cells_.runs, before) << "nothing was carried, the test shows nothing";
  const double error = step(sand, {gradient(-4e-4)});
  std::cout << "[figure] a step back to where the cell is: error " << error << ", " << cells_.runs - before
            << " runs\n";
  EXPECT_EQ(cells_.runs - before, 2) << "out to the turn, and back";
  EXPECT_LE(error, kOfProducts);
}

// Sixty points that turn at different places, five times. What sharing leaves in a history adds up over turns, as far as
// longer ways do not wipe it out: here to about two of them.
TEST_F(AdaptiveTurnTest, PointsThatTurnAtDifferentPlacesShareCells) {
  constexpr std::size_t kPoints = 60;
  std::map<double, double> runs;
  for (const double tolerance : {0.01, 0.03, 0.1}) {
    AdaptiveMaterial<2> sand = material(kPoints, tolerance);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> size(0.9, 1.1);
    std::vector<Eigen::Matrix2d> own;
    for (std::size_t p = 0; p < kPoints; ++p) own.push_back(gradient(size(random)));
    double largest = 0.0;
    for (const auto& [count, amount] : std::vector<std::pair<int, double>>{
             {4, 1e-3}, {5, 1e-4}, {10, -1e-4}, {10, 1e-4}, {10, -1e-4}, {10, 2e-4}}) {
      for (int k = 0; k < count; ++k) {
        std::vector<Eigen::Matrix2d> gradients;
        for (const Eigen::Matrix2d& h : own) gradients.push_back(amount * h);
        largest = std::max(largest, step(sand, gradients));
      }
    }
    runs[tolerance] = figure(sand, "cell_runs");
    std::cout << "[figure] tolerance " << tolerance << ": largest error " << largest << ", "
              << runs[tolerance] << " runs for " << 49 * kPoints << " point steps, " << figure(sand, "cells")
              << " cells\n";
    EXPECT_LE(largest, (kSticksAtOnce + 2.0 * kOfATurn) * tolerance);
  }
  EXPECT_LT(runs[0.1], runs[0.01]);
}

TEST_F(AdaptiveTurnTest, ACheckpointKeepsWhereAPointHasBeen) {
  AdaptiveMaterial<2> whole = material(1, 0.01);
  for (int k = 0; k < 4; ++k) step(whole, {gradient(1e-3)});
  for (int k = 0; k < 4; ++k) step(whole, {gradient(1e-4)});
  step(whole, {gradient(-2e-5)});
  MemoryArchive archive;
  whole.save(archive);
  AdaptiveMaterial<2> again(cells_.calls(), kCosserat, {0.01, 0.0, 1});
  again.allocate(1);
  again.restore(archive);
  const double runs = figure(whole, "cell_runs");
  EXPECT_LE(step(again, {gradient(-3.8e-4)}), kOfProducts);
  EXPECT_EQ(figure(again, "cell_runs") - runs, 2.0);
}

// Audited, so that the run says itself what it misses.
TEST_F(AdaptiveTurnTest, ATurnIsVouchedFor) {
  AdaptiveMaterial<2> sand = material(60, 0.02, 0.1);
  const auto all = [&](double amount) {
    std::vector<Eigen::Matrix2d> gradients;
    for (int p = 0; p < 60; ++p) gradients.push_back(gradient(amount * (1.0 + 0.002 * p)));
    return gradients;
  };
  for (int k = 0; k < 4; ++k) step(sand, all(1e-3));
  for (int k = 0; k < 6; ++k) step(sand, all(1e-4));
  for (int k = 0; k < 12; ++k) step(sand, all(-1e-4));
  std::cout << "[figure] bound " << figure(sand, "error_bound") << ", " << figure(sand, "cell_runs")
            << " runs\n";
  EXPECT_EQ(figure(sand, "vouched_for"), 1.0) << sand.doubt();
}

}  // namespace
}  // namespace polargrain::coupler
