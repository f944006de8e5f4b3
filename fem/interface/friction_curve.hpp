// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

namespace polargrain::fem {

/// Friction and opening of an interface over its slip, linear between points that were measured and constant friction behind the last
/// one, where nothing opens any more.
class FrictionCurve {
 public:
  /// A measurement at one slip.
  struct Measured {
    double slip = 0.0;      ///< way of sliding so far, m
    double friction = 0.0;  ///< tan(delta), not negative
    double opening = 0.0;   ///< normal jump that came with that slip, m
  };
  /// A straight piece of the curve.
  struct Piece {
    double from = 0.0;            ///< slip, m
    double to = 0.0;              ///< slip, m; infinite behind the last point
    double friction = 0.0;        ///< tan(delta) at `from`
    double friction_slope = 0.0;  ///< of tan(delta) over the slip, 1/m
    double tan_dilation = 0.0;    ///< opening over slip, not negative
  };

  /// @param points at least one, the first at a slip of zero, slips rising. An opening that falls is kept: an interface does not
  /// close by sliding.
  explicit FrictionCurve(const std::vector<Measured>& points);

  /// The same with tan(delta) divided by a factor.
  [[nodiscard]] FrictionCurve divided(double factor) const {
    FrictionCurve made = *this;
    for (Piece& piece : made.pieces_) {
      piece.friction /= factor;
      piece.friction_slope /= factor;
    }
    return made;
  }
  /// One behind the other, from a slip of zero to infinity.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// The piece that a slip lies in, at a point between two the one behind it. @param slip m, not negative
  [[nodiscard]] std::size_t piece_at(double slip) const;
  /// tan(delta). @param slip m, not negative
  [[nodiscard]] double friction(double slip) const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace polargrain::fem
