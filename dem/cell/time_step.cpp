// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/time_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace polargrain::dem {

namespace {

constexpr int kMostVectors = 60;     // of the Lanczos iteration
constexpr double kTolerance = 1e-3;  // of the eigenvalue, hence 5e-4 of the frequency

/// Displacement and rotation of one grain, or force and moment.
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// One contact with what its springs do: forces on both grains from their motions.
struct Springs {
  Eigen::Index first, second;
  Eigen::Vector3d normal;
  double normal_stiffness, tangential_stiffness, rolling_stiffness;
  double arm_first, arm_second;

  explicit Springs(const Contact& contact)
      : first(contact.first),
        second(contact.second),
        normal(contact.normal()),
        normal_stiffness(contact.normal_stiffness),
        tangential_stiffness(contact.tangential_stiffness),
        rolling_stiffness(contact.rolling_stiffness),
        arm_first(contact.arm_first),
        arm_second(contact.arm_second) {}

  /// K x added to `force`, both of all grains, six values a grain.
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& force) const {
    const auto grain = [&x](Eigen::Index k) { return x.segment<6>(6 * k); };
    const Eigen::Vector3d turning = arm_first * grain(first).tail<3>() + arm_second * grain(second).tail<3>();
    const Eigen::Vector3d opening = grain(second).head<3>() - grain(first).head<3>() - turning.cross(normal);
    const double along = opening.dot(normal);
    const Eigen::Vector3d pull =
        normal_stiffness * along * normal + tangential_stiffness * (opening - along * normal);
    const Eigen::Vector3d moment = rolling_stiffness * (grain(second).tail<3>() - grain(first).tail<3>());
    const Eigen::Vector3d lever = normal.cross(pull);
    force.segment<3>(6 * first) -= pull;
    force.segment<3>(6 * second) += pull;
    force.segment<3>(6 * first + 3) -= arm_first * lever + moment;
    force.segment<3>(6 * second + 3) -= arm_second * lever - moment;
  }

  /// The share of the springs in the diagonal block of a disc, scaled by the roots of its inertias.
  [[nodiscard]] Eigen::Matrix3d block(double arm, double root_mass, double root_moment) const {
    Eigen::Matrix<double, 2, 3> opening;
    opening << 1.0 / root_mass, 0.0, -normal.y() * (arm / root_moment), 0.0, 1.0 / root_mass,
        normal.x() * (arm / root_moment);
    const Eigen::Vector2d n = normal.head<2>();
    const Eigen::Matrix2d stiffness = tangential_stiffness * Eigen::Matrix2d::Identity() +
                                      (normal_stiffness - tangential_stiffness) * n * n.transpose();
    Eigen::Matrix3d block = opening.transpose() * stiffness * opening;
    block(2, 2) += rolling_stiffness / (root_moment * root_moment);
    return block;
  }
};

/// M^-1/2 of six motions a grain; zero for those that a disc does not have.
Eigen::VectorXd inverse_roots(const Inertia& inertia) {
  Eigen::VectorXd roots(6 * static_cast<Eigen::Index>(inertia.masses.size()));
  for (std::size_t k = 0; k < inertia.masses.size(); ++k) {
    const double push = 1.0 / std::sqrt(inertia.masses[k]);
    const double turn = 1.0 / std::sqrt(inertia.moments[k]);
    const double off = inertia.space ? 1.0 : 0.0;
    Vector6 root;
    root << push, push, off * push, off * turn, off * turn, turn;
    roots.segment<6>(6 * static_cast<Eigen::Index>(k)) = root;
  }
  return roots;
}

}  // namespace

double largest_frequency(std::span<const Contact> contacts, const Inertia& inertia) {
  if (contacts.empty()) return 0.0;
  const std::vector<Springs> springs(contacts.begin(), contacts.end());
  const Eigen::VectorXd roots = inverse_roots(inertia);
  // A start without symmetry, the same every time: no mode is orthogonal to it.
  Eigen::VectorXd vector(roots.size());
  for (Eigen::Index k = 0; k < vector.size(); ++k)
    vector(k) = roots(k) > 0.0 ? std::sin(1.0 + 1.7 * k * k) : 0.0;
  vector.normalize();
  Eigen::VectorXd former = Eigen::VectorXd::Zero(vector.size());
  std::vector<double> diagonal;
  std::vector<double> beside;
  double value = 0.0;
  for (int n = 1; n <= kMostVectors; ++n) {
    Eigen::VectorXd next = Eigen::VectorXd::Zero(vector.size());
    const Eigen::VectorXd moved = roots.cwiseProduct(vector);
    for (const Springs& spring : springs) spring.apply(moved, next);
    next = next.cwiseProduct(roots);
    diagonal.push_back(next.dot(vector));
    next -= diagonal.back() * vector;
    if (n > 1) next -= beside.back() * former;
    const double length = next.norm();
    if (n % 5 == 0 || n == 1 || length <= 1e-12 * diagonal.front()) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                    Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1),
                                    Eigen::EigenvaluesOnly);
      const double found = solver.eigenvalues()(n - 1);
      const bool settled = found - value <= 0.2 * kTolerance * found;
      value = found;
      if ((settled && n > 1) || length <= 1e-12 * found) break;
    }
    beside.push_back(length);
    former = std::move(vector);
    vector = next / length;
  }
  return std::sqrt(std::max(0.0, value));
}

namespace {

/// The diagonal block of a sphere from its parts: as Springs::block, summed over its contacts and not yet scaled.
struct BlockOfSphere {
  Eigen::Matrix3d pushes = Eigen::Matrix3d::Zero();  // displacement to force, N/m
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();   // of the forces of rotations, across: N
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();   // rotation to moment, N m

  /// @param outer of the normal with itself
  void add(const Springs& springs, const Eigen::Matrix3d& outer, double arm) {
    const double kt = springs.tangential_stiffness;
    pushes += (springs.normal_stiffness - kt) * outer;
    pushes.diagonal().array() += kt;
    lever += kt * arm * springs.normal;
    turns -= kt * arm * arm * outer;
    turns.diagonal().array() += kt * arm * arm + springs.rolling_stiffness;
  }

  /// Largest sum of magnitudes along a row once it is scaled by the roots of the inertias, 1/s^2.
  [[nodiscard]] double norm(double mass, double moment) const {
    const Eigen::Array3d size = lever.array().abs() / std::sqrt(mass * moment);
    const Eigen::Array3d coupling(size.y() + size.z(), size.x() + size.z(), size.x() + size.y());
    const Eigen::Array3d pushed = pushes.cwiseAbs().colwise().sum().transpose().array() / mass + coupling;
    const Eigen::Array3d turned = turns.cwiseAbs().colwise().sum().transpose().array() / moment + coupling;
    return std::max(pushed.maxCoeff(), turned.maxCoeff());
  }
};

/// frequency_bound of spheres, in a tenth of the time that whole blocks take: packings in the making ask often.
double frequency_bound_in_space(std::span<const Contact> contacts, const Inertia& inertia) {
  std::vector<BlockOfSphere> blocks(inertia.masses.size());
  for (const Contact& contact : contacts) {
    const Springs springs(contact);
    const Eigen::Matrix3d outer = springs.normal * springs.normal.transpose();
    // The two turn against their motion along the contact in opposite senses.
    blocks[static_cast<std::size_t>(contact.first)].add(springs, outer, springs.arm_first);
    blocks[static_cast<std::size_t>(contact.second)].add(springs, outer, -springs.arm_second);
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    largest = std::max(largest, blocks[k].norm(inertia.masses[k], inertia.moments[k]));
  return std::sqrt(2.0 * largest);
}

}  // namespace

double frequency_bound(std::span<const Contact> contacts, const Inertia& inertia) {
  if (inertia.space) return frequency_bound_in_space(contacts, inertia);
  std::vector<Eigen::Matrix3d> blocks(inertia.masses.size(), Eigen::Matrix3d::Zero());
  std::vector<std::pair<double, double>> roots;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    roots.emplace_back(std::sqrt(inertia.masses[k]), std::sqrt(inertia.moments[k]));
  for (const Contact& contact : contacts) {
    const Springs springs(contact);
    // The two turn against their motion along the contact in opposite senses.
    for (const auto& [grain, arm] :
         {std::pair(contact.first, springs.arm_first), std::pair(contact.second, -springs.arm_second)}) {
      const auto k = static_cast<std::size_t>(grain);
      blocks[k] += springs.block(arm, roots[k].first, roots[k].second);
    }
  }
  double largest = 0.0;
  for (const Eigen::Matrix3d& block : blocks) {
    // No eigenvalue exceeds the magnitudes of a row, and most grains stay below those seen before.
    constexpr double kDigits = 1.0 + 1e-9;
    if (kDigits * block.cwiseAbs().rowwise().sum().maxCoeff() <= largest) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    largest = std::max(largest, solver.computeDirect(block, Eigen::EigenvaluesOnly).eigenvalues()(2));
  }
  return std::sqrt(2.0 * largest);
}

double longest_viscous_time(std::span<const Contact> contacts) {
  double longest = 0.0;
  for (const Contact& contact : contacts)
    for (const auto& [viscosity, stiffness] :
         {std::pair(contact.normal_viscosity, contact.normal_stiffness),
          std::pair(contact.tangential_viscosity, contact.tangential_stiffness)})
      if (stiffness > 0.0) longest = std::max(longest, viscosity / stiffness);
  return longest;
}

void StiffestContact::see(std::span<const Contact> contacts) {
  for (const Contact& contact : contacts) {
    normal_stiffness = std::max(normal_stiffness, contact.normal_stiffness);
    tangential_stiffness = std::max(tangential_stiffness, contact.tangential_stiffness);
    rolling_stiffness = std::max(rolling_stiffness, contact.rolling_stiffness);
  }
  viscous_time = std::max(viscous_time, longest_viscous_time(contacts));
}

double StiffestContact::crowded_frequency(const Inertia& inertia, double neighbours) const {
  // Contacts on all sides: the mean of n n is a half or a third of the identity.
  const double pushed = inertia.space ? (normal_stiffness + 2.0 * tangential_stiffness) / 3.0
                                      : 0.5 * (normal_stiffness + tangential_stiffness);
  const double across = inertia.space ? 2.0 / 3.0 : 1.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < inertia.masses.size(); ++k) {
    const double turned =
        across * tangential_stiffness * inertia.radii[k] * inertia.radii[k] + rolling_stiffness;
    largest = std::max({largest, pushed / inertia.masses[k], turned / inertia.moments[k]});
  }
  return std::sqrt(2.0 * neighbours * largest);
}

double stable_time_step(double frequency, double viscous_time, double damping_rate) {
  if (!(frequency > 0.0)) return std::numeric_limits<double>::infinity();
  const double damping = 0.5 * (viscous_time * frequency + damping_rate / frequency);
  return 2.0 / frequency * (std::sqrt(1.0 + damping * damping) - damping);
}

double chosen_time_step(double stable) {
  const double step = kStepShare * stable;
  const double unit = std::pow(10.0, std::floor(std::log10(step)) - 2.0);
  return std::floor(step / unit) * unit;
}

}  // namespace polargrain::dem
