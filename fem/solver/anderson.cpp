// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/anderson.hpp"

#include <type_traits>

#include "fem/element/dofs.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace polargrain::fem {

void Anderson::clear() {
  places_.clear();
}

void Anderson::remember(const Correction& position, const Eigen::VectorXd& unbalanced,
                        const Eigen::VectorXd& noise) {
  places_.push_back({position, unbalanced, weighted(noise, 1.0 / length_).lpNorm<1>(),
                     weighted(unbalanced, 1.0 / length_).lpNorm<1>()});
  if (places_.size() > static_cast<std::size_t>(depth_) + 1) places_.pop_front();
}

Eigen::VectorXd Anderson::weighted(Eigen::VectorXd nodal, double weight_of_rotations) const {
  const Eigen::Index mechanics = std::min(nodal.size(), mechanics_);
  nodal.tail(nodal.size() - mechanics).setZero();
  const auto weigh = [&]<int dim>(std::integral_constant<int, dim>) {
    for (Eigen::Index entry = 0; entry < mechanics; ++entry)
      if (is_rotation(dof_at<dim>(entry))) nodal(entry) *= weight_of_rotations;
  };
  if (dimension_ == 2) {
    weigh(std::integral_constant<int, 2>());
  } else {
    weigh(std::integral_constant<int, 3>());
  }
  return nodal;
}

bool Anderson::has_jumped(const Correction& correction) const {
  const Place& from = places_[places_.size() - 2];
  const Place& to = places_.back();
  if (to.out_of_balance <= from.out_of_balance) return false;
  // Behind a tangent that was too soft the way was too long and is gone back; a jump leads anywhere.
  constexpr double kBack = -0.5;
  const Eigen::VectorXd way = weighted(to.position.displacement - from.position.displacement, length_);
  const Eigen::VectorXd next = weighted(correction.displacement, length_);
  return next.dot(way) > kBack * next.norm() * way.norm();
}

void Anderson::accelerate(Correction& correction,
                          const std::function<Correction(const Eigen::VectorXd&)>& solve) {
  if (places_.size() >= 2 && has_jumped(correction)) places_.erase(places_.begin(), places_.end() - 1);
  if (places_.size() < 2) return;
  const auto count = static_cast<Eigen::Index>(places_.size()) - 1;
  const Eigen::Index size = correction.displacement.size();
  std::vector<Correction> defects;  // dX + C
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(size + count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Place& from = places_[static_cast<std::size_t>(j)];
    const Place& to = places_[static_cast<std::size_t>(j) + 1];
    const Eigen::VectorXd change = to.unbalanced - from.unbalanced;
    Correction defect = solve(change);
    c.col(j).head(size) = weighted(defect.displacement, length_);
    const double sum = weighted(change, 1.0 / length_).lpNorm<1>();
    const double noise_share = sum > 0.0 ? std::hypot(from.noise, to.noise) / sum : 0.0;
    c(size + j, j) = noise_share * c.col(j).norm();
    defect.displacement += to.position.displacement - from.position.displacement;
    defect.time += to.position.time - from.position.time;
    defects.push_back(std::move(defect));
  }
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(size + count);
  right_side.head(size) = weighted(correction.displacement, length_);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-8);  // ways gone twice say nothing new
  const Eigen::VectorXd g = qr.compute(c).solve(right_side);
  if (!g.allFinite()) return;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Correction& defect = defects[static_cast<std::size_t>(j)];
    correction.displacement -= g(j) * defect.displacement;
    correction.time -= g(j) * defect.time;
  }
}

}  // namespace polargrain::fem
