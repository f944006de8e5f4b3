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

template <int dim>
double mean_stress(const ScaledVector<double, dim>& stress) {
  if constexpr (dim == 2) {
    return stress.template head<3>().sum() / 3.0;
  } else {
    return Split<double, dim>(stress).mean;
  }
}

/// At one end of the step or both: the strain that closes a gap is no flow.
template <int dim>
bool has_lost_contact(const MicroStep<dim>& step) {
  const double least = kLostContact * step.macro_mean;
  return step.macro_mean < 0.0 &&
         (mean_stress<dim>(step.stress_before) > least || mean_stress<dim>(step.stress_after) > least);
}

/// The dilatancy that works the difference of the mean stresses off. A step that shears by more than drift_shear would
/// overshoot, the more the longer it is: the next is expected to be as long as this one.
template <int dim>
double drift(const MicroStep<dim>& step, const SubspaceModuli& moduli, const MobilisationOptions& options) {
  if (!(options.drift_shear > 0.0)) return 0.0;
  const double over = std::max(options.drift_shear, shear_strain<dim>(moduli, step.strain));
  return (step.macro_mean - mean_stress<dim>(step.stress_after)) / (moduli.bulk * over);
}

template <int dim>
bool is_loading(const MicroStep<dim>& step) {
  const Split<double, dim> stress(0.5 * (step.stress_before + step.stress_after));
  const Split<double, dim> strain(step.strain);
  double work = 0.0;
  for (std::size_t k = 0; k < 3; ++k) work += plain_dot(stress.part[k], strain.part[k]);
  return work > 0.0;
}

/// Least-squares slope of the plastic strain over the deformation; zero with fewer than two samples.
template <int dim>
ScaledVector<double, dim> plastic_slope(const std::vector<typename Mobilisation<dim>::Sample>& samples) {
  ScaledVector<double, dim> slope = ScaledVector<double, dim>::Zero();
  double mean = 0.0;
  for (const auto& sample : samples) mean += sample.deformation / static_cast<double>(samples.size());
  double squares = 0.0;
  for (const auto& sample : samples) {
    slope += (sample.deformation - mean) * sample.plastic_strain;
    squares += (sample.deformation - mean) * (sample.deformation - mean);
  }
  return squares > 0.0 ? ScaledVector<double, dim>(slope / squares) : slope;
}

template <int dim>
void add_to_window(const MicroStep<dim>& step, const SubspaceModuli& moduli, int window,
                   std::vector<typename Mobilisation<dim>::Sample>& samples) {
  if (samples.empty()) samples.emplace_back();
  const typename Mobilisation<dim>::Sample& last = samples.back();
  samples.push_back({last.deformation + step.strain.norm(),
                     last.plastic_strain +
                         plastic_strain<dim>(moduli, step.strain, step.stress_after - step.stress_before)});
  if (samples.size() > static_cast<std::size_t>(window) + 1) samples.erase(samples.begin());
}

}  // namespace

template <int dim>
Mobilisation<dim> initial_mobilisation(const MobilisationOptions& options) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  Mobilisation<dim> start;
  start.cone = matched_cone({options.initial_friction * kDegrees, 0.0, options.cohesion}, options.match);
  return start;
}

template <int dim>
Mobilisation<dim> rotated(Mobilisation<dim> mobilisation, const std::type_identity_t<Turn<dim>>& turn) {
  for (typename Mobilisation<dim>::Sample& sample : mobilisation.samples)
    sample.plastic_strain = rotated(sample.plastic_strain, turn);
  return mobilisation;
}

template <int dim>
Mobilisation<dim> advance(const Mobilisation<dim>& start, const MicroStep<dim>& step,
                          const SubspaceModuli& moduli, const MobilisationOptions& options) {
  Mobilisation<dim> end = start;
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
  const std::optional<double> friction = cone_friction<dim>(moduli, step.stress_after, start.cone.cohesion);
  end.limited = !friction;
  if (!friction) return end;
  end.micro_friction = *friction;
  // A micro scale beyond the cone is one that the law has yet to catch up with: as stiff as it is.
  if (!step.macro_plastic && *friction < start.cone.friction)
    end.unloading = unloading_mode<dim>(moduli, step.strain, step.stress_after - step.stress_before);
  if (!loading || !step.macro_plastic) return end;
  const bool softening = *friction < start.micro_friction;
  if (*friction >= start.cone.friction || softening) end.cone.friction = *friction;

  std::optional<double> dilatancy = cone_dilatancy<dim>(moduli, plastic_slope<dim>(end.samples));
  if (!dilatancy) return end;
  const Mobilised cone = within(end.cone.friction, *dilatancy + drift(step, moduli, options), options.limits);
  end.cone.dilatancy = cone.dilatancy;
  end.limited = cone.clipped;
  return end;
}

template Mobilisation<2> initial_mobilisation<2>(const MobilisationOptions&);
template Mobilisation<2> rotated(Mobilisation<2>, const Turn<2>&);
template Mobilisation<2> advance(const Mobilisation<2>&, const MicroStep<2>&, const SubspaceModuli&,
                                 const MobilisationOptions&);
template Mobilisation<3> initial_mobilisation<3>(const MobilisationOptions&);
template Mobilisation<3> rotated(Mobilisation<3>, const Turn<3>&);
template Mobilisation<3> advance(const Mobilisation<3>&, const MicroStep<3>&, const SubspaceModuli&,
                                 const MobilisationOptions&);

}  // namespace polargrain::fem
