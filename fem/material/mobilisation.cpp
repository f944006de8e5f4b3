// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/mobilisation.hpp"

#include <algorithm>
#include <numbers>

#include "fem/material/cone_matching.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

/// Share of the law's pressure below which grains have come out of contact: their stresses are then no strength.
constexpr double kLostContact = 0.05;

double mean_stress(const ScaledVector<double>& stress) {
  return stress.head<3>().sum() / 3.0;
}

/// At one end of the step or both: the strain that closes a gap is no flow.
bool has_lost_contact(const MicroStep& step) {
  const double least = kLostContact * step.macro_mean;
  return step.macro_mean < 0.0 &&
         (mean_stress(step.stress_before) > least || mean_stress(step.stress_after) > least);
}

/// The dilatancy that works the difference of the mean stresses off. A step that shears by more than drift_shear would
/// overshoot, the more the longer it is: the next is expected to be as long as this one.
double drift(const MicroStep& step, const SubspaceModuli& moduli, const MobilisationOptions& options) {
  if (!(options.drift_shear > 0.0)) return 0.0;
  const double over = std::max(options.drift_shear, shear_strain(moduli, step.strain));
  return (step.macro_mean - mean_stress(step.stress_after)) / (moduli.bulk * over);
}

bool is_loading(const MicroStep& step) {
  const Split<double> stress(0.5 * (step.stress_before + step.stress_after));
  const Split<double> strain(step.strain);
  double work = 0.0;
  for (std::size_t k = 0; k < 3; ++k) work += plain_dot(stress.part[k], strain.part[k]);
  return work > 0.0;
}

/// Least-squares slope of the plastic strain over the deformation; zero with fewer than two samples.
ScaledVector<double> plastic_slope(const std::vector<Mobilisation::Sample>& samples) {
  ScaledVector<double> slope = ScaledVector<double>::Zero();
  double mean = 0.0;
  for (const auto& sample : samples) mean += sample.deformation / static_cast<double>(samples.size());
  double squares = 0.0;
  for (const auto& sample : samples) {
    slope += (sample.deformation - mean) * sample.plastic_strain;
    squares += (sample.deformation - mean) * (sample.deformation - mean);
  }
  return squares > 0.0 ? ScaledVector<double>(slope / squares) : slope;
}

void add_to_window(const MicroStep& step, const SubspaceModuli& moduli, int window,
                   std::vector<Mobilisation::Sample>& samples) {
  if (samples.empty()) samples.emplace_back();
  const Mobilisation::Sample& last = samples.back();
  samples.push_back(
      {last.deformation + step.strain.norm(),
       last.plastic_strain + plastic_strain(moduli, step.strain, step.stress_after - step.stress_before)});
  if (samples.size() > static_cast<std::size_t>(window) + 1) samples.erase(samples.begin());
}

}  // namespace

Mobilisation initial_mobilisation(const MobilisationOptions& options) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  Mobilisation start;
  start.cone = cone_from_plane_strain({options.initial_friction * kDegrees, 0.0, options.cohesion});
  return start;
}

Mobilisation rotated(Mobilisation mobilisation, double angle) {
  for (Mobilisation::Sample& sample : mobilisation.samples)
    sample.plastic_strain = rotated(sample.plastic_strain, angle);
  return mobilisation;
}

Mobilisation advance(const Mobilisation& start, const MicroStep& step, const SubspaceModuli& moduli,
                     const MobilisationOptions& options) {
  Mobilisation end = start;
  end.unloading.reset();
  if (has_lost_contact(step)) {
    // Nothing can be read, but the grains must be pressed together again: with the dilatancy as it is they would never come back.
    end.limited = true;
    end.samples.clear();
    end.micro_friction = 0.0;  // it will be on its way up
    if (step.macro_plastic)
      end.cone.dilatancy = within(end.cone.friction, drift(step, moduli, options), options.limits).dilatancy;
    return end;
  }
  const bool loading = is_loading(step);
  if (loading) {
    add_to_window(step, moduli, options.window, end.samples);
  } else {
    end.samples.clear();
  }
  const std::optional<double> friction = cone_friction(moduli, step.stress_after, start.cone.cohesion);
  end.limited = !friction;
  if (!friction) return end;
  end.micro_friction = *friction;
  // A micro scale beyond the cone is one that the law has yet to catch up with: as stiff as it is.
  if (!step.macro_plastic && *friction < start.cone.friction)
    end.unloading = unloading_mode(moduli, step.strain, step.stress_after - step.stress_before);
  if (!loading || !step.macro_plastic) return end;
  const bool softening = *friction < start.micro_friction;
  if (*friction >= start.cone.friction || softening) end.cone.friction = *friction;

  std::optional<double> dilatancy = cone_dilatancy(moduli, plastic_slope(end.samples));
  if (!dilatancy) return end;
  const Mobilised cone = within(end.cone.friction, *dilatancy + drift(step, moduli, options), options.limits);
  end.cone.dilatancy = cone.dilatancy;
  end.limited = cone.clipped;
  return end;
}

}  // namespace polargrain::fem
