// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/disc_box.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "dem/discs/laws.hpp"

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

LatticeVector image_of(const Snapshot<2>::Springs& contact) {
  return {contact.image[0], contact.image[1]};
}

}  // namespace

DiscBox::DiscBox(Definition definition)
    : definition_(std::move(definition)),
      loop_(definition_.plain ? make_plain_contact_loop(definition_.combination)
                              : make_contact_loop(definition_.combination)) {
  const std::size_t count = definition_.radii.size();
  discs_.resize(count);
  forces_.resize(count);
  motions_.resize(count);
  rotations_.resize(count);
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
  list_.springs = former_.springs = spring_count(definition_.combination.rolling);
  contacts_.reserve(3 * count);
}

void DiscBox::restore(const State& state) {
  restore(decode_snapshot<2>(state));
}

void DiscBox::restore(const Snapshot<2>& snapshot) {
  if (snapshot.grains.size() != discs_.size() || snapshot.code != definition_.combination.code() ||
      snapshot.springs != list_.springs)
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
  former_.images.assign(1, LatticeVector{});
  former_.rows.assign(1, 0);
  former_.pairs.clear();
  for (const Snapshot<2>::Springs& contact : snapshot.contacts) {
    while (static_cast<std::int32_t>(former_.rows.size()) <= contact.first)
      former_.rows.push_back(static_cast<std::int32_t>(former_.pairs.size()));
    auto image = std::find(former_.images.begin(), former_.images.end(), image_of(contact));
    if (image == former_.images.end()) image = former_.images.insert(image, image_of(contact));
    former_.pairs.push_back(
        {contact.second, static_cast<std::uint16_t>(image - former_.images.begin()), 0, 0.0});
  }
  former_.rows.resize(discs_.size() + 1, static_cast<std::int32_t>(former_.pairs.size()));
  former_.values = snapshot.values;
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
  snapshot.springs = list_.springs;
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
      const double* const values = &list_.values[static_cast<std::size_t>(c) * list_.springs];
      if (std::all_of(values, values + list_.springs, [](double value) { return value == 0.0; })) continue;
      const Candidate& pair = list_.pairs[c];
      const LatticeVector& old = list_.images[pair.image];
      const LatticeVector& away = copies[pair.second];
      // p b_1 + q b_2 = (p - q fold) b_1 + q (b_2 + fold b_1)
      snapshot.contacts.push_back(
          {static_cast<std::int32_t>(i),
           pair.second,
           {{old.p - old.q * fold + away.p - copies[i].p, old.q + away.q - copies[i].q}}});
      snapshot.values.insert(snapshot.values.end(), values, values + list_.springs);
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
  images_.resize(list_.images.size());
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
  for (std::size_t k = 0; k < images_.size(); ++k) {
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
  const ContactLoop::Scene scene{discs_, images_, motion_.curvature_rate().transpose(), definition_.time_step,
                                 advance};
  if (!record) {
    loop_->add_forces(scene, list_, forces_);
    return;
  }
  contacts_.clear();
  loop_->record_forces(scene, list_, forces_, contacts_);
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

namespace {

/// Second half of a step of one disc: damping against the affine flow, half a kick.
struct Ending {
  double half, rate;                                ///< half a time step, s; damping rate, 1/s
  double flow_xx, flow_xy, flow_yx, flow_yy, spin;  ///< affine, 1/s

  Ending(const BoxMotion<2>& box, double step, double damping_rate)
      : half(0.5 * step),
        rate(damping_rate),
        flow_xx(box.gradient()(0, 0)),
        flow_xy(box.gradient()(0, 1)),
        flow_yx(box.gradient()(1, 0)),
        flow_yy(box.gradient()(1, 1)),
        spin(box.spin()(0)) {}

  void apply(Disc& disc, const DiscForce& force, DiscMotion& motion) const {
    motion.ax = force.x * disc.inverse_mass - rate * (disc.vx - (flow_xx * disc.x + flow_xy * disc.y));
    motion.ay = force.y * disc.inverse_mass - rate * (disc.vy - (flow_yx * disc.x + flow_yy * disc.y));
    motion.angular = force.torque * disc.inverse_inertia - rate * (disc.spin - spin);
    disc.vx += half * motion.ax;
    disc.vy += half * motion.ay;
    disc.spin += half * motion.angular;
  }
};

/// First half of a step of one disc: velocities that the box adds, half a kick, drift.
struct Beginning {
  double step, half;                                  ///< s
  double change_xx, change_xy, change_yx, change_yy;  ///< of the affine velocity gradient, 1/s
  double flow_xx, flow_xy, flow_yx, flow_yy;          ///< affine, 1/s
  double change_of_spin, turn;                        ///< rad/s, rad

  Beginning(const BoxMotion<2>& box, double time_step) : step(time_step), half(0.5 * time_step) {
    const Eigen::Matrix2d change = box.change_of_gradient();
    const Eigen::Matrix2d flow = box.gradient_before();
    change_xx = change(0, 0);
    change_xy = change(0, 1);
    change_yx = change(1, 0);
    change_yy = change(1, 1);
    flow_xx = flow(0, 0);
    flow_xy = flow(0, 1);
    flow_yx = flow(1, 0);
    flow_yy = flow(1, 1);
    change_of_spin = box.change_of_spin()(0);
    turn = box.turn()(0);
  }

  /// @returns square of the speed against the affine flow
  double apply(Disc& disc, DiscMotion& motion) const {
    disc.vx += change_xx * disc.x + change_xy * disc.y;
    disc.vy += change_yx * disc.x + change_yy * disc.y;
    disc.spin += change_of_spin;
    disc.vx += half * motion.ax;
    disc.vy += half * motion.ay;
    disc.spin += half * motion.angular;
    const double ux = disc.vx - (flow_xx * disc.x + flow_xy * disc.y);
    const double uy = disc.vy - (flow_yx * disc.x + flow_yy * disc.y);
    disc.x += step * disc.vx;
    disc.y += step * disc.vy;
    motion.turned += step * disc.spin + turn;
    return ux * ux + uy * uy;
  }
};

}  // namespace

void DiscBox::begin_step(bool end_the_last) {
  const Ending ending(motion_, definition_.time_step, damping_rate_);
  motion_.advance();
  const Beginning beginning(motion_, definition_.time_step);
  double fastest = 0.0;
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    if (end_the_last) ending.apply(discs_[k], forces_[k], motions_[k]);
    fastest = std::max(fastest, beginning.apply(discs_[k], motions_[k]));
    forces_[k] = DiscForce{};
  }
  wandered_ += definition_.time_step * std::sqrt(fastest);
}

void DiscBox::end_step() {
  const Ending ending(motion_, definition_.time_step, damping_rate_);
  for (std::size_t k = 0; k < discs_.size(); ++k) ending.apply(discs_[k], forces_[k], motions_[k]);
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
  if (steps > 0) end_step();
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
  for (std::size_t k = 0; k < motions_.size(); ++k) rotations_[k] = motions_[k].turned;
  return rotations_;
}

std::span<const double> DiscBox::places() const {
  places_.clear();
  for (const Disc& disc : discs_) places_.insert(places_.end(), {disc.x, disc.y});
  return places_;
}

GrainMotion<2> DiscBox::motion(int disc) const {
  const Disc& at = discs_[static_cast<std::size_t>(disc)];
  return {{at.x, at.y}, {at.vx, at.vy}, {at.spin}, {}};
}

}  // namespace polargrain::dem
