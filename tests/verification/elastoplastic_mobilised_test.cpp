// SPDX-License-Identifier: GPL-2.0-or-later
// The generalised model on a synthetic micro scale (docs/theory/plasticity.md, B.9): friction and dilatancy
// are read from a point whose true law hardens, then softens, and drive a frozen cone in plane-strain
// compression.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "fem/material/elastoplastic.hpp"
#include "fem/material/mobilised.hpp"
#include "tests/support/synthetic_sand.hpp"
#include "tests/verification/elastoplastic_biaxial.hpp"

namespace polargrain::fem::test {
namespace {

using polargrain::testing::Curve;
using polargrain::testing::elasticity;
using polargrain::testing::kCohesion;
using polargrain::testing::kLateral;
using polargrain::testing::kStandstill;
using polargrain::testing::kStrain;
using polargrain::testing::kSubSteps;
using polargrain::testing::micro_strength;

ElastoplasticParameters<2> sand() {
  return {elasticity(), {}, micro_strength()};
}

/// Stands in for a cell: same increment, same state, same answer.
class SyntheticCell {
 public:
  struct Answer {
    ElastoplasticState<2> state;
    std::optional<Mobilised> mobilised;
  };

  [[nodiscard]] Answer evaluate(const ElastoplasticState<2>& start, const Increment<2>& increment) const {
    Increment<2> part = increment;
    part.displacement_gradient /= kSubSteps;
    Answer answer{start, std::nullopt};
    for (int i = 0; i < kSubSteps; ++i) {
      const ElastoplasticState<2> before = answer.state;
      if (law_.integrate(before, part, answer.state).quality != Quality::good) {
        throw std::runtime_error("the synthetic cell failed");
      }
    }
    // Plastic strain of the whole step: what an implicit frozen step multiplies its dilatancy with.
    const ScaledVector<double> plastic =
        plastic_strain(moduli_, increment.strain(), answer.state.scaled_stress - start.scaled_stress);
    if (answer.state.regime == Regime::smooth) {  // else the cell was elastic and shows no strength
      answer.mobilised = mobilised(moduli_, answer.state.scaled_stress, plastic, kCohesion);
    }
    return answer;
  }
  [[nodiscard]] ElastoplasticState<2> initial_state() const { return law_.initial_state(); }
  [[nodiscard]] const SubspaceModuli& moduli() const { return moduli_; }

 private:
  ElastoplasticLaw<2> law_{sand()};
  SubspaceModuli moduli_{sand().elastic, sand().weights};
};

/// The true law itself along the same path in very small steps.
Curve reference(int steps) {
  const ElastoplasticLaw<2> law(sand());
  ElastoplasticState<2> state = law.initial_state();
  ElastoplasticState<2> trial;
  Curve curve;
  for (int step = 1; step <= steps; ++step) {
    double vertical = 0.0;
    biaxial_step(-kStrain / steps, kLateral, [&](const Increment<2>& guess) {
      const Response<2> response = law.integrate(state, guess, trial);
      vertical = response.stress(k22);
      return response;
    });
    state = trial;
    curve.record(vertical / kLateral, kStrain * step / steps);
  }
  return curve;
}

/// @param most_calls 1: friction and dilatancy frozen over the step and read after it (published scheme);
/// more: the step is repeated with what the cell shows of it until that stands still.
Curve generalised(int steps, int most_calls) {
  const SyntheticCell cell;
  const ElastoplasticFrame<2> frame{cell.moduli(), sand().elastic.internal_length, 0.0};
  const Cone<double> first = micro_strength()(0.0);
  FrozenCone cone{first.friction, first.dilatancy, kCohesion};
  ElastoplasticState<2> state = cell.initial_state();
  ElastoplasticState<2> cell_state = cell.initial_state();
  Curve curve;
  int calls = 0;
  for (int step = 1; step <= steps; ++step) {
    SyntheticCell::Answer answer;
    ElastoplasticState<2> trial;
    double vertical = 0.0;
    double change = 1.0;
    for (int call = 0; call < most_calls && change > kStandstill; ++call) {
      const Increment<2> increment = biaxial_step(-kStrain / steps, kLateral, [&](const Increment<2>& guess) {
        const Response<2> response = integrate_elastoplastic(frame, cone, state, guess, trial);
        vertical = response.stress(k22);
        return response;
      });
      answer = cell.evaluate(cell_state, increment);
      ++calls;
      if (!answer.mobilised) {
        break;
      }
      change = std::abs(answer.mobilised->friction - cone.friction) +
               std::abs(answer.mobilised->dilatancy - cone.dilatancy);
      cone = {answer.mobilised->friction, answer.mobilised->dilatancy, kCohesion};
    }
    state = trial;
    cell_state = answer.state;
    curve.record(vertical / kLateral, kStrain * step / steps);
  }
  curve.calls = static_cast<double>(calls) / steps;
  return curve;
}

TEST(GeneralisedModel, FrozenIsFirstOrderAndTheFixedPointTenTimesBetter) {
  const Curve fine = reference(9600);
  std::cout << "[figure] reference: peak " << fine.peak << " at " << 100.0 * fine.peak_strain << " %\n";
  testing::expect_accuracy_table(
      fine, [](int steps) { return generalised(steps, 1); },
      [](int steps) { return generalised(steps, 20); });
}

}  // namespace
}  // namespace polargrain::fem::test
