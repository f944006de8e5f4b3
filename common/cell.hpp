// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/cell_increment.hpp"
#include "common/cell_response.hpp"
#include "common/contact_library_file.hpp"
#include "common/packing.hpp"
#include "common/record.hpp"
#include "common/state.hpp"

namespace polargrain {

/// Which tangent a cell returns with its stress: affine motion of the grains (cheap, far too stiff once
/// contacts slide), or the contact network condensed onto its own equilibrium (one sparse factorisation).
/// `cosserat`: the condensed one with the mean rotation of the grains prescribed, also where their rotations are
/// free: the answer of the network to a skew strain and a curvature. `secant`: condensed where a tangent is asked for, which the
/// material does rarely (coupler/cells/secant_tangent.hpp).
enum class CellTangent { none, voigt, condensed, cosserat, secant };

/// The condition on the rotations of the grains (docs/theory.md, C.6): free, so that the stress is
/// symmetric (mode 1), or their mean prescribed, so that the cell also answers to the micro-rotation with a skew stress
/// (mode 2).
enum class CellRotations { free, controlled };

/// Which loop steps the grains of a cell. `automatic`: the loop over discs where it knows the scene
/// (docs/theory/grains.md), else the engine's own. The others are for comparison: always the engine's own, and
/// the plain twin of the loop over discs.
enum class CellLoop { automatic, engine, plain };

constexpr Choices choices_of(CellTangent) {
  return {0, 5};
}
constexpr Choices choices_of(CellRotations) {
  return {0, 2};
}
constexpr Choices choices_of(CellLoop) {
  return {0, 3};
}

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

template <RecordOf<CellControl> Record, class Visit>
void describe(Record& control, Visit&& visit) {
  visit(FieldNotes{"inertial_number", "1", "mean loading rate"}, control.inertial_number);
  visit(FieldNotes{"unbalanced_force_ratio", "1", "at read-out"}, control.unbalanced_force_ratio);
  visit(FieldNotes{"unbalanced_moment_ratio", "1", "at read-out"}, control.unbalanced_moment_ratio);
  visit(FieldNotes{"damping", "1", "share of the critical damping of a mean grain on one mean contact"},
        control.damping);
  visit(FieldNotes{"least_steps", "1", "fewest DEM steps of a loading ramp"}, control.least_steps);
  visit(FieldNotes{"most_relaxation_steps", "1", "DEM steps after which an answer is unreliable"},
        control.most_relaxation_steps);
  visit(FieldNotes{"tangent", "",
                   "0 none, 1 Voigt, 2 condensed, 3 condensed with the mean rotation prescribed"},
        control.tangent);
  visit(FieldNotes{"rotations", "", "0 free, 1 controlled"}, control.rotations);
  visit(FieldNotes{"loop", "", "0 automatic, 1 the engine's own, 2 plain"}, control.loop);
}

/// The knowledge of a worker about cells of one material. Sent whole, so that a worker needs no file.
struct CellDefinition {
  std::string name;         ///< the material's name in the case
  std::string script_file;  ///< the user's file, for messages only
  std::string script;       ///< text of the input script (liggghts_inputs/)
  Packing packing;
  CellControl control;
  ContactLibraryFile contact_library =
      {};  ///< on every worker's machine; empty: the laws of this project are enough
};

template <RecordOf<CellDefinition> Record, class Visit>
void describe(Record& definition, Visit&& visit) {
  visit(FieldNotes{"name", "", "name of the material in the case"}, definition.name);
  visit(FieldNotes{"script_file", "", "the user's script, for messages"}, definition.script_file);
  visit(FieldNotes{"script", "", "text of the script"}, definition.script);
  visit(FieldNotes{"packing", "", "the packing that cells start from"}, definition.packing);
  visit(FieldNotes{"control", "", "how cells are loaded and read out"}, definition.control);
  visit(FieldNotes{"contact_library", "", "contact laws of the user's own, or none"},
        definition.contact_library);
}

/// One evaluation: from a state (or, when null, from the packing) along an increment.
struct CellRequest {
  StatePointer state;
  CellIncrement increment;
};

/// Version of the folders that write_replay makes; `fix cell/load` reads it and 1, whose increments are those of the
/// plane. Raised with every change of their content.
inline constexpr int kReplayVersion = 2;

/// Diagnostics of a cell at read-out: the meaning of each field is given in its description below, once.
struct CellDiagnostics {
  double unbalanced_force_ratio = 0.0;
  double unbalanced_moment_ratio = 0.0;
  double void_ratio = 0.0;
  double coordination_number = 0.0;
  double sliding_fraction = 0.0;
  double rolling_fraction = 0.0;
  double rattlers = 0.0;
  double mean_overlap = 0.0;
  double largest_overlap = 0.0;
  double multiplier = 0.0;
  double mean_rotation = 0.0;
  double rotation_spread = 0.0;
  std::array<double, 3> fabric{};
  std::int64_t contacts = 0;
  std::int64_t dem_steps = 0;
  double engine_seconds = 0.0;
};

template <RecordOf<CellDiagnostics> Record, class Visit>
void describe(Record& d, Visit&& visit) {
  visit(FieldNotes{"void_ratio", "1", "in the plane, area of the voids / area of the grains"}, d.void_ratio);
  visit(FieldNotes{"coordination_number", "1", "2 contacts / grains"}, d.coordination_number);
  visit(FieldNotes{"unbalanced_force_ratio", "1", "mean unbalanced force / mean contact force"},
        d.unbalanced_force_ratio);
  visit(FieldNotes{"unbalanced_moment_ratio", "1",
                   "mean unbalanced moment / (mean contact force times mean radius)"},
        d.unbalanced_moment_ratio);
  visit(FieldNotes{"sliding_fraction", "1", "contacts at the sliding limit / contacts"}, d.sliding_fraction);
  visit(FieldNotes{"rolling_fraction", "1",
                   "contacts at the rolling limit / contacts (models `li_chu`, `epsd2`)"},
        d.rolling_fraction);
  visit(FieldNotes{"rattlers", "1", "grains without a contact / grains"}, d.rattlers);
  visit(FieldNotes{"mean_overlap", "1", "overlap / smaller radius, mean over the contacts"}, d.mean_overlap);
  visit(FieldNotes{"largest_overlap", "1", "overlap / smaller radius, of the worst contact"},
        d.largest_overlap);
  visit(FieldNotes{"multiplier", "Pa", "s21 - s12 that holds the mean rotation; 0 with free rotations"},
        d.multiplier);
  visit(FieldNotes{"mean_rotation", "rad", "mean rotation of the grains since the packing"}, d.mean_rotation);
  visit(FieldNotes{"rotation_spread", "rad", "standard deviation of the rotations of the grains"},
        d.rotation_spread);
  visit(FieldNotes{"fabric", "1", "mean of n_i n_j over the contacts in the laboratory, trace 1",
                   "_11 _22 _12"},
        d.fabric);
  visit(FieldNotes{"contacts", "1", "contacts in the cell"}, d.contacts);
  visit(FieldNotes{"dem_steps", "1", "DEM steps of the last evaluation"}, d.dem_steps);
  visit(FieldNotes{"engine_seconds", "s", "wall time inside the engine", {}, FieldUse::cost},
        d.engine_seconds);
}

/// Answer of a cell.
struct CellReply {
  CellResponse response;
  CellDiagnostics diagnostics;
  StatePointer state;  ///< state after the increment; null when the evaluation failed
};

template <RecordOf<CellReply> Record, class Visit>
void describe(Record& reply, Visit&& visit) {
  visit(FieldNotes{"response", "", "stress and tangent"}, reply.response);
  visit(FieldNotes{"diagnostics", "", "diagnostics at read-out"}, reply.diagnostics);
  visit(FieldNotes{"state", "", "state after the increment"}, reply.state);
}

class ResidentBoxes;

/// One engine that stands in for the cells of one definition. Its answer depends on its arguments alone,
/// to the bit, so any engine made from an equal definition may take any request.
class CellService {
 public:
  virtual ~CellService() = default;
  /// The packing at rest: its stress, diagnostics, tangent and the state every cell starts from.
  virtual CellReply initial() = 0;
  /// @throws RunError when the request cannot be served (a state of another definition, an increment
  /// that its grains cannot follow).
  virtual CellReply evaluate(const CellRequest& request) = 0;

  /// Boxes of these grains that stay where they are and go on (common/resident_boxes.hpp); no boxes at first. The service must
  /// outlive them. @throws RunError when only the engine's own loop can step these grains
  virtual std::unique_ptr<ResidentBoxes> residents();

  /// To be called now and then while the engine works, so that others know it is alive; may be empty.
  std::function<void()> progress;
};

/// Makes the engine for a definition; the worker calls it once per definition it is sent.
using CellServiceFactory = std::function<std::unique_ptr<CellService>(const CellDefinition&)>;

}  // namespace polargrain
