// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/contact_loop.hpp"

#include <cmath>

#include "dem/discs/laws.hpp"
#include "dem/discs/take_down.hpp"

namespace polargrain::dem {

namespace {

/// @tparam Bare without dashpots and without a limit of normal forces, which then need not be asked for
template <NormalLaw Normal, TangentialLaw Tangential, RollingLaw Rolling, bool Bare>
class Loop final : public ContactLoop {
  static constexpr int kSprings = spring_count(Rolling);

 public:
  explicit Loop(const DiscCombination& combination)
      : settings_(combination.settings), parameters_(combination.pairs) {}

  void add_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces) const override {
    if (scene.advance)
      pass<true, false>(scene, list, forces, nullptr);
    else
      pass<false, false>(scene, list, forces, nullptr);
  }
  void record_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces,
                     std::vector<Contact>& contacts) const override {
    if (scene.advance)
      pass<true, true>(scene, list, forces, &contacts);
    else
      pass<false, true>(scene, list, forces, &contacts);
  }

 private:
  template <bool Advance, bool Record>
  void pass(const Scene& scene, CandidateList& list, std::span<DiscForce> sums,
            std::vector<Contact>* contacts) const {
    const Disc* const discs = scene.discs.data();
    const MovingImage* const images = scene.images.data();
    DiscForce* const forces = sums.data();
    const Candidate* const pairs = list.pairs.data();
    double* const values = list.values.data();
    const PairParameters* const parameters = parameters_.data();
    LawSettings settings = settings_;
    if constexpr (Bare) settings.damped = settings.limit_force = false;
    const double step = scene.step;
    const double bend_x = scene.curvature_rate.x();
    const double bend_y = scene.curvature_rate.y();
    const int count = static_cast<int>(scene.discs.size());

    for (int i = 0; i < count; ++i) {
      const Disc& a = discs[i];
      double fx = 0.0;
      double fy = 0.0;
      double torque = 0.0;
      for (std::int32_t c = list.rows[i]; c < list.rows[i + 1]; ++c) {
        const Candidate& pair = pairs[c];
        const Disc& b = discs[pair.second];
        const MovingImage& image = images[pair.image];
        double* const springs = values + static_cast<std::size_t>(c) * kSprings;
        const double dx = a.x - b.x - image.x;
        const double dy = a.y - b.y - image.y;
        const double sum = a.radius + b.radius;
        const double square = dx * dx + dy * dy;
        if (!(square < sum * sum)) {
          // Discs that have parted forget their springs.
          if constexpr (Advance)
            for (int k = 0; k < kSprings; ++k) springs[k] = 0.0;
          continue;
        }
        const double distance = std::sqrt(square);
        const double inverse = 1.0 / distance;
        Touch touch;
        touch.nx = dx * inverse;
        touch.ny = dy * inverse;
        touch.overlap = sum - distance;
        touch.radius_first = a.radius;
        touch.radius_second = b.radius;
        touch.arm_first = a.radius - 0.5 * touch.overlap;
        touch.arm_second = b.radius - 0.5 * touch.overlap;
        touch.harmonic = pair.harmonic;
        touch.inverse_mass_first = a.inverse_mass;
        touch.inverse_mass_second = b.inverse_mass;
        touch.inverse_inertia_first = a.inverse_inertia;
        touch.inverse_inertia_second = b.inverse_inertia;
        const double vx = a.vx - b.vx - image.vx;
        const double vy = a.vy - b.vy - image.vy;
        touch.opening_rate = vx * touch.nx + vy * touch.ny;
        // Spins seen from the middle of the branch (C.8).
        const double bent = 0.5 * (bend_x * dx + bend_y * dy);
        const double spin_first = a.spin + bent;
        const double spin_second = b.spin - bent;
        touch.slip_rate =
            vy * touch.nx - vx * touch.ny - (touch.arm_first * spin_first + touch.arm_second * spin_second);
        touch.spin_difference = a.spin - b.spin;
        touch.relative_spin = spin_first - spin_second;

        const PairParameters& p = parameters[pair.kind];
        const NormalAnswer normal = normal_law<Normal>(p, settings, touch);
        const double tangential =
            tangential_law<Tangential>(p, settings, touch, normal, step, Advance, springs);
        const RollingAnswer rolling =
            rolling_law<Rolling>(p, settings, touch, normal, step, Advance, springs);

        const double push_x = normal.force * touch.nx - tangential * touch.ny;
        const double push_y = normal.force * touch.ny + tangential * touch.nx;
        fx += push_x;
        fy += push_y;
        double turn_first = touch.arm_first * tangential;
        double turn_second = touch.arm_second * tangential;
        if constexpr (Rolling != RollingLaw::off) {
          turn_first += rolling.moment;
          turn_second -= rolling.moment;
        }
        torque -= turn_first;
        DiscForce& other = forces[pair.second];
        other.x -= push_x;
        other.y -= push_y;
        other.torque -= turn_second;
        if constexpr (Record)
          contacts->push_back(take_down(i, pair.second, dx, dy, touch, p, normal, push_x, push_y, rolling));
      }
      forces[i].x += fx;
      forces[i].y += fy;
      forces[i].torque += torque;
    }
  }

  LawSettings settings_;
  std::vector<PairParameters> parameters_;
};

template <NormalLaw Normal, TangentialLaw Tangential, RollingLaw Rolling>
std::unique_ptr<ContactLoop> with_settings(const DiscCombination& combination) {
  if (combination.settings.damped || combination.settings.limit_force)
    return std::make_unique<Loop<Normal, Tangential, Rolling, false>>(combination);
  return std::make_unique<Loop<Normal, Tangential, Rolling, true>>(combination);
}

template <NormalLaw Normal, TangentialLaw Tangential>
std::unique_ptr<ContactLoop> with_rolling(const DiscCombination& combination) {
  switch (combination.rolling) {
    case RollingLaw::off:
      return with_settings<Normal, Tangential, RollingLaw::off>(combination);
    case RollingLaw::epsd2:
      return with_settings<Normal, Tangential, RollingLaw::epsd2>(combination);
    case RollingLaw::li_chu:
      return with_settings<Normal, Tangential, RollingLaw::li_chu>(combination);
  }
  return nullptr;
}

template <NormalLaw Normal>
std::unique_ptr<ContactLoop> with_tangential(const DiscCombination& combination) {
  return combination.tangential == TangentialLaw::history
             ? with_rolling<Normal, TangentialLaw::history>(combination)
             : with_rolling<Normal, TangentialLaw::li_chu>(combination);
}

}  // namespace

std::unique_ptr<ContactLoop> make_contact_loop(const DiscCombination& combination) {
  switch (combination.normal) {
    case NormalLaw::hooke_radii:
      return with_tangential<NormalLaw::hooke_radii>(combination);
    case NormalLaw::hooke_stiffness:
      return with_tangential<NormalLaw::hooke_stiffness>(combination);
    case NormalLaw::hertz:
      return with_tangential<NormalLaw::hertz>(combination);
  }
  return nullptr;
}

}  // namespace polargrain::dem
