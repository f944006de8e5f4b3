// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupler/cells/cosserat_part.hpp"
#include "fem/output/material_values.hpp"

namespace polargrain::app {
namespace {

using Lines = std::vector<std::string>;

template <int dim>
std::string at(const Eigen::Matrix<double, dim, 1>& position) {
  if constexpr (dim == 2) return fmt::format("({:.4g}, {:.4g})", position(0), position(1));
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", position(0), position(1), position(dim - 1));
}

/// Boundaries and sets that a node lies on, `all` left out.
template <int dim>
Lines places_of(const fem::Mesh<dim>& mesh, int node) {
  Lines places;
  for (const std::string& name : mesh.boundary_and_node_set_names()) {
    if (name == "all") continue;
    const std::vector<int> nodes = mesh.nodes_on(name);
    if (std::ranges::binary_search(nodes, node)) places.push_back("'" + name + "'");
  }
  return places;
}

template <int dim>
Lines elements_at(const fem::Mesh<dim>& mesh, int node) {
  Lines elements;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::ranges::find(mesh.elements[e].nodes, node) != mesh.elements[e].nodes.end())
      elements.push_back(std::to_string(e));
  return elements;
}

template <int dim>
std::string where(const fem::Trouble& trouble, const fem::Mesh<dim>& mesh) {
  Lines nodes;
  double share = 0.0;
  for (const fem::Trouble::Node& node : trouble.nodes) {
    const Lines places = places_of(mesh, node.number);
    const Lines elements = elements_at(mesh, node.number);
    std::string of;
    if (!elements.empty())  // nodes of beams and rigid walls have no element
      of =
          fmt::format(", of {} {}", elements.size() == 1 ? "element" : "elements", fmt::join(elements, ", "));
    nodes.push_back(fmt::format("{}{}{}{}", at<dim>(mesh.nodes[static_cast<std::size_t>(node.number)]),
                                places.empty() ? "" : " on ", fmt::join(places, " and "), of));
    share += node.share;
  }
  if (nodes.empty()) return {};
  return fmt::format("  where: {:.0f} % of the unbalanced force is at the nodes {}", 100.0 * share,
                     fmt::join(nodes, "; "));
}

/// The values of a cell or a law at a point, in the words of the fields of the result.
template <int dim>
std::string words_of(const fem::Solver<dim>& solver, fem::MaterialValues<dim>& values, std::size_t point) {
  Lines words{
      fmt::format("p {:.3g} kPa", 1e-3 * coupler::pressure_of<dim>(solver.state().responses[point].stress))};
  for (const char* const name : {"sliding_fraction", "coordination_number", "rattlers", "source",
                                 "error_estimate", "stress_mismatch", "plastic_shear"})
    if (const std::optional<double> value = values.at(point, name))
      words.push_back(fmt::format("{} {:.2g}", name, *value));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// One point of every element at the worst node, as last committed.
template <int dim>
std::string neighbours(const fem::Trouble& trouble, const fem::Solver<dim>& solver) {
  if (trouble.nodes.empty()) return {};
  const fem::Mesh<dim>& mesh = solver.problem().mesh;
  const int node = trouble.nodes.front().number;
  const typename Cosserat<dim>::Place& position = mesh.nodes[static_cast<std::size_t>(node)];
  std::map<int, std::size_t> nearest;  // element: its point next to the node
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const int element = solver.element_of_point(point);
    const std::vector<int>& nodes = mesh.elements[static_cast<std::size_t>(element)].nodes;
    if (std::ranges::find(nodes, node) == nodes.end()) continue;
    const auto [place, added] = nearest.try_emplace(element, point);
    if ((solver.position_of_point(point) - position).norm() <
        (solver.position_of_point(place->second) - position).norm())
      place->second = point;
  }
  fem::MaterialValues<dim> values(solver);
  std::string text = "  values there, before this step:";
  for (const auto& [element, point] : nearest)
    text += fmt::format("\n    element {}, point {}: {}", element, point, words_of(solver, values, point));
  return text;
}

/// A point that carries less than this share of the mean pressure of all, and any that carries less than one pascal, has
/// lost the forces between its grains. In a slope of 10 m that is 0.1 kPa, the weight of 5 mm.
constexpr double kLost = 1e-3;
constexpr double kNothing = 1.0;  // Pa

/// Cells that carry next to nothing, as last committed: their grains touch no longer, and their tangent says nothing of
/// where they go.
template <int dim>
std::string without_stress(const fem::Solver<dim>& solver) {
  const auto pressure = [&](std::size_t point) {
    return coupler::pressure_of<dim>(solver.state().responses[point].stress);
  };
  fem::MaterialValues<dim> values(solver);
  double mean = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point)
    mean += pressure(point) / static_cast<double>(solver.points());
  std::size_t lost = 0;
  std::optional<std::size_t> least;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    // Laws have no grains that could part.
    if (pressure(point) >= std::max(kNothing, kLost * mean) || !values.at(point, "coordination_number"))
      continue;
    ++lost;
    if (!least || pressure(point) < pressure(*least)) least = point;
  }
  if (!least) return {};
  return fmt::format(
      "  {} of {} points carry hardly any stress, least point {} of element {} at {} ({}): their grains have "
      "parted, and the tangent of a box of loose grains gives no direction. If that stops the run, some "
      "pressure left on the free surface may help, and a weight raised slowly at first ('factor' of 'body')",
      lost, solver.points(), *least, solver.element_of_point(*least),
      at<dim>(solver.position_of_point(*least)), words_of(solver, values, *least));
}

template <int dim>
std::string points_without_answer(const fem::Trouble& trouble, const fem::Solver<dim>& solver) {
  if (trouble.points.empty()) return {};
  std::string text = fmt::format("  {} of {} points have no good answer:", trouble.not_good, solver.points());
  for (const fem::Trouble::Point& point : trouble.points)
    text += fmt::format("\n    point {} of element {} at {}: {}", point.number,
                        solver.element_of_point(point.number),
                        at<dim>(solver.position_of_point(point.number)), point.message);
  return text;
}

/// The next larger number of one digit.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return unit * std::ceil(value / unit - 1e-9);
}

/// A balance within a hundredth of the loads is as good as grains answer; beyond, looser tolerances hide what is wrong.
constexpr double kLoosest = 1e-2;

Lines keys_of_balance(const fem::Trouble& trouble, const coupler::Case& the_case) {
  Lines keys;
  const fem::SolverOptions& solver = the_case.solver;
  const double least = trouble.least_force_residual;
  if (trouble.force_noise > 0.0 && solver.noise_factor == 0.0 && least < 2.0 * trouble.force_noise)
    keys.push_back(
        fmt::format("noise: 2 (the noise of the stresses alone leaves {:.2g})", trouble.force_noise));
  const double looser = least > 0.0 ? rounded_up(1.5 * least) : 0.0;
  if (looser > solver.force_tolerance && looser <= kLoosest)
    keys.push_back(fmt::format("tolerance: {:.1g} (the iteration came down to {:.2g}, asked is {:.2g})",
                               looser, least, solver.force_tolerance));
  if (solver.most_line_search_halvings == 0 && trouble.last_force_residual > 1.2 * least)
    keys.push_back("line_search: 3 (corrections make the balance worse again)");
  if (trouble.jumps && solver.most_jumps == 0)
    keys.push_back(fmt::format("jumps: 50 (the stresses jump here, however small the strain{})",
                               the_case.needs_workers() ? "; packings with more grains jump less" : ""));
  if (trouble.last_force_residual == least && least < 0.5 * trouble.first_force_residual)
    keys.push_back(
        fmt::format("iterations: {} (the residual was still falling)", 2 * solver.most_iterations));
  return keys;
}

Lines keys_of(const fem::Trouble& trouble, const coupler::Case& the_case) {
  Lines keys = trouble.not_good > 0 ? Lines{} : keys_of_balance(trouble, the_case);
  if (trouble.not_good > 0 || keys.empty() || trouble.nodes.empty())
    keys.push_back(fmt::format("count: {} (shorter steps)", 2 * the_case.steps()));
  return keys;
}

/// A node between two boundaries of which one moves: no mesh makes the stress there finite.
template <int dim>
std::string corner(const fem::Trouble& trouble, const fem::Problem<dim>& problem) {
  if (trouble.nodes.empty()) return {};
  const int node = trouble.nodes.front().number;
  bool moves = false;
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (item.value.largest_magnitude() == 0.0) continue;
    const std::vector<int> nodes = problem.mesh.nodes_on(item.on);
    moves = moves || std::ranges::binary_search(nodes, node);
  }
  const Lines places = places_of(problem.mesh, node);
  if (!moves || places.size() < 2) return {};
  return fmt::format(
      "  {} is an end of the moving part ({}): strains have no bound there, whatever the mesh; a finer one makes "
      "it harder",
      at<dim>(problem.mesh.nodes[static_cast<std::size_t>(node)]), fmt::join(places, " and "));
}

/// A residual that no tolerance should cover.
std::string far_from_balance(const fem::Trouble& trouble) {
  if (trouble.not_good > 0 || trouble.least_force_residual <= kLoosest) return {};
  return fmt::format(
      "  the iteration stands at {:.2g} of the loads at best: a tolerance as loose as that would take forces out of balance for a "
      "result, and a higher inertial_number or unbalanced_force_ratio grains that are not at rest; shorter steps do not",
      trouble.least_force_residual);
}

template <int dim>
Lines what_is_seen(const fem::Trouble& trouble, const fem::Solver<dim>& solver) {
  const bool good = trouble.not_good == 0;
  return {good ? where(trouble, solver.problem().mesh) : "", points_without_answer(trouble, solver),
          good ? neighbours(trouble, solver) : "", good ? corner(trouble, solver.problem()) : "",
          without_stress(solver)};
}

}  // namespace

template <int dim>
std::string advice(const fem::Trouble& trouble, const fem::Solver<dim>& solver,
                   const coupler::Case& the_case) {
  // At a limit load a looser tolerance would let the body creep on.
  const Lines keys = trouble.no_part_helps ? Lines{} : keys_of(trouble, the_case);
  Lines parts = what_is_seen(trouble, solver);
  parts.push_back(far_from_balance(trouble));
  if (!keys.empty()) parts.push_back(fmt::format("  worth trying below 'steps': {}", fmt::join(keys, "; ")));
  std::erase(parts, "");
  return fmt::format("{}", fmt::join(parts, "\n"));
}

template <int dim>
std::string advice_at_start(const fem::Trouble& trouble, const fem::Solver<dim>& solver,
                            const Remarks& remarks) {
  Lines parts = what_is_seen(trouble, solver);
  parts.emplace_back(
      "  step 0 brings the stress at time zero (of the packings, or initial_stress) into balance with the loads and supports at "
      "time zero. No key below 'steps' helps: let each boundary that is free carry the pressure of its grains at time zero, "
      "and let loads change from there over steps, [[0, FIRST], [1, LAST]]");
  for (const Remark& remark : remarks)
    if (remark.rank != Rank::costly)
      parts.push_back(fmt::format("    {}\n      -> {}", remark.at.text(), remark.remedy));
  std::erase(parts, "");
  return fmt::format("{}", fmt::join(parts, "\n"));
}

template std::string advice<2>(const fem::Trouble& trouble, const fem::Solver<2>& solver,
                               const coupler::Case& the_case);
template std::string advice<3>(const fem::Trouble& trouble, const fem::Solver<3>& solver,
                               const coupler::Case& the_case);
template std::string advice_at_start<2>(const fem::Trouble& trouble, const fem::Solver<2>& solver,
                                        const Remarks& remarks);
template std::string advice_at_start<3>(const fem::Trouble& trouble, const fem::Solver<3>& solver,
                                        const Remarks& remarks);

}  // namespace polargrain::app
