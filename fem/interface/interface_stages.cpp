// SPDX-License-Identifier: GPL-2.0-or-later
// Interfaces in stages of construction: faces that come, go, and are cut into the ground.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "fem/element/dofs.hpp"
#include "fem/interface/interface.hpp"
#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {
namespace {

/// Stress of an element at a place, drawn on linearly from its points. Nothing where it has no stress: a wall tells nothing of the
/// ground.
template <int dim>
std::optional<typename Cosserat<dim>::Vector> stress_at(const StageBegin<dim>& now, std::size_t element,
                                                        const typename Cosserat<dim>::Place& place) {
  using Place = typename Cosserat<dim>::Place;
  using Stress = typename Cosserat<dim>::Vector;
  const std::size_t first = now.discretisation.first_point(element);
  const std::size_t last = now.discretisation.first_point(element + 1);
  double volume = 0.0;
  Place centre = Place::Zero();
  Stress mean = Stress::Zero();
  for (std::size_t i = first; i < last; ++i) {
    const auto& point = now.discretisation.point(i);
    volume += point.volume;
    centre += point.volume * point.position;
    mean += point.volume * now.committed[i].stress;
  }
  if (mean.isZero(0.0)) return {};
  centre /= volume;
  mean /= volume;
  if (last - first <= static_cast<std::size_t>(dim)) return mean;  // too few for a slope
  Eigen::Matrix<double, dim, dim> spread = Eigen::Matrix<double, dim, dim>::Zero();
  Eigen::Matrix<double, dim, Cosserat<dim>::components> slopes =
      Eigen::Matrix<double, dim, Cosserat<dim>::components>::Zero();
  for (std::size_t i = first; i < last; ++i) {
    const auto& point = now.discretisation.point(i);
    const Place arm = point.position - centre;
    spread += point.volume * arm * arm.transpose();
    slopes += point.volume * arm * now.committed[i].stress.transpose();
  }
  return mean + slopes.transpose() * spread.inverse() * (place - centre);
}

}  // namespace

template <int dim>
void Interface<dim>::forget(Point& point) {
  point.committed = {};
  point.birth = FaceVector<dim>::Zero();
  point.jump = point.committed_jump = FaceVector<dim>::Zero();
  point.answer = {FaceVector<dim>::Zero(), Eigen::Matrix<double, dim, dim>::Zero(), Contact::sticks, {}};
  point.committed_answer = point.answer;
}

template <int dim>
bool Interface<dim>::is_there(std::size_t e, int stage, const std::vector<char>& there) const {
  return this->life.holds(stage) &&
         (there.empty() || std::ranges::all_of(elements_[e].face.neighbours, [&](int neighbour) {
            return there[static_cast<std::size_t>(neighbour)] != 0;
          }));
}

template <int dim>
std::vector<std::pair<int, int>> Interface<dim>::tied_nodes(int stage) const {
  if (!settings_.parts_ground || stage >= this->life.begin) return {};
  std::vector<std::pair<int, int>> pairs;
  for (const Element& element : elements_) {
    const InterfaceFace<dim>& face = element.face;
    for (std::size_t a = 0; a < face.nodes_a.size(); ++a) {
      const auto met = met_.find(face.nodes_b[a]);
      const bool is_taken = met != met_.end() && std::ranges::any_of(met->second, [&](const auto& wall) {
                              return wall->life.holds(stage);
                            });
      const std::vector<int>& others = is_taken ? face.nodes_across : face.nodes_b;
      if (!others.empty() && others[a] != face.nodes_a[a]) pairs.emplace_back(face.nodes_a[a], others[a]);
    }
  }
  return pairs;
}

template <int dim>
void Interface<dim>::set_stage(int stage, const std::vector<char>& there) {
  for (std::size_t e = 0; e < elements_.size(); ++e) elements_[e].active = is_there(e, stage, there);
}

template <int dim>
void Interface<dim>::begin_stage(const StageBegin<dim>& now) {
  std::vector<std::size_t> born;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    Element& element = elements_[e];
    const bool before = std::exchange(element.active, is_there(e, now.stage, now.there));
    if (before == element.active) continue;
    for (Point& point : element.points) forget(point);
    if (!element.active) continue;
    born.push_back(e);
    // It has no stress at the jump of the moment.
    const Eigen::VectorXd values = now.nodal(element.entries);
    for (Point& point : element.points) {
      point.jump = point.committed_jump = jump_at(element, point, values);
      point.committed.plastic_jump = point.birth = point.jump;
    }
  }
  if (settings_.parts_ground && this->life.begin == now.stage) carry_stress_of_ground(now, born);
}

template <int dim>
void Interface<dim>::begin_at_rest(const StageBegin<dim>& now) {
  std::vector<std::size_t> there;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_[e].active) there.push_back(e);
  carry_stress_of_points(now, there);
}

// In the plane the points lie at the nodes, so the stress vectors follow from the nodal forces that the ground on side a needs to
// stay as it is: nothing moves. In space they follow from the points of the elements beside the face, and the imbalance that is left
// is let go along the stage.
template <int dim>
void Interface<dim>::carry_stress_of_ground(const StageBegin<dim>& now,
                                            const std::vector<std::size_t>& born) {
  if constexpr (dim == 2) {
    carry_nodal_forces(now, born);
  } else {
    carry_stress_of_points(now, born);
  }
}

template <int dim>
void Interface<dim>::carry_nodal_forces(const StageBegin<dim>& now, const std::vector<std::size_t>& born) {
  using Place = typename Cosserat<dim>::Place;
  std::map<int, double> area;
  std::map<int, Place> water;  // pushes nodes: the forces of the ground are total ones
  for (const std::size_t e : born) {
    const Eigen::VectorXd values = now.nodal(elements_[e].entries);
    for (const Point& point : elements_[e].points)
      for (std::size_t a = 0; a < elements_[e].face.nodes_a.size(); ++a) {
        const int node = elements_[e].face.nodes_a[a];
        const double share = point.geometry.shape(static_cast<Eigen::Index>(a)) * point.geometry.area;
        area[node] += share;
        Place& pushed = water.try_emplace(node, Place::Zero()).first->second;
        pushed +=
            share * pressure_at(elements_[e], point, values) * point.geometry.axes.row(dim - 1).transpose();
      }
  }
  const auto stress_at = [&](int node) -> std::optional<Place> {
    if (settings_.single_nodes.contains(node)) return {};
    Place force;
    for (int i = 0; i < dim; ++i) {
      const int entry = entry_of<dim>(node, static_cast<Dof>(i));
      if (now.given[static_cast<std::size_t>(entry)] != 0) return {};
      force(i) = -now.unbalanced(entry);
    }
    return Place((force + water.at(node)) / area.at(node));
  };
  for (const std::size_t e : born) {
    Element& element = elements_[e];
    const std::vector<int>& nodes = element.face.nodes_a;
    std::vector<std::optional<Place>> stresses;
    for (const int node : nodes) stresses.push_back(stress_at(node));
    for (Point& point : element.points) {
      Place stress = Place::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const double share = point.geometry.shape(static_cast<Eigen::Index>(a));
        if (share == 0.0) continue;
        std::optional<Place> here = stresses[a];
        // A node that is held, or a toe: the nearest node of the face that tells.
        for (std::size_t other = nodes.size(); !here && other-- > 0;) here = stresses[other];
        if (here) stress += share * *here;
      }
      point.committed.initial_traction = point.geometry.axes * stress;
    }
  }
}

template <int dim>
void Interface<dim>::carry_stress_of_points(const StageBegin<dim>& now,
                                            const std::vector<std::size_t>& born) {
  using Place = typename Cosserat<dim>::Place;
  for (const std::size_t e : born) {
    Element& element = elements_[e];
    for (Point& point : element.points) {
      typename Cosserat<dim>::Vector sum = Cosserat<dim>::Vector::Zero();
      double count = 0.0;
      for (const int neighbour : element.face.neighbours) {
        const auto found = stress_at<dim>(now, static_cast<std::size_t>(neighbour), point.geometry.place);
        if (!found) continue;
        sum += *found;
        count += 1.0;
      }
      if (count == 0.0) continue;
      Place stress = Place::Zero();
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          stress(i) += sum(Cosserat<dim>::stress_place(j, i)) / count * point.geometry.axes(dim - 1, j);
      point.committed.initial_traction = point.geometry.axes * stress;
    }
  }
}

template void Interface<2>::forget(Point&);
template void Interface<3>::forget(Point&);
template bool Interface<2>::is_there(std::size_t, int, const std::vector<char>&) const;
template bool Interface<3>::is_there(std::size_t, int, const std::vector<char>&) const;
template std::vector<std::pair<int, int>> Interface<2>::tied_nodes(int) const;
template std::vector<std::pair<int, int>> Interface<3>::tied_nodes(int) const;
template void Interface<2>::set_stage(int, const std::vector<char>&);
template void Interface<3>::set_stage(int, const std::vector<char>&);
template void Interface<2>::begin_stage(const StageBegin<2>&);
template void Interface<3>::begin_stage(const StageBegin<3>&);
template void Interface<2>::begin_at_rest(const StageBegin<2>&);
template void Interface<3>::begin_at_rest(const StageBegin<3>&);

}  // namespace polargrain::fem
