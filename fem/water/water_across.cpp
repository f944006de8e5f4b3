// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/water/water_across.hpp"

#include <algorithm>

#include "fem/interface/interface_face.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::fem {
namespace {

/// Integral of N_p N_p^T over a face, of its corners.
template <int dim>
Eigen::MatrixXd mass_of(const Mesh<dim>& mesh, const AcrossFace<dim>& face) {
  VectorRows<dim> positions(static_cast<Eigen::Index>(face.nodes_a.size()), dim);
  for (std::size_t a = 0; a < face.nodes_a.size(); ++a)
    positions.row(static_cast<Eigen::Index>(a)) =
        mesh.nodes[static_cast<std::size_t>(face.nodes_a[a])].transpose();
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(face.type->corners, face.type->corners);
  for (const InterfacePoint<dim>& point : interface_points<dim>(*face.type, positions))
    mass += point.area * point.corner_shape * point.corner_shape.transpose();
  return mass;
}

}  // namespace

template <int dim>
WaterAcross<dim>::WaterAcross(const Problem<dim>& problem, WaterAcrossOptions options,
                              const std::vector<AcrossFace<dim>>& faces)
    : options_(std::move(options)) {
  const std::size_t field = number_of_field(problem.fields, kPorePressure);
  const FieldPlaces<dim> places = problem.places();
  const std::vector<int>& wet = problem.fields.at(field).elements;
  for (const AcrossFace<dim>& face : faces) {
    if (!std::ranges::binary_search(wet, face.element_a) || !std::ranges::binary_search(wet, face.element_b))
      continue;
    Face& made = faces_.emplace_back();
    made.element_a = face.element_a;
    made.element_b = face.element_b;
    std::vector<std::pair<int, int>> places_of_pair;
    const auto place_of = [&](int entry) {
      const auto at = std::ranges::find(made.entries, entry);
      const auto number = static_cast<int>(at - made.entries.begin());
      if (at == made.entries.end()) made.entries.push_back(entry);
      return number;
    };
    for (int a = 0; a < face.type->corners; ++a) {
      const int one = places.entry(field, face.nodes_a[static_cast<std::size_t>(a)]);
      const int other = places.entry(field, face.nodes_b[static_cast<std::size_t>(a)]);
      made.pairs.emplace_back(one, other);
      places_of_pair.emplace_back(place_of(one), place_of(other));
    }
    if (options_.passage != Passage::leaky) continue;
    const Eigen::MatrixXd mass =
        mass_of<dim>(problem.mesh, face) / (options_.unit_weight * options_.resistance);
    const auto size = static_cast<Eigen::Index>(made.entries.size());
    made.conduction.setZero(size, size);
    for (Eigen::Index i = 0; i < mass.rows(); ++i)
      for (Eigen::Index j = 0; j < mass.cols(); ++j) {
        const auto& [one, other] = places_of_pair[static_cast<std::size_t>(i)];
        const auto& [of_one, of_other] = places_of_pair[static_cast<std::size_t>(j)];
        made.conduction(one, of_one) += mass(i, j);
        made.conduction(one, of_other) -= mass(i, j);
        made.conduction(other, of_one) -= mass(i, j);
        made.conduction(other, of_other) += mass(i, j);
      }
  }
}

template <int dim>
bool WaterAcross<dim>::is_there(std::size_t e, int stage, const std::vector<char>& there) const {
  const auto stands = [&](int element) {
    return there.empty() || there[static_cast<std::size_t>(element)] != 0;
  };
  return this->life.holds(stage) && stands(faces_[e].element_a) && stands(faces_[e].element_b);
}

template <int dim>
std::size_t WaterAcross<dim>::bare_faces(int stage, const std::vector<char>& there) const {
  if (there.empty() || !this->life.holds(stage)) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(faces_, [&](const Face& face) {
    return (there[static_cast<std::size_t>(face.element_a)] != 0) !=
           (there[static_cast<std::size_t>(face.element_b)] != 0);
  }));
}

template <int dim>
std::vector<std::pair<int, int>> WaterAcross<dim>::tied_entries(int stage) const {
  if (options_.passage != Passage::permeable && stage >= this->life.begin) return {};
  std::vector<std::pair<int, int>> pairs;
  for (const Face& face : faces_)
    for (const auto& pair : face.pairs)
      if (pair.first != pair.second) pairs.push_back(pair);
  return pairs;
}

template <int dim>
void WaterAcross<dim>::set_stage(int stage, const std::vector<char>& there) {
  for (std::size_t e = 0; e < faces_.size(); ++e) faces_[e].active = is_there(e, stage, there);
}

template <int dim>
std::string WaterAcross<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  constexpr double kRounding = 1e-6;  // NodalForces::parts: a flow is a small difference of two pressures
  duration_ = step.duration();
  if (options_.passage != Passage::leaky) return {};
  for (const Face& face : faces_) {
    if (!face.active) continue;
    const Eigen::VectorXd mean = step.start(face.entries) + options_.theta * step.increment(face.entries);
    const Eigen::VectorXd led = duration_ * (face.conduction * mean);
    forces.internal(face.entries) -= led;
    forces.parts(face.entries) +=
        led.cwiseAbs() + kRounding * duration_ * (face.conduction.cwiseAbs() * mean.cwiseAbs());
  }
  return {};
}

template <int dim>
Eigen::MatrixXd WaterAcross<dim>::tangent(std::size_t e) const {
  const auto size = static_cast<Eigen::Index>(faces_[e].entries.size());
  if (faces_[e].conduction.size() == 0) return Eigen::MatrixXd::Zero(size, size);
  return -options_.theta * duration_ * faces_[e].conduction;
}

template <int dim>
void add_water_across(Problem<dim>& problem, std::shared_ptr<WaterAcross<dim>> across) {
  const auto water = std::ranges::find_if(problem.contributions, [](const auto& one) {
    return dynamic_cast<const PoreWater<dim>*>(one.get()) != nullptr;
  });
  problem.contributions.insert(water, std::move(across));
}

template class WaterAcross<2>;
template class WaterAcross<3>;
template void add_water_across<2>(Problem<2>&, std::shared_ptr<WaterAcross<2>>);
template void add_water_across<3>(Problem<3>&, std::shared_ptr<WaterAcross<3>>);

}  // namespace polargrain::fem
