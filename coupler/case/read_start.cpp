// SPDX-License-Identifier: GPL-2.0-or-later
// start_from: the end of another run in the place of packings and initial stresses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "common/error.hpp"
#include "common/prefixed_archive.hpp"
#include "coupler/case/parts.hpp"
#include "coupler/case/quantity.hpp"
#include "coupler/case/stress_at_end.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "fem/solver/end_of_run.hpp"
#include "fem/solver/later_regions.hpp"
#include "fem/solver/stabilisation.hpp"

namespace polargrain::coupler {
namespace {

/// The models whose states another mesh can take over.
bool can_be_taken_over(const std::string& model) {
  return model == "elastic" || model == "elastoplastic" || model == "cell";
}

/// Of the grains of a material with cells; boxes of either kind answer to stresses that those of the other do not know.
std::string rotations_of(const CaseIdentity& identity, const std::string& material) {
  const auto value = identity.values.find(material + "rotations");
  return value == identity.values.end() ? "free" : value->second;
}

/// Compares each region with the one of its name there.
void check_materials(const Entry& start, const CaseIdentity& before, const CaseIdentity& now,
                     const std::string& run, CaseParts& parts) {
  const auto value_of = [](const std::map<std::string, std::string>& values, const std::string& key) {
    const auto value = values.find(key);
    return value == values.end() ? std::string() : value->second;
  };
  const std::vector<std::string> known = regions_of(before);
  for (const auto& [region, material] : parts.result.regions) {
    const auto fault = [&](const std::string& text) {
      parts.faults.push_back(start.fault(fmt::format("start_from: region '{}': {}", region, text)));
    };
    const std::string key = "materials." + material + ".";
    const std::string model = value_of(now.values, key + "model");
    if (parts.result.with_problem([&](const auto& problem) { return fem::comes_later(problem, region); }))
      continue;
    if (std::ranges::find(known, region) == known.end()) {
      fault(fmt::format(
          "'{}' has no region of this name; it has {}. Give the region a name of that run, or 'place' "
          "it in a stage",
          run, listed(known)));
      continue;
    }
    const std::string key_before = "materials." + value_of(before.values, "regions." + region) + ".";
    const std::string model_before = value_of(before.values, key_before + "model");
    if (model != model_before) {
      fault(fmt::format(
          "is of model '{}' and was of model '{}' in '{}'; a state goes over to the same model alone", model,
          model_before, run));
    } else if (!can_be_taken_over(model)) {
      fault(fmt::format(
          "states of model '{}' cannot be taken over yet; states of elastic, elastoplastic and cell can",
          model));
    } else if (value_of(now.files, key + "packing") != value_of(before.files, key_before + "packing")) {
      fault(fmt::format("its boxes are of another packing in '{}'; name the packing of that run", run));
    } else if (rotations_of(now, key) != rotations_of(before, key_before)) {
      fault(fmt::format(
          "the rotations of its grains are {} in '{}' and {} here; a box goes over to the same alone: set "
          "'rotations: {}'",
          rotations_of(before, key_before), run, rotations_of(now, key), rotations_of(before, key_before)));
    } else if (const std::string springs = value_of(before.values, key_before + "script" + kSprings),
               springs_now = value_of(now.values, key + "script" + kSprings);
               !springs.empty() && springs != springs_now) {  // empty: a run of an older version, too
      fault(fmt::format(
          "its contacts are '{}' by {} and were '{}' in '{}'; a box goes over to the same contact models alone: "
          "name the script of that run, or give its models in 'pair_style'",
          springs_now, value_of(now.values, key + "script"), springs, run));
    }
  }
}

/// Regions with grains whose contacts were others there.
std::vector<std::string> regions_of_other_scripts(const CaseIdentity& before, const CaseIdentity& now) {
  const auto script_of = [](const CaseIdentity& identity, const std::string& region) {
    const auto material = identity.values.find("regions." + region);
    if (material == identity.values.end()) return std::string();
    const auto script = identity.files.find("materials." + material->second + ".script");
    return script == identity.files.end() ? std::string() : script->second;
  };
  std::vector<std::string> others;
  for (const std::string& region : regions_of(now)) {
    const std::string there = script_of(before, region);
    if (!there.empty() && there != script_of(now, region)) others.push_back(region);
  }
  return others;
}

/// Pore pressures carry a share of the loads: they neither vanish nor appear.
void check_water(const Entry& start, const CaseIdentity& before, const CaseIdentity& now,
                 const std::string& run, CaseParts& parts) {
  const auto has_water = [](const CaseIdentity& identity) {
    return std::ranges::any_of(identity.values,
                               [](const auto& value) { return value.first.starts_with("water."); });
  };
  if (has_water(before) == has_water(now)) return;
  parts.faults.push_back(start.fault(
      has_water(now)
          ? fmt::format("start_from: '{}' has no pore water to start with; give 'water' to that run, or "
                        "leave it out here",
                        run)
          : fmt::format("start_from: '{}' has pore water, and its pressures would be lost; give this "
                        "case 'water' too",
                        run)));
}

/// The body at the end of a run. A checkpoint without one gives nothing.
/// @throws RunError where it is damaged
template <int dim>
std::optional<fem::EndOfRun<dim>> body_at_end(Checkpoint& end) {
  if (!end.state.all_integers().contains("solver/body/dimension")) return {};
  PrefixedReader archive(end.state, "solver/body/");
  return fem::read_end<dim>(archive);
}

template <int dim>
RunBefore run_before_of(const Checkpoint& end, const std::string& name,
                        const std::optional<fem::EndOfRun<dim>>& body) {
  RunBefore before;
  before.name = name;
  for (const std::string key : {"continuum", "continuum.kind"})
    if (const auto value = end.identity.values.find(key); value != end.identity.values.end())
      before.continuum = value->second == "cauchy" ? fem::Continuum::cauchy : fem::Continuum::cosserat;
  if (!body) return before;
  const std::vector<char> used = fem::nodes_of_elements(body->mesh, body->there);
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node] == 0) continue;
    const auto& place = body->mesh.nodes[node];
    if (before.least.empty()) {
      before.least.assign(place.begin(), place.end());
      before.largest = before.least;
    }
    for (std::size_t i = 0; i < before.least.size(); ++i) {
      before.least[i] = std::min(before.least[i], place(static_cast<Eigen::Index>(i)));
      before.largest[i] = std::max(before.largest[i], place(static_cast<Eigen::Index>(i)));
    }
  }
  return before;
}

/// States of structures and water go over on the same mesh alone (fem::Solver::start_from).
template <int dim>
void check_mesh(const Entry& start, const fem::Mesh<dim>& before, const fem::Problem<dim>& problem,
                const std::string& run, CaseParts& parts) {
  if (problem.contributions.empty() || problem.mesh.nodes == before.nodes) return;
  parts.faults.push_back(start.fault(fmt::format(
      "start_from: '{}' has another mesh, of {} nodes, and this one has {}; {} can be taken over on the same mesh alone: use "
      "its mesh, or 'place' what is new in a stage",
      run, before.nodes.size(), problem.mesh.nodes.size(), problem.contributions.front()->name())));
}

/// States of structures go over one by one, in their order.
void check_structures(const Entry& start, const Checkpoint& end, const std::string& run, CaseParts& parts) {
  std::vector<std::string> before;
  const auto& numbers = end.state.all_integers();
  for (auto name = numbers.find("solver/contributions/0/name"); name != numbers.end();
       name = numbers.find(fmt::format("solver/contributions/{}/name", before.size())))
    before.emplace_back(name->second.begin(), name->second.end());
  // The solver adds these itself, behind all others.
  std::erase(before, fem::Stabilisation<2>::kName);
  std::vector<std::string> now;
  parts.result.with_problem([&](const auto& problem) {
    for (const auto& contribution : problem.contributions) now.push_back(contribution->name());
  });
  if (before == now) return;
  const auto told = [](const std::vector<std::string>& names) {
    return names.empty() ? std::string("nothing of the kind") : fmt::format("{}", fmt::join(names, ", "));
  };
  parts.faults.push_back(start.fault(fmt::format(
      "start_from: '{}' ends with {}, and this case has {}: their states go over one by one, so give this case the same in the "
      "same order; a part comes or goes in a stage",
      run, told(before), told(now))));
}

/// Ground that the other run does not have has no state to begin with.
template <int dim>
void check_body(const Entry& start, const RunBefore& before, const fem::Problem<dim>& problem,
                CaseParts& parts) {
  if (before.least.empty()) return;
  const std::vector<char> used = fem::nodes_of_elements(problem.mesh, fem::elements_in_stage(problem, 0));
  constexpr double kRounding = 1e-6;
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node] == 0) continue;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i) {
      const double x = problem.mesh.nodes[node](static_cast<Eigen::Index>(i));
      const double slack = kRounding * (before.largest[i] - before.least[i]);
      if (x >= before.least[i] - slack && x <= before.largest[i] + slack) continue;
      parts.faults.push_back(start.fault(fmt::format(
          "start_from: the body in '{}' reaches from x{} = {:.4g} m to {:.4g} m, and this one has a node at {:.4g} m, where "
          "that run has no state to give; keep to its body, or 'place' new ground in a stage",
          before.name, i + 1, before.least[i], before.largest[i], x)));
      return;
    }
  }
}

/// Ground that was removed has no state at the end.
template <int dim>
void check_regions_there(const Entry& start, const fem::EndOfRun<dim>& body, const fem::Problem<dim>& problem,
                         const std::vector<std::string>& known, const std::string& run, CaseParts& parts) {
  std::set<std::size_t> left;
  for (std::size_t e = 0; e < body.there.size(); ++e)
    if (body.there[e] != 0) left.insert(body.region_of_element[e]);
  for (const auto& [region, unused] : problem.materials) {
    const auto number = static_cast<std::size_t>(std::ranges::find(known, region) - known.begin());
    if (number == known.size() || left.contains(number) || fem::comes_later(problem, region)) continue;
    parts.faults.push_back(start.fault(fmt::format(
        "start_from: region '{}' had been removed at the end of '{}', so it has no state there; leave it out of the mesh, or "
        "'place' it in a stage",
        region, run)));
  }
}

template <int dim>
void check_problem(const Entry& start, Checkpoint& end, const fem::Problem<dim>& problem,
                   const std::string& run, CaseParts& parts) {
  const std::optional<fem::EndOfRun<dim>> body = body_at_end<dim>(end);
  RunBefore& before = parts.result.run_before.emplace(run_before_of(end, run, body));
  if (!body) return;
  if (parts.faults.empty()) check_regions_there(start, *body, problem, regions_of(end.identity), run, parts);
  if (parts.faults.empty()) check_body(start, before, problem, parts);
  if (parts.faults.empty()) add_stress_at_end(end, *body, problem, before);
  check_mesh(start, body->mesh, problem, run, parts);
}

}  // namespace

void read_start(Section& top, CaseParts& parts) {
  const Entry& start = *top.find("start_from");
  const std::string name = top.text("start_from", "the result directory of a run");
  const std::filesystem::path directory = parts.directory / name;
  parts.result.start_from = directory;
  const auto fault = [&](const std::string& text) { top.fault("start_from", "start_from: " + text); };
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error)) {
    fault(fmt::format(
        "there is no folder '{}'; give the result directory of a run, as seen from the case file", name));
    return;
  }
  if (!std::filesystem::exists(directory / "checkpoint.h5", error)) {
    fault(fmt::format(
        "'{}' holds no checkpoint.h5; give the result directory of a run that has come to its end", name));
    return;
  }
  if (parts.result.is_explicit() || parts.result.is_automatic() || parts.result.real_time)
    fault("it begins with a balanced step; leave out 'method'");
  if (parts.result.spread > 0.0)
    fault("slips that are spread begin at zero and take no run over yet; leave out 'spread' or this key");
  parts.result.with_problem([&](const auto& problem) {
    if (!problem.initial_stresses.empty())
      fault("the run brings its stress; leave out 'initial_stress', or keep it and leave out this key");
  });
  if (!parts.faults.empty()) return;
  try {
    Checkpoint end = read_checkpoint(directory / "checkpoint.h5");
    if (end.step < 1) fault(fmt::format("'{}' has taken no step yet; run it to its end", name));
    const auto spread = end.identity.values.find("continuum.spread");
    if (spread != end.identity.values.end() &&
        parse_quantity(spread->second, Dimension::length).value_or(1.0) > 0.0)  // or of grains
      fault(fmt::format("'{}' spreads slips over {}, which no run takes over yet; take a run without spread",
                        name, spread->second));
    const CaseIdentity now = identity_of(top.entry(), parts.directory);
    check_materials(start, end.identity, now, name, parts);
    check_water(start, end.identity, now, name, parts);
    parts.result.with_problem([&](const auto& problem) { check_problem(start, end, problem, name, parts); });
    parts.result.run_before->other_scripts = regions_of_other_scripts(end.identity, now);
    if (parts.faults.empty()) check_structures(start, end, name, parts);
  } catch (const InputError& of_file) {
    fault(of_file.what());
  } catch (const RunError& of_body) {
    fault(fmt::format("'{}': {}", name, of_body.what()));
  }
}

}  // namespace polargrain::coupler
