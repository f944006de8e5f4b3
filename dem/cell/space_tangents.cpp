// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/space_tangents.hpp"

#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

Matrix18 voigt_cosserat_space_tangent(const SpaceNetwork& network) {
  Matrix18 sum = Matrix18::Zero();
  for (const Contact& contact : network.contacts) {
    const LinearSpaceContact law(contact, network.frame);
    sum.noalias() += law.affine.transpose() * (law.stiffness * law.affine);
  }
  return sum / network.volume;
}

Matrix18 voigt_space_tangent(const SpaceNetwork& network) {
  return classical_tangent<3>(voigt_cosserat_space_tangent(network) * classical_strains<3>());
}

template <int Strains>
std::optional<Eigen::Matrix<double, 18, Strains>> CondensedSpaceTangent::stresses(
    const SpaceNetwork& network, std::span<const double> weights,
    const Eigen::Matrix<double, 18, Strains>& strains) {
  const auto law_of = [&network](std::size_t c, double arm) {
    const Contact& contact = network.contacts[c];
    const SpaceContactStiffness law(contact, network.frame,
                                    network.slips.empty() ? SpaceSlip{} : network.slips[c]);
    return SpaceContactParts(contact, law, arm);
  };
  if (digits_ == EliminationDigits::single_where_balanced) {
    if (auto found = quick_.stresses<Strains>(network, weights, strains, law_of)) return found;
    ++repeated_;
  }
  return network_.stresses<Strains>(network, weights, strains, law_of);
}

std::optional<Matrix18> CondensedSpaceTangent::classical(const SpaceNetwork& network) {
  if (network.contacts.empty()) return Matrix18::Zero();
  const auto relaxed = stresses<6>(network, {}, classical_strains<3>());
  if (!relaxed) return std::nullopt;
  return classical_tangent<3>(*relaxed);
}

std::optional<Matrix18> CondensedSpaceTangent::cosserat(const SpaceNetwork& network,
                                                        std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix18::Zero();
  return stresses<18>(network, weights, Matrix18::Identity());
}

}  // namespace polargrain::dem
