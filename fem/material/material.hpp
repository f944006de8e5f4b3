// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/error.hpp"
#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/material/point_mean.hpp"
#include "fem/material/unrest.hpp"

namespace polargrain::fem {

/// One number a material tells of its work, for the summary of a run.
struct Figure {
  std::string name;
  double value;
};

/// How the steps to come ask a material.
struct Asking {
  /// Explicit steps: each is evaluated once, and committed; a SlipDriven material once more, with the same strains and the slips
  /// that follow from its answers. Else iterations ask again and again from the same state.
  bool once = false;
  double seconds = 0.0;  ///< that such a step takes; 0: steps have no time of their own
};

/// A material and the states of all the points that are made of it. Every point has two states: the one at
/// the start of the step (committed) and the trial one. Three verbs move them: evaluate, commit, revert.
///
/// Order of calls: allocate once; then per step any number of evaluate, ended by commit (trial becomes
/// committed) or revert (trial is dropped). evaluate always starts from the committed states, so calling it
/// twice with the same increments gives the same bits. Before a commit a material may be asked to confirm its answers.
template <int dim>
class Material {
 public:
  virtual ~Material() = default;

  /// Gives `points` points the material's initial state.
  virtual void allocate(std::size_t points) = 0;

  /// Overwrites the initial stress of one point; only between allocate and the first evaluate.
  /// @throws RunError when this material's initial stress is its own and cannot be given.
  virtual void set_initial_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) {
    (void)point;
    (void)stress;
    throw RunError("this material brings its own initial stress and takes no other by position");
  }

  /// Whether it can take increments of large deformation, whose rotation turns the stress that is kept
  /// (Increment::configuration, rotation.hpp).
  [[nodiscard]] virtual bool can_turn() const { return true; }

  /// The length over which moments of this material act, m: the mean diameter of grains that answer with couple
  /// stresses of their own. 0: the material has no such length, and moments are measured by the size of the elements.
  [[nodiscard]] virtual double moment_length() const { return 0.0; }

  /// Told before the first evaluation and before each step, when nothing is on trial.
  virtual void expect(const Asking& asking) { (void)asking; }

  /// Answers for all points at once, so that a material may spread the work (cells over workers).
  /// @param increments one a point, from the committed state; @param responses one a point, overwritten.
  /// A point that cannot answer says so in its Response (Quality::failed); no exception for that.
  virtual void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) = 0;

  /// Asked when a step is balanced, before commit: whether the answers to the last increments stand. A material that
  /// finds that it has to answer better says false; evaluate then gives other answers to the same increments, the
  /// iteration of the step goes on with them, and confirm is asked again when they are balanced.
  [[nodiscard]] virtual bool confirm() { return true; }

  /// Asked at the end of a row of explicit steps, when results are about to be written: a material whose points go on
  /// without being looked at looks at them now.
  virtual void settle() {}

  /// Means over the steps since the last settle.
  [[nodiscard]] virtual Unrest unrest() const { return {}; }

  virtual void commit() = 0;
  virtual void revert() = 0;

  /// Writes the committed states of all points; only between steps, when nothing is on trial.
  /// @throws RunError when this material cannot be kept.
  virtual void save(ArchiveWriter& archive) const {
    (void)archive;
    throw RunError("this material cannot be written to a checkpoint");
  }
  /// Takes the committed states of all points from the archive of save; after allocate with as many points. The run
  /// continues to the same bits as without the interruption.
  /// @throws RunError when the archive holds something else.
  virtual void restore(ArchiveReader& archive) {
    (void)archive;
    throw RunError("this material cannot be read from a checkpoint");
  }

  /// Takes states over from the archive of save of a material with points elsewhere, of a run on another mesh.
  /// @param count of its points @param means of them, one for each point of this material
  /// @throws RunError when the archive holds something else, or this material cannot do it.
  virtual TakenOver take_over(ArchiveReader& archive, std::size_t count, std::span<const PointMean> means) {
    (void)archive;
    (void)count;
    (void)means;
    throw RunError("this material cannot take the states of another run over");
  }

  /// Names of the values beyond stress and strain that this material can show (void_ratio, ...).
  [[nodiscard]] virtual std::vector<std::string> field_names() const { return {}; }
  /// The committed values of those fields at one point, in the order of field_names().
  virtual void fields(std::size_t point, std::span<double> values) const {
    (void)point;
    (void)values;
  }

  /// The cost and error that the material reports since it was allocated; empty for most.
  [[nodiscard]] virtual std::vector<Figure> figures() const { return {}; }
  /// The committed answers that the material cannot vouch for, in a sentence; empty: no such answer. For the end of a run.
  [[nodiscard]] virtual std::string doubt() const { return {}; }
  /// Events of the last commits that a user should read in the log, a sentence each; then forgotten.
  [[nodiscard]] virtual std::vector<std::string> take_notes() { return {}; }
};

}  // namespace polargrain::fem
