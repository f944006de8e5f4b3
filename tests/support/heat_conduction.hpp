// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <memory>

#include "fem/element/corner_shape.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

/// A further field at nodes: heat that a bar loses.
namespace polargrain::testing::heat {

using namespace polargrain::fem;

inline constexpr double kCapacity = 2.0e6;                                             // J/(m^3 K)
inline constexpr double kConductivity = 3.0;                                           // W/(m K)
inline constexpr double kLength = 2.0;                                                 // m
inline const double kDecay = kConductivity / kCapacity * std::pow(M_PI / kLength, 2);  // 1/s

/// Transient conduction of heat with temperatures at corner nodes: -(C dT + dt K T_theta) = 0.
template <int dim>
class HeatConduction final : public Contribution<dim> {
 public:
  HeatConduction(const Problem<dim>& problem, double theta, double longest_step = HUGE_VAL)
      : theta_(theta), longest_step_(longest_step) {
    const FieldPlaces<dim> places = problem.places();
    for (std::size_t e = 0; e < problem.mesh.elements.size(); ++e) {
      const Element<dim>& element = problem.mesh.elements[e];
      const VectorRows<dim> nodes = problem.mesh.element_positions(static_cast<int>(e));
      const auto points = point_geometries<dim>(*element.type, nodes);
      const auto shapes = corner_shapes_in_place<dim>(*element.type, nodes);
      Matrices m{{}, Eigen::MatrixXd::Zero(element.type->corners, element.type->corners), {}};
      m.conduction = m.capacity;
      for (int a = 0; a < element.type->corners; ++a)
        m.entries.push_back(places.entry(0, element.nodes[static_cast<std::size_t>(a)]));
      for (std::size_t i = 0; i < points.size(); ++i) {
        m.capacity += kCapacity * points[i].volume * shapes[i].value * shapes[i].value.transpose();
        m.conduction +=
            kConductivity * points[i].volume * shapes[i].derivative * shapes[i].derivative.transpose();
      }
      elements_.push_back(std::move(m));
    }
  }

  [[nodiscard]] std::string name() const override { return "heat"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return elements_[e].entries; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override {
    duration_ = step.duration();
    if (duration_ > longest_step_) return "the step is too long";
    for (const Matrices& m : elements_) {
      const Eigen::VectorXd change = step.increment(m.entries);
      const Eigen::VectorXd stored = m.capacity * change;
      const Eigen::VectorXd led = duration_ * m.conduction * (step.start(m.entries) + theta_ * change);
      forces.internal(m.entries) -= stored + led;
      forces.parts(m.entries) += stored.cwiseAbs() + led.cwiseAbs();
    }
    return {};
  }
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override {
    return -(elements_[e].capacity + theta_ * duration_ * elements_[e].conduction);
  }
  void allocate() override {}
  void commit() override {}
  void revert() override {}
  void save(ArchiveWriter&) const override {}
  void restore(ArchiveReader&) override {}
  [[nodiscard]] bool depends_on_duration() const override { return true; }

 private:
  struct Matrices {
    std::vector<int> entries;
    Eigen::MatrixXd capacity;
    Eigen::MatrixXd conduction;
  };
  double theta_;
  double longest_step_;
  double duration_ = 0.0;
  std::vector<Matrices> elements_;
};

template <int dim>
Mesh<dim> bar(int elements, const char* type) {
  if constexpr (dim == 2) {
    return rectangle({{kLength, 0.5}, {elements, std::max(1, elements / 4)}}, type);
  } else {
    return box({{kLength, 0.5, 0.5}, {elements, 1, 1}}, type);
  }
}

/// A bar under pressure, cold at both ends, whose temperature at time 0 is a half wave of a sine.
template <int dim>
Problem<dim> cooling_bar(int elements, const char* type, double theta, double longest_step = HUGE_VAL) {
  Problem<dim> problem;
  problem.mesh = bar<dim>(elements, type);
  const ElasticParameters<dim> parameters{1e7, 0.25, 2e6, 0.1};
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<dim>>>(ElasticLaw<dim>(parameters));
  for (const Dof dof : node_dofs<dim>())
    problem.prescribed.push_back({"left", dof, TimeTable::constant(0.0), {}});
  problem.boundary_loads.push_back({"right", TimeTable::ramp(1e4, 1.0)});
  NodalField temperature{"T", "K", {}};
  std::vector<char> is_corner(problem.mesh.nodes.size(), 0);
  for (const Element<dim>& element : problem.mesh.elements)
    for (int a = 0; a < element.type->corners; ++a)
      is_corner[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(a)])] = 1;
  for (std::size_t node = 0; node < is_corner.size(); ++node) {
    if (is_corner[node] == 0) continue;
    temperature.nodes.push_back(static_cast<int>(node));
    temperature.initial.push_back(std::sin(M_PI * problem.mesh.nodes[node](0) / kLength));
  }
  problem.fields = {temperature};
  problem.prescribed_fields = {{"T", "left", TimeTable::constant(0.0)},
                               {"T", "right", TimeTable::constant(0.0)}};
  problem.contributions = {std::make_shared<HeatConduction<dim>>(problem, theta, longest_step)};
  return problem;
}

/// Largest error of a temperature when the wave has fallen to 1/e.
template <int dim>
double error_at_end(int elements, const char* type, double theta, int steps) {
  Solver<dim> solver(cooling_bar<dim>(elements, type, theta), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= steps; ++step) {
    const StepReport report = solver.advance(step / (steps * kDecay));
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_LT(report.field_residuals.at(0), 1e-10);
  }
  const Problem<dim>& problem = solver.problem();
  double error = 0.0;
  for (const int node : problem.fields[0].nodes) {
    const double exact =
        std::exp(-1.0) * std::sin(M_PI * problem.mesh.nodes[static_cast<std::size_t>(node)](0) / kLength);
    error = std::max(error, std::abs(solver.state().displacement(problem.places().entry(0, node)) - exact));
  }
  return error;
}

}  // namespace polargrain::testing::heat
