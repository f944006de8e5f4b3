// SPDX-License-Identifier: GPL-2.0-or-later
#include "element/driver.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "element/stiffness.hpp"

namespace polargrain::element {
namespace {

using Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Strains and volume are met to rounding before the material is asked.
constexpr double kGeometry = 1e-13;
constexpr int kGeometryIterations = 8;
/// A step of Newton's method is held to so many of the largest increments.
constexpr double kLongestCorrection = 2.0;
/// A step is cut whose guess or answer strains more than so many of the largest increments: one that is asked for as a
/// strain of that size is not.
constexpr double kLargestStep = 2.0;
/// A stage that changes its stresses by less than the first share of the pressure meets them to the second share of that change.
/// By the tolerance alone it would hardly move.
constexpr double kSmallChange = 0.05;
constexpr double kShareOfChange = 0.02;
/// Rounding of stresses, over the pressure.
constexpr double kRoundingOfStress = 1e-12;
/// A residual that is not below this share of the one before shows a tangent that is not the answer's own.
constexpr double kGoodShare = 0.5;
/// Steps without loading that bring the stress back after a jump.
constexpr int kCorrections = 6;

Vector6 upper(const Matrix3d& h) {
  Vector6 values;
  for (int place = 0; place < 6; ++place) {
    const auto [i, j] = kIndices[static_cast<std::size_t>(place)];
    values(place) = h(i, j);
  }
  return values;
}

/// By how much a stage asks a stress to change; 0: it does not, or no stress is prescribed.
/// @param goes_on whether the start is what was asked for before. Else it is a stress as it was found, off by tolerances
double asked_change(const Constraint& constraint, double start, bool goes_on) {
  if (constraint.kind != Constraint::Kind::stress) return 0.0;
  const double amount = constraint.amount;
  switch (constraint.way) {
    case Constraint::Way::hold:
      break;
    case Constraint::Way::reach:
      if (goes_on) return std::abs(amount - start);
      return amount == 0.0 ? 0.0 : std::max(std::abs(amount), std::abs(amount - start));
    case Constraint::Way::cycle:
      return std::abs(amount);
    case Constraint::Way::scale:
      return std::abs(start * (amount - 1.0));
  }
  return 0.0;
}

/// How a step ended.
struct Trial {
  bool accepted = false;
  Vector6 strain = Vector6::Zero();
  CellResponse response;
  double residual = 0.0;  ///< of the stresses, over the pressure
  bool usable = false;    ///< response is an answer that may be committed
  double size = 0.0;      ///< largest component of the increment
  std::string reason;     ///< when it was not accepted
};

class Follower {
 public:
  Follower(MaterialPoint& point, const Accuracy& accuracy) : point_(point), accuracy_(accuracy) {}

  Outcome run(std::span<const Stage> stages, const std::function<void(const Row&)>& on_row);

 private:
  void start_stage(const Stage& stage);
  /// @returns why the row cannot be reached; empty: it is
  std::string advance(const Stage& stage, int row);
  /// @returns the same, of what is left of a jump at the end of a row
  std::string bring_back(double t);
  /// Whether the committed state is what is asked for at stage time t.
  [[nodiscard]] bool is_met(double t) const;
  /// @param is_last nothing shorter is left to be tried: guesses that are too long are shortened
  Trial step(double t, bool is_last);
  Trial evaluate(const Vector6& strain);
  void commit(const Trial& trial);
  void record(int stage, int row, std::vector<Row>& rows);
  void correct_geometry(Vector6& strain, double t) const;
  [[nodiscard]] double volume_of(const Vector6& strain) const;
  [[nodiscard]] CellIncrement increment_to(const Vector6& strain) const;
  [[nodiscard]] double value(const Constraint& constraint, const Vector6& stress,
                             const Vector6& strain) const;
  /// value - target of every constraint; stresses over the pressure
  [[nodiscard]] Vector residuals(const Vector6& stress, const Vector6& strain, double t) const;
  [[nodiscard]] double stress_residual(const Vector& residuals) const;
  [[nodiscard]] std::string worst(const Vector& residuals) const;
  /// d residuals / d strains that can change
  [[nodiscard]] Matrix jacobian(const CellResponse& response, const Vector6& strain) const;
  [[nodiscard]] Vector6 spread(const Vector& of_free) const;

  MaterialPoint& point_;
  const Accuracy& accuracy_;
  const Stage* stage_ = nullptr;
  std::vector<int> free_;  ///< places that can be strained
  std::vector<double> starts_;
  Vector6 strain_ = Vector6::Zero();  ///< committed, from the last zero
  CellResponse response_;             ///< committed
  CellResponse at_rest_;              ///< before anything has moved
  double volume_before_zero_ = 1.0;
  double pore_pressure_ = 0.0;  ///< at the start of the stage
  Vector6 stress_at_start_ = Vector6::Zero();
  double residual_ = 0.0;
  double tolerance_ = 0.0;  ///< of the stage
  int row_steps_ = 0;
  int row_evaluations_ = 0;
  int jumps_ = 0;
};

double Follower::volume_of(const Vector6& strain) const {
  if (!point_.is_large()) return 1.0 + strain.head<3>().sum();
  return (1.0 + strain(k11)) * (1.0 + strain(k22)) * (1.0 + strain(k33));  // no gradient below the diagonal
}

CellIncrement Follower::increment_to(const Vector6& strain) const {
  Matrix3d h = gradient_of(strain - strain_);
  if (point_.is_large()) {
    const Matrix3d at_start = Matrix3d::Identity() + gradient_of(strain_);
    h = Matrix3d(h * at_start.inverse()).triangularView<Eigen::Upper>();
  }
  return increment_over(h);
}

double Follower::value(const Constraint& constraint, const Vector6& stress, const Vector6& strain) const {
  switch (constraint.kind) {
    case Constraint::Kind::stress:
      return constraint.weights.dot(stress);
    case Constraint::Kind::strain:
      return constraint.weights.dot(strain);
    case Constraint::Kind::volume:
      break;
  }
  return volume_of(strain);
}

Vector Follower::residuals(const Vector6& stress, const Vector6& strain, double t) const {
  Vector r(static_cast<Eigen::Index>(stage_->constraints.size()));
  for (std::size_t k = 0; k < stage_->constraints.size(); ++k) {
    const Constraint& constraint = stage_->constraints[k];
    double& one = r(static_cast<Eigen::Index>(k));
    one = value(constraint, stress, strain) - target(constraint, stage_->cycles, starts_[k], t);
    if (constraint.kind == Constraint::Kind::stress) one /= accuracy_.pressure;
  }
  return r;
}

double Follower::stress_residual(const Vector& residuals) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < stage_->constraints.size(); ++k)
    if (stage_->constraints[k].kind == Constraint::Kind::stress)
      largest = std::max(largest, std::abs(residuals(static_cast<Eigen::Index>(k))));
  return largest;
}

std::string Follower::worst(const Vector& residuals) const {
  std::size_t which = 0;
  double largest = -1.0;
  for (std::size_t k = 0; k < stage_->constraints.size(); ++k) {
    const double one = std::abs(residuals(static_cast<Eigen::Index>(k)));
    if (stage_->constraints[k].kind != Constraint::Kind::stress || one <= largest) continue;
    largest = one;
    which = k;
  }
  return stage_->constraints[which].name;
}

Matrix Follower::jacobian(const CellResponse& response, const Vector6& strain) const {
  const auto size = static_cast<Eigen::Index>(free_.size());
  const Matrix6 of_stress = stiffness_of(response);
  const Matrix3d at_start_inverse = point_.is_large()
                                        ? Matrix3d((Matrix3d::Identity() + gradient_of(strain_)).inverse())
                                        : Matrix3d::Identity();
  Matrix j = Matrix::Zero(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    Vector6 unit = Vector6::Zero();
    const int place = free_[static_cast<std::size_t>(column)];
    unit(place) = 1.0;
    const Vector6 of_increment = upper(gradient_of(unit) * at_start_inverse);
    for (Eigen::Index row = 0; row < size; ++row) {
      const Constraint& constraint = stage_->constraints[static_cast<std::size_t>(row)];
      if (constraint.kind == Constraint::Kind::stress)
        j(row, column) = constraint.weights.dot(of_stress * of_increment) / accuracy_.pressure;
      else if (constraint.kind == Constraint::Kind::strain)
        j(row, column) = constraint.weights(place);
      else if (place <= k33)
        j(row, column) = point_.is_large() ? volume_of(strain) / (1.0 + strain(place)) : 1.0;
    }
  }
  return j;
}

Vector6 Follower::spread(const Vector& of_free) const {
  Vector6 all = Vector6::Zero();
  for (std::size_t k = 0; k < free_.size(); ++k) all(free_[k]) = of_free(static_cast<Eigen::Index>(k));
  return all;
}

/// Moves a guess by the shortest way to where strains and volume are as asked.
void Follower::correct_geometry(Vector6& strain, double t) const {
  for (int iteration = 0; iteration < kGeometryIterations; ++iteration) {
    const Vector r = residuals(Vector6::Zero(), strain, t);
    const Matrix j = jacobian(CellResponse{}, strain);
    std::vector<Eigen::Index> rows;
    double largest = 0.0;
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      if (stage_->constraints[static_cast<std::size_t>(k)].kind == Constraint::Kind::stress) continue;
      rows.push_back(k);
      largest = std::max(largest, std::abs(r(k)));
    }
    if (largest <= kGeometry) return;
    const Matrix of_rows = j(rows, Eigen::all);
    const Vector wanted = r(rows);
    strain -= spread(of_rows.completeOrthogonalDecomposition().solve(wanted));
  }
}

Trial Follower::evaluate(const Vector6& strain) {
  Trial trial;
  trial.strain = strain;
  const CellIncrement increment = increment_to(strain);
  trial.size = increment.displacement_gradient.cwiseAbs().maxCoeff();
  trial.response = point_.evaluate(increment);
  ++row_evaluations_;
  return trial;
}

bool Follower::is_met(double t) const {
  const Vector r = residuals(six(response_.stress), strain_, t);
  double of_geometry = 0.0;
  for (std::size_t k = 0; k < stage_->constraints.size(); ++k)
    if (stage_->constraints[k].kind != Constraint::Kind::stress)
      of_geometry = std::max(of_geometry, std::abs(r(static_cast<Eigen::Index>(k))));
  return of_geometry <= kGeometry && stress_residual(r) <= tolerance_;
}

/// One step from the committed state to stage time t.
Trial Follower::step(double t, bool is_last) {
  Matrix j = jacobian(response_, strain_);
  Vector r = residuals(six(response_.stress), strain_, t);
  Vector6 strain = strain_;
  Trial best;
  double before = 0.0;
  for (int iteration = 0; iteration < accuracy_.iterations; ++iteration) {
    Vector change = -j.fullPivLu().solve(r);
    const double longest = kLongestCorrection * accuracy_.largest_increment;
    if (iteration == 0 && !(change.cwiseAbs().maxCoeff() <= longest)) {
      // Close to a peak the tangent of loading is far too soft for a way back. The tangent at rest is stiff enough.
      const Matrix stiff = jacobian(at_rest_, strain_);
      const Vector shorter = -stiff.fullPivLu().solve(r);
      if (shorter.allFinite() && !(shorter.norm() >= change.norm())) {
        change = shorter;
        j = stiff;
      }
    }
    if (!change.allFinite() || (iteration == 0 && (j * change + r).norm() > 1e-6 * r.norm())) {
      best.reason = fmt::format("the tangent of the material leaves {} undetermined", worst(r));
      return best;
    }
    // Where everything is a strain the first guess is the answer, of whatever size it was asked for.
    const double length = change.cwiseAbs().maxCoeff();
    if ((iteration > 0 || is_last) && length > longest) change *= longest / length;
    const Vector6 last = strain;
    strain += spread(change);
    correct_geometry(strain, t);
    const double asked = increment_to(strain).displacement_gradient.cwiseAbs().maxCoeff();
    if (!is_last && asked > kLargestStep * accuracy_.largest_increment) {
      best.size = asked;
      best.reason = fmt::format("{} would take a strain of {:.2g} at once (largest_increment {:.2g})",
                                worst(r), asked, accuracy_.largest_increment);
      return best;
    }
    Trial trial = evaluate(strain);
    if (trial.response.quality == Quality::failed) {
      best.reason = trial.response.message;
      return best;
    }
    const Vector answer = residuals(six(trial.response.stress), strain, t);
    trial.residual = stress_residual(answer);
    trial.usable = trial.response.quality == Quality::good;
    if (trial.residual <= tolerance_) {
      trial.accepted = trial.usable;
      trial.reason = trial.response.message;
      return trial;
    }
    trial.reason = fmt::format("{} stays {:.2e} of the pressure off", worst(answer), trial.residual);
    if (!trial.usable) trial.reason += fmt::format(" ({})", trial.response.message);
    if (iteration == 0 || trial.residual < kGoodShare * before) {
      j = jacobian(trial.response, strain);
    } else {  // Broyden 1965: the least change of the matrix that explains what the last step has done
      Vector done(static_cast<Eigen::Index>(free_.size()));
      for (std::size_t k = 0; k < free_.size(); ++k)
        done(static_cast<Eigen::Index>(k)) = strain(free_[k]) - last(free_[k]);
      if (const double square = done.squaredNorm(); square > 0.0)
        j += ((answer - r) - j * done) * done.transpose() / square;
    }
    r = answer;
    before = trial.residual;
    if (trial.usable && (!best.usable || trial.residual < best.residual))
      best = std::move(trial);
    else if (!best.usable)
      best.reason = trial.reason;
  }
  return best;
}

void Follower::commit(const Trial& trial) {
  point_.commit();
  strain_ = trial.strain;
  response_ = trial.response;
  residual_ = trial.residual;
  ++row_steps_;
}

void Follower::start_stage(const Stage& stage) {
  const Stage* const before = stage_;
  const std::vector<double> starts_before = starts_;
  if (stage_ != nullptr && stage_->pore >= 0)
    pore_pressure_ += six(response_.stress)(stage_->pore) - stress_at_start_(stage_->pore);
  if (stage.pore < 0) pore_pressure_ = 0.0;
  stage_ = &stage;
  if (stage.zero) {
    volume_before_zero_ *= volume_of(strain_);
    strain_.setZero();
  }
  stress_at_start_ = six(response_.stress);
  starts_.clear();
  double asked = 0.0;  // the largest change of a stress
  for (const Constraint& constraint : stage.constraints) {
    bool goes_on = false;
    double start = value(constraint, stress_at_start_, strain_);
    // A stress that was prescribed goes on from what was asked for, not from how well that was met.
    if (constraint.kind == Constraint::Kind::stress && before != nullptr)
      for (std::size_t k = 0; k < before->constraints.size(); ++k)
        if (before->constraints[k].kind == constraint.kind &&
            before->constraints[k].weights == constraint.weights) {
          start = target(before->constraints[k], before->cycles, starts_before[k], 1.0);
          goes_on = true;
        }
    starts_.push_back(start);
    asked = std::max(asked, asked_change(constraint, start, goes_on));
  }
  tolerance_ = accuracy_.tolerance;
  asked /= accuracy_.pressure;
  if (asked > 0.0 && asked < kSmallChange)
    tolerance_ = std::min(tolerance_, std::max(kShareOfChange * asked, kRoundingOfStress));
}

std::string Follower::advance(const Stage& stage, int row) {
  // Places within a row are counted in its smallest parts, so that its end is met to the bit.
  const int parts = 1 << accuracy_.cuts;
  const auto time_at = [&](int part) {
    return part == parts ? static_cast<double>(row) / stage.rows
                         : (row - 1 + static_cast<double>(part) / parts) / stage.rows;
  };
  int at = is_met(time_at(parts)) ? parts : 0;
  int length = parts;
  while (at < parts) {
    length = std::min(length, parts - at);
    Trial trial = step(time_at(at + length), length == 1);
    if (trial.size > kLargestStep * accuracy_.largest_increment && length > 1) trial.accepted = false;
    if (trial.accepted) {
      commit(trial);
      at += length;
      length *= 2;
      // Steps start where a step of their length can: the end of the row is then met.
      while (length > 1 && at % length != 0) length /= 2;
      continue;
    }
    if (length > 1) {
      length /= 2;
      continue;
    }
    if (!trial.usable || jumps_ >= accuracy_.jumps) return trial.reason;
    ++jumps_;
    Trial taken = evaluate(trial.strain);  // the point holds another trial by now
    taken.residual = trial.residual;
    commit(taken);
    at += length;
  }
  return residual_ <= tolerance_ ? "" : bring_back(time_at(parts));
}

std::string Follower::bring_back(double t) {
  std::string reason;
  for (int attempt = 0; attempt < kCorrections; ++attempt) {
    Trial trial = step(t, true);
    if (trial.accepted) {
      commit(trial);
      return "";
    }
    reason = trial.reason;
    if (!trial.usable || jumps_ >= accuracy_.jumps) break;
    ++jumps_;
    Trial taken = evaluate(trial.strain);
    taken.residual = trial.residual;
    commit(taken);
  }
  return reason;
}

void Follower::record(int stage, int row, std::vector<Row>& rows) {
  Row made;
  made.stage = stage;
  made.number = row;
  made.strain = strain_;
  made.volume = volume_of(strain_);
  made.total_volume = volume_before_zero_ * made.volume;
  made.stress = six(response_.stress);
  made.pore_pressure = pore_pressure_;
  if (stage_->pore >= 0) made.pore_pressure += made.stress(stage_->pore) - stress_at_start_(stage_->pore);
  made.residual = residual_;
  made.steps = row_steps_;
  made.evaluations = row_evaluations_;
  made.jumps = jumps_;
  made.fields = point_.fields();
  rows.push_back(std::move(made));
  row_steps_ = row_evaluations_ = 0;
}

Outcome Follower::run(std::span<const Stage> stages, const std::function<void(const Row&)>& on_row) {
  Outcome outcome;
  for (int place = 0; place < 6; ++place)
    if (can_strain(point_.room(), place)) free_.push_back(place);
  response_ = at_rest_ = point_.initial();
  if (response_.quality == Quality::failed) {
    outcome.failure = response_.message;
    return outcome;
  }
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Stage& stage = stages[k];
    start_stage(stage);
    const int number = static_cast<int>(k);
    if (k == 0 || stage.zero) {
      record(number, 0, outcome.rows);
      if (on_row) on_row(outcome.rows.back());
    }
    for (int row = 1; row <= stage.rows; ++row) {
      if (const std::string reason = advance(stage, row); !reason.empty()) {
        outcome.failure = fmt::format(
            "stage {} ({}), row {} of {}: {}; a step was cut to 1/{} of the row, {} of {} "
            "jumps were taken",
            k + 1, stage.name, row, stage.rows, reason, 1 << accuracy_.cuts, jumps_, accuracy_.jumps);
        return outcome;
      }
      record(number, row, outcome.rows);
      if (on_row) on_row(outcome.rows.back());
    }
  }
  return outcome;
}

}  // namespace

Outcome follow(MaterialPoint& point, std::span<const Stage> stages, const Accuracy& accuracy,
               const std::function<void(const Row&)>& on_row) {
  return Follower(point, accuracy).run(stages, on_row);
}

}  // namespace polargrain::element
