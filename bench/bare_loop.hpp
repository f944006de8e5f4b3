// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The yardstick of step_bench: discs in a periodic box under an isochoric strain, as a program would step
// them that can do nothing else. One linear law for all contacts, its stiffnesses worked out per pair
// beforehand, one list of pairs that lasts the whole run, arrays, plain doubles.
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/packing.hpp"

namespace polargrain::bench {

struct BareMaterial {
  double modulus = 0.0;  ///< k_n = 2 modulus r1 r2 / (r1 + r2), Pa
  double ratio = 0.0;    ///< k_t / k_n
  double friction = 0.0;
  double rolling_stiffness = 0.0;  ///< over k_t R*^2
  double rolling_friction = 0.0;   ///< over R* f_n
  double damping = 0.0;            ///< fraction of the critical one, as in a cell
  double time_step = 0.0;          ///< s
};

template <bool Rolling>
class BareLoop {
 public:
  BareLoop(const Packing& packing, const BareMaterial& material);

  /// From rest, strains the box by diag(strain, -strain) in so many steps, as a cell does.
  void run(double strain, int steps);

  [[nodiscard]] Eigen::Matrix2d stress() const { return virial_ / (lx_ * ly_ * thickness_); }
  [[nodiscard]] int contacts() const { return contacts_; }
  [[nodiscard]] int pairs() const { return static_cast<int>(pairs_.size()); }
  /// Whether two discs that are no pair have come to touch: then the list was too short.
  [[nodiscard]] bool missed_contact() const;

 private:
  struct Disc {
    double x, y, vx, vy, spin, radius, ax, ay, angular, inverse_mass, inverse_inertia;
    double fx, fy, torque;
  };
  struct Pair {
    int i, j;
    int image;
    double reach, kn, kt, kr, rolling_limit;
    double slip, roll;  // springs
  };
  struct Image {
    double x, y, vx, vy;
  };

  /// @param gxx, gyy added to the strain rate by the step; @param rate_x, rate_y of the lengths, m/s
  void begin_step(double gxx, double gyy, double rate_x, double rate_y);
  template <bool Advance, bool Record>
  void forces();
  void end_step(double gxx, double gyy);
  /// Calls `visit(i, j, image)` for the pairs nearer than a gap.
  template <typename Visit>
  void near(double gap, Visit visit) const;

  std::vector<Disc> start_, discs_;
  std::vector<Pair> fresh_, pairs_;
  Image images_[9] = {};
  double lx_ = 0.0, ly_ = 0.0, length_x_ = 0.0, length_y_ = 0.0, thickness_ = 0.0;
  double friction_ = 0.0, damping_ = 0.0, step_ = 0.0;
  Eigen::Matrix2d virial_ = Eigen::Matrix2d::Zero();
  int contacts_ = 0;
};

template <bool Rolling>
template <typename Visit>
void BareLoop<Rolling>::near(double gap, Visit visit) const {
  for (int i = 0; i < static_cast<int>(discs_.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(discs_.size()); ++j)
      for (int image = 0; image < 9; ++image) {
        const double dx = discs_[i].x - discs_[j].x - (image % 3 - 1) * lx_;
        const double dy = discs_[i].y - discs_[j].y - (image / 3 - 1) * ly_;
        if (std::hypot(dx, dy) < discs_[i].radius + discs_[j].radius + gap) visit(i, j, image);
      }
}

template <bool Rolling>
BareLoop<Rolling>::BareLoop(const Packing& packing, const BareMaterial& material)
    : length_x_(packing.box(0, 0)),
      length_y_(packing.box(1, 1)),
      thickness_(packing.thickness),
      friction_(material.friction),
      step_(material.time_step) {
  lx_ = length_x_;
  ly_ = length_y_;
  double mean_radius = 0.0;
  double mean_mass = 0.0;
  const auto count = static_cast<double>(packing.grains.size());
  for (const Grain& grain : packing.grains) {
    Disc disc{};
    disc.x = grain.position.x();
    disc.y = grain.position.y();
    disc.radius = grain.radius;
    disc.inverse_mass = 1.0 / grain.mass;
    disc.inverse_inertia = 2.0 / (grain.mass * grain.radius * grain.radius);
    start_.push_back(disc);
    mean_radius += grain.radius / count;
    mean_mass += grain.mass / count;
  }
  discs_ = start_;
  near(0.05 * mean_radius, [&](int i, int j, int image) {
    const double reach = discs_[i].radius + discs_[j].radius;
    const double harmonic = discs_[i].radius * discs_[j].radius / reach;
    const double kn = 2.0 * material.modulus * harmonic;
    const double kt = material.ratio * kn;
    fresh_.push_back({i, j, image, reach, kn, kt, material.rolling_stiffness * kt * harmonic * harmonic,
                      material.rolling_friction * harmonic, 0.0, 0.0});
  });
  double stiffness = 0.0;
  int touching = 0;
  near(0.0, [&](int i, int j, int) {
    stiffness +=
        2.0 * material.modulus * discs_[i].radius * discs_[j].radius / (discs_[i].radius + discs_[j].radius);
    ++touching;
  });
  damping_ = 2.0 * material.damping * std::sqrt(stiffness / touching / mean_mass);
}

template <bool Rolling>
bool BareLoop<Rolling>::missed_contact() const {
  bool missed = false;
  near(0.0, [&](int i, int j, int image) {
    missed = missed || std::none_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
               return pair.i == i && pair.j == j && pair.image == image;
             });
  });
  return missed;
}

template <bool Rolling>
void BareLoop<Rolling>::begin_step(double gxx, double gyy, double rate_x, double rate_y) {
  const double half = 0.5 * step_;
  for (Disc& disc : discs_) {
    disc.vx += gxx * disc.x + half * disc.ax;
    disc.vy += gyy * disc.y + half * disc.ay;
    disc.spin += half * disc.angular;
    disc.x += step_ * disc.vx;
    disc.y += step_ * disc.vy;
    disc.fx = disc.fy = disc.torque = 0.0;
  }
  for (int image = 0; image < 9; ++image)
    images_[image] = {(image % 3 - 1) * lx_, (image / 3 - 1) * ly_, (image % 3 - 1) * rate_x,
                      (image / 3 - 1) * rate_y};
}

template <bool Rolling>
template <bool Advance, bool Record>
void BareLoop<Rolling>::forces() {
  const double friction = friction_;
  const double step = step_;
  Disc* const discs = discs_.data();
  for (Pair& pair : pairs_) {
    Disc& a = discs[pair.i];
    Disc& b = discs[pair.j];
    const Image& image = images_[pair.image];
    const double dx = a.x - b.x - image.x;
    const double dy = a.y - b.y - image.y;
    const double square = dx * dx + dy * dy;
    if (square >= pair.reach * pair.reach) {
      pair.slip = pair.roll = 0.0;
      continue;
    }
    const double distance = std::sqrt(square);
    const double nx = dx / distance;
    const double ny = dy / distance;
    const double overlap = pair.reach - distance;
    const double arm_a = a.radius - 0.5 * overlap;
    const double arm_b = b.radius - 0.5 * overlap;
    const double normal = pair.kn * overlap;
    if constexpr (Advance)
      pair.slip += step * ((b.vx - a.vx + image.vx) * ny + (a.vy - b.vy - image.vy) * nx -
                           (arm_a * a.spin + arm_b * b.spin));
    double shear = -pair.kt * pair.slip;
    if (std::abs(shear) > friction * normal) {
      shear = std::copysign(friction * normal, shear);
      pair.slip = -shear / pair.kt;
    }
    const double fx = normal * nx - shear * ny;
    const double fy = normal * ny + shear * nx;
    double moment = 0.0;
    if constexpr (Rolling) {
      if constexpr (Advance) pair.roll += step * (a.spin - b.spin);
      moment = pair.kr * pair.roll;
      if (std::abs(moment) > pair.rolling_limit * normal) {
        moment = std::copysign(pair.rolling_limit * normal, moment);
        pair.roll = moment / pair.kr;
      }
    }
    a.fx += fx;
    a.fy += fy;
    a.torque -= arm_a * shear + moment;
    b.fx -= fx;
    b.fy -= fy;
    b.torque -= arm_b * shear - moment;
    if constexpr (Record) {
      virial_ += Eigen::Vector2d(-dx, -dy) * Eigen::RowVector2d(fx, fy);
      ++contacts_;
    }
  }
}

template <bool Rolling>
void BareLoop<Rolling>::end_step(double gxx, double gyy) {
  const double half = 0.5 * step_;
  for (Disc& disc : discs_) {
    disc.ax = disc.fx * disc.inverse_mass - damping_ * (disc.vx - gxx * disc.x);
    disc.ay = disc.fy * disc.inverse_mass - damping_ * (disc.vy - gyy * disc.y);
    disc.angular = disc.torque * disc.inverse_inertia - damping_ * disc.spin;
    disc.vx += half * disc.ax;
    disc.vy += half * disc.ay;
    disc.spin += half * disc.angular;
  }
}

template <bool Rolling>
void BareLoop<Rolling>::run(double strain, int steps) {
  discs_ = start_;
  pairs_ = fresh_;
  lx_ = length_x_;
  ly_ = length_y_;
  virial_.setZero();
  contacts_ = 0;
  for (int image = 0; image < 9; ++image)
    images_[image] = {(image % 3 - 1) * lx_, (image / 3 - 1) * ly_, 0.0, 0.0};
  forces<false, false>();
  for (Disc& disc : discs_) {
    disc.ax = disc.fx * disc.inverse_mass;
    disc.ay = disc.fy * disc.inverse_mass;
    disc.angular = disc.torque * disc.inverse_inertia;
  }
  double rate_x = 0.0;
  double rate_y = 0.0;
  for (int done = 1; done <= steps; ++done) {
    const double time = static_cast<double>(done) / steps;
    const double part = strain * (time - std::sin(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi));
    const double before_x = lx_;
    const double before_y = ly_;
    lx_ = length_x_ * (1.0 + part);
    ly_ = length_y_ * (1.0 - part);
    const double now_x = (lx_ - before_x) / step_;
    const double now_y = (ly_ - before_y) / step_;
    begin_step((now_x - rate_x) / before_x, (now_y - rate_y) / before_y, now_x, now_y);
    rate_x = now_x;
    rate_y = now_y;
    if (done == steps)
      forces<true, true>();
    else
      forces<true, false>();
    end_step(rate_x / lx_, rate_y / ly_);
  }
}

}  // namespace polargrain::bench
