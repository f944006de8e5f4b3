// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_box.hpp"

#include <algorithm>
#include <cmath>

#include "dem/box/lost_grains.hpp"
#include "dem/contact/hertz_slope.hpp"

namespace polargrain::dem {

namespace {

/// Gap up to which two spheres are candidates, over the mean radius: at strains of 1e-3 a list lasts an increment.
constexpr double kSphereSkin = 0.05;

/// Steps between two calls of `progress`.
constexpr int kSphereProgressChunk = 200;

/// Bounds of the ways of spheres are taken so much longer: they leave out products of strains.
constexpr double kReachMargin = 1.01;

using Place = Eigen::Map<Eigen::Vector3d>;
using ConstPlace = Eigen::Map<const Eigen::Vector3d>;

void put_matrix(double* nine, const Eigen::Matrix3d& matrix) {
  Eigen::Map<Eigen::Matrix3d> to(nine);
  to = matrix;
}
void put_vector(double* three, const Eigen::Vector3d& vector) {
  std::copy_n(vector.data(), 3, three);
}

}  // namespace

SphereBox::SphereBox(Spheres spheres, const SphereKernels& kernels)
    : spheres_(std::move(spheres)),
      kernels_(kernels),
      pass_(kernel_of(kernels, spheres_.combination)),
      springs_(sphere_spring_count(spheres_.combination)) {
  const auto n = static_cast<std::size_t>(count());
  grains_.assign((n + 2) * kGrainStride, 0.0);
  forces_.assign((n + 2) * kForceStride, 0.0);
  accelerations_.assign(n * kForceStride, 0.0);
  turned_.assign(n * 4, 0.0);
  double mean = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double radius = spheres_.radii[k];
    mean += radius / static_cast<double>(n);
    largest_radius_ = std::max(largest_radius_, radius);
    grains_[k * kGrainStride + 3] = radius;
    inverse_mass_.push_back(1.0 / spheres_.masses[k]);
    inverse_inertia_.push_back(1.0 / spheres_.inertias[k]);
  }
  grains_[(n + 1) * kGrainStride] = 1.0;  // two places without a grain lie apart
  skin_ = kSphereSkin * mean;
  list_.spring_count = springs_in_pass(spheres_.combination);
  listed_places_.resize(n);
}

void SphereBox::find_candidates(const CarriedSprings& carried) {
  const Eigen::Matrix3d& base = motion_.box().base;
  list_.find(grains_.data(), count(), base, skin_);
  list_.take_springs(carried);
  fill_constants(spheres_, list_);
  listed_inverse_ = motion_.box().inverse();
  wandered_ = reach_ = 0.0;
  for (std::size_t k = 0; k < listed_places_.size(); ++k)
    listed_places_[k] = ConstPlace(&grains_[k * kGrainStride]);
  images_.resize(list_.images.size() * kImageStride);
  records_->clear(this);
  place_images();
}

bool SphereBox::outgrown() {
  // The affine flow has brought no two places nearer than by this factor.
  const Eigen::Matrix3d f = motion_.box().base * listed_inverse_;
  const double stretch = 1.0 - (f - Eigen::Matrix3d::Identity()).norm();
  const double closing = (1.0 - stretch) * 2.0 * largest_radius_;
  const double room = 0.5 * (stretch * skin_ - closing);
  if (stretch > 0.5) reach_ = std::max(reach_, kReachMargin * (2.0 * wandered_ + closing) / stretch);
  if (kReachMargin * wandered_ < room) return false;
  // The bound adds up speeds; the way itself is shorter.
  double longest = 0.0;
  for (std::size_t k = 0; k < listed_places_.size(); ++k)
    longest =
        std::max(longest, (ConstPlace(&grains_[k * kGrainStride]) - f * listed_places_[k]).squaredNorm());
  wandered_ = std::sqrt(longest);
  return !(kReachMargin * wandered_ < 0.8 * room);
}

void SphereBox::place_images() {
  const Eigen::Matrix3d& base = motion_.box().base;
  const Eigen::Matrix3d& rate = motion_.rate();
  for (std::size_t k = 0; k < list_.images.size(); ++k) {
    double* const rows = &images_[k * kImageStride];
    put_vector(rows, list_.images[k].of(base));
    put_vector(rows + 4, list_.images[k].of(rate));
    rows[3] = rows[7] = 0.0;
  }
}

void SphereBox::begin(const BoxPath<3>& path, double damping_rate, const Loading& rotation,
                      double time_step) {
  time_step_ = time_step;
  motion_ = BoxMotion<3>(path, rotation, time_step);
  damping_rate_ = damping_rate;
  multiplier_.setZero();
  weights_.clear();  // they belong to another path
}

void SphereBox::go_on(const BoxPath<3>& path, double damping_rate, const Loading& rotation) {
  motion_.go_on(path, rotation, time_step_);
  damping_rate_ = damping_rate;
}

void SphereBox::compute_forces(bool advance, bool record) {
  SpherePass pass = pass_over(list_, spheres_.combination);
  pass.grains = grains_.data();
  pass.forces = forces_.data();
  pass.images = images_.data();
  pass.reach = reach_;
  pass.step = time_step_;
  pass.advance = advance;
  const Eigen::Matrix3d by_rows = motion_.curvature_rate().transpose();
  put_matrix(pass.curvature_rate, by_rows);
  pass.bends = !by_rows.isZero(0.0);
  if (record) {
    pass.records = records_->begin(this, static_cast<std::size_t>(list_.count) * kSphereRecords);
    for (int block = 0; block < list_.count / kBlock; ++block)
      std::fill_n(pass.records + static_cast<std::size_t>(block) * kBlock * kSphereRecords, kBlock, 0.0);
  }
  pass_(pass);
  if (further_forces) further_forces(grains_.data(), forces_.data());
}

std::span<const Contact> SphereBox::contacts() const {
  const BoxRecords& records = records_->of(this);
  if (!records.are_listed) read_records();
  return records.contacts;
}

const double* SphereBox::record_of(int candidate) const {
  return &records_->values[static_cast<std::size_t>(candidate / kBlock) * (kBlock * kSphereRecords) +
                           candidate % kBlock];
}

ContactSums<3> SphereBox::contact_sums() const {
  if (records_->of(this).are_listed) return sums_of<3>(records_->contacts);
  ContactSums<3> sums;
  for (int c = 0; c < list_.count; ++c) {
    const auto at = [record = record_of(c)](int which) { return record[which * kBlock]; };
    if (at(kIsTouching) == 0.0) continue;
    sums.add({-at(kDelta), -at(kDelta + 1), -at(kDelta + 2)}, {at(kForce), at(kForce + 1), at(kForce + 2)});
  }
  return sums;
}

void SphereBox::read_records() const {
  records_->clear(this);
  for (int c = 0; c < list_.count; ++c) {
    const double* const record = record_of(c);
    if (record[kIsTouching * kBlock] != 0.0) records_->contacts.push_back(contact_of(c, record));
  }
}

Contact SphereBox::contact_of(int candidate, const double* record) const {
  const auto at = [record](int which) { return record[which * kBlock]; };
  const LawCombination& laws = spheres_.combination;
  Contact contact;
  contact.first = list_.first[candidate];
  contact.second = list_.second[candidate];
  contact.branch = {-at(kDelta), -at(kDelta + 1), -at(kDelta + 2)};
  contact.force = {at(kForce), at(kForce + 1), at(kForce + 2)};
  const double slope = laws.normal == NormalLaw::hertz ? kHertzSlope : 1.0;
  contact.normal_stiffness = slope * at(kStiffnesses);
  contact.tangential_stiffness = at(kStiffnesses + 1);
  contact.normal_viscosity = at(kDashpots);
  contact.tangential_viscosity = at(kDashpots + 1);
  contact.arm_first = at(kArms);
  contact.arm_second = at(kArms + 1);
  contact.friction = list_.constants[kFriction][candidate];
  if (laws.rolling == RollingLaw::off) return contact;
  contact.moment = {-at(kMoment), -at(kMoment + 1), -at(kMoment + 2)};
  contact.rolling_stiffness = at(kRolling);
  contact.rolling_limit = at(kRollingLimit);
  if (laws.rolling == RollingLaw::epsd2) {
    contact.rolling_at_limit = contact.moment.norm() >= contact.rolling_limit * (1.0 - 1e-6);  // as StockLaws
    return contact;
  }
  contact.rolling_at_limit = at(kIsRolling) != 0.0;
  if (!laws.settings.torsion) return contact;
  contact.torsion_stiffness = contact.rolling_stiffness;
  contact.torsion_at_limit = at(kIsTwisting) != 0.0;
  return contact;
}

void SphereBox::set_up() {
  std::fill(forces_.begin(), forces_.end(), 0.0);
  compute_forces(false, true);
  for (int k = 0; k < count(); ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * kForceStride;
    for (int axis = 0; axis < 3; ++axis) {
      accelerations_[row + axis] = forces_[row + axis] * inverse_mass_[k];
      accelerations_[row + 4 + axis] = forces_[row + 4 + axis] * inverse_inertia_[k];
    }
  }
  sum_up();
}

void SphereBox::set_rotation_weights(std::span<const double> weights) {
  weights_.assign(weights.begin(), weights.end());
}

void SphereBox::hold_rotation() {
  if (!controlled()) return;
  control_rotation(false);
  for (int k = 0; k < count(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t place = static_cast<std::size_t>(k) * kForceStride + 4 + axis;
      accelerations_[place] = forces_[place] * inverse_inertia_[k];
    }
  sum_up();
}

void SphereBox::control_rotation(bool damped) {
  // The spins of the next half step must average to the prescribed one, see FixCellStrain.
  const double rate = damped ? damping_rate_ : 0.0;
  const double volume = motion_.box().size();
  Eigen::Vector3d mean_spin = Eigen::Vector3d::Zero();
  double compliance = 0.0;
  for (int k = 0; k < count(); ++k) {
    const ConstPlace spin(&grains_[static_cast<std::size_t>(k) * kGrainStride + 8]);
    const ConstPlace torque(&forces_[static_cast<std::size_t>(k) * kForceStride + 4]);
    const Eigen::Vector3d angular = torque * inverse_inertia_[k] - rate * (spin - motion_.spin());
    mean_spin += weights_[k] * (spin + time_step_ * angular);
    compliance += weights_[k] * weights_[k] * time_step_ * inverse_inertia_[k];
  }
  multiplier_ = (motion_.spin() - mean_spin) / (compliance * volume);
  const Eigen::Vector3d torque = volume * multiplier_;
  for (int k = 0; k < count(); ++k)
    Place(&forces_[static_cast<std::size_t>(k) * kForceStride + 4]) += weights_[k] * torque;
}

SphereMotion SphereBox::motion_of_step() {
  SphereMotion motion{};
  motion.grains = grains_.data();
  motion.forces = forces_.data();
  motion.accelerations = accelerations_.data();
  motion.turned = turned_.data();
  motion.inverse_mass = inverse_mass_.data();
  motion.inverse_inertia = inverse_inertia_.data();
  motion.count = count();
  motion.step = time_step_;
  motion.damping_rate = damping_rate_;
  put_matrix(motion.gradient, motion_.gradient());
  put_vector(motion.spin, motion_.spin());
  return motion;
}

void SphereBox::begin_step(bool end_the_last) {
  SphereMotion motion = motion_of_step();
  const Eigen::Matrix3d inverse = motion_.box().inverse();
  motion_.advance();
  put_matrix(motion.change, motion_.change_of_gradient());
  put_vector(motion.change_of_spin, motion_.change_of_spin());
  put_matrix(motion.flow, motion_.rate() * inverse);
  put_matrix(motion.turn_of_spin, time_step_ * motion_.box().orientation);
  put_vector(motion.turn, motion_.turn());
  wandered_ += time_step_ * std::sqrt(kernels_.begin_step(motion, end_the_last));
}

void SphereBox::run(int steps) {
  for (int done = 1; done <= steps; ++done) {
    begin_step(done > 1);
    if (outgrown()) {
      find_candidates(list_.carried());
    } else if (motion_.moving()) {
      place_images();
    }
    compute_forces(true, done == steps);
    if (controlled()) control_rotation(damping_rate_ > 0.0);
    if (progress && done % kSphereProgressChunk == 0) progress();
  }
  if (steps <= 0) return;
  sum_up();
  kernels_.end_step(motion_of_step());
}

void SphereBox::sum_up() {
  imbalance_ = {0.0, 0.0, count()};
  for (int k = 0; k < count(); ++k) {
    const double* const force = &forces_[static_cast<std::size_t>(k) * kForceStride];
    imbalance_.force += ConstPlace(force).norm();
    imbalance_.moment += ConstPlace(force + 4).norm();
  }
  if (std::isfinite(imbalance_.force + imbalance_.moment)) return;
  lose_grains();
}

std::span<const double> SphereBox::rotations() const {
  std::vector<double>& all = records_->rotations;
  all.resize(3 * spheres_.radii.size());
  for (std::size_t k = 0; k < spheres_.radii.size(); ++k) std::copy_n(&turned_[k * 4], 3, &all[3 * k]);
  return all;
}

std::span<const double> SphereBox::places() const {
  std::vector<double>& all = records_->places;
  all.resize(3 * spheres_.radii.size());
  for (std::size_t k = 0; k < spheres_.radii.size(); ++k)
    std::copy_n(&grains_[k * kGrainStride], 3, &all[3 * k]);
  return all;
}

GrainMotion<3> SphereBox::motion(int sphere) const {
  const double* const grain = &grains_[static_cast<std::size_t>(sphere) * kGrainStride];
  GrainMotion<3> motion;
  std::copy_n(grain, 3, motion.place.begin());
  std::copy_n(grain + 4, 3, motion.velocity.begin());
  std::copy_n(grain + 8, 3, motion.spin.begin());
  return motion;
}

}  // namespace polargrain::dem
