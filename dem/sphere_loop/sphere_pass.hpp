// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The data that the compiled kernels of the loop over spheres read and write: plain numbers and pointers, because each kernel is
// compiled for an instruction set of its own (dem/lanes/vectors.hpp).
#include "dem/laws/law_settings.hpp"

namespace polargrain::dem {

/// Candidates are treated in blocks of so many, however many lanes an instruction set has.
inline constexpr int kBlock = 8;

/// A grain is three rows of four numbers: place and radius | velocity, 0 | spin, 0. A row of nothing fills two cache lines.
inline constexpr int kGrainStride = 16;
/// The resultant of its contacts, two rows: force, 0 | torque, 0.
inline constexpr int kForceStride = 8;
/// An image of the box, two rows: place, 0 | velocity, 0.
inline constexpr int kImageStride = 8;

/// Numbers that a candidate keeps while its list lasts. Between Hertzian spheres stiffnesses are over the root of the
/// overlap, dashpots over its fourth root.
enum SphereConstant {
  kNormalStiffness,
  kTangentialStiffness,
  kFriction,           ///< mu_s
  kNormalDashpot,      ///< N s/m
  kTangentialDashpot,  ///< N s/m
  kRollingStiffness,   ///< N m
  kRollingReach,       ///< the rolling moment at its limit over the normal force, m
  kForceStiffness,     ///< of the rolling friction force of li_chu, N/m
  kForceFriction,      ///< mu_r
  kForceDashpot,       ///< N s/m
  kRollingDashpot,     ///< N m s
  kHarmonicRadius,     ///< r_1 r_2 / (r_1 + r_2), m
  kSphereConstants
};

/// Where the springs of a contact stand.
enum SphereSpring {
  kSliding = 0,              ///< three components, m
  kBending = 3,              ///< li_chu: three components, rad; epsd2: its moment, N m
  kTorsion = 6,              ///< rad
  kRollingDisplacement = 7,  ///< li_chu with a rolling friction force: three components, m
  kSphereSprings = 10
};

/// The record of a candidate, in this order, lane by lane of its block.
enum SphereRecord {
  kIsTouching,
  kDelta,             ///< three: from the centre of the second to that of the first, m
  kForce = 4,         ///< three: on the first, N
  kMoment = 7,        ///< three: rolling resistance on the second, N m
  kArms = 10,         ///< two: centre to contact point, m
  kStiffnesses = 12,  ///< two: normal, tangential, N/m
  kDashpots = 14,     ///< two: normal, tangential, N s/m
  kRolling = 16,      ///< stiffness, N m
  kRollingLimit,      ///< N m
  kIsRolling,         ///< the bending spring stands at its limit
  kIsTwisting,        ///< the torsion spring stands at its limit
  kSphereRecords
};

/// One pass over the candidates: forces from places, velocities and springs. Candidates stand in four zones, each
/// filled up to whole blocks with pairs of dummies that never touch:
///
///     touching in the box | near | touching across its faces | near
///
/// Touching ones are treated always, near ones, in order of their gaps, up to the reach.
struct SpherePass {
  const double* grains;
  double* forces;  ///< the pass adds to them
  const double* images;
  const unsigned* first;   ///< number at which the rows of the first grain begin
  const unsigned* second;  ///< of the second
  const unsigned* image;   ///< of its image
  const double* radius_first;
  const double* radius_second;
  const double* constants[kSphereConstants];
  double* springs[kSphereSprings];
  int touching, interior, touching_across, count;  ///< ends of the zones
  const double* gaps;                              ///< least gap of each block when the list was made, m
  unsigned char* active;     ///< of each block: some pair of it touched in the last pass
  double reach;              ///< pairs with a larger gap in the list cannot touch, m
  double step;               ///< s
  bool advance;              ///< springs move by a step
  bool bends;                ///< there is a rate of curvature
  double curvature_rate[9];  ///< row after row, rad/(m s)
  LawSettings settings;
  double* records;  ///< kSphereRecords numbers a candidate, block by block; null: nothing is taken down
};

/// One pass over the grains: the second half of a step and the first half of the next.
struct SphereMotion {
  double* grains;
  double* forces;         ///< set to zero
  double* accelerations;  ///< as forces: m/s^2, rad/s^2
  double* turned;         ///< rows: rotation in the laboratory, rad
  const double* inverse_mass;
  const double* inverse_inertia;
  int count;
  double step, damping_rate;
  // Of the step that ends; matrices column after column.
  double gradient[9], spin[3];
  // Of the step that begins.
  double change[9], change_of_spin[3];
  double flow[9];          ///< affine velocity gradient where the grains are when it begins
  double turn_of_spin[9];  ///< the frame times the time step
  double turn[3];          ///< of the frame, rad
};

struct SphereKernels {
  using Pass = void (*)(const SpherePass&);
  /// [hertz][tangential law][rolling law, with torsion behind the others][bare: no settings]
  Pass pass[2][2][4][2];
  /// First half of a step. @param ends the one before ends first @returns square of the largest speed against the flow
  double (*begin_step)(const SphereMotion&, bool ends);
  /// Second half of a step; keeps the accelerations.
  void (*end_step)(const SphereMotion&);
};

const SphereKernels& plain_sphere_kernels();
const SphereKernels& sphere_kernels_of_two_lanes();
const SphereKernels& sphere_kernels_of_four_lanes();
const SphereKernels& sphere_kernels_of_eight_lanes();

}  // namespace polargrain::dem
