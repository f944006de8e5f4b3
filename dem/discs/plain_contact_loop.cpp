// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over the contacts of discs as the equations have it (docs/theory/grains.md, C.1 and D). Slow on
// purpose; the fast one is held to it.
#include <cmath>

#include "dem/discs/contact_loop.hpp"
#include "dem/discs/laws.hpp"
#include "dem/discs/take_down.hpp"

namespace polargrain::dem {

namespace {

NormalAnswer normal_answer(const DiscCombination& combination, const PairParameters& p, const Touch& touch) {
  switch (combination.normal) {
    case NormalLaw::hooke_radii:
      return normal_law<NormalLaw::hooke_radii>(p, combination.settings, touch);
    case NormalLaw::hooke_stiffness:
      return normal_law<NormalLaw::hooke_stiffness>(p, combination.settings, touch);
    case NormalLaw::hertz:
      return normal_law<NormalLaw::hertz>(p, combination.settings, touch);
  }
  return {};
}

RollingAnswer rolling_answer(const DiscCombination& combination, const PairParameters& p, const Touch& touch,
                             const NormalAnswer& normal, const ContactLoop::Scene& scene, double* springs) {
  const LawSettings& on = combination.settings;
  switch (combination.rolling) {
    case RollingLaw::off:
      return {};
    case RollingLaw::epsd2:
      return rolling_law<RollingLaw::epsd2>(p, on, touch, normal, scene.step, scene.advance, springs);
    case RollingLaw::li_chu:
      return rolling_law<RollingLaw::li_chu>(p, on, touch, normal, scene.step, scene.advance, springs);
  }
  return {};
}

class PlainLoop final : public ContactLoop {
 public:
  explicit PlainLoop(const DiscCombination& combination) : combination_(combination) {}

  void add_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces) const override {
    std::vector<Contact> unused;
    record_forces(scene, list, forces, unused);
  }

  void record_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces,
                     std::vector<Contact>& contacts) const override {
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
      DiscForce sum;
      for (std::int32_t c = list.rows[i]; c < list.rows[i + 1]; ++c)
        one(scene, static_cast<int>(i), list.pairs[c],
            &list.values[static_cast<std::size_t>(c) * list.springs], list.springs, sum, forces, contacts);
      forces[i].x += sum.x;
      forces[i].y += sum.y;
      forces[i].torque += sum.torque;
    }
  }

 private:
  void one(const Scene& scene, int i, const Candidate& pair, double* springs, int count, DiscForce& sum,
           std::span<DiscForce> forces, std::vector<Contact>& contacts) const {
    const Disc& a = scene.discs[i];
    const Disc& b = scene.discs[pair.second];
    const MovingImage& image = scene.images[pair.image];
    const Eigen::Vector2d delta(a.x - b.x - image.x, a.y - b.y - image.y);  // from the second to the first
    const double distance = std::sqrt(delta.x() * delta.x() + delta.y() * delta.y());
    if (!(delta.x() * delta.x() + delta.y() * delta.y() < (a.radius + b.radius) * (a.radius + b.radius))) {
      if (scene.advance) std::fill_n(springs, count, 0.0);
      return;
    }
    const Touch touch = touch_of(a, b, image, pair, scene, delta, distance);
    const PairParameters& p = combination_.pairs[pair.kind];
    const NormalAnswer normal = normal_answer(combination_, p, touch);
    const double tangential =
        combination_.tangential == TangentialLaw::history
            ? tangential_law<TangentialLaw::history>(p, combination_.settings, touch, normal, scene.step,
                                                     scene.advance, springs)
            : tangential_law<TangentialLaw::li_chu>(p, combination_.settings, touch, normal, scene.step,
                                                    scene.advance, springs);
    const RollingAnswer rolling = rolling_answer(combination_, p, touch, normal, scene, springs);

    const Eigen::Vector2d n(touch.nx, touch.ny);
    const Eigen::Vector2d t(-touch.ny, touch.nx);
    const Eigen::Vector2d force = normal.force * n + tangential * t;  // on the first
    sum.x += force.x();
    sum.y += force.y();
    sum.torque -= touch.arm_first * tangential + rolling.moment;
    DiscForce& other = forces[static_cast<std::size_t>(pair.second)];
    other.x -= force.x();
    other.y -= force.y();
    other.torque -= touch.arm_second * tangential - rolling.moment;

    contacts.push_back(
        take_down(i, pair.second, delta.x(), delta.y(), touch, p, normal, force.x(), force.y(), rolling));
  }

  /// Kinematics of a contact (D.1).
  static Touch touch_of(const Disc& a, const Disc& b, const MovingImage& image, const Candidate& pair,
                        const Scene& scene, const Eigen::Vector2d& delta, double distance) {
    Touch touch;
    touch.nx = delta.x() * (1.0 / distance);
    touch.ny = delta.y() * (1.0 / distance);
    touch.overlap = a.radius + b.radius - distance;
    touch.radius_first = a.radius;
    touch.radius_second = b.radius;
    touch.arm_first = a.radius - 0.5 * touch.overlap;
    touch.arm_second = b.radius - 0.5 * touch.overlap;
    touch.harmonic = pair.harmonic;
    touch.inverse_mass_first = a.inverse_mass;
    touch.inverse_mass_second = b.inverse_mass;
    touch.inverse_inertia_first = a.inverse_inertia;
    touch.inverse_inertia_second = b.inverse_inertia;
    const Eigen::Vector2d velocity(a.vx - b.vx - image.vx, a.vy - b.vy - image.vy);
    touch.opening_rate = velocity.x() * touch.nx + velocity.y() * touch.ny;
    // Half of the curvature times the branch, which points to the second: spins from its middle (C.8).
    const double bent = -0.5 * scene.curvature_rate.dot(-delta);
    touch.slip_rate = velocity.y() * touch.nx - velocity.x() * touch.ny -
                      (touch.arm_first * (a.spin + bent) + touch.arm_second * (b.spin - bent));
    touch.spin_difference = a.spin - b.spin;
    touch.relative_spin = (a.spin + bent) - (b.spin - bent);
    return touch;
  }

  DiscCombination combination_;
};

}  // namespace

std::unique_ptr<ContactLoop> make_plain_contact_loop(const DiscCombination& combination) {
  return std::make_unique<PlainLoop>(combination);
}

}  // namespace polargrain::dem
