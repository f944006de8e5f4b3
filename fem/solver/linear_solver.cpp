// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/linear_solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <optional>
#include <utility>

#include "fem/solver/direct_solver.hpp"
#include "fem/solver/multilevel.hpp"

namespace polargrain::fem {

struct LinearSolver::Implementation {
  Implementation(CoarseSpace of_mesh, int most_direct)
      : space(std::move(of_mesh)), direct_unknowns(most_direct) {
    if (space.groups.unknowns() > direct_unknowns) iterative.emplace(space, direct_unknowns);
  }

  CoarseSpace space;
  int direct_unknowns;
  std::optional<MultilevelSolver> iterative;
  DirectSolver direct;
  const Eigen::SparseMatrix<double>* matrix = nullptr;
  bool tries_iterations = true;
  bool is_direct = true;  ///< the matrix factorised last
  bool was_told = false;  ///< how iterations are made
  std::string news;

  void tell(const std::string& text) { news += (news.empty() ? "" : "; ") + text; }

  /// The direct solution in place of iterations. @param why "they do not converge"
  bool give_up_iterations(const char* why) {
    is_direct = true;
    tries_iterations = false;
    iterative.emplace(space, direct_unknowns);  // its memory is needed
    const bool solved = direct.factorise(*matrix);
    tell(fmt::format("iterations for {} unknowns end: {}; {}", matrix->rows(), why,
                     solved ? "direct solutions (UMFPACK) until the end of the step" : direct.why_not()));
    return solved;
  }
};

LinearSolver::LinearSolver(CoarseSpace space, int direct_unknowns)
    : implementation_(std::make_unique<Implementation>(std::move(space), direct_unknowns)) {}

LinearSolver::~LinearSolver() = default;

void LinearSolver::change_pattern(CoarseSpace space) {
  std::string unread = std::move(implementation_->news);
  implementation_ = std::make_unique<Implementation>(std::move(space), implementation_->direct_unknowns);
  implementation_->news = std::move(unread);
}

void LinearSolver::begin_step() {
  implementation_->tries_iterations = true;
}

bool LinearSolver::factorise(const Eigen::SparseMatrix<double>& matrix) {
  if (matrix.rows() == 0) return true;
  Implementation& own = *implementation_;
  if (!Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return false;
  own.matrix = &matrix;
  own.is_direct = !own.iterative || !own.tries_iterations;
  if (own.is_direct) return own.direct.factorise(matrix);
  if (!own.iterative->factorise(matrix)) return own.give_up_iterations("a level is singular");
  if (!std::exchange(own.was_told, true))
    own.tell(fmt::format("linear systems are solved by iterations on levels of {} unknowns",
                         fmt::join(own.iterative->unknowns_of_levels(), ", ")));
  return true;
}

Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& right_side) const {
  if (right_side.size() == 0) return right_side;
  Implementation& own = *implementation_;
  if (!own.is_direct) {
    if (std::optional<Eigen::VectorXd> solution = own.iterative->solve(right_side))
      return *std::move(solution);
    if (!own.give_up_iterations("they do not converge"))
      return Eigen::VectorXd::Constant(right_side.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return own.direct.solve(right_side);
}

int LinearSolver::sign_of_determinant() const {
  return implementation_->is_direct ? implementation_->direct.sign_of_determinant() : 0;
}

std::string LinearSolver::news() {
  return std::exchange(implementation_->news, {});
}

}  // namespace polargrain::fem
