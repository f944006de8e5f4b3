// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all pack/space_box
///
/// Strains and shears a periodic box of spheres in space: smoothly, with the affine velocity given to the
/// grains and the velocity of the faces to their images, and with viscous damping against the affine flow.
/// The counterpart of fix cell/strain of plane boxes, as far as the making of packings needs it. Not for scripts.
class FixSpaceBox : public LAMMPS_NS::Fix {
 public:
  FixSpaceBox(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void post_integrate() override;
  void post_force(int vflag) override;

  /// Sets the move of the steps to come. @param gradient displacement gradient, upper triangular: the
  /// engine's box keeps its first base vector along x and its second in the x-y plane @param steps of the
  /// move; the box stands still afterwards @param damping_rate 1/s
  void begin(const Eigen::Matrix3d& gradient, int steps, double damping_rate);
  [[nodiscard]] Eigen::Matrix3d base_vectors() const;  ///< of the box, columns, m
  /// Sums over the grains of the magnitudes of resultant force, N, and torque, N m, before damping.
  [[nodiscard]] double sum_of_unbalanced_force() const { return unbalanced_force_; }
  [[nodiscard]] double sum_of_unbalanced_moment() const { return unbalanced_moment_; }

 private:
  void sum_unbalanced();
  [[nodiscard]] Eigen::Matrix3d base_vectors_at(int step) const;

  Eigen::Matrix3d start_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d gradient_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d rate_ = Eigen::Matrix3d::Zero();  // of the base vectors, in the step under way, m/s
  int steps_ = 0;
  int step_ = 0;
  double damping_rate_ = 0.0;
  double unbalanced_force_ = 0.0;
  double unbalanced_moment_ = 0.0;
};

}  // namespace polargrain::dem
