// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/beam/beam_section.hpp"

#include <algorithm>

namespace polargrain::fem {

BeamAnswer respond(const BeamSection& section, double plastic_curvature, const BeamVector& strain) {
  const BeamVector stiffness(section.axial_stiffness, section.shear_stiffness, section.bending_stiffness);
  BeamVector elastic = strain;
  elastic(2) -= plastic_curvature;
  BeamAnswer answer{stiffness.cwiseProduct(elastic), stiffness.asDiagonal(), plastic_curvature};
  const double axial = answer.forces(0);
  const double trial = answer.forces(2);
  const double limit =
      section.plastic_moment * std::max(0.0, 1.0 - std::abs(axial) / section.plastic_axial_force);
  if (std::abs(trial) <= limit) return answer;
  const double sign = trial > 0.0 ? 1.0 : -1.0;
  answer.forces(2) = sign * limit;
  answer.plastic_curvature += (trial - answer.forces(2)) / section.bending_stiffness;
  answer.tangent(2, 2) = kYieldingStiffness * section.bending_stiffness;
  // Np may be infinite: then the moment knows nothing of the axial force.
  if (limit > 0.0)
    answer.tangent(2, 0) = -sign * (axial > 0.0 ? 1.0 : -1.0) * section.plastic_moment /
                           section.plastic_axial_force * section.axial_stiffness;
  return answer;
}

}  // namespace polargrain::fem
