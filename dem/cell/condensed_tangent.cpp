// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/condensed_tangent.hpp"

#include "dem/cell/plain_tangents.hpp"
#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

template <int Strains>
std::optional<Eigen::Matrix<double, 7, Strains>> CondensedTangent::stresses(
    const ContactNetwork& network, std::span<const double> weights,
    const Eigen::Matrix<double, 7, Strains>& strains) {
  return network_.stresses<Strains>(network, weights, strains, [&network](std::size_t c, double arm) {
    return WholeContact<LinearContact, 1>(LinearContact(network.contacts[c], network.frame, network.strain),
                                          arm);
  });
}

std::optional<Matrix7> CondensedTangent::classical(const ContactNetwork& network) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto relaxed = stresses<3>(network, {}, classical_strains<2>());
  if (relaxed) return classical_tangent<2>(*relaxed);
  ++fallbacks_;
  return plain_classical_tangent(network);
}

std::optional<Matrix7> CondensedTangent::cosserat(const ContactNetwork& network,
                                                  std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto relaxed = stresses<6>(network, weights, cosserat_strains());
  if (relaxed) return cosserat_tangent(*relaxed);
  ++fallbacks_;
  return plain_cosserat_tangent(network, weights);
}

}  // namespace polargrain::dem
