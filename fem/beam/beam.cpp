// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/beam/beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.hpp"
#include "fem/element/dofs.hpp"
#include "fem/element/quadrature.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {
namespace {

Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction(1), direction(0)};
}

}  // namespace

Beam::Beam(const Mesh<2>& mesh, std::string name, const BeamSection& section,
           std::vector<BeamElement> elements)
    : name_(std::move(name)), section_(section) {
  for (BeamElement& element : elements) {
    Part& part = parts_.emplace_back();
    const auto nodes = static_cast<Eigen::Index>(element.nodes.size());
    VectorRows<2> positions(nodes, 2);
    for (Eigen::Index a = 0; a < nodes; ++a) {
      const int node = element.nodes[static_cast<std::size_t>(a)];
      positions.row(a) = mesh.nodes[static_cast<std::size_t>(node)].transpose();
      for (const Dof dof : {Dof::u1, Dof::u2}) part.entries.push_back(entry_of<2>(node, dof));
    }
    part.entries.insert(part.entries.end(), element.rotations.begin(), element.rotations.end());
    const auto along_at = [&](double xi) {
      const ShapeFunctions<1> shape = element.type->shape_functions(Eigen::Matrix<double, 1, 1>(xi));
      return Eigen::Vector2d(positions.transpose() * shape.derivative);
    };
    for (const LinePoint& at : gauss_line(element.type->nodes - 1)) {
      const ShapeFunctions<1> shape = element.type->shape_functions(Eigen::Matrix<double, 1, 1>(at.position));
      const Eigen::Vector2d along = along_at(at.position);
      const double stretch = along.norm();
      const Eigen::Vector2d tangent = along / stretch;
      const Eigen::Vector2d normal = left_of(tangent);
      Point& point = part.points.emplace_back();
      point.length = stretch * at.weight;
      part.length += point.length;
      point.strain_of.setZero(3, 3 * nodes);
      for (Eigen::Index a = 0; a < nodes; ++a) {
        const double slope = shape.derivative(a, 0) / stretch;
        point.strain_of.block<1, 2>(0, 2 * a) = slope * tangent.transpose();
        point.strain_of.block<1, 2>(1, 2 * a) = slope * normal.transpose();
        point.strain_of(1, 2 * nodes + a) = -shape.value(a);
        point.strain_of(2, 2 * nodes + a) = slope;
      }
    }
    for (const std::size_t end : {0, 1}) {
      part.tangents[end] = along_at(end == 0 ? -1.0 : 1.0).normalized();
      part.places[end] = positions.row(static_cast<Eigen::Index>(end)).transpose();
    }
    part.forces = part.committed_forces = Eigen::VectorXd::Zero(3 * nodes);
    part.element = std::move(element);
  }
}

void Beam::allocate() {
  for (Part& part : parts_) {
    for (Point& point : part.points) point.plastic_curvature = 0.0;
    part.forces.setZero();
    part.committed_forces.setZero();
    part.born.resize(0);
  }
}

void Beam::begin_stage(const StageBegin<2>& now) {
  const bool before = std::exchange(active_, this->life.holds(now.stage));
  if (before == active_) return;
  allocate();
  if (!active_) return;
  for (Part& part : parts_) part.born = now.nodal(part.entries);
}

std::string Beam::evaluate(const NodalStep& step, NodalForces& forces) {
  constexpr double kRounding = 1e-6;  // NodalForces::parts: strains are small differences of displacements
  if (!active_) return {};
  for (Part& part : parts_) {
    Eigen::VectorXd values = step.end(part.entries);
    Eigen::VectorXd sizes = step.start(part.entries).cwiseAbs() + step.increment(part.entries).cwiseAbs();
    if (part.born.size() > 0) {
      values -= part.born;
      sizes += part.born.cwiseAbs();
    }
    part.forces.setZero();
    Eigen::VectorXd larger = Eigen::VectorXd::Zero(sizes.size());
    for (Point& point : part.points) {
      point.answer = respond(section_, point.plastic_curvature, point.strain_of * values);
      part.forces += point.length * (point.strain_of.transpose() * point.answer.forces);
      const Eigen::MatrixXd strains = point.strain_of.cwiseAbs();
      larger += point.length * (strains.transpose() * (point.answer.tangent.cwiseAbs() * (strains * sizes)));
    }
    forces.internal(part.entries) += part.forces;
    forces.parts(part.entries) += part.forces.cwiseAbs().cwiseMax(kRounding * larger);
  }
  return {};
}

Eigen::MatrixXd Beam::tangent(std::size_t e) const {
  const Part& part = parts_[e];
  const auto size = static_cast<Eigen::Index>(part.entries.size());
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  for (const Point& point : part.points)
    tangent += point.length * (point.strain_of.transpose() * point.answer.tangent * point.strain_of);
  return tangent;
}

void Beam::commit() {
  if (!active_) return;
  for (Part& part : parts_) {
    for (Point& point : part.points) point.plastic_curvature = point.answer.plastic_curvature;
    part.committed_forces = part.forces;
  }
  note_largest_moment();
}

void Beam::note_largest_moment() {
  constexpr double kAbovePlastic = 1.05;
  constexpr double kMore = 1.1;  // times the one that was told
  double largest = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  for (const Part& part : parts_) {
    const auto nodes = static_cast<Eigen::Index>(part.element.nodes.size());
    for (const std::size_t end : {0, 1}) {
      const double moment = std::abs(part.forces(2 * nodes + static_cast<Eigen::Index>(end)));
      if (moment <= largest) continue;
      largest = moment;
      place = part.places[end];
    }
  }
  const double ratio = largest / section_.plastic_moment;
  if (!(ratio > std::max(kAbovePlastic, kMore * told_ratio_))) return;
  told_ratio_ = ratio;
  notes_.push_back(fmt::format(
      "{}: its moment at {} is {:.3g} times Mp: hinges form within its elements, so that it resists by as much "
      "more and collapses too late; divide it more finely there",
      name(), place_text<2>(place), ratio));
}

std::vector<std::string> Beam::take_notes() {
  return std::exchange(notes_, {});
}

void Beam::revert() {
  for (Part& part : parts_) part.forces = part.committed_forces;
}

void Beam::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  for (const Part& part : parts_) {
    for (const Point& point : part.points) values.push_back(point.plastic_curvature);
    values.insert(values.end(), part.committed_forces.begin(), part.committed_forces.end());
  }
  archive.write("beam", std::span<const double>(values));
  std::vector<double> born;
  for (const Part& part : parts_) born.insert(born.end(), part.born.begin(), part.born.end());
  archive.write("born", std::span<const double>(born));
}

void Beam::restore(ArchiveReader& archive) {
  const std::vector<double> values = archive.doubles("beam");
  std::size_t length = 0;
  for (const Part& part : parts_) length += part.points.size() + part.entries.size();
  if (values.size() != length) throw RunError(fmt::format("{}: the checkpoint is of another beam", name()));
  auto value = values.begin();
  for (Part& part : parts_) {
    for (Point& point : part.points) point.plastic_curvature = *value++;
    for (double& force : part.committed_forces) force = *value++;
  }
  const std::vector<double> born = archive.doubles("born");
  std::size_t entries = 0;
  for (const Part& part : parts_) entries += part.entries.size();
  if (!born.empty() && born.size() != entries)
    throw RunError(fmt::format("{}: the checkpoint is of another beam", name()));
  auto at = born.begin();
  for (Part& part : parts_) {
    part.born.resize(born.empty() ? 0 : static_cast<Eigen::Index>(part.entries.size()));
    for (double& x : part.born) x = *at++;
  }
  revert();
}

std::vector<std::pair<int, int>> Beam::joined_nodes() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Part& part : parts_)
    for (std::size_t a = 1; a < part.element.nodes.size(); ++a)
      pairs.emplace_back(part.element.nodes.front(), part.element.nodes[a]);
  return pairs;
}

std::vector<std::string> Beam::faults(const Problem<2>& problem) const {
  if (problem.deformation == Deformation::large)
    return {"beams are of small deformation; set 'deformation: small'"};
  return {};
}

// The share of an element's load at the node of its end is carried past the element, so nodal forces alone miss it in N and V.
Eigen::VectorXd Beam::carried_by(const Part& part, const Problem<2>& problem) {
  const auto nodes = static_cast<Eigen::Index>(part.element.nodes.size());
  Eigen::VectorXd internal = Eigen::VectorXd::Zero(2 * nodes);
  bool is_known = false;
  for (const auto& contribution : problem.contributions)
    is_known = contribution->add_forces_on_face(part.element.nodes, internal) || is_known;
  if (is_known) return -internal;
  // Nodes that the ground shares: of its forces the middle node tells, as of a uniform load.
  if (nodes == 3)
    for (const Eigen::Index end : {0, 1})
      internal.segment<2>(2 * end) = 0.25 * part.committed_forces.segment<2>(4);
  return internal;
}

std::vector<BeamResult> Beam::results(const Problem<2>& problem) const {
  std::vector<BeamResult> all;
  if (!active_) return all;
  double along = 0.0;
  for (const Part& part : parts_) {
    const auto nodes = static_cast<Eigen::Index>(part.element.nodes.size());
    const Eigen::VectorXd carried = carried_by(part, problem);
    for (const std::size_t end : {0, 1}) {
      // The nodal forces of the first end act on the element from outside, against its own forces there.
      const double sign = end == 0 ? -1.0 : 1.0;
      const auto node = static_cast<Eigen::Index>(end);
      const Eigen::Vector2d force =
          sign * (part.committed_forces.segment<2>(2 * node) - carried.segment<2>(2 * node));
      all.push_back({part.places[end], along + (end == 0 ? 0.0 : part.length),
                     sign * part.committed_forces(2 * nodes + node), force.dot(part.tangents[end]),
                     force.dot(left_of(part.tangents[end]))});
    }
    along += part.length;
  }
  return all;
}

bool Beam::yields() const {
  for (const Part& part : parts_)
    for (const Point& point : part.points)
      if (point.plastic_curvature != 0.0) return true;
  return false;
}

}  // namespace polargrain::fem
