// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of the decisions of an adaptive material: microseconds a point and evaluation, over cells that
// answer at once.
//
//   build/release/bench/adaptive_bench        seconds
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/linearised.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kModulus = 3e7;

/// s = -p + 2 G e / (1 + |e| / 0.4 %), with the secant for a tangent: enough for the decisions.
PlaneReply answer(const Eigen::Matrix2d& strain) {
  PlaneReply reply;
  const double factor = kModulus / (1.0 + strain.norm() / 4e-3);
  reply.response.stress << factor * strain(0, 0) - 1e5, factor * strain(1, 1) - 1e5, -1e5,
      factor * strain(0, 1), factor * strain(0, 1), 0.0, 0.0;
  for (int i : {k11, k22}) reply.response.tangent(i, i) = factor;
  for (int i : {k12, k21}) reply.response.tangent(i, k12) = reply.response.tangent(i, k21) = 0.5 * factor;
  const auto bytes = std::as_bytes(std::span(strain.data(), 4));
  reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
  return reply;
}

CellCalls<2> calls() {
  return {[] { return answer(Eigen::Matrix2d::Zero()); },
          [](std::span<const PlaneRequest> requests, std::span<const std::size_t>) {
            std::vector<PlaneReply> replies;
            for (const PlaneRequest& request : requests) {
              Eigen::Matrix2d strain;
              std::memcpy(strain.data(), request.state->bytes().data(), sizeof strain);
              replies.push_back(answer(strain + request.increment.displacement_gradient));
            }
            return replies;
          }};
}

/// Strains of a field that varies over the points by `spread` around a mean step of 3e-4.
void measure(const char* what, std::size_t points, double spread) {
  constexpr int kSteps = 10;
  AdaptiveMaterial<2> sand(calls(), CosseratParameters{16e6, 14e6, 0.02}, {0.02, 0.0, 1});
  sand.allocate(points);
  std::vector<Increment<2>> increments(points);
  std::vector<Response<2>> responses(points);
  double first = 0.0;
  double later = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t p = 0; p < points; ++p) {
      const double place = static_cast<double>(p) / static_cast<double>(points);
      Eigen::Matrix2d h;
      h << 1e-4 * (1.0 + spread * std::sin(9.0 * place)), spread * 1e-4 * std::cos(17.0 * place), 0.0,
          -3e-4 * (1.0 + spread * std::cos(5.0 * place));
      increments[p] = increment_of<2>(h);
    }
    for (double* seconds : {&first, &later}) {
      const auto start = std::chrono::steady_clock::now();
      sand.evaluate(increments, responses);
      *seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    sand.commit();
  }
  const double count = static_cast<double>(points) * kSteps;
  fmt::print("{:>28} {:>8} {:>8.0f} {:>12.2f} {:>12.2f}\n", what, points, sand.figures()[1].value,
             1e6 * first / count, 1e6 * later / count);
}

}  // namespace
}  // namespace polargrain::coupler

int main() {
  using polargrain::coupler::measure;
  fmt::print("{:>28} {:>8} {:>8} {:>12} {:>12}\n", "field", "points", "cells", "first, us", "later, us");
  for (const std::size_t points : {560u, 5000u}) {
    measure("uniform", points, 0.0);
    measure("varies by 30 %", points, 0.3);
    measure("varies by 300 %", points, 3.0);
  }
  return 0;
}
