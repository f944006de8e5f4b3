// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/remarks/body.hpp"
#include "app/remarks/outline.hpp"
#include "app/remarks/packing_at_rest.hpp"
#include "app/remarks/remark.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/document.hpp"
#include "coupler/case/quantity.hpp"

namespace polargrain::app {

/// A region of the mesh and its material.
struct SceneRegion {
  std::string name;
  std::string material;
  const CellDefinition* cell = nullptr;    ///< null: a law in closed form
  const PackingAtRest* packing = nullptr;  ///< null: no cells, or nobody has asked the engine
  std::vector<int> elements = {};
  bool comes_later = false;  ///< with a later stage: nothing of it is there at time zero
};

/// A case as remarks look at it: read, with the text it was read from, and the packings as the engine has found them.
class Scene {
 public:
  using Path = std::vector<std::string>;

  /// All must outlive the scene. @param document of the case, settings applied
  Scene(const coupler::Case& the_case, const coupler::Entry& document, const PackingsAtRest& packings);

  /// The same with the supports and loads of a later stage. @param stage from 0
  [[nodiscard]] Scene in_stage(int stage) const;
  [[nodiscard]] int stage() const { return stage_; }

  [[nodiscard]] const coupler::Case& the_case() const { return case_; }
  [[nodiscard]] int dimension() const { return case_.dimension(); }
  /// Of a case of the plane. Where parts come and go: with the supports and loads of the stage alone.
  [[nodiscard]] const fem::Problem<2>& problem() const { return in_stage_ ? *in_stage_ : case_.problem; }
  [[nodiscard]] const fem::Mesh<2>& mesh() const { return case_.problem.mesh; }
  /// The same of a case of either kind.
  template <int dim>
  [[nodiscard]] const fem::Problem<dim>& problem_of() const {
    if constexpr (dim == 2)
      return problem();
    else
      return space_in_stage_ ? *space_in_stage_ : *case_.space;
  }
  /// Calls visit(problem) with the problem of the plane or of space.
  template <class Visit>
  decltype(auto) with_problem(Visit visit) const {
    return case_.space ? visit(problem_of<3>()) : visit(problem_of<2>());
  }
  [[nodiscard]] bool is_classical() const;
  /// The side of the body that a movement strains: of one along the last axis that along it; of another, which may shear the height
  /// or shorten the width, the smaller side, m.
  [[nodiscard]] double strained_side(fem::Dof movement) const;
  [[nodiscard]] const coupler::Entry& document() const { return document_; }
  [[nodiscard]] const Body& body() const { return body_; }
  /// As outline_of finds it, once for all stages.
  template <int dim>
  [[nodiscard]] const std::vector<OutlineSide<dim>>& outline() const;
  /// All, also those that come with a later stage.
  [[nodiscard]] const std::vector<SceneRegion>& regions() const { return regions_; }
  [[nodiscard]] const SceneRegion& region_of(int element) const {
    return regions_[region_of_element_[static_cast<std::size_t>(element)]];
  }

  /// The entry of keys, from the top; null when it is not there.
  [[nodiscard]] const coupler::Entry* find(const Path& path) const;
  /// The number at that place; nothing where there is no number.
  [[nodiscard]] std::optional<double> quantity(const Path& path, coupler::Dimension dimension) const;
  /// The entry, or the nearest above it that is there: where a remark points.
  [[nodiscard]] const coupler::Entry& place(const Path& path) const;
  /// The value of `key` in the first item of `boundary` that is on `name` and has it, of the stage before those of earlier ones;
  /// null where no item has it.
  [[nodiscard]] const coupler::Entry* boundary_value(const std::string& name, const std::string& key) const;

  /// Where the stress at time zero comes from.
  enum class StressAtStart {
    materials,  ///< packings and laws
    given,      ///< `initial_stress`, at least somewhere
    run_before  ///< `start_from`: it is not known here
  };
  [[nodiscard]] StressAtStart stress_at_start() const;

  [[nodiscard]] bool has_cells() const;
  /// Pressure of the grains of a region, Pa: as the engine found it, else as the packing records it; 0 without cells.
  [[nodiscard]] static double pressure_of(const SceneRegion& region);
  /// Stress at time zero; nothing where neither grains nor the case give one, and where the region comes later.
  template <int dim>
  [[nodiscard]] std::optional<typename Cosserat<dim>::Vector> initial_stress(
      const SceneRegion& region, const Eigen::Matrix<double, dim, 1>& position) const;
  /// Time at which the last step ends; nothing where that is not known before.
  [[nodiscard]] std::optional<double> end_time() const;
  /// Growth of all measures that control steps, m; 0: loading times alone control them.
  [[nodiscard]] double growth_of_measures() const;
  /// Largest magnitude that a movement has at the end of a step, m. Under a measure or an arc length the time is found, and a
  /// table may well go on beyond it: then the largest of the table, or the growth of the measures where that is less.
  [[nodiscard]] double reached(const fem::TimeTable& movement) const;
  /// Integration points of a region.
  [[nodiscard]] std::size_t points_of(const SceneRegion& region) const;
  /// Largest prescribed displacement of a run, m: its movements up to the end, and measures that are to grow.
  [[nodiscard]] double largest_movement() const;
  /// Largest strain of a step: change of a movement over the side of the body along it. Steps whose times are not known before
  /// share the whole evenly.
  [[nodiscard]] double strain_of_step() const;
  /// Sum of these strains over the run, there and back counted both.
  [[nodiscard]] double strain_of_run() const;

 private:
  [[nodiscard]] double strain_between(double before, double after) const;

  const coupler::Case& case_;
  int stage_ = 0;
  std::optional<fem::Problem<2>> in_stage_;
  std::optional<fem::Problem<3>> space_in_stage_;
  const coupler::Entry& document_;
  Body body_;
  template <int dim>
  using Outline = std::optional<std::vector<OutlineSide<dim>>>;
  std::shared_ptr<std::tuple<Outline<2>, Outline<3>>> outlines_ =
      std::make_shared<std::tuple<Outline<2>, Outline<3>>>();  ///< nothing before they are asked for
  std::vector<SceneRegion> regions_;
  std::vector<std::size_t> region_of_element_;
};

}  // namespace polargrain::app
