// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/element/dofs.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/material/material.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/ties.hpp"
#include "fem/solver/time_table.hpp"

namespace polargrain::fem {

/// A displacement (m) or micro-rotation (rad) that is given: a support when the table is constant zero.
struct PrescribedDof {
  std::string on;  ///< boundary or node set
  Dof dof;
  TimeTable value;
  /// Factor by position; 1 everywhere when empty.
  std::function<double(const Eigen::Vector2d&)> profile;
};

/// Traction on a boundary, per area: t = -pressure n + traction, and couple traction about e_3.
struct EdgeLoad {
  std::string on;                                        ///< boundary
  TimeTable pressure = TimeTable::constant(0.0);         ///< Pa, pushing into the body when positive
  TimeTable traction1 = TimeTable::constant(0.0);        ///< Pa, along e_1
  TimeTable traction2 = TimeTable::constant(0.0);        ///< Pa, along e_2
  TimeTable couple_traction = TimeTable::constant(0.0);  ///< N/m
};

/// Force (N/m of thickness) or moment (N) on each node of a boundary or node set.
struct NodeLoad {
  std::string on;
  Dof dof;
  TimeTable value;
};

/// Force per volume (b1, b2 in N/m^3) and couple per volume (c in N/m^2), by position.
struct BodyLoad {
  std::function<Eigen::Vector3d(const Eigen::Vector2d&)> density;
  TimeTable factor = TimeTable::constant(1.0);
  std::string region = "";  ///< every element when empty
};

/// Stress at time 0 by position, in place of the materials' own.
struct InitialStress {
  std::function<Vector7(const Eigen::Vector2d&)> stress;
  std::string region = "";  ///< every element when empty
};

enum class Deformation {
  small,  ///< equilibrium and strain on the mesh as it was made
  /// On the mesh where it is (updated Lagrangian); stresses turn with the material, pressures follow the
  /// boundary, and the tangent knows both.
  large
};

/// A boundary value problem: everything the solver needs, per unit thickness.
struct Problem {
  Mesh mesh;
  Continuum continuum = Continuum::cosserat;
  Deformation deformation = Deformation::small;
  /// Material of each region; together the regions named here must cover every element exactly once.
  std::map<std::string, std::shared_ptr<Material>> materials;
  std::vector<PrescribedDof> prescribed;
  std::vector<Tie> ties = {};
  std::vector<EdgeLoad> edge_loads;
  std::vector<NodeLoad> node_loads;
  std::vector<BodyLoad> body_loads;
  std::vector<InitialStress> initial_stresses;
};

/// The prescribed dofs in the order in which they hold: those on a set of nodes go before those on a boundary, which go
/// before those on the set `all`; the first that names a node gives its value there.
std::vector<const PrescribedDof*> in_precedence(const Problem& problem);

/// All faults of a problem, one message each: unknown names, elements with no or two materials, a dof
/// prescribed twice with different values by items of one precedence, ties whose sides do not match, distorted elements, rigid motions that no support holds. Runs no
/// material, so that a case can be checked before anything starts. Materials may still be null.
std::vector<std::string> faults(const Problem& problem);

/// Rigid motions of the body that prescribed dofs and ties leave free: "translation along 1", "translation along
/// 2", "rotation", or "a rotation about (x, y)" when only a rotation about that point is free.
std::vector<std::string> free_rigid_motions(const Mesh& mesh, Continuum continuum,
                                            const std::vector<PrescribedDof>& prescribed,
                                            const std::vector<Tie>& ties = {});

}  // namespace polargrain::fem
