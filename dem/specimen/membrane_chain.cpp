// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/membrane_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unordered_map>

#include "common/elementary_functions.hpp"

namespace polargrain::dem {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Two grains that the probe meets at once, to round-off.
constexpr double kSameAngle = 1e-9;

/// Discs sorted into square boxes wide enough that a probe on one disc reaches only discs of the eight boxes
/// around.
class Neighbours {
 public:
  Neighbours(const std::vector<Disc>& discs, double probe) : discs_(discs) {
    double largest = 0.0;
    for (const Disc& disc : discs) largest = std::max(largest, disc.radius);
    side_ = 2.0 * (largest + probe);
    for (std::size_t k = 0; k < discs.size(); ++k)
      boxes_[{index(discs[k].centre.x()), index(discs[k].centre.y())}].push_back(k);
  }
  template <class Visit>
  void visit(const Eigen::Vector2d& place, Visit visit) const {
    for (long i = index(place.x()) - 1; i <= index(place.x()) + 1; ++i)
      for (long j = index(place.y()) - 1; j <= index(place.y()) + 1; ++j)
        if (const auto box = boxes_.find({i, j}); box != boxes_.end())
          for (const std::size_t k : box->second) visit(k);
  }

 private:
  using Key = std::pair<long, long>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return static_cast<std::size_t>(key.first) * 2'000'003U + static_cast<std::size_t>(key.second);
    }
  };
  [[nodiscard]] long index(double x) const { return static_cast<long>(std::floor(x / side_)); }

  const std::vector<Disc>& discs_;
  double side_ = 0.0;
  std::unordered_map<Key, std::vector<std::size_t>, Hash> boxes_;
};

/// The probe on the left side, rolling upwards: clockwise around the grains.
class Roller {
 public:
  Roller(const std::vector<Disc>& discs, double probe, double bottom, double top)
      : discs_(discs), neighbours_(discs, probe), probe_(probe), bottom_(bottom), top_(top) {}

  std::vector<std::size_t> chain() {
    std::vector<std::size_t> chain{first()};
    while (const auto next = roll_on(chain.back())) {
      if (chain.size() > 2 * discs_.size())
        throw std::runtime_error(
            "the membrane rolls in circles: a gap between grains lets the probe in; take a larger probe");
      chain.push_back(*next);
    }
    return chain;
  }

 private:
  struct Next {
    bool found = false;
    std::size_t grain = 0;
    explicit operator bool() const { return found; }
    std::size_t operator*() const { return grain; }
  };

  /// The grain that the probe meets on its way along the bottom platen; sets the angle of the probe.
  std::size_t first() {
    const double height = bottom_ + probe_;
    double least = std::numeric_limits<double>::infinity();
    std::size_t grain = 0;
    for (std::size_t k = 0; k < discs_.size(); ++k) {
      const double reach = discs_[k].radius + probe_;
      const double up = height - discs_[k].centre.y();
      if (std::abs(up) >= reach) continue;
      const double place = discs_[k].centre.x() - std::sqrt(reach * reach - up * up);
      if (place >= least) continue;
      least = place;
      grain = k;
    }
    if (!std::isfinite(least))
      throw std::runtime_error("no grain is next to the bottom platen: the membrane has no grain to hold");
    const Eigen::Vector2d probe(least, height);
    set_angle(grain, probe);
    return grain;
  }

  void set_angle(std::size_t grain, const Eigen::Vector2d& probe) {
    angle_ = arc_tangent(probe.y() - discs_[grain].centre.y(), probe.x() - discs_[grain].centre.x());
  }

  /// How far the probe rolls clockwise around a grain from its present angle to another.
  [[nodiscard]] double roll_to(double angle) const {
    double roll = std::fmod(angle_ - angle, kTurn);
    if (roll < 0.0) roll += kTurn;
    return roll > kTurn - kSameAngle ? 0.0 : roll;
  }

  /// Rolls over a grain until the next is met. @returns nothing at the top platen
  Next roll_on(std::size_t grain) {
    const Disc& here = discs_[grain];
    const double reach = here.radius + probe_;
    double least = std::numeric_limits<double>::infinity();
    Next next;
    const double rise = (top_ - probe_ - here.centre.y()) / reach;
    if (rise <= -1.0) return next;  // the probe is held between the platen and grains below its face
    if (rise < 1.0) least = roll_to(std::numbers::pi - arc_sine(rise));
    neighbours_.visit(here.centre, [&](std::size_t k) {
      if (k == grain) return;
      const Eigen::Vector2d apart = discs_[k].centre - here.centre;
      const double distance = apart.norm();
      const double other = discs_[k].radius + probe_;
      if (distance >= reach + other || distance <= std::abs(reach - other)) return;
      // On its way round, clockwise, the probe meets k at the greater of the two angles where it touches
      // both.
      const double half =
          arc_cosine((distance * distance + reach * reach - other * other) / (2.0 * distance * reach));
      const double roll = roll_to(arc_tangent(apart.y(), apart.x()) + half);
      if (roll >= least) return;
      least = roll;
      next = {true, k};
    });
    if (!std::isfinite(least))
      throw std::runtime_error("a grain on the membrane has no neighbour: the specimen fell apart");
    if (next) {
      const double angle = angle_ - least;
      const Eigen::Vector2d probe = here.centre + reach * Eigen::Vector2d(cosine(angle), sine(angle));
      set_angle(*next, probe);
    }
    return next;
  }

  const std::vector<Disc>& discs_;
  Neighbours neighbours_;
  double probe_;
  double bottom_;
  double top_;
  double angle_ = 0.0;  ///< of the probe's centre, seen from the grain it rolls on
};

/// Area between the y axis and a chain, positive where the chain is at positive x.
double area_beside(const std::vector<Eigen::Vector2d>& chain, double bottom, double top) {
  double twice = 2.0 * chain.front().x() * (chain.front().y() - bottom) +
                 2.0 * chain.back().x() * (top - chain.back().y());
  for (std::size_t k = 1; k < chain.size(); ++k)
    twice += (chain[k].x() + chain[k - 1].x()) * (chain[k].y() - chain[k - 1].y());
  return 0.5 * twice;
}

}  // namespace

std::vector<std::size_t> membrane_chain(const std::vector<Disc>& discs, double probe, double bottom,
                                        double top, Side side) {
  if (side == Side::left) return Roller(discs, probe, bottom, top).chain();
  std::vector<Disc> mirrored = discs;
  for (Disc& disc : mirrored) disc.centre.x() = -disc.centre.x();
  return Roller(mirrored, probe, bottom, top).chain();
}

std::vector<Eigen::Vector2d> membrane_forces(const std::vector<Eigen::Vector2d>& centres,
                                             double line_pressure, double bottom, double top, Side side) {
  // A link (dx, dy) going up is pushed to the right on the left side: pressure * (dy, -dx).
  const double inwards = side == Side::left ? line_pressure : -line_pressure;
  std::vector<Eigen::Vector2d> forces(centres.size(), Eigen::Vector2d::Zero());
  for (std::size_t k = 1; k < centres.size(); ++k) {
    const Eigen::Vector2d link = centres[k] - centres[k - 1];
    const Eigen::Vector2d half = 0.5 * inwards * Eigen::Vector2d(link.y(), -link.x());
    forces[k - 1] += half;
    forces[k] += half;
  }
  forces.front().x() += inwards * (centres.front().y() - bottom);
  forces.back().x() += inwards * (top - centres.back().y());
  return forces;
}

double enclosed_area(const std::vector<Eigen::Vector2d>& left, const std::vector<Eigen::Vector2d>& right,
                     double bottom, double top) {
  return area_beside(right, bottom, top) - area_beside(left, bottom, top);
}

}  // namespace polargrain::dem
