// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/increment.hpp"
#include "common/packing.hpp"
#include "common/response.hpp"
#include "common/state.hpp"

namespace polargrain {

/// Which tangent a cell returns with its stress: affine motion of the grains (cheap, far too stiff once
/// contacts slide), or the contact network condensed onto its own equilibrium (one sparse factorisation).
enum class CellTangent { none, voigt, condensed };

/// What is prescribed of the rotations of the grains (docs/theory.md, C.6): nothing, so that the stress is
/// symmetric (mode 1), or their mean, so that the cell also answers to the micro-rotation with a skew stress
/// (mode 2).
enum class CellRotations { free, controlled };

/// Which loop steps the grains of a cell. `automatic`: the loop over discs where it knows the scene
/// (docs/theory/grains.md), else the engine's own. The others are for comparison: always the engine's own, and
/// the plain twin of the loop over discs.
enum class CellLoop { automatic, engine, plain };

/// How a cell is loaded and when its answer counts as quasi-static (mechanics G.3).
struct CellControl {
  /// Mean loading rate as an inertial number I = rate * mean diameter * sqrt(grain density / pressure).
  double inertial_number = 6e-4;
  /// Read out when the mean unbalanced force over the mean contact force has fallen below this.
  double unbalanced_force_ratio = 5e-3;
  /// The same for moments: mean unbalanced moment over mean contact force times mean radius.
  double unbalanced_moment_ratio = 5e-3;
  /// Viscous damping against the affine flow, as a fraction of the critical damping of a mean grain on one
  /// mean contact: the rate is 2 damping sqrt(mean normal stiffness / mean mass).
  double damping = 0.12;
  /// Fewest DEM steps of a loading ramp; keeps small increments free of waves.
  int least_steps = 20;
  /// Relaxation ends unreliable after this many DEM steps.
  int most_relaxation_steps = 20000;
  CellTangent tangent = CellTangent::condensed;
  CellRotations rotations = CellRotations::free;
  CellLoop loop = CellLoop::automatic;
};

/// What a worker must know to stand in for cells of one material. Sent whole, so that a worker needs no file.
struct CellDefinition {
  std::string name;         ///< the material's name in the case
  std::string script_file;  ///< the user's file, for messages only
  std::string script;       ///< text of the input script (liggghts_inputs/)
  Packing packing;
  CellControl control;
};

/// One evaluation: from a state (or, when null, from the packing) along an increment.
struct CellRequest {
  StatePointer state;
  Increment increment;
};

/// Diagnostics of a cell at read-out.
struct CellDiagnostics {
  double unbalanced_force_ratio = 0.0;   ///< reached at read-out
  double unbalanced_moment_ratio = 0.0;  ///< reached at read-out
  double void_ratio = 0.0;               ///< in plane: (area of the box - area of grains) / area of grains
  double coordination_number = 0.0;      ///< 2 contacts / grains
  double sliding_fraction = 0.0;         ///< contacts at the sliding limit / contacts
  double multiplier = 0.0;  ///< s21 - s12 that holds the mean rotation, Pa; 0 with free rotations
  std::int64_t contacts = 0;
  std::int64_t dem_steps = 0;
  double engine_seconds = 0.0;    ///< wall time inside the engine; never part of a result
  double rolling_fraction = 0.0;  ///< contacts at the rolling limit / contacts (rolling models li_chu, epsd2)
  double rattlers = 0.0;          ///< grains without a contact / grains
  double mean_rotation = 0.0;     ///< of the grains, since the packing, rad
  double rotation_spread = 0.0;   ///< standard deviation of the rotations of the grains, rad
  /// Fabric tensor in the laboratory, F_ij = mean of n_i n_j over the contacts (trace 1): F11, F22, F12.
  std::array<double, 3> fabric{};
};

/// Answer of a cell. Stress and tangent are the cell's own (laboratory frame); Response::tangent is with
/// respect to the Cosserat strain.
struct CellReply {
  Response response;
  CellDiagnostics diagnostics;
  StatePointer state;  ///< state after the increment; null when the evaluation failed
};

/// One engine that stands in for the cells of one definition. What it answers depends on its arguments alone,
/// to the bit, so any engine made from an equal definition may take any request.
class CellService {
 public:
  virtual ~CellService() = default;
  /// The packing at rest: its stress, diagnostics, tangent and the state every cell starts from.
  virtual CellReply initial() = 0;
  /// @throws RunError when the request cannot be served (a state of another definition, a broken increment).
  virtual CellReply evaluate(const CellRequest& request) = 0;

  /// To be called now and then while the engine works, so that others know it is alive; may be empty.
  std::function<void()> progress;
};

/// Makes the engine for a definition; the worker calls it once per definition it is sent.
using CellServiceFactory = std::function<std::unique_ptr<CellService>(const CellDefinition&)>;

}  // namespace polargrain
