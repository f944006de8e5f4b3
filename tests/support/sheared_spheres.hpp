// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/increment_slip.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/space_tangents.hpp"

namespace polargrain::test {

/// The network of a cell of spheres where it takes its tangent: at the end of the loading of an increment.
struct LoadedNetwork {
  std::vector<dem::Contact> contacts;
  std::vector<dem::SpaceSlip> slips;
  std::vector<double> weights;  ///< of the grains in the mean rotation
  int grains = 0;
  double volume = 0.0;   ///< m^3
  double strain = 0.0;   ///< of the way, largest component
  double sliding = 0.0;  ///< share of the contacts

  [[nodiscard]] dem::SpaceNetwork network(double hold = 1e-4) const {
    return {contacts, grains, Eigen::Matrix3d::Identity(), volume, hold, slips};
  }
};

/// Along increments of one symmetric gradient, whose principal axes are those of the laboratory, so that the frame of the box
/// does not turn. A second cell that goes on from each state and does not wait for rest shows the contacts as they are
/// when the loading ends.
/// @param keep every so many increments
inline std::vector<LoadedNetwork> loaded_networks(CellDefinition definition, const Eigen::Matrix3d& gradient,
                                                  int increments, int keep) {
  definition.control.tangent = CellTangent::none;
  const auto walker = dem::make_cell_service(definition);
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio =
      std::numeric_limits<double>::max();
  const auto watcher = dem::make_cell_service(definition);
  const auto places_of = [](const GrainView& view) {
    std::vector<double> all;
    for (const GrainView::Grain& grain : view.grains)
      all.insert(all.end(), grain.position.data(), grain.position.data() + 3);
    return all;
  };
  const auto rotations_of = [](const GrainView& view) {
    std::vector<double> all;
    for (const GrainView::Grain& grain : view.grains)
      all.insert(all.end(), grain.rotation.data(), grain.rotation.data() + 3);
    return all;
  };
  std::vector<LoadedNetwork> kept;
  CellRequest request{walker->initial().state, {}};
  request.increment.displacement_gradient = gradient;
  for (int k = 1; k <= increments; ++k) {
    const GrainView before = walker->view();
    const std::vector<dem::Contact> contacts_before(walker->contacts().begin(), walker->contacts().end());
    if (k % keep == 0) {
      watcher->evaluate(request);
      const GrainView after = watcher->view();
      LoadedNetwork made;
      made.contacts.assign(watcher->contacts().begin(), watcher->contacts().end());
      made.grains = static_cast<int>(after.grains.size());
      made.volume = after.box.determinant();
      made.strain = k * gradient.cwiseAbs().maxCoeff();
      made.sliding = static_cast<double>(std::ranges::count_if(made.contacts, &dem::Contact::sliding)) /
                     static_cast<double>(made.contacts.size());
      dem::IncrementSlip slip;
      slip.start(contacts_before, places_of(before).data(), rotations_of(before),
                 {before.box, Eigen::Matrix3d::Identity()}, made.grains);
      made.slips = slip.until(made.contacts, rotations_of(after), {after.box, Eigen::Matrix3d::Identity()},
                              Eigen::Matrix3d::Zero());
      made.weights = dem::rotation_weights(made.contacts, made.grains);
      kept.push_back(std::move(made));
    }
    request.state = walker->evaluate(request).state;
  }
  return kept;
}

}  // namespace polargrain::test
