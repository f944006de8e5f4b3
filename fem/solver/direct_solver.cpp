// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/direct_solver.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <signal.h>
#include <unistd.h>

#include <Eigen/UmfPackSupport>
#include <array>

namespace polargrain::fem {
namespace {

/// Holds SIGTERM and SIGABRT back from this thread. METIS takes them over while it orders: it would swallow the wish to
/// stop, jump out of its own middle, and leave the ordering to another method, with other last bits of every result.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : kSignals) sigaddset(&held, signal);
    pthread_sigmask(SIG_BLOCK, &held, &mask_);
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], nullptr, &actions_[k]);
  }
  /// Signals that came meanwhile go to the handlers of before, with their flags, which METIS forgets.
  ~SignalsHeldBack() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &actions_[k], nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

 private:
  static constexpr std::array kSignals{SIGTERM, SIGABRT};
  sigset_t mask_{};
  std::array<struct sigaction, kSignals.size()> actions_{};
};

/// UMFPACK's estimates come with the analysis.
struct Factors : Eigen::UmfPackLU<Eigen::SparseMatrix<double>> {
  /// An upper bound, bytes.
  [[nodiscard]] double memory() const {
    return m_umfpackInfo[UMFPACK_PEAK_MEMORY_ESTIMATE] * m_umfpackInfo[UMFPACK_SIZE_OF_UNIT];
  }
  [[nodiscard]] int sign_of_determinant() const {
    double mantissa = 0.0;
    double exponent = 0.0;
    if (umfpack_di_get_determinant(&mantissa, &exponent, m_numeric, nullptr) != UMFPACK_OK) return 0;
    return (mantissa > 0.0 ? 1 : 0) - (mantissa < 0.0 ? 1 : 0);
  }
};

/// UMFPACK's bound allows for pivots off the diagonal, which these matrices hardly need.
constexpr double kBoundOverNeed = 2.0;

/// Of the machine, bytes.
double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

struct DirectSolver::Implementation {
  Factors lu;
  bool analysed = false;
  std::string why_not;
};

DirectSolver::DirectSolver() : implementation_(std::make_unique<Implementation>()) {
#ifdef __GLIBC__
  // The factors of every iteration go where the last ones were. Given back to the system in between, their
  // pages would be zeroed and mapped again each time, a fifth of the time of a factorisation.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
#endif
  // The pattern is symmetric even where values are not: diagonal pivots keep the fill of a symmetric
  // ordering, and nested dissection needs half the time of minimum degree at 100,000 unknowns.
  auto& control = implementation_->lu.umfpackControl();
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  control[UMFPACK_IRSTEP] = 0;  // Newton's iteration refines the solution itself
}
DirectSolver::~DirectSolver() = default;

void DirectSolver::forget_pattern() {
  implementation_->analysed = false;
}

bool DirectSolver::factorise(const Eigen::SparseMatrix<double>& matrix) {
  if (matrix.rows() == 0) return true;
  auto& [lu, analysed, why_not] = *implementation_;
  const Eigen::Map<const Eigen::VectorXd> values(matrix.valuePtr(), matrix.nonZeros());
  why_not = "the matrix has entries that are not finite";
  if (!values.allFinite()) return false;
  why_not = "the matrix is singular";
  if (!analysed) {
    const SignalsHeldBack held;
    lu.analyzePattern(matrix);
    if (lu.info() != Eigen::Success) return false;
    analysed = true;
  }
  // Beyond that the system would end the program in the middle.
  if (lu.memory() > kBoundOverNeed * physical_memory()) {
    why_not =
        fmt::format("a direct solution may need {:.0f} GB, more than this machine has", 1e-9 * lu.memory());
    return false;
  }
  lu.factorize(matrix);
  return lu.info() == Eigen::Success;
}

int DirectSolver::sign_of_determinant() const {
  return implementation_->lu.sign_of_determinant();
}

const std::string& DirectSolver::why_not() const {
  return implementation_->why_not;
}

Eigen::VectorXd DirectSolver::solve(const Eigen::VectorXd& right_side) const {
  if (right_side.size() == 0) return right_side;
  return implementation_->lu.solve(right_side);
}

}  // namespace polargrain::fem
