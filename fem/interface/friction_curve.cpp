// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/interface/friction_curve.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {

FrictionCurve::FrictionCurve(const std::vector<Measured>& points) {
  double widest = points.front().opening;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double length = points[k + 1].slip - points[k].slip;
    const double before = widest;
    widest = std::max(widest, points[k + 1].opening);
    pieces_.push_back({points[k].slip, points[k + 1].slip, points[k].friction,
                       (points[k + 1].friction - points[k].friction) / length, (widest - before) / length});
  }
  pieces_.push_back({points.back().slip, HUGE_VAL, points.back().friction, 0.0, 0.0});
}

std::size_t FrictionCurve::piece_at(double slip) const {
  const auto behind =
      std::ranges::upper_bound(pieces_, slip, {}, [](const Piece& piece) { return piece.from; });
  return behind == pieces_.begin() ? 0 : static_cast<std::size_t>(behind - pieces_.begin()) - 1;
}

double FrictionCurve::friction(double slip) const {
  const Piece& piece = pieces_[piece_at(slip)];
  return piece.friction + piece.friction_slope * (slip - piece.from);
}

}  // namespace polargrain::fem
