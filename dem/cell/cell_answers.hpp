// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/cell.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/time_step.hpp"
#include "dem/laws/combination.hpp"

namespace polargrain::dem {

/// The largest strain, rotation against the continuum, or curvature times mean diameter that a cell takes in one
/// increment.
inline constexpr double kLargestIncrement = 0.25;
/// The largest turn, rad, that a cell takes in one increment with all its grains: it changes no contact.
inline constexpr double kLargestTurn = 0.5;

/// Whether cells of this kind may be given a curvature. Those that are asked for their network (CellTangent::cosserat) are
/// sheared and turned, to find the moduli and limits of a packing, and never bent.
inline bool is_bent(const CellControl& control) {
  return control.tangent != CellTangent::cosserat;
}

/// Ends the process where rotations are controlled and the rolling model is one that would not feel a curvature.
void check_rolling_model(LAMMPS_NS::LAMMPS& lammps);

/// Gives the cell the contacts of its packing.
/// @param restore does it @throws RunError of restore, with the remedy for the user
void restore_packing(const std::function<void()>& restore);

/// The answer to an increment beyond kLargestIncrement or kLargestTurn, an iteration gone astray; nothing where it is not.
/// @param turn of the cell with all its grains, rad
std::optional<CellReply> gone_astray(double size, double turn);

/// Marks an answer as not to be committed, with the reason, where its grains did not come to rest, or are beyond the range
/// of the laws of their contacts or of the time step.
/// @param diagnostics of the answer, whose overlaps are judged
void judge(CellResponse& response, const CellDiagnostics& diagnostics, const QuasiStatic& protocol,
           const CellControl& control, const Equilibrium& rest, std::span<const Contact> contacts,
           const Inertia& inertia, double time_step, double most_void_ratio);

/// Which loop steps the grains of a scene, in words (kSteppingNote).
/// @param loop that takes the scenes it knows: "the loop over discs" @param selection its verdict on this scene
/// @param instructions that it is compiled for, or nothing
std::string stepping_note(CellLoop asked, const std::string& loop, const LawSelection& selection,
                          std::string_view instructions = {});

/// The remarks of a cell on its packing at rest, a line each: `remark`, if there is one, and its stepping_note.
std::string remarks_at_rest(const std::string& remark, const CellControl& control, const std::string& loop,
                            const LawSelection& selection, std::string_view instructions = {});

/// Why a scene cannot be stepped by resident boxes, and what to do.
std::string no_residents(const LawSelection& selection);

/// Diagnostics from the contacts of a cell, but for fabric and rotations. @param radii of the grains, m
CellDiagnostics diagnostics_of(const Equilibrium& rest, std::span<const Contact> contacts,
                               std::span<const double> radii);

}  // namespace polargrain::dem
