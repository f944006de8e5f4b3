// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupler/case/case_identity.hpp"
#include "coupler/case/expression.hpp"
#include "coupler/case/material_model.hpp"
#include "coupler/case/place_values.hpp"
#include "coupler/pool/patience.hpp"
#include "fem/solver/problem.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::coupler {

/// A value that is followed through a run: measured on the mesh, or computed from others by a formula.
struct Monitor {
  enum class Kind { reaction, displacement, structure, water, place, formula };
  std::string name;
  Kind kind = Kind::formula;
  std::vector<std::string>
      on;  ///< boundaries and node sets, a node of several counts once; not of structures, places and formulas
  fem::Dof dof = fem::Dof::u1;  ///< of reaction and displacement
  /// An interface, beam or anchor.
  std::string structure = {};
  /// Of a structure or of water: "moment", "pressure".
  std::string value = {};
  std::vector<double> at = {};        ///< of a place: where, m
  PlaceValue component = {};          ///< of a place: which value
  std::optional<Expression> formula;  ///< of names that stand before it, and of built_in_values()
};

/// Names that every formula may use: time, volume_strain, external_work, internal_work.
const std::vector<std::string>& built_in_values();

/// The target of one step of a run.
struct StepTarget {
  enum class Control {
    time,       ///< a loading time
    measure,    ///< growth of a measure of the displacements, at whatever loading time
    arc_length  ///< a way along the path of equilibrium
  };
  Control control = Control::time;
  double amount = 0.0;  ///< the time itself; the growth; the length (m)
  fem::DisplacementMeasure measure;
  int explicit_steps = 0;  ///< in so many explicit steps; 0: by Newton's method
  double released =
      1.0;  ///< share of the forces held back at the beginning of its stage that is let go at its end
};

/// A stage of construction: steps with a name, before which parts may come and go.
struct CaseStage {
  std::string name;
  int first_step = 0;  ///< of the plan, the first one is 1
  int last_step = 0;
  /// Of the problem (fem::Solver::begin_stage). The same as of the stage before: nothing comes, goes, begins or ends.
  int number = 0;
  bool resets_displacements = false;
};

/// The end of the run that another one starts from, as far as both are compared before anything runs.
struct RunBefore {
  std::string name;  ///< of its folder, as the case has it
  fem::Continuum continuum = fem::Continuum::cosserat;
  std::vector<double> least, largest;           ///< corners of the box around its body, m; empty: not known
  double pressure = 0.0;                        ///< mean over its points, Pa; without that of water
  std::vector<std::string> other_scripts = {};  ///< regions whose contact script is another one there
  /// Stress behind the sides of each boundary that this case loads, in their order, Pa, tension positive; NaN: it is not known.
  std::map<std::string, std::vector<Eigen::Matrix3d>> behind = {};
};

/// Everything a run needs, read from a case file and checked. A plain value apart from the recipes.
struct Case {
  std::filesystem::path file;
  CaseIdentity identity;             ///< must agree with that of a checkpoint
  double checkpoint_minutes = 10.0;  ///< least time between two checkpoints
  std::string title;
  /// Mesh, supports and loads; its materials are null until a run makes them from the recipes.
  fem::Problem<2> problem;
  /// The same of a body in space, in the place of `problem`; nothing: the case is of the plane.
  std::optional<fem::Problem<3>> space;
  /// Width over which slips are spread, m (fem::SpreadOptions::width); 0: each point slips by itself.
  double spread = 0.0;
  std::vector<std::string> slips_held_on;  ///< boundaries where they are zero; others mirror them
  std::map<std::string, std::shared_ptr<const MaterialRecipe>> materials;  ///< by name
  std::map<std::string, std::string> regions;                              ///< region: name of its material
  std::vector<StepTarget> plan;                                            ///< the steps, in their order
  std::vector<CaseStage> stages;  ///< all of the plan, in its order; empty: no stage of it has a name
  fem::SolverOptions solver;
  fem::ExplicitOptions explicit_options;  ///< of rows whose fields are written; others do not come to rest
  int effort =
      0;  ///< iterations that a step may take before explicit steps go on; 0: the method is not automatic
  bool real_time = false;             ///< explicit steps of true masses; the loading time is in s
  bool gives_explicit_steps = false;  ///< their number, in the place of a pace
  bool rate_follows = false;          ///< the rate of explicit steps, so that explicit_error holds
  double explicit_error = 0.02;       ///< error of the reactions that is allowed in explicit steps
  std::vector<Monitor> monitors;
  std::vector<Profile> profiles;
  std::filesystem::path
      start_from;  ///< result directory of the run whose end this one starts from; empty: it starts by itself
  std::optional<RunBefore> run_before;  ///< of start_from
  std::vector<std::string> table;       ///< monitors and built-in values shown at the end
  int output_every = 1;                 ///< steps between two .vtu files
  bool output_points = true;            ///< whether there is one of the integration points beside each
  /// Integration points whose grains are written beside each, in the order of points-NNNNN.vtu.
  std::set<std::size_t> output_grains;
  PatienceLimits patience;         ///< with workers
  std::vector<KeyLeft> left = {};  ///< keys that took their defaults
  double check_share = 0.0;        ///< of the evaluations: made by two workers, 0 to 1

  [[nodiscard]] int dimension() const { return space ? 3 : 2; }
  /// The problem of the dimension that the case has.
  template <int dim>
  [[nodiscard]] auto& problem_of() {
    if constexpr (dim == 2) {
      return problem;
    } else {
      return *space;
    }
  }
  template <int dim>
  [[nodiscard]] const fem::Problem<dim>& problem_of() const {
    return const_cast<Case&>(*this).problem_of<dim>();
  }
  /// Calls visit(problem) with the problem that the case has.
  template <class Visit>
  decltype(auto) with_problem(Visit visit) {
    return space ? visit(*space) : visit(problem);
  }
  template <class Visit>
  decltype(auto) with_problem(Visit visit) const {
    return space ? visit(*space) : visit(problem);
  }

  /// The stage of a step of the plan; null where stages have no names, and of step 0.
  [[nodiscard]] const CaseStage* stage_of(int step) const;
  /// The number of steps.
  [[nodiscard]] int steps() const { return static_cast<int>(plan.size()); }
  [[nodiscard]] bool needs_workers() const;
  [[nodiscard]] bool is_automatic() const { return effort > 0; }
  /// Whether it goes on in explicit steps, or (is_automatic) may.
  [[nodiscard]] bool is_explicit() const { return !plan.empty() && plan.front().explicit_steps > 0; }
};

/// Reads and checks a case file; runs nothing and writes nothing.
/// @param settings "key=value" of --set, put into the document before it is read
/// @param scripts which scripts of cells it may name
/// @throws InputError with all faults, in the order of the file
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& settings = {},
               const ScriptRules& scripts = {});

}  // namespace polargrain::coupler
