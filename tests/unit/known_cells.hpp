// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <random>

#include "common/memory_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/linearised.hpp"

namespace polargrain::coupler {

inline constexpr double kConfining = 1e5;
inline constexpr double kModulus = 3e7;
/// Strain at which the law has lost half of its stiffness.
inline constexpr double kHalf = 4e-3;
inline constexpr CosseratParameters kCosserat{16e6, 14e6, 0.02};

/// s = -p + 2 G e / (1 + |e| / half), without history but for the creep. Its state is its strain and
/// the number of its runs.
class KnownCells {
 public:
  /// Contacts creep whenever they are stepped: every run adds this to s11 (Pa). No tangent and no estimate shows it.
  double creep = 0.0;
  /// Fails beyond this strain.
  double breaks_at = 1e9;
  int runs = 0;
  PlaneRequest last_request;
  std::size_t last_point = 0;  ///< that it was said to stand for

  static Vector7 stress(const Eigen::Matrix2d& strain) {
    const double factor = kModulus / (1.0 + strain.norm() / kHalf);
    Vector7 s = Vector7::Zero();
    s << factor * strain(0, 0) - kConfining, factor * strain(1, 1) - kConfining, -kConfining,
        factor * strain(0, 1), factor * strain(0, 1), 0.0, 0.0;
    return s;
  }

  PlaneReply at(const Eigen::Matrix2d& strain, double runs_before = 0.0) const {
    PlaneReply reply;
    reply.response.stress = stress(strain);
    reply.response.stress[k11] += creep * runs_before;
    const double norm = strain.norm();
    const double factor = kModulus / (1.0 + norm / kHalf);
    // d(factor e_ij)/d e_kl, with e_12 = (eps_12 + eps_21) / 2.
    const double slope = norm > 0.0 ? -factor / (kHalf + norm) / norm : 0.0;
    const std::array<double, 3> e{strain(0, 0), strain(1, 1), strain(0, 1)};
    const std::array<std::array<int, 2>, 3> places{{{k11, k11}, {k22, k22}, {k12, k21}}};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        double d = slope * e[row] * e[column] * (column == 2 ? 2.0 : 1.0) + (row == column ? factor : 0.0);
        if (column == 2) d *= 0.5;
        for (const int r : places[row]) {
          for (const int c : places[column]) reply.response.tangent(r, c) = d;
        }
      }
    }
    const std::array<double, 5> kept{strain(0, 0), strain(1, 0), strain(0, 1), strain(1, 1), runs_before};
    const auto bytes = std::as_bytes(std::span(kept));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }

  PlaneReply answer(const PlaneRequest& request) {
    ++runs;
    std::array<double, 5> kept;
    std::memcpy(kept.data(), request.state->bytes().data(), sizeof kept);
    Eigen::Matrix2d strain;
    strain << kept[0], kept[2], kept[1], kept[3];
    const Eigen::Matrix2d& h = request.increment.displacement_gradient;
    strain += 0.5 * (h + h.transpose());
    PlaneReply reply = at(strain, kept[4] + 1.0);
    reply.diagnostics.dem_steps = 10;
    if (strain.norm() > breaks_at) {
      reply.response.quality = Quality::failed;
      reply.response.message = "the box collapsed";
      reply.state = nullptr;
    }
    return reply;
  }

  CellCalls<2> calls() {
    return {[this] { return at(Eigen::Matrix2d::Zero()); },
            [this](std::span<const PlaneRequest> requests, std::span<const std::size_t> points) {
              std::vector<PlaneReply> replies;
              EXPECT_EQ(requests.size(), points.size());
              for (const PlaneRequest& request : requests) replies.push_back(answer(request));
              last_request = requests.back();
              last_point = points.back();
              return replies;
            }};
  }
};

class AdaptiveMaterialTest : public ::testing::Test {
 protected:
  AdaptiveMaterial<2> material(std::size_t points, double tolerance, double audit = 0.0) {
    AdaptiveMaterial<2> made(cells_.calls(), kCosserat, {tolerance, audit, 1});
    made.allocate(points);
    strain_.assign(points, Eigen::Matrix2d::Zero());
    return made;
  }

  /// Takes a step and follows the true strains. @returns the answers
  std::vector<Response<2>> step(AdaptiveMaterial<2>& sand, const std::vector<Eigen::Matrix2d>& gradients,
                                Configuration configuration = Configuration::fixed) {
    std::vector<Increment<2>> increments;
    for (std::size_t p = 0; p < gradients.size(); ++p) {
      increments.push_back(increment_of<2>(gradients[p]));
      increments.back().configuration = configuration;
      strain_[p] += 0.5 * (gradients[p] + gradients[p].transpose());
    }
    std::vector<Response<2>> responses(gradients.size());
    sand.evaluate(increments, responses);
    for (int asked = 0; !sand.confirm(); ++asked) {
      EXPECT_LT(asked, 5) << "the material never stands by its answers";
      sand.evaluate(increments, responses);
    }
    sand.commit();
    return responses;
  }

  /// The largest error of any point, as a share of the confining pressure.
  double error(const std::vector<Response<2>>& responses) const {
    double largest = 0.0;
    for (std::size_t p = 0; p < responses.size(); ++p) {
      largest =
          std::max(largest, GrainMeasure<2>().stress(responses[p].stress - KnownCells::stress(strain_[p])));
    }
    return largest / kConfining;
  }

  static double figure(const AdaptiveMaterial<2>& sand, const std::string& name) {
    for (const fem::Figure& figure : sand.figures()) {
      if (figure.name == name) return figure.value;
    }
    ADD_FAILURE() << "no figure " << name;
    return -1.0;
  }

  KnownCells cells_;
  std::vector<Eigen::Matrix2d> strain_;
};

inline Eigen::Matrix2d compression(double amount) {
  Eigen::Matrix2d h;
  h << 0.4 * amount, 0.0, 0.0, -amount;
  return h;
}

/// Points whose strains lie in three bands, a little apart within each: fast, slow, and calm.
inline std::vector<Eigen::Matrix2d> three_bands(std::size_t points) {
  std::vector<Eigen::Matrix2d> gradients;
  for (std::size_t p = 0; p < points; ++p) {
    const double within = 1.0 + 0.02 * static_cast<double>(p % 7) / 7.0;
    const double band = p % 3 == 0 ? 1e-3 : p % 3 == 1 ? 3e-4 : 5e-6;
    gradients.push_back(compression(band * within));
  }
  return gradients;
}

}  // namespace polargrain::coupler
