// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/disc_box.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "dem/contact/hertz_slope.hpp"

namespace polargrain::dem {

namespace {

/// Gap up to which two discs are candidates, over the mean radius: at strains of 1e-3 a list lasts an
/// increment and holds few pairs that do not touch.
constexpr double kDiscSkin = 0.05;

/// Steps between two calls of `progress`.
constexpr int kDiscProgressChunk = 200;

/// Smallest stretch of a deformation gradient.
double least_stretch(const Eigen::Matrix2d& f) {
  const double mean = 0.5 * f.squaredNorm();
  const double determinant = f.determinant();
  const double root = std::sqrt(std::max(0.0, mean * mean - determinant * determinant));
  return std::sqrt(std::max(0.0, mean - root));
}

DiscKernels::Pass pass_of(const DiscKernels& kernels, const LawCombination& laws) {
  return kernels.pass[static_cast<int>(laws.normal)][static_cast<int>(laws.tangential)]
                     [static_cast<int>(laws.rolling)][laws.is_bare() ? 1 : 0];
}

void put_rows(double* four, const Eigen::Matrix2d& matrix) {
  four[0] = matrix(0, 0);
  four[1] = matrix(0, 1);
  four[2] = matrix(1, 0);
  four[3] = matrix(1, 1);
}

LatticeVector image_of(const Snapshot<2>::Springs& contact) {
  return {contact.image[0], contact.image[1]};
}

}  // namespace

DiscBox::DiscBox(Definition definition)
    : definition_(std::move(definition)),
      plain_loop_(definition_.combination),
      kernels_(disc_kernels(definition_.instructions)),
      pass_(pass_of(kernels_, definition_.combination)) {
  const std::size_t count = definition_.radii.size();
  discs_.resize(count);
  forces_.resize(count);
  motions_.resize(count);
  listed_places_.resize(count);
  double mean = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double radius = definition_.radii[k];
    mean += radius / static_cast<double>(count);
    largest_radius_ = std::max(largest_radius_, radius);
    discs_[k].radius = radius;
    discs_[k].inverse_mass = 1.0 / definition_.masses[k];
    discs_[k].inverse_inertia = 2.0 / (definition_.masses[k] * radius * radius);  // disc
  }
  skin_ = kDiscSkin * mean;
  list_.spring_count = former_.spring_count = spring_count(definition_.combination.rolling);
}

void DiscBox::restore(const State& state) {
  restore(decode_snapshot<2>(state));
}

void DiscBox::restore(const Snapshot<2>& snapshot) {
  if (snapshot.grains.size() != discs_.size() || snapshot.code != definition_.combination.code() ||
      snapshot.springs != list_.spring_count)
    throw RunError("this state belongs to a cell of another packing or another input script");
  if (const std::string fault = snapshot_fault(snapshot, definition_.radii, definition_.time_step);
      !fault.empty())
    throw RunError(fault);
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const GrainMotion<2>& from = snapshot.grains[k];
    Disc& disc = discs_[k];
    disc.x = from.place[0];
    disc.y = from.place[1];
    disc.vx = from.velocity[0];
    disc.vy = from.velocity[1];
    disc.spin = from.spin[0];
    motions_[k] = {0.0, 0.0, 0.0, from.turned[0]};
  }
  motion_ = BoxMotion<2>(BoxPath<2>(snapshot.box), std::nullopt, definition_.time_step);
  // The springs wait in the form of a list for the one that is made next.
  former_.clear();
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const Snapshot<2>::Springs& contact = snapshot.contacts[c];
    former_.add(contact.first, contact.second, image_of(contact),
                &snapshot.values[c * static_cast<std::size_t>(snapshot.springs)]);
  }
  former_.close_rows(discs_.size());
  find_candidates();
}

void DiscBox::restore_moving(const State& state, const Eigen::Matrix2d& gradient,
                             const Cosserat<2>::Rotation& spin) {
  restore(state);
  motion_.set_rates(gradient, spin);
}

StatePointer DiscBox::save_moving() {
  Snapshot<2> snapshot = decode_snapshot<2>(*save());
  const Eigen::Matrix2d& gradient = motion_.gradient();
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    GrainMotion<2>& disc = snapshot.grains[k];
    const Eigen::Vector2d folded(disc.place[0] - discs_[k].x, disc.place[1] - discs_[k].y);
    Eigen::Map<Eigen::Vector2d>(disc.velocity.data()) += gradient * folded;
  }
  return encode(snapshot);
}

StatePointer DiscBox::save() {
  const Box<2>& box = motion_.box();
  Snapshot<2> snapshot;
  snapshot.box = box.reduced();
  snapshot.code = definition_.combination.code();
  snapshot.springs = list_.spring_count;
  // b_2 of the reduced box is b_2 + fold b_1.
  const auto fold =
      static_cast<std::int32_t>(std::lround((snapshot.box.base(0, 1) - box.base(0, 1)) / box.base(0, 0)));
  const Eigen::Matrix2d base = snapshot.box.base;
  const Eigen::Matrix2d inverse = base.inverse();
  std::vector<LatticeVector> copies(discs_.size());
  snapshot.grains.resize(discs_.size());
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const Disc& disc = discs_[k];
    LatticeVector& copy = copies[k];
    copy = copy_at(inverse, disc.x, disc.y);
    snapshot.grains[k] = motion(static_cast<int>(k));
    snapshot.grains[k].place = {disc.x - (base(0, 0) * copy.p + base(0, 1) * copy.q),
                                disc.y - (base(1, 0) * copy.p + base(1, 1) * copy.q)};
    snapshot.grains[k].turned = {motions_[k].turned};
  }
  for (std::size_t i = 0; i < discs_.size(); ++i)
    for (std::int32_t c = list_.rows[i]; c < list_.rows[i + 1]; ++c) {
      if (!list_.is_stressed(c)) continue;
      const int second = list_.second[c];
      const LatticeVector& old = list_.images[list_.image[c]];
      const LatticeVector& away = copies[second];
      // p b_1 + q b_2 = (p - q fold) b_1 + q (b_2 + fold b_1)
      snapshot.contacts.push_back(
          {static_cast<std::int32_t>(i),
           second,
           {{old.p - old.q * fold + away.p - copies[i].p, old.q + away.q - copies[i].q}}});
      for (int k = 0; k < list_.spring_count; ++k) snapshot.values.push_back(list_.springs[k][c]);
    }
  // An answer must be a state to go on from.
  if (const std::string fault = snapshot_fault(snapshot, definition_.radii, definition_.time_step);
      !fault.empty())
    throw RunError(fault);
  return encode(snapshot);
}

void DiscBox::find_candidates() {
  const Eigen::Matrix2d base = motion_.box().base;
  list_.find(discs_, definition_.types, definition_.combination.types, base, skin_);
  list_.take_springs(former_);
  listed_inverse_ = base.inverse();
  wandered_ = 0.0;
  for (std::size_t k = 0; k < discs_.size(); ++k) listed_places_[k] = {discs_[k].x, discs_[k].y};
  records_->clear(this);
  images_.resize(list_.images.size() + 1);
  images_.back().x = 10.0 * largest_radius_;  // of pairs that never touch
  place_images();
}

bool DiscBox::outgrown() {
  const Eigen::Matrix2d f = motion_.box().base * listed_inverse_;
  // How far discs may move against the affine flow before two that are no candidates may touch.
  const double stretch = least_stretch(f);
  const double room = 0.5 * (stretch * skin_ - (1.0 - stretch) * 2.0 * largest_radius_);
  if (wandered_ < room) return false;
  // The bound adds up speeds; the way itself is shorter.
  double longest = 0.0;
  for (std::size_t k = 0; k < discs_.size(); ++k)
    longest =
        std::max(longest, (Eigen::Vector2d(discs_[k].x, discs_[k].y) - f * listed_places_[k]).squaredNorm());
  wandered_ = std::sqrt(longest);
  return !(wandered_ < 0.8 * room);
}

void DiscBox::place_images() {
  const Eigen::Matrix2d base = motion_.box().base;
  const Eigen::Matrix2d& rate = motion_.rate();
  for (std::size_t k = 0; k < list_.images.size(); ++k) {
    const LatticeVector& image = list_.images[k];
    images_[k] = {base(0, 0) * image.p + base(0, 1) * image.q, base(1, 0) * image.p + base(1, 1) * image.q,
                  rate(0, 0) * image.p + rate(0, 1) * image.q, rate(1, 0) * image.p + rate(1, 1) * image.q};
  }
}

void DiscBox::begin(const BoxPath<2>& path, double damping_rate, const Loading& rotation, double time_step) {
  definition_.time_step = time_step;
  motion_ = BoxMotion<2>(path, rotation, time_step);
  damping_rate_ = damping_rate;
  multiplier_ = 0.0;
  weights_.clear();  // they belong to another path
}

void DiscBox::go_on(const BoxPath<2>& path, double damping_rate, const Loading& rotation) {
  motion_.go_on(path, rotation, definition_.time_step);
  damping_rate_ = damping_rate;
}

void DiscBox::compute_forces(bool advance, bool record) {
  double* const records = record ? records_->begin(this, DiscRecord::columns * list_.second.size()) : nullptr;
  if (definition_.plain)
    plain_loop_.add_forces(
        {discs_, images_, motion_.curvature_rate().transpose(), definition_.time_step, advance, records},
        list_, forces_);
  else
    run_kernel(advance, records);
}

void DiscBox::run_kernel(bool advance, double* records) {
  DiscPass pass{};
  pass.discs = discs_.data();
  pass.images = images_.data();
  pass.forces = forces_.data();
  pass.row_sums = list_.row_sums.data();
  pass.first = list_.first_row.data();
  pass.second = list_.second_row.data();
  pass.image = list_.image_row.data();
  pass.kind = definition_.combination.types > 1 ? list_.kind.data() : nullptr;
  pass.continues = list_.continues.data();
  pass.radius_first = list_.radius_first.data();
  pass.radius_second = list_.radius_second.data();
  pass.harmonic = list_.harmonic.data();
  for (int k = 0; k < kDiscSprings; ++k) pass.springs[k] = list_.springs[k].data();
  pass.parameters = definition_.combination.pairs.data();
  pass.settings = definition_.combination.settings;
  pass.candidates = static_cast<int>(list_.second.size());
  pass.count = static_cast<int>(discs_.size());
  pass.step = definition_.time_step;
  const Eigen::RowVector2d bend = motion_.curvature_rate();
  pass.bend_x = bend.x();
  pass.bend_y = bend.y();
  pass.advance = advance;
  pass.records = records;
  pass_(pass);
}

std::span<const Contact> DiscBox::contacts() const {
  if (!records_->of(this).are_listed) read_records();
  return records_->contacts;
}

ContactSums<2> DiscBox::contact_sums() const {
  if (records_->of(this).are_listed) return sums_of<2>(records_->contacts);
  ContactSums<2> sums;
  const std::size_t candidates = list_.second.size();
  const double* const touches = &records_->values[DiscRecord::touches * candidates];
  const double* const delta = &records_->values[DiscRecord::delta * candidates];
  const double* const force = &records_->values[DiscRecord::force * candidates];
  for (std::size_t c = 0; c < static_cast<std::size_t>(list_.rows.back()); ++c)
    if (touches[c] != 0.0) sums.add({-delta[c], -delta[candidates + c]}, {force[c], force[candidates + c]});
  return sums;
}

void DiscBox::read_records() const {
  records_->clear(this);
  const LawCombination& laws = definition_.combination;
  const double slope = laws.normal == NormalLaw::hertz ? kHertzSlope : 1.0;
  const std::size_t candidates = list_.second.size();
  const auto at = [this, candidates](int column, std::size_t c) {
    return records_->values[static_cast<std::size_t>(column) * candidates + c];
  };
  for (std::size_t c = 0; c < static_cast<std::size_t>(list_.rows.back()); ++c) {
    if (at(DiscRecord::touches, c) == 0.0) continue;
    Contact& contact = records_->contacts.emplace_back();
    contact.first = list_.first[c];
    contact.second = list_.second[c];
    contact.branch = {-at(DiscRecord::delta, c), -at(DiscRecord::delta + 1, c), 0.0};
    contact.force = {at(DiscRecord::force, c), at(DiscRecord::force + 1, c), 0.0};
    contact.normal_stiffness = slope * at(DiscRecord::stiffnesses, c);
    contact.tangential_stiffness = at(DiscRecord::stiffnesses + 1, c);
    contact.normal_viscosity = at(DiscRecord::dashpots, c);
    contact.tangential_viscosity = at(DiscRecord::dashpots + 1, c);
    contact.arm_first = at(DiscRecord::arms, c);
    contact.arm_second = at(DiscRecord::arms + 1, c);
    contact.friction = laws.pairs[list_.kind[c]].friction;
    contact.moment.z() = -at(DiscRecord::moment, c);
    contact.rolling_stiffness = at(DiscRecord::rolling, c);
    contact.rolling_at_limit = at(DiscRecord::is_rolling, c) != 0.0;
    contact.rolling_limit = at(DiscRecord::rolling_limit, c);
  }
}

void DiscBox::set_up() {
  std::fill(forces_.begin(), forces_.end(), DiscForce{});
  compute_forces(false, true);
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    motions_[k].ax = forces_[k].x * discs_[k].inverse_mass;
    motions_[k].ay = forces_[k].y * discs_[k].inverse_mass;
    motions_[k].angular = forces_[k].torque * discs_[k].inverse_inertia;
  }
}

void DiscBox::set_rotation_weights(std::span<const double> weights) {
  weights_.assign(weights.begin(), weights.end());
}

void DiscBox::hold_rotation() {
  if (!controlled()) return;
  control_rotation(false);
  for (std::size_t k = 0; k < discs_.size(); ++k)
    motions_[k].angular = forces_[k].torque * discs_[k].inverse_inertia;
}

void DiscBox::control_rotation(bool damped) {
  // The spins of the next half step must average to the prescribed one, sum W (spin + dt (T + lambda W) / I)
  // = V rate with W = V weight (C.6). All grains get the change of the rate until then alike.
  const double step = definition_.time_step;
  const double rate = damped ? damping_rate_ : 0.0;
  const double volume = motion_.box().size() * definition_.thickness;
  const double spin = motion_.spin()(0);
  double mean_spin = 0.0;
  double compliance = 0.0;
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const Disc& disc = discs_[k];
    const double angular = forces_[k].torque * disc.inverse_inertia - rate * (disc.spin - spin);
    mean_spin += weights_[k] * (disc.spin + step * angular);
    compliance += weights_[k] * weights_[k] * step * disc.inverse_inertia;
  }
  multiplier_ = (spin - mean_spin) / (compliance * volume);
  const double torque = multiplier_ * volume;
  for (std::size_t k = 0; k < discs_.size(); ++k) forces_[k].torque += torque * weights_[k];
}

DiscMotionPass DiscBox::motion_pass() {
  DiscMotionPass pass{};
  pass.discs = discs_.data();
  pass.forces = forces_.data();
  pass.motions = motions_.data();
  pass.count = static_cast<int>(discs_.size());
  pass.step = definition_.time_step;
  pass.damping_rate = damping_rate_;
  put_rows(pass.gradient, motion_.gradient());
  pass.spin = motion_.spin()(0);
  return pass;
}

void DiscBox::begin_step(bool end_the_last) {
  DiscMotionPass pass = motion_pass();
  motion_.advance();
  put_rows(pass.change, motion_.change_of_gradient());
  pass.change_of_spin = motion_.change_of_spin()(0);
  put_rows(pass.flow, motion_.gradient_before());
  pass.turn = motion_.turn()(0);
  wandered_ += definition_.time_step * std::sqrt(kernels_.begin_step(pass, end_the_last));
}

void DiscBox::run(int steps) {
  for (int done = 1; done <= steps; ++done) {
    begin_step(done > 1);
    if (outgrown()) {
      std::swap(list_, former_);
      find_candidates();
    } else if (motion_.moving()) {
      place_images();
    }
    compute_forces(true, done == steps);
    if (controlled()) control_rotation(damping_rate_ > 0.0);
    if (progress && done % kDiscProgressChunk == 0) progress();
  }
  if (steps > 0) kernels_.end_step(motion_pass());
}

Imbalance DiscBox::imbalance() const {
  Imbalance sums;
  sums.grains = static_cast<int>(discs_.size());
  for (const DiscForce& force : forces_) {
    sums.force += std::sqrt(force.x * force.x + force.y * force.y);
    sums.moment += std::abs(force.torque);
  }
  return sums;
}

std::span<const double> DiscBox::rotations() const {
  std::vector<double>& all = records_->rotations;
  all.resize(motions_.size());
  for (std::size_t k = 0; k < motions_.size(); ++k) all[k] = motions_[k].turned;
  return all;
}

std::span<const double> DiscBox::places() const {
  std::vector<double>& all = records_->places;
  all.clear();
  for (const Disc& disc : discs_) all.insert(all.end(), {disc.x, disc.y});
  return all;
}

GrainMotion<2> DiscBox::motion(int disc) const {
  const Disc& at = discs_[static_cast<std::size_t>(disc)];
  return {{at.x, at.y}, {at.vx, at.vy}, {at.spin}, {}};
}

}  // namespace polargrain::dem
