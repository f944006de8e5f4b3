// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fem/element/dofs.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/material/material.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/nodal_field.hpp"
#include "fem/solver/stages.hpp"
#include "fem/solver/ties.hpp"
#include "fem/solver/time_table.hpp"

namespace polargrain::fem {

/// A displacement (m) or micro-rotation (rad) that is given: a support when the table is constant zero.
template <int dim>
struct PrescribedDof {
  std::string on;  ///< boundary or node set
  Dof dof;
  TimeTable value;
  /// Factor by position; 1 everywhere when empty.
  std::function<double(const typename Cosserat<dim>::Place&)> profile = {};
  Lifetime life = {};
  /// Of a support that begins in a later stage: the value counts from where the node is then. Else the node moves to the
  /// value as the forces held back in that stage are let go.
  bool from_here = true;
};

/// Nodes that share one displacement or micro-rotation, whatever it is: a stiff, smooth plate.
struct EqualDof {
  std::string on;  ///< boundary or node set
  Dof dof;
};

/// So many tables that are zero.
template <std::size_t count>
std::array<TimeTable, count> zero_tables() {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return std::array<TimeTable, count>{((void)i, TimeTable::constant(0.0))...};
  }
  (std::make_index_sequence<count>());
}

/// Traction on a boundary, per area: t = -pressure n + traction, and couple traction.
template <int dim>
struct BoundaryLoad {
  std::string on;                                            ///< boundary
  TimeTable pressure = TimeTable::constant(0.0);             ///< Pa, pushing into the body when positive
  std::array<TimeTable, dim> traction = zero_tables<dim>();  ///< Pa, along each axis
  /// N/m, about e_3; in space about each axis.
  std::array<TimeTable, Cosserat<dim>::rotations> couple_traction = zero_tables<Cosserat<dim>::rotations>();
  Lifetime life = {};
};

/// Force (N; in the plane N/m of thickness) or moment (N m; N) at each place of a boundary or node set. Nodes at one place share
/// it: an interface has made several of one.
struct NodeLoad {
  std::string on;
  Dof dof;
  TimeTable value;
  Lifetime life = {};
  std::string field = {};  ///< takes it in place of the dof where a node carries it: the rotation of a beam
};

/// Force per volume (N/m^3) along each axis and couple per volume (N/m^2) about each axis of rotation, by position.
template <int dim>
struct BodyLoad {
  std::function<typename Cosserat<dim>::NodeValues(const typename Cosserat<dim>::Place&)> density;
  TimeTable factor = TimeTable::constant(1.0);
  std::string region = "";  ///< every element when empty
  Lifetime life = {};
};

/// Stress at time 0 by position, in place of the materials' own.
template <int dim>
struct InitialStress {
  std::function<typename Cosserat<dim>::Vector(const typename Cosserat<dim>::Place&)> stress;
  std::string region = "";  ///< every element that is there at time 0 when empty
};

enum class Deformation {
  small,  ///< equilibrium and strain on the mesh as it was made
  /// On the mesh where it is (updated Lagrangian); stresses turn with the material, pressures follow the
  /// boundary, and the tangent knows both.
  large
};

/// A boundary value problem: everything the solver needs; in the plane per unit thickness.
template <int dim>
struct Problem {
  Mesh<dim> mesh;
  Continuum continuum = Continuum::cosserat;
  Deformation deformation = Deformation::small;
  /// Material of each region; together the regions named here must cover every element exactly once.
  std::map<std::string, std::shared_ptr<Material<dim>>> materials;
  std::vector<PrescribedDof<dim>> prescribed;
  std::vector<Tie> ties = {};
  std::vector<EqualDof> equal_dofs = {};
  std::vector<BoundaryLoad<dim>> boundary_loads;
  std::vector<NodeLoad> node_loads;
  std::vector<BodyLoad<dim>> body_loads;
  std::vector<InitialStress<dim>> initial_stresses;
  /// Names of the stages of construction, for messages; empty: there is one. Solver::begin_stage goes on to the next.
  std::vector<std::string> stages = {};
  /// The time at which each of them begins; not a number where nobody knows it before, and empty where the stages have no names.
  std::vector<double> stage_starts = {};
  /// Of the regions that come or go; all others are there in every stage.
  std::map<std::string, Lifetime> lifetimes = {};
  std::vector<NodalField> fields = {};
  std::vector<PrescribedField<dim>> prescribed_fields = {};
  /// The further terms of the balance at the nodes. One solver at a time works with them.
  std::vector<std::shared_ptr<Contribution<dim>>> contributions = {};

  /// Where nodal vectors keep the fields.
  [[nodiscard]] FieldPlaces<dim> places() const { return {mesh.nodes.size(), fields}; }
  // Of steps in real time (Solver::begin_real_time) alone.
  std::map<std::string, double> densities = {};  ///< kg/m^3, of each region, pores included
  /// Boundaries that let waves out: dashpots there (quiet_boundary.hpp). Displacements that are given on them hold them in the
  /// balance at the start, and the forces of that stay.
  std::vector<std::string> quiet = {};
};

/// The prescribed dofs of a stage in the order in which they hold: those on a set of nodes go before those on a boundary, which go
/// before those on the set `all`; the first that names a node gives its value there.
template <int dim>
std::vector<const PrescribedDof<dim>*> in_precedence(const Problem<dim>& problem, int stage = 0);
template <int dim>
std::vector<const PrescribedField<dim>*> fields_in_precedence(const Problem<dim>& problem, int stage = 0);

/// All faults of a problem, one message each: unknown names, elements with no or two materials, a dof
/// prescribed twice with different values by items of one precedence, ties whose sides do not match, distorted elements, rigid
/// motions that no support holds, in any stage. Runs no material, so that a case can be checked before anything starts.
/// Materials may still be null.
template <int dim>
std::vector<std::string> faults(const Problem<dim>& problem);

/// Rigid motions of the body that prescribed dofs and ties leave free: "translation along 1", "rotation", or "rotation about
/// (x, y)" when only a rotation about that point is free. In space also "screw motion along ..."
/// @param there elements of a stage (elements_in_stage) @param joined pairs of nodes that hang together without an element
template <int dim>
std::vector<std::string> free_rigid_motions(const Mesh<dim>& mesh, Continuum continuum,
                                            const std::vector<PrescribedDof<dim>>& prescribed,
                                            const std::vector<Tie>& ties = {},
                                            const std::vector<char>& there = {},
                                            const std::vector<std::pair<int, int>>& joined = {});
/// The same of a stage.
template <int dim>
std::vector<std::string> free_rigid_motions(const Problem<dim>& problem, int stage);

/// Pairs of nodes that the contributions of a problem hold together in a stage.
template <int dim>
std::vector<std::pair<int, int>> joined_nodes(const Problem<dim>& problem, int stage = 0);

}  // namespace polargrain::fem
