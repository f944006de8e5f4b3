// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A loop over spheres as one would write it by hand for one law and one box, with no care for vectors: the yardstick of
// sphere_step_bench. Linear normal force, a sliding spring with Coulomb's limit, and with Rolling springs against
// bending and torsion that turn with the contact. Candidates are given once and never made anew.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

namespace polargrain::bench {

struct CleanMaterial {
  double modulus = 0.0;            ///< E_c, Pa
  double tangential = 0.0;         ///< k_t / k_n
  double friction = 0.0;           ///< mu_s
  double rolling_stiffness = 0.0;  ///< k_th / (k_t R*^2)
  double rolling_friction = 0.0;   ///< mu_th
  double damping_rate = 0.0;       ///< against the affine flow, 1/s
  double time_step = 0.0;          ///< s
};

template <bool Rolling>
class CleanSphereLoop {
 public:
  struct Sphere {
    double x[3], v[3], w[3], radius, inverse_mass, inverse_inertia;
  };

  /// @param base columns are the base vectors of the box @param skin largest gap of candidates, m
  CleanSphereLoop(std::vector<Sphere> spheres, const Eigen::Matrix3d& base, const CleanMaterial& material,
                  double skin)
      : spheres_(std::move(spheres)),
        forces_(spheres_.size()),
        turned_(spheres_.size()),
        base_(base),
        m_(material) {
    for (std::size_t k = 0; k < images_.size(); ++k) images_[k] = {};
    place_images(Eigen::Matrix3d::Zero());
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      for (std::size_t j = i + 1; j < spheres_.size(); ++j)
        for (int image = 0; image < 27; ++image) add_if_near(i, j, image, skin);
      rows_.push_back(static_cast<int>(pairs_.size()));
    }
  }

  /// Steps at a constant diagonal velocity gradient, 1/s.
  void run(const Eigen::Vector3d& gradient, int steps) {
    for (int step = 0; step < steps; ++step) {
      base_ += m_.time_step * gradient.asDiagonal() * base_;
      place_images(gradient.asDiagonal());
      move(gradient);
      forces();
    }
  }
  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }

 private:
  struct Force {
    double f[3], t[3];
  };
  struct Pair {
    int other, image;
    double kn, kt, kr, rolling_limit;
    double sliding[3], bending[3], torsion;
  };
  static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  void place_images(const Eigen::Matrix3d& gradient) {
    for (int k = 0; k < 27; ++k) {
      const Eigen::Vector3d place = base_ * Eigen::Vector3d(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
      const Eigen::Vector3d velocity = gradient * place;
      for (int axis = 0; axis < 3; ++axis) {
        images_[k][axis] = place(axis);
        images_[k][3 + axis] = velocity(axis);
      }
    }
  }

  void add_if_near(std::size_t i, std::size_t j, int image, double skin) {
    const Sphere& a = spheres_[i];
    const Sphere& b = spheres_[j];
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) square += std::pow(a.x[axis] - b.x[axis] - images_[image][axis], 2);
    if (!(std::sqrt(square) < a.radius + b.radius + skin)) return;
    const double harmonic = a.radius * b.radius / (a.radius + b.radius);
    Pair pair{};
    pair.other = static_cast<int>(j);
    pair.image = image;
    pair.kn = 2.0 * m_.modulus * harmonic;
    pair.kt = m_.tangential * pair.kn;
    pair.kr = m_.rolling_stiffness * pair.kt * harmonic * harmonic;
    pair.rolling_limit = m_.rolling_friction * harmonic;
    pairs_.push_back(pair);
  }

  void move(const Eigen::Vector3d& gradient) {
    const double step = m_.time_step;
    const double rate = m_.damping_rate;
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
      Sphere& s = spheres_[k];
      Force& f = forces_[k];
      for (int axis = 0; axis < 3; ++axis) {
        const double flow = gradient(axis) * s.x[axis];
        s.v[axis] += step * (f.f[axis] * s.inverse_mass - rate * (s.v[axis] - flow));
        s.x[axis] += step * s.v[axis];
        s.w[axis] += step * (f.t[axis] * s.inverse_inertia - rate * s.w[axis]);
        turned_[k][axis] += step * s.w[axis];
      }
      f = {};
    }
  }

  static void turn_with_contact(double* spring, const double* n, double twirl) {
    const double old = dot(spring, spring);
    if (old == 0.0) return;
    const double turn[3] = {n[1] * spring[2] - n[2] * spring[1], n[2] * spring[0] - n[0] * spring[2],
                            n[0] * spring[1] - n[1] * spring[0]};
    for (int axis = 0; axis < 3; ++axis) spring[axis] += twirl * turn[axis];
    const double out = dot(spring, n);
    for (int axis = 0; axis < 3; ++axis) spring[axis] -= out * n[axis];
    const double now = dot(spring, spring);
    if (now == 0.0) return;
    const double stretch = std::sqrt(old / now);
    for (int axis = 0; axis < 3; ++axis) spring[axis] *= stretch;
  }

  void forces() {
    int row = 0;
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      Force own{};
      for (; row < rows_[i]; ++row) contact(spheres_[i], pairs_[row], own);
      for (int axis = 0; axis < 3; ++axis) {
        forces_[i].f[axis] += own.f[axis];
        forces_[i].t[axis] += own.t[axis];
      }
    }
  }

  void contact(const Sphere& a, Pair& pair, Force& own) {
    const Sphere& b = spheres_[pair.other];
    const std::array<double, 6>& image = images_[pair.image];
    double d[3], v[3], n[3], slip[3], lever[3];
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = a.x[axis] - b.x[axis] - image[axis];
      square += d[axis] * d[axis];
    }
    const double sum = a.radius + b.radius;
    if (!(square < sum * sum)) {
      for (double& spring : pair.sliding) spring = 0.0;
      for (double& spring : pair.bending) spring = 0.0;
      pair.torsion = 0.0;
      return;
    }
    const double distance = std::sqrt(square);
    const double inverse = 1.0 / distance;
    const double overlap = sum - distance;
    double opening = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      n[axis] = d[axis] * inverse;
      v[axis] = a.v[axis] - b.v[axis] - image[3 + axis];
      opening += v[axis] * n[axis];
    }
    const double arm_a = a.radius - 0.5 * overlap;
    const double arm_b = b.radius - 0.5 * overlap;
    const double normal = pair.kn * overlap;
    for (int axis = 0; axis < 3; ++axis) lever[axis] = arm_a * a.w[axis] + arm_b * b.w[axis];
    slip[0] = v[0] - opening * n[0] - (lever[1] * n[2] - lever[2] * n[1]);
    slip[1] = v[1] - opening * n[1] - (lever[2] * n[0] - lever[0] * n[2]);
    slip[2] = v[2] - opening * n[2] - (lever[0] * n[1] - lever[1] * n[0]);

    const double step = m_.time_step;
    double twirl = 0.0;
    if constexpr (Rolling) {
      for (int axis = 0; axis < 3; ++axis) twirl += 0.5 * step * (a.w[axis] + b.w[axis]) * n[axis];
      turn_with_contact(pair.sliding, n, twirl);
    }
    for (int axis = 0; axis < 3; ++axis) pair.sliding[axis] += step * slip[axis];
    const double out = dot(pair.sliding, n);
    double shear[3], moment[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
      pair.sliding[axis] -= out * n[axis];
      shear[axis] = -pair.kt * pair.sliding[axis];
    }
    const double limit = m_.friction * normal;
    if (const double size = dot(shear, shear); size > limit * limit) {
      const double factor = limit / std::sqrt(size);
      for (int axis = 0; axis < 3; ++axis) {
        shear[axis] *= factor;
        pair.sliding[axis] = -shear[axis] / pair.kt;
      }
    }
    if constexpr (Rolling) roll(a, b, pair, n, twirl, normal, moment);
    const double turn[3] = {n[1] * shear[2] - n[2] * shear[1], n[2] * shear[0] - n[0] * shear[2],
                            n[0] * shear[1] - n[1] * shear[0]};
    Force& other = forces_[pair.other];
    for (int axis = 0; axis < 3; ++axis) {
      const double force = normal * n[axis] + shear[axis];
      own.f[axis] += force;
      other.f[axis] -= force;
      own.t[axis] -= arm_a * turn[axis] + moment[axis];
      other.t[axis] -= arm_b * turn[axis] - moment[axis];
    }
  }

  void roll(const Sphere& a, const Sphere& b, Pair& pair, const double* n, double twirl, double normal,
            double* moment) {
    const double step = m_.time_step;
    double spin[3];
    for (int axis = 0; axis < 3; ++axis) spin[axis] = a.w[axis] - b.w[axis];
    const double twist = dot(spin, n);
    const double limit = pair.rolling_limit * normal;
    turn_with_contact(pair.bending, n, twirl);
    for (int axis = 0; axis < 3; ++axis) {
      pair.bending[axis] += step * (spin[axis] - twist * n[axis]);
      moment[axis] = pair.kr * pair.bending[axis];
    }
    if (const double size = dot(moment, moment); size > limit * limit) {
      const double factor = limit / std::sqrt(size);
      for (int axis = 0; axis < 3; ++axis) {
        moment[axis] *= factor;
        pair.bending[axis] = moment[axis] / pair.kr;
      }
    }
    pair.torsion += step * twist;
    double torque = pair.kr * pair.torsion;
    if (std::abs(torque) > limit) {
      torque = std::copysign(limit, torque);
      pair.torsion = torque / pair.kr;
    }
    for (int axis = 0; axis < 3; ++axis) moment[axis] += torque * n[axis];
  }

  std::vector<Sphere> spheres_;
  std::vector<Force> forces_;
  std::vector<std::array<double, 3>> turned_;
  std::vector<int> rows_;  // ends of the candidates of each sphere
  std::vector<Pair> pairs_;
  std::array<std::array<double, 6>, 27> images_;
  Eigen::Matrix3d base_;
  CleanMaterial m_;
};

}  // namespace polargrain::bench
