// SPDX-License-Identifier: GPL-2.0-or-later
// Water in the pores: its numbers, where it may leave, and steps against the time of consolidation.
#include "fem/water/pore_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "app/remarks/kinds.hpp"
#include "app/remarks/weights.hpp"
#include "fem/solver/loads.hpp"
#include "fem/solver/tables_of.hpp"
#include "fem/water/free_water.hpp"
#include "fem/water/water_across.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;

/// Ground: clay to gravel.
constexpr double kLeastPermeability = 1e-13;  // m/s
constexpr double kMostPermeability = 0.1;
constexpr double kLightestSaturated = 14e3;  // N/m^3, of clay; peat has less

/// A number beyond the bounds of water or ground.
void look_at_number(const Scene& scene, const Scene::Path& path, Dimension dimension, double least,
                    double most, const std::string& usual, Remarks& remarks) {
  const auto value = scene.quantity(path, dimension);
  if (!value || (*value >= least && *value <= most)) return;
  remarks.push_back({Rank::wrong, *value < least ? least / *value : *value / most,
                     scene.place(path).fault(fmt::format("water: {} is {:.3g} {} ({})", path.back(), *value,
                                                         coupler::si_unit(dimension), usual)),
                     "check the number and its unit"});
}

void look_at_numbers(const Scene& scene, Remarks& remarks) {
  look_at_number(scene, {"water", "unit_weight"}, Dimension::unit_weight, 9.5e3, 11e3,
                 "water: 9.81 kN/m3, of the sea 10.1 kN/m3", remarks);
  std::vector<Scene::Path> places{{"water"}};
  if (const coupler::Entry* const regions = scene.find({"water", "regions"}))
    for (const coupler::Entry::Member& member : regions->members)
      places.push_back({"water", "regions", member.key});
  for (Scene::Path path : places) {
    path.emplace_back("permeability");
    look_at_number(scene, path, Dimension::flow, kLeastPermeability, kMostPermeability,
                   "clay: 1e-11 to 1e-8 m/s, sand: 1e-6 to 1e-3 m/s, gravel: to 0.1 m/s", remarks);
    path.back() = "void_ratio";
    look_at_number(scene, path, Dimension::number, 0.15, 4.0, "sand: 0.4 to 1, clay: to 3", remarks);
  }
}

/// Oedometric modulus of a law in closed form, Pa.
std::optional<double> stiffness_of(const Scene& scene, const std::string& region) {
  const std::string& material = scene.the_case().regions.at(region);
  const auto young = scene.quantity({"materials", material, "E"}, Dimension::pressure);
  const auto poisson = scene.quantity({"materials", material, "nu"}, Dimension::number);
  if (!young || !poisson || scene.the_case().materials.at(material)->grains() != nullptr) return {};
  return *young * (1.0 - *poisson) / ((1.0 + *poisson) * (1.0 - 2.0 * *poisson));
}

/// Terzaghi's mean pressure behind a load that has just come, over that load: the excess of one implicit step over the
/// series. @param time_factor duration of the step over H^2/cv
double excess_of_step(double time_factor) {
  constexpr int kTerms = 200;
  double exact = 0.0;
  for (int m = 0; m < kTerms; ++m) {
    const double root = (m + 0.5) * std::numbers::pi;
    exact += 2.0 / (root * root) * std::exp(-root * root * time_factor);
  }
  const double depth = std::sqrt(time_factor);
  return 1.0 - depth * std::tanh(1.0 / depth) - exact;
}

template <int dim>
class Look {
 public:
  Look(const Scene& scene, const fem::Problem<dim>& problem, const fem::PoreWater<dim>& water,
       Remarks& remarks)
      : scene_(scene), problem_(problem), water_(water), remarks_(remarks) {}

  void at_drains() {
    if (!drained_places().empty() || !flows()) return;
    const bool fed = !water_.options().fluxes.empty();
    add(fed ? Rank::wrong : Rank::doubtful, 10.0, {"boundary"},
        fmt::format("boundary: all boundaries are closed to water{}",
                    fed ? ", and a flux brings some in: its pressure rises for ever"
                        : ": excess pressures stay in the body"),
        "give a boundary 'drained: true' or 'pore_pressure', or the water 'undrained: true'");
  }

  /// Conditions of water at ground without any flow: they change nothing in the run.
  void at_undrained() {
    std::set<int> dry;  // elements in which no water flows
    for (const auto& [name, region] : water_.regions())
      if (region.undrained)
        dry.insert(problem_.mesh.regions.at(name).begin(), problem_.mesh.regions.at(name).end());
    if (dry.empty()) return;
    std::vector<const coupler::Entry*> lists{scene_.find({"boundary"})};
    if (const coupler::Entry* const stages = scene_.find({"steps", "stages"}))
      for (const coupler::Entry& stage : stages->items) lists.push_back(stage.find("boundary"));
    for (const coupler::Entry* const list : lists)
      if (list != nullptr)
        for (const coupler::Entry& item : list->items)
          for (const char* const key : {"drained", "pore_pressure", "water_level", "flux"})
            if (const coupler::Entry* const value = item.find(key); value != nullptr)
              look_at_undrained(item, key, *value, dry);
  }

  /// Bounds of the steps of a flow, while no water flows.
  void at_bounds_of_flow() {
    if (flows()) return;
    for (const char* const key : {"pressure_change", "shortest_step"})
      if (scene_.find({"water", key}) != nullptr)
        return add(
            Rank::doubtful, 1.0, {"water", key},
            fmt::format("water: '{}' does nothing: all ground is undrained, and no time passes for the water",
                        key),
            "leave it out; or give 'permeability' in the place of 'undrained: true'");
  }

  /// A flux into nodes whose pressure is given goes straight out again there.
  void at_fluxes() {
    std::set<int> given;
    for (const auto& item : problem_.prescribed_fields)
      if (item.field == fem::kPorePressure)
        for (const int node : problem_.mesh.nodes_on(item.on)) given.insert(node);
    for (const auto& flux : water_.options().fluxes) {
      const std::vector<int> nodes = problem_.mesh.nodes_on(flux.on);
      if (nodes.empty() || !std::ranges::all_of(nodes, [&](int node) { return given.contains(node); }))
        continue;
      add(Rank::wrong, 1.0, {"boundary"},
          fmt::format(
              "boundary: the flux into '{}' changes nothing: all of its {} nodes have a given pressure, and it leaves "
              "there at once",
              flux.on, nodes.size()),
          "give that boundary either 'flux' or a pressure ('drained', 'pore_pressure', 'water_level')");
    }
  }

  /// Water passes a wall from ground to ground alone.
  void at_bare_walls() {
    const int stages = std::max(1, static_cast<int>(problem_.stages.size()));
    for (const auto& contribution : problem_.contributions) {
      const auto* const across = dynamic_cast<const fem::WaterAcross<dim>*>(contribution.get());
      if (across == nullptr || across->options().passage == fem::Passage::impervious) continue;
      if (across->options().passage == fem::Passage::leaky && !flows())
        add(Rank::doubtful, 1.0, {"interfaces", across->options().name},
            fmt::format(
                "interface '{}': it leaks with a resistance of {:.3g} s, and all ground is undrained: no water comes to it",
                across->options().name, across->options().resistance),
            "leave out 'undrained: true' and give 'permeability', or leave out 'water: leaky'");
      for (int stage = 0; stage < stages; ++stage) {
        const std::size_t bare = across->bare_faces(stage, fem::elements_in_stage(problem_, stage));
        if (bare == 0) continue;
        const std::string& name = across->options().name;
        add(Rank::doubtful, 1.0, {"interfaces", name},
            fmt::format(
                "interface '{}': water passes it, and {} of its faces have ground on one side alone{}: there it is closed",
                name, bare,
                problem_.stages.empty()
                    ? std::string()
                    : fmt::format(" in stage '{}'", problem_.stages[static_cast<std::size_t>(stage)])),
            "say 'water: impervious' for a wall that lets no water through; else keep the ground, or leave out the interface and give "
            "the side that is bare its 'pore_pressure' or 'drained: true'");
        break;
      }
    }
  }

  void at_weight() {
    const bool heavy = !problem_.body_loads.empty();
    if (heavy && !water_.options().table) {
      if (!std::ranges::any_of(water_.regions(), [&](const auto& region) {
            return full_weight(problem_, region.first) >= kLightestSaturated;
          }))
        return;
      add(Rank::doubtful, 2.0, {"body"},
          "body: without 'level' below 'water' pressures are those in excess of water at rest: the weight must "
          "be the submerged one",
          "give the height of the water, 'level', and the saturated weight; or the submerged weight, some 10 kN/m3");
    } else if (!heavy && water_.options().table) {
      add(Rank::doubtful, 2.0, {"water", "level"},
          "water: 'level' gives the water its weight, and the ground has no weight",
          "give the saturated weight below 'body', or leave out 'level'");
    } else if (heavy) {
      at_submerged_weight();
    }
  }

  /// Below its level the water has its weight of its own accord: a submerged weight counts the lift twice.
  void at_submerged_weight() {
    for (const auto& [name, region] : water_.regions()) {
      const double weight = full_weight(problem_, name);
      const std::vector<int>& elements = problem_.mesh.regions.at(name);
      const bool is_wet = std::ranges::any_of(elements, [&](int e) {
        const auto& nodes = problem_.mesh.elements[static_cast<std::size_t>(e)].nodes;
        return std::ranges::any_of(nodes, [&](int node) {
          return problem_.mesh.nodes[static_cast<std::size_t>(node)](dim - 1) < *water_.options().table;
        });
      });
      if (!is_wet || weight <= 0.0 || weight >= kLightestSaturated) continue;
      add(Rank::doubtful, kLightestSaturated / weight, {"body"},
          fmt::format(
              "body: region '{}' weighs {:.4g} kN/m3 below the 'level' of the water, whose weight is in it: "
              "saturated ground has 15 to 22 kN/m3",
              name, 1e-3 * weight),
          fmt::format(
              "give the saturated weight, {:.4g} kN/m3 if this one is submerged, to 'body' and 'initial_stress'; or "
              "leave out 'level'",
              1e-3 * (weight + water_.options().unit_weight)));
      return;
    }
  }

  /// Free surfaces with a pressure inside and nothing outside.
  void at_loads() {
    std::set<std::string> loaded;
    for (const auto& load : problem_.boundary_loads) loaded.insert(load.on);
    for (const auto& support : problem_.prescribed) loaded.insert(support.on);
    for (const auto& contribution : problem_.contributions)
      if (const auto* const free = dynamic_cast<const fem::FreeWater<dim>*>(contribution.get()))
        loaded.insert(free->on());
    for (const auto& given : problem_.prescribed_fields) {
      if (given.field != fem::kPorePressure || !problem_.mesh.boundaries.contains(given.on) ||
          loaded.contains(given.on))
        continue;
      double largest = 0.0;
      for (const int node : problem_.mesh.nodes_on(given.on)) {
        const auto& x = problem_.mesh.nodes[static_cast<std::size_t>(node)];
        largest =
            std::max(largest, given.factor_at(x) * given.value.at(end_of_first_step()) + given.offset_at(x));
      }
      if (water_.options().table && largest > 0.01 * water_.options().unit_weight)
        add(Rank::doubtful, largest / water_.options().unit_weight, {"boundary"},
            fmt::format(
                "boundary: the water at '{}' has a pressure of up to {:.3g} kPa, and no load acts there",
                given.on, 1e-3 * largest),
            "water outside presses on the ground: 'free_water' instead of 'water_level', or 'pressure' too");
    }
  }

  void at_steps() {
    const auto& plan = scene_.the_case().plan;
    if (plan.empty()) return;
    const bool jumps = jumps_at_start();
    if (!jumps && !comes_in_first_step()) return;
    const fem::PoreWaterOptions& options = water_.options();
    const double first = options.pressure_change > 0.0 ? std::min(options.shortest_step, end_of_first_step())
                                                       : end_of_first_step();
    double least = 0.0;         // h^2 / (6 cv) beside drained sides, s
    double largest_h = 0.0;     // that it belongs to, m
    double slowest = HUGE_VAL;  // cv, m^2/s
    std::string where;
    for (const std::string& place : drained_places()) {
      const auto boundary = problem_.mesh.boundaries.find(place);
      if (boundary == problem_.mesh.boundaries.end()) continue;
      for (const fem::BoundarySide& side : boundary->second) {
        const auto diffusivity = diffusivity_of(side.element);
        if (!diffusivity) continue;
        const double height = height_over(side);
        slowest = std::min(slowest, *diffusivity);
        if (height * height / (6.0 * *diffusivity) <= least) continue;
        least = height * height / (6.0 * *diffusivity);
        largest_h = height;
        where = place;
      }
    }
    if (where.empty()) return;
    if (first >= 0.99 * least) return at_long_step(first, least, slowest);
    if (!jumps) return;
    add(Rank::doubtful, least / first, {"steps"},
        fmt::format(
            "steps: the first one takes {:.3g} s, less than h^2/(6 cv) = {:.3g} s of the elements of {:.3g} m "
            "at '{}': behind the sudden load the pressure overshoots there, by up to a quarter of it",
            first, least, largest_h, where),
        fmt::format(
            "begin with a step of {:.2g} s ('first', 'shortest_step'), or make these elements {:.2g} m high",
            least, largest_h * std::sqrt(first / least)));
  }

 private:
  void add(Rank rank, double weight, const Scene::Path& path, const std::string& finding,
           const std::string& remedy) {
    remarks_.push_back({rank, std::max(1.0, weight), scene_.place(path).fault(finding), remedy});
  }
  /// Of equal steps there are too few: a load that comes in the first one drains within it.
  void at_long_step(double first, double shortest, double diffusivity) {
    constexpr double kMostExcess = 0.04;
    const double way = way_to_drains();
    const double whole = way * way / diffusivity;
    const double excess = whole > 0.0 ? excess_of_step(first / whole) : 0.0;
    if (excess <= kMostExcess) return;
    add(Rank::doubtful, excess / kMostExcess, {"steps"},
        fmt::format(
            "steps: the first one takes {:.3g} s, and ground {:.3g} m from its drains consolidates in H^2/cv = {:.3g} s: "
            "mean pressures are off by some {:.0f} % of the load",
            first, way, whole, 100.0 * excess),
        fmt::format("begin with a shorter step that grows: 'first: {:.2g} s'",
                    std::max(shortest, 1e-3 * whole)));
  }
  [[nodiscard]] double end_of_first_step() const {
    return scene_.the_case().plan.empty() ? 0.0 : scene_.the_case().plan.front().amount;
  }
  [[nodiscard]] bool flows() const {
    return std::ranges::any_of(water_.regions(), [](const auto& region) { return !region.second.undrained; });
  }
  /// Boundaries and node sets where water may leave.
  [[nodiscard]] std::vector<std::string> drained_places() const {
    std::vector<std::string> places;
    for (const auto& given : problem_.prescribed_fields)
      if (given.field == fem::kPorePressure) places.push_back(given.on);
    for (const fem::OpenSide& side : water_.options().open_sides)
      if (side.holds(scene_.stage())) places.push_back(side.on);
    return places;
  }
  /// Largest distance of ground in which water flows from the nearest place where it may leave, m.
  [[nodiscard]] double way_to_drains() const {
    const std::vector<int> drains = problem_.mesh.nodes_on(drained_places());
    std::set<int> ground;
    for (const auto& [name, region] : water_.regions())
      if (!region.undrained)
        for (const int element : problem_.mesh.regions.at(name)) {
          const auto& nodes = problem_.mesh.elements[static_cast<std::size_t>(element)].nodes;
          ground.insert(nodes.begin(), nodes.end());
        }
    constexpr std::size_t kPairs = 10'000'000;  // more take a second and longer: then not every node is asked
    const std::size_t stride = 1 + ground.size() * drains.size() / kPairs;
    const auto place = [this](int node) { return problem_.mesh.nodes[static_cast<std::size_t>(node)]; };
    double farthest = 0.0;
    std::size_t count = 0;
    for (const int node : ground) {
      if (count++ % stride != 0) continue;
      double nearest = HUGE_VAL;
      for (const int drain : drains) nearest = std::min(nearest, (place(node) - place(drain)).norm());
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  }
  void look_at_undrained(const coupler::Entry& item, const std::string& key, const coupler::Entry& value,
                         const std::set<int>& dry) {
    const coupler::Entry* const on = item.find("on");
    if (on == nullptr || value.text == "false" || value.text == "no") return;
    std::vector<std::string> names{on->text};
    for (const coupler::Entry& word : on->items) names.push_back(word.text);
    for (const std::string& name : names) {
      const auto boundary = problem_.mesh.boundaries.find(name);
      if (boundary == problem_.mesh.boundaries.end() || boundary->second.empty() ||
          !std::ranges::all_of(boundary->second,
                               [&](const fem::BoundarySide& side) { return dry.contains(side.element); }))
        continue;
      remarks_.push_back(
          {Rank::wrong, 1.0,
           value.fault(fmt::format(
               "boundary: '{}' at '{}' does nothing: all {} elements there are undrained, and no water "
               "leaves or enters these",
               key, name, boundary->second.size())),
           fmt::format(
               "where water flows leave out 'undrained: true' and give 'permeability'; else leave out '{}'",
               key)});
    }
  }
  using Place = typename Cosserat<dim>::Place;

  /// Total force per area of the stress at time zero on a node's share of a boundary, Pa; nothing where no stress is given.
  [[nodiscard]] std::optional<Place> traction_at_start(const fem::ShareOfSide<dim>& share) const {
    const SceneRegion& region = scene_.region_of(share.element);
    const Place& at = problem_.mesh.nodes[static_cast<std::size_t>(share.node)];
    const auto stress = scene_.initial_stress<dim>(region, at);
    if (!stress) return {};
    Place traction = Place::Zero();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        traction(i) += (*stress)(Cosserat<dim>::stress_place(j, i)) * share.normal(j);
    const fem::PoreWaterOptions& options = water_.options();
    if (options.table && water_.regions().contains(region.name))
      traction -= options.unit_weight * (*options.table - at(dim - 1)) * share.normal;
    return traction;
  }
  /// Whether a load acts at time zero that the stress there does not hold.
  [[nodiscard]] bool is_sudden(const fem::BoundaryLoad<dim>& load) const {
    Place along = Place::Zero();
    for (int i = 0; i < dim; ++i) along(i) = load.traction[static_cast<std::size_t>(i)].at(0.0);
    const double pressure = load.pressure.at(0.0);
    if (pressure == 0.0 && along.isZero(0.0)) return false;
    if (!problem_.mesh.boundaries.contains(load.on)) return true;
    double given = 0.0;
    double held = 0.0;
    for (const fem::ShareOfSide<dim>& share : fem::shares_of_boundary<dim>(problem_.mesh, load.on)) {
      const Place wanted = along - pressure * share.normal;
      given += share.area * wanted.norm();
      // Round-off and coarse inputs: a twentieth of a load makes no overshoot that one sees.
      if (const auto there = traction_at_start(share);
          there && (wanted - *there).norm() < 0.05 * wanted.norm())
        held += share.area * wanted.norm();
    }
    return held < 0.95 * given;
  }
  /// Whether the first step bears a load at once, and without most of it by a straight rise. The loads of a run before are not
  /// known here.
  [[nodiscard]] bool jumps_at_start() const {
    if (scene_.stress_at_start() == Scene::StressAtStart::run_before) return false;
    if (std::ranges::any_of(problem_.boundary_loads, [&](const auto& load) { return is_sudden(load); }))
      return true;
    return std::ranges::any_of(problem_.node_loads,
                               [](const auto& load) { return load.value.at(0.0) != 0.0; });
  }
  /// Whether most of what a load changes by comes within the first step.
  [[nodiscard]] bool comes_in_first_step() const {
    return std::ranges::any_of(fem::tables_of(problem_), [this](const fem::TimeTable* const table) {
      const double start = table->at(0.0);
      double largest = 0.0;
      for (const coupler::StepTarget& target : scene_.the_case().plan)
        largest = std::max(largest, std::abs(table->at(target.amount) - start));
      return std::abs(table->at(end_of_first_step()) - start) > 0.5 * largest;
    });
  }
  /// cv = k Eoed / (unit weight of water), m^2/s.
  [[nodiscard]] std::optional<double> diffusivity_of(int element) const {
    for (const auto& [name, region] : water_.regions()) {
      const std::vector<int>& elements = problem_.mesh.regions.at(name);
      if (region.undrained || std::ranges::find(elements, element) == elements.end()) continue;
      const auto stiffness = stiffness_of(scene_, name);
      if (!stiffness) return {};
      return region.permeability.at(region.void_ratio) * *stiffness / water_.options().unit_weight;
    }
    return {};
  }
  /// Size of an element across one of its sides, m.
  [[nodiscard]] double height_over(const fem::BoundarySide& side) const {
    const double size = scene_.body().elements[static_cast<std::size_t>(side.element)];
    if constexpr (dim == 3) return size;
    const std::vector<int> nodes = problem_.mesh.side_nodes(side);
    return size * size /
           (problem_.mesh.nodes[static_cast<std::size_t>(nodes[0])] -
            problem_.mesh.nodes[static_cast<std::size_t>(nodes[1])])
               .norm();
  }

  const Scene& scene_;
  const fem::Problem<dim>& problem_;
  const fem::PoreWater<dim>& water_;
  Remarks& remarks_;
};

}  // namespace

void pore_water(const Scene& scene, Remarks& remarks) {
  if (scene.find({"water"}) == nullptr) return;
  look_at_numbers(scene, remarks);
  const auto look = [&]<int dim>(const fem::Problem<dim>& problem) {
    const fem::PoreWater<dim>* const water = fem::pore_water_of(problem);
    if (water == nullptr) return;
    Look<dim> at(scene, problem, *water, remarks);
    at.at_drains();
    at.at_undrained();
    at.at_bounds_of_flow();
    at.at_fluxes();
    at.at_bare_walls();
    at.at_weight();
    at.at_loads();
    at.at_steps();
  };
  scene.with_problem(look);
}

}  // namespace polargrain::app
