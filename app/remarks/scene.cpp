// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/scene.hpp"

#include <algorithm>
#include <cmath>

#include "app/remarks/given_stress.hpp"
#include "fem/solver/later_regions.hpp"

namespace polargrain::app {

namespace {

/// With the supports and loads of a stage alone; nothing where there are no stages.
template <int dim>
std::optional<fem::Problem<dim>> problem_in_stage(const fem::Problem<dim>& problem, int stage) {
  if (problem.stages.size() < 2) return {};
  fem::Problem<dim> there = problem;
  const auto is_away = [stage](const auto& item) { return !item.life.holds(stage); };
  std::erase_if(there.prescribed, is_away);
  std::erase_if(there.boundary_loads, is_away);
  std::erase_if(there.node_loads, is_away);
  std::erase_if(there.body_loads, is_away);
  return there;
}

/// The value of `key` in the first of these items that is on `name` and has it.
const coupler::Entry* value_among(const coupler::Entry& items, const std::string& name,
                                  const std::string& key) {
  for (const coupler::Entry& item : items.items) {
    const coupler::Entry* const on = item.find("on");
    const coupler::Entry* const value = item.find(key);
    if (on == nullptr || value == nullptr) continue;
    const auto is_name = [&](const coupler::Entry& word) { return word.text == name; };
    if (is_name(*on) || std::ranges::any_of(on->items, is_name)) return value;
  }
  return nullptr;
}

}  // namespace

Scene::Scene(const coupler::Case& the_case, const coupler::Entry& document, const PackingsAtRest& packings)
    : case_(the_case),
      document_(document),
      body_(the_case.with_problem([](const auto& problem) { return body_of(problem.mesh); })) {
  in_stage_ = problem_in_stage(case_.problem, 0);
  if (case_.space) space_in_stage_ = problem_in_stage(*case_.space, 0);
  region_of_element_.resize(body_.elements.size());
  for (const auto& [name, material] : case_.regions) {
    SceneRegion region{name, material};
    region.cell = case_.materials.at(material)->grains();
    region.comes_later = with_problem([&](const auto& problem) { return fem::comes_later(problem, name); });
    if (const auto found = packings.find(material); found != packings.end()) region.packing = &found->second;
    region.elements = with_problem([&](const auto& problem) { return problem.mesh.regions.at(name); });
    for (const int element : region.elements)
      region_of_element_[static_cast<std::size_t>(element)] = regions_.size();
    regions_.push_back(std::move(region));
  }
}

Scene Scene::in_stage(int stage) const {
  Scene later = *this;
  later.stage_ = stage;
  later.in_stage_ = problem_in_stage(case_.problem, stage);
  if (case_.space) later.space_in_stage_ = problem_in_stage(*case_.space, stage);
  return later;
}

template <int dim>
const std::vector<OutlineSide<dim>>& Scene::outline() const {
  Outline<dim>& kept = std::get<Outline<dim>>(*outlines_);
  if (!kept) kept = outline_of(problem_of<dim>().mesh);
  return *kept;
}

template const std::vector<OutlineSide<2>>& Scene::outline() const;
template const std::vector<OutlineSide<3>>& Scene::outline() const;

const coupler::Entry* Scene::find(const Path& path) const {
  const coupler::Entry* entry = &document_;
  for (const std::string& key : path) {
    if (entry == nullptr) return nullptr;
    entry = entry->find(key);
  }
  return entry;
}

std::optional<double> Scene::quantity(const Path& path, coupler::Dimension dimension) const {
  const coupler::Entry* const entry = find(path);
  if (entry == nullptr || entry->kind != coupler::Entry::Kind::scalar) return {};
  return coupler::parse_quantity(entry->text, dimension);
}

const coupler::Entry& Scene::place(const Path& path) const {
  const coupler::Entry* entry = &document_;
  for (const std::string& key : path) {
    const coupler::Entry* const next = entry->find(key);
    if (next == nullptr) break;
    entry = next;
  }
  return *entry;
}

const coupler::Entry* Scene::boundary_value(const std::string& name, const std::string& key) const {
  if (const coupler::Entry* const stages = find({"steps", "stages"}))
    for (int stage = std::min(stage_ + 1, static_cast<int>(stages->items.size())); stage-- > 0;)
      if (const coupler::Entry* const items = stages->items[static_cast<std::size_t>(stage)].find("boundary"))
        if (const coupler::Entry* const value = value_among(*items, name, key)) return value;
  const coupler::Entry* const items = document_.find("boundary");
  return items != nullptr ? value_among(*items, name, key) : nullptr;
}

Scene::StressAtStart Scene::stress_at_start() const {
  if (!case_.start_from.empty()) return StressAtStart::run_before;
  const bool is_given = with_problem([](const auto& problem) { return !problem.initial_stresses.empty(); });
  return is_given ? StressAtStart::given : StressAtStart::materials;
}

bool Scene::has_cells() const {
  return std::ranges::any_of(regions_, [](const SceneRegion& region) { return region.cell != nullptr; });
}

double Scene::pressure_of(const SceneRegion& region) {
  if (region.packing != nullptr) return region.packing->pressure();
  return region.cell != nullptr ? region.cell->packing.pressure : 0.0;
}

template <int dim>
std::optional<typename Cosserat<dim>::Vector> Scene::initial_stress(
    const SceneRegion& region, const Eigen::Matrix<double, dim, 1>& position) const {
  if (region.comes_later) return {};
  if (const auto given = given_stress<dim>(*this, region.name, position)) return given;
  if (region.packing != nullptr) return stress_in<dim>(region.packing->stress);
  const double pressure =
      region.cell != nullptr
          ? region.cell->packing.pressure
          : quantity({"materials", region.material, "confining"}, coupler::Dimension::pressure).value_or(0.0);
  if (region.cell == nullptr && pressure == 0.0) return {};
  typename Cosserat<dim>::Vector stress = Cosserat<dim>::Vector::Zero();
  for (int i = 0; i < 3; ++i) stress(Cosserat<dim>::stress_place(i, i)) = -pressure;
  return stress;
}

template std::optional<Vector7> Scene::initial_stress<2>(const SceneRegion&, const Eigen::Vector2d&) const;
template std::optional<Vector18> Scene::initial_stress<3>(const SceneRegion&, const Eigen::Vector3d&) const;

std::optional<double> Scene::end_time() const {
  double end = 0.0;
  for (const coupler::StepTarget& target : case_.plan) {
    if (target.control != coupler::StepTarget::Control::time) return {};
    end = target.amount;
  }
  return end;
}

bool Scene::is_classical() const {
  return with_problem([](const auto& problem) { return problem.continuum == fem::Continuum::cauchy; });
}

double Scene::strained_side(fem::Dof movement) const {
  return fem::axis_of(movement) + 1 == dimension() ? body_.sides.back() : body_.smaller_side();
}

std::size_t Scene::points_of(const SceneRegion& region) const {
  return with_problem([&](const auto& problem) {
    std::size_t points = 0;
    for (const int element : region.elements)
      points += problem.mesh.elements[static_cast<std::size_t>(element)].type->quadrature.size();
    return points;
  });
}

double Scene::growth_of_measures() const {
  double grown = 0.0;
  for (const coupler::StepTarget& target : case_.plan)
    if (target.control == coupler::StepTarget::Control::measure) grown += std::abs(target.amount);
  return grown;
}

double Scene::reached(const fem::TimeTable& movement) const {
  if (end_time()) {
    double largest = 0.0;
    for (const coupler::StepTarget& target : case_.plan)
      largest = std::max(largest, std::abs(movement.at(target.amount)));
    return largest;
  }
  const double grown = growth_of_measures();
  return grown > 0.0 ? std::min(grown, movement.largest_magnitude()) : movement.largest_magnitude();
}

double Scene::largest_movement() const {
  double largest = growth_of_measures();
  case_.with_problem([&](const auto& of_all_stages) {
    for (const auto& item : of_all_stages.prescribed)
      if (!fem::is_rotation(item.dof)) largest = std::max(largest, reached(item.value));
  });
  return largest;
}

double Scene::strain_between(double before, double after) const {
  double largest = 0.0;
  with_problem([&](const auto& problem) {
    for (const auto& item : problem.prescribed) {
      if (fem::is_rotation(item.dof)) continue;
      const double movement =
          end_time() ? std::abs(item.value.at(after) - item.value.at(before)) : reached(item.value);
      largest = std::max(largest, movement / strained_side(item.dof));
    }
  });
  return largest;
}

double Scene::strain_of_step() const {
  if (!end_time()) return strain_between(0.0, 0.0) / static_cast<double>(std::max(1, case_.steps()));
  double largest = 0.0;
  double before = 0.0;
  for (const coupler::StepTarget& target : case_.plan) {
    largest = std::max(largest, strain_between(before, target.amount));
    before = target.amount;
  }
  return largest;
}

double Scene::strain_of_run() const {
  if (!end_time()) return strain_between(0.0, 0.0);
  double sum = 0.0;
  double before = 0.0;
  for (const coupler::StepTarget& target : case_.plan) {
    sum += strain_between(before, target.amount);
    before = target.amount;
  }
  return sum;
}

}  // namespace polargrain::app
