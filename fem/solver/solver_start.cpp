// SPDX-License-Identifier: GPL-2.0-or-later
// The start of a run from the end of another one (docs/theory/solver.md, start from another run).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "common/prefixed_archive.hpp"
#include "fem/solver/end_of_run.hpp"
#include "fem/solver/later_regions.hpp"
#include "fem/solver/recovery.hpp"
#include "fem/solver/solver_implementation.hpp"

namespace polargrain::fem {
namespace {

/// Numbers of the other run's regions, by number of region here; nothing for a region that only comes in a later stage.
template <int dim>
std::vector<std::optional<std::size_t>> regions_there(const Problem<dim>& problem, Recovery<dim>& recovery,
                                                      const std::vector<std::string>& regions_of_end) {
  std::vector<std::optional<std::size_t>> numbers;
  for (const auto& [region, unused] : problem.materials) {
    std::optional<std::size_t>& number = numbers.emplace_back();
    if (comes_later(problem, region)) continue;
    const auto found = std::ranges::find(regions_of_end, region);
    if (found == regions_of_end.end())
      throw RunError(
          fmt::format("it has no region '{}'; it has {}", region, fmt::join(regions_of_end, ", ")));
    number = static_cast<std::size_t>(found - regions_of_end.begin());
    if (!recovery.has(*number)) throw RunError(fmt::format("its region '{}' was gone at the end", region));
  }
  return numbers;
}

/// Values of the points of a run, found again at the points of this one.
template <int dim>
class StatesOfEnd {
 public:
  StatesOfEnd(const Problem<dim>& problem, const Discretisation<dim>& discretisation, Recovery<dim>& recovery,
              const std::vector<std::string>& regions_of_end)
      : there_(regions_there(problem, recovery, regions_of_end)),
        region_of_element_(discretisation.elements(), 0) {
    std::size_t number = 0;
    for (const auto& [region, unused] : problem.materials) {
      for (const int e : problem.mesh.regions.at(region))
        region_of_element_[static_cast<std::size_t>(e)] = number;
      ++number;
    }
    for (std::size_t i = 0; i < discretisation.points(); ++i) {
      const std::optional<std::size_t> region = region_at(discretisation, i);
      found_.push_back(region ? std::optional(recovery.at(discretisation.point(i).position, *region))
                              : std::nullopt);
    }
  }

  /// Nothing where the region of the point only comes later.
  [[nodiscard]] const std::optional<typename Recovery<dim>::Found>& of(std::size_t point) const {
    return found_[point];
  }
  /// Region of the other run that a point is in.
  [[nodiscard]] std::optional<std::size_t> region_at(const Discretisation<dim>& discretisation,
                                                     std::size_t point) const {
    return there_[region_of_element_[static_cast<std::size_t>(discretisation.element_of_point(point))]];
  }

 private:
  std::vector<std::optional<std::size_t>> there_;
  std::vector<std::size_t> region_of_element_;
  std::vector<std::optional<typename Recovery<dim>::Found>> found_;
};

}  // namespace

template <int dim>
void Solver<dim>::Implementation::save_body(ArchiveWriter& archive) const {
  EndOfRun<dim> end;
  end.mesh.nodes = this->problem.mesh.nodes;
  end.mesh.elements = this->problem.mesh.elements;
  end.region_of_element.resize(end.mesh.elements.size());
  for (std::size_t e = 0; e < end.mesh.elements.size(); ++e)
    end.there.push_back(this->discretisation.is_there(e) ? 1 : 0);
  for (const auto& [region, material] : this->problem.materials) {
    for (const int e : this->problem.mesh.regions.at(region))
      end.region_of_element[static_cast<std::size_t>(e)] = end.material_of_region.size();
    end.material_of_region.push_back(this->materials.number_of(material));
  }
  write_end(archive, end);
}

template <int dim>
void Solver<dim>::Implementation::take_displacements(const EndOfRun<dim>& end, const Eigen::VectorXd& of_end,
                                                     const Recovery<dim>& recovery) {
  const std::vector<char> used = nodes_of_elements(this->problem.mesh, elements_in_stage(this->problem, 0));
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node] == 0) continue;
    const auto& place = this->problem.mesh.nodes[node];
    const auto inside = recovery.element_at(place);
    if (!inside)
      throw RunError(fmt::format("the node at {} lies outside of its body", place_text<dim>(place)));
    const Element<dim>& element = end.mesh.elements[static_cast<std::size_t>(inside->element)];
    const Eigen::VectorXd shape = element.type->shape_functions(inside->reference).value;
    auto here = state.displacement.template segment<Cosserat<dim>::dofs>(
        static_cast<Eigen::Index>(entry_of<dim>(node, node_dofs<dim>().front())));
    here.setZero();
    for (std::size_t a = 0; a < element.nodes.size(); ++a)
      here += shape(static_cast<Eigen::Index>(a)) *
              of_end.template segment<Cosserat<dim>::dofs>(entry_of<dim>(element.nodes[a]));
  }
}

template <int dim>
StartReport Solver<dim>::start_from(ArchiveReader& archive, const std::vector<std::string>& regions_of_end) {
  Implementation& self = *implementation_;
  StartReport report;
  PrefixedReader body(archive, "body/");
  const EndOfRun<dim> end = read_end<dim>(body);
  if (end.material_of_region.size() != regions_of_end.size()) throw RunError("its regions are damaged");
  report.same_mesh = is_same_mesh(end.mesh, problem().mesh);
  if (!problem().contributions.empty() && !report.same_mesh)
    throw RunError(
        fmt::format("it has another mesh, and {} can be taken over on the same mesh alone; use its "
                    "mesh, or place what is new in a stage",
                    problem().contributions.front()->name()));
  Recovery<dim> recovery(end);
  const StatesOfEnd<dim> states(problem(), self.discretisation, recovery, regions_of_end);
  const std::vector<double> strains = archive.doubles("strain");
  constexpr auto components = static_cast<std::size_t>(Cosserat<dim>::components);
  const std::vector<typename EndOfRun<dim>::Point> points = end.points();
  if (strains.size() != components * points.size()) throw RunError("its strains are damaged");
  using Gradient = typename Cosserat<dim>::Gradient;
  constexpr auto of_gradient = static_cast<std::size_t>(dim * dim);
  const std::vector<double> placed = archive.doubles("stage_placed_with");
  if (!placed.empty() && placed.size() != of_gradient * points.size())
    throw RunError("its placed regions are damaged");
  if (!placed.empty()) self.state.placed_with.assign(self.discretisation.points(), Gradient::Zero());
  // Numbers of the points of each material, by their number among them.
  std::vector<std::vector<std::size_t>> numbers(end.material_of_region.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    numbers[end.material_of_region[end.region_of_element[static_cast<std::size_t>(points[i].element)]]]
        .push_back(i);
  PrefixedReader materials(archive, "materials/");
  for (std::size_t material = 0; material < self.materials.count(); ++material) {
    std::vector<PointMean> means;
    std::optional<std::size_t> from;
    for (const std::size_t point : self.materials.points_of(material)) {
      const auto& found = states.of(point);
      if (!found) continue;
      const std::size_t theirs = end.material_of_region[*states.region_at(self.discretisation, point)];
      if (from && *from != theirs)
        throw RunError(
            "regions that share a material here have different ones there; give them names of "
            "their own below 'materials'");
      from = theirs;
      report.outside += found->is_recovered ? 0 : 1;
      report.farthest = std::max(report.farthest, found->distance);
      typename Cosserat<dim>::Vector& strain = self.state.strain[point];
      strain.setZero();
      for (const auto& [other, weight] : found->mean.parts) {
        const std::size_t number = numbers[theirs][other];
        strain += weight * Eigen::Map<const typename Cosserat<dim>::Vector>(&strains[components * number]);
        if (!placed.empty())
          self.state.placed_with[point] += weight * Eigen::Map<const Gradient>(&placed[of_gradient * number]);
      }
      means.push_back(found->mean);
    }
    if (!from) continue;  // it only comes later
    if (means.size() != self.materials.points_of(material).size())
      throw RunError("regions that come in a later stage need a material of their own");
    const TakenOver taken =
        self.materials.take_over(materials, *from, numbers[*from].size(), material, means);
    report.from_nearest += taken.from_nearest;
    report.zeroed += taken.zeroed;
  }
  const std::vector<double> nodal = archive.doubles("displacement");
  const Eigen::VectorXd displacement =
      Eigen::Map<const Eigen::VectorXd>(nodal.data(), static_cast<Eigen::Index>(nodal.size()));
  if (report.same_mesh && displacement.size() == self.state.displacement.size()) {
    self.state.displacement = displacement;
    PrefixedReader contributions(archive, "contributions/");
    self.contributions.restore(contributions);
  } else if (!problem().contributions.empty()) {
    throw RunError("its interfaces, beams or water are others");
  } else {
    self.take_displacements(end, displacement, recovery);
  }
  self.count_supports_from_here();
  self.move_to_committed();
  self.materials.expect({.once = false});
  const Eigen::VectorXd before = self.state.displacement;
  const std::optional<Residual> residual = self.start(report.step, false);
  if (!residual) return report;
  report.imbalance = residual->force;
  report.step.converged = self.excess(*residual) <= 1.0;
  if (!report.step.converged) report.step = self.let_go(std::move(report.step), self.most_of_start());
  const Eigen::VectorXd moved = self.state.displacement - before;
  for (Eigen::Index entry = 0; entry < self.constraints.places().mechanics(); ++entry)
    if (!is_rotation(dof_at<dim>(entry))) report.moved = std::max(report.moved, std::abs(moved(entry)));
  return report;
}

template void Solver<2>::Implementation::save_body(ArchiveWriter&) const;
template void Solver<3>::Implementation::save_body(ArchiveWriter&) const;
template StartReport Solver<2>::start_from(ArchiveReader&, const std::vector<std::string>&);
template StartReport Solver<3>::start_from(ArchiveReader&, const std::vector<std::string>&);

}  // namespace polargrain::fem
