// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all pack/right_box
///
/// Strains the axes of a right periodic box of spheres: smoothly, with the affine velocity given to the
/// grains and the velocity of the faces to their images, and with viscous damping against the affine flow.
/// What fix cell/strain is for plane boxes, as far as the making of packings needs it. Not for scripts.
class FixRightBox : public LAMMPS_NS::Fix {
 public:
  FixRightBox(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void post_integrate() override;
  void post_force(int vflag) override;

  /// Sets the move of the steps to come. @param strain of the three axes @param steps of the move; the box
  /// stands still afterwards @param damping_rate 1/s
  void begin(const Eigen::Vector3d& strain, int steps, double damping_rate);
  [[nodiscard]] Eigen::Vector3d lengths() const;  ///< of the box, m
  /// Sums over the grains of the magnitudes of resultant force, N, and torque, N m, before damping.
  [[nodiscard]] double sum_of_unbalanced_force() const { return unbalanced_force_; }
  [[nodiscard]] double sum_of_unbalanced_moment() const { return unbalanced_moment_; }

 private:
  void sum_unbalanced();
  [[nodiscard]] Eigen::Vector3d lengths_at(int step) const;

  Eigen::Vector3d start_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d strain_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();  // of the step under way, 1/s
  int steps_ = 0;
  int step_ = 0;
  double damping_rate_ = 0.0;
  double unbalanced_force_ = 0.0;
  double unbalanced_moment_ = 0.0;
};

}  // namespace polargrain::dem
