// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/response.hpp"
#include "fem/material/material.hpp"
#include "fem/solver/stages.hpp"

namespace polargrain::fem {

template <int dim>
struct Problem;
template <int dim>
class Discretisation;

/// The step that a contribution is asked about: nodal values at its start and their increments, both with the entries of
/// node_dofs for each node and then those of the fields (FieldPlaces).
struct NodalStep {
  double start_time;
  double time;                   ///< at the end; may be start_time
  const Eigen::VectorXd& start;  ///< committed nodal values
  const Eigen::VectorXd& increment;

  [[nodiscard]] double duration() const { return time - start_time; }
  /// Values at the end of the step, of the entries of one element.
  [[nodiscard]] Eigen::VectorXd end(const std::vector<int>& entries) const {
    return start(entries) + increment(entries);
  }
};

/// The sums over all contributions.
struct NodalForces {
  /// Internal forces, which loads balance: N and N m; in the plane N/m and N. At the entries of a field: the sum that must vanish.
  Eigen::VectorXd internal;
  /// At the entries of fields alone: absolute parts that `internal` is the sum of. A field is balanced when its rows are small
  /// against the sum of all of them. A part that is itself the rounded difference of larger numbers must not be smaller than a
  /// millionth of these.
  Eigen::VectorXd parts;
};

/// The committed state at which a stage of construction begins.
template <int dim>
struct StageBegin {
  int stage;
  const std::vector<char>& there;  ///< elements of the mesh in the stage, as elements_in_stage has them
  const Eigen::VectorXd& nodal;    ///< nodal values
  /// Loads less internal forces of the stage before, at the nodes; zero at nodes that are free.
  const Eigen::VectorXd& unbalanced;
  const std::vector<char>& given;  ///< by entry of nodal vectors: a support has held it in the stage before
  const Discretisation<dim>& discretisation;
  std::span<const Response<dim>> committed;
};

/// Terms of the balance beside the stresses of the mesh: water in pores, interfaces, beams. Made of elements that couple entries
/// of nodal vectors. Lives like a Material: evaluate starts from the committed state every time, commit keeps the last
/// evaluation, revert drops it. Sums run in the order of the elements, so they have the same bits every time.
///
/// Order of calls: allocate once, by the solver that is made; evaluate with an increment of zero and commit for the initial state; then per step any number of evaluate,
/// each perhaps followed by tangent, ended by commit or revert. A step begins with an increment of zero, for its predictor.
/// Explicit steps ask the materials once, with the displacements of their end and fields as they were. Then fields that do not
/// store are balanced there, and the materials are asked again with the same strains (Material::expect, Asking::once).
template <int dim>
class Contribution {
 public:
  virtual ~Contribution() = default;

  /// Names it in messages: "pore water", "the interface 'wall'".
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::size_t elements() const = 0;
  /// Entries of nodal vectors that an element couples, each once; always the same.
  [[nodiscard]] virtual const std::vector<int>& entries(std::size_t element) const = 0;

  /// Gives all elements their initial state, whatever they were asked before.
  virtual void allocate() = 0;
  /// The committed answers of the elements, told before the first evaluation and at the start of each step: for what follows its
  /// neighbours, such as friction that is a share of theirs.
  virtual void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed) {
    (void)discretisation;
    (void)committed;
  }
  /// Adds the forces at the end of the step. @returns why it cannot, empty when it can; the step is then cut.
  [[nodiscard]] virtual std::string evaluate(const NodalStep& step, NodalForces& forces) = 0;
  /// Derivative of the internal forces of an element with respect to the values at the end of the step, of the last evaluation.
  [[nodiscard]] virtual Eigen::MatrixXd tangent(std::size_t element) const = 0;

  virtual void commit() = 0;
  virtual void revert() = 0;
  /// The committed state, as Material::save and restore keep theirs.
  virtual void save(ArchiveWriter& archive) const = 0;
  virtual void restore(ArchiveReader& archive) = 0;

  /// The stages of construction that have it. Before the first of them it has no forces, behind the last one neither.
  Lifetime life = {};
  /// Whether it can come and go, or its elements with the elements of the mesh beside them.
  [[nodiscard]] virtual bool takes_stages() const { return false; }
  /// Whether an element is there in a stage. @param there elements of the mesh in it, as elements_in_stage has them
  [[nodiscard]] virtual bool is_there(std::size_t element, int stage, const std::vector<char>& there) const {
    (void)element;
    (void)there;
    return life.holds(stage);
  }
  /// Pairs of nodes that are one in a stage, since it does not part them yet.
  [[nodiscard]] virtual std::vector<std::pair<int, int>> tied_nodes(int stage) const {
    (void)stage;
    return {};
  }
  /// From now on the elements of a stage, and no others, have forces: of a run that goes on, whose states restore gives.
  virtual void set_stage(int stage, const std::vector<char>& there) {
    (void)stage;
    (void)there;
  }
  /// The same at the beginning of the stage: elements that come are born at the nodal values of the moment.
  virtual void begin_stage(const StageBegin<dim>& now) { set_stage(now.stage, now.there); }
  /// A run begins, and from no other run's end: for what begins with the stress of the ground beside it. Its committed state is
  /// that of an evaluation without an increment; it is evaluated again behind this.
  virtual void begin_at_rest(const StageBegin<dim>& now) { (void)now; }
  /// Whether an element has forces since set_stage or begin_stage.
  [[nodiscard]] virtual bool is_active(std::size_t element) const {
    (void)element;
    return true;
  }
  /// The longest time that the step to come should take, for the accuracy of the contribution; longer ones are taken in parts.
  [[nodiscard]] virtual double longest_step() const { return HUGE_VAL; }

  /// Whether its forces depend on how long a step takes: the time can then be no unknown (Solver::advance_measure).
  [[nodiscard]] virtual bool depends_on_duration() const { return false; }
  /// Whether its forces may stand in steps that are not balanced (Solver::advance_explicit).
  [[nodiscard]] virtual bool takes_explicit_steps() const { return false; }
  /// Whether its fields stiffen the body when nothing flows, as water does, by a definite matrix. Else they only soften it.
  [[nodiscard]] virtual bool fields_store() const { return true; }
  /// Work over the step that was evaluated last, J (in the plane per m of thickness), of loads that it brings.
  [[nodiscard]] virtual double work_from_outside() const { return 0.0; }
  /// Pairs of nodes that it holds together in all directions: parts of a body that hang on each other by it.
  [[nodiscard]] virtual std::vector<std::pair<int, int>> joined_nodes() const { return {}; }
  /// Faults of a problem that the contribution belongs to, one message each; runs nothing.
  [[nodiscard]] virtual std::vector<std::string> faults(const Problem<dim>& problem) const {
    (void)problem;
    return {};
  }
  /// The same of one stage in which it is there.
  [[nodiscard]] virtual std::vector<std::string> faults_of_stage(const Problem<dim>& problem,
                                                                 int stage) const {
    (void)problem;
    (void)stage;
    return {};
  }
  /// Adds its committed internal forces on the face that has these nodes, at their displacements in turn: by them a beam there
  /// knows what it carries. @returns whether it acts on that face
  virtual bool add_forces_on_face(const std::vector<int>& nodes, Eigen::VectorXd& forces) const {
    (void)nodes;
    (void)forces;
    return false;
  }
  [[nodiscard]] virtual std::vector<Figure> figures() const { return {}; }
  /// Events of the last commits that a user should read in the log, a sentence each; then forgotten.
  [[nodiscard]] virtual std::vector<std::string> take_notes() { return {}; }
  /// Told of each step that is evaluated before the materials are: for materials that follow nodal values beside the strain.
  /// The predictor of a step, whose increment is zero, asks the materials nothing, and does not tell.
  virtual void prepare(const NodalStep& step) { (void)step; }
};

/// A term without a state: the nodal values alone give its forces.
template <int dim>
class StatelessContribution : public Contribution<dim> {
 public:
  void allocate() override {}
  void commit() override {}
  void revert() override {}
  void save(ArchiveWriter&) const override {}
  void restore(ArchiveReader&) override {}
};

}  // namespace polargrain::fem
