// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The data that the compiled kernels of the loop over discs read and write: plain numbers and pointers, because each kernel
// is compiled for an instruction set of its own (dem/lanes/vectors.hpp).
#include "dem/discs/disc.hpp"
#include "dem/laws/law_settings.hpp"

namespace polargrain::dem {

/// Candidates are filled up to whole blocks of so many, however many lanes an instruction set has.
inline constexpr int kDiscBlock = 8;
/// Numbers in the row of a disc, of a force on it, of an image.
inline constexpr unsigned kDiscRow = sizeof(Disc) / sizeof(double);
inline constexpr unsigned kForceRow = sizeof(DiscForce) / sizeof(double);
inline constexpr unsigned kImageRow = sizeof(MovingImage) / sizeof(double);

/// The record of a candidate: a number in each of these columns.
struct DiscRecord {
  enum Column {
    touches,        ///< 1, or 0
    delta,          ///< two: from the centre of the second disc to that of the first, m
    force = 3,      ///< two: on the first, N
    moment = 5,     ///< rolling resistance on the second, N m
    stiffnesses,    ///< two: normal, tangential, N/m
    dashpots = 8,   ///< two: normal, tangential, N s/m
    arms = 10,      ///< two: centre to contact point, m
    rolling = 12,   ///< stiffness, N m
    rolling_limit,  ///< N m
    is_rolling,     ///< the rolling spring stands at its limit
    columns
  };
};

/// One pass over the candidates: forces from places, velocities and springs. Rows of candidates of
/// one disc stand one behind the other; the discs at the end of the last block are far apart.
struct DiscPass {
  const Disc* discs;
  const MovingImage* images;
  DiscForce* forces;           ///< the pass adds to them
  DiscForce* row_sums;         ///< of each disc, over its own row; zero where the row is empty
  const unsigned* first;       ///< number at which the row of the first disc begins
  const unsigned* second;      ///< of the second disc
  const unsigned* image;       ///< of its image
  const int* kind;             ///< of the pair of types; null where there is one type
  const long long* continues;  ///< all bits set where the candidate before has the same first disc, else zero
  const double* radius_first;
  const double* radius_second;
  const double* harmonic;  ///< r_1 r_2 / (r_1 + r_2), m
  double* springs[kDiscSprings];
  const PairParameters* parameters;
  LawSettings settings;
  int candidates, count;  ///< in whole blocks; of discs
  double step;            ///< s
  double bend_x, bend_y;  ///< rate of curvature in the frame of the box, rad/(m s)
  bool advance;           ///< springs move by a step
  double* records;  ///< columns of DiscRecord, each as long as the candidates; null: nothing is taken down
};

/// One pass over the discs: the second half of a step and the first half of the next. Matrices row after row.
struct DiscMotionPass {
  Disc* discs;
  DiscForce* forces;  ///< set to zero
  DiscMotion* motions;
  int count;
  double step, damping_rate;  ///< s, 1/s
  // Of the step that ends.
  double gradient[4], spin;  ///< affine, 1/s
  // Of the step that begins.
  double change[4], change_of_spin;  ///< of the affine velocity gradient and of the spin, 1/s
  double flow[4];                    ///< affine velocity gradient where the discs are when it begins, 1/s
  double turn;                       ///< of the frame, rad
};

/// Kernels compiled for one instruction set. All give the same bits.
struct DiscKernels {
  using Pass = void (*)(const DiscPass&);
  /// [normal law][tangential law][rolling law][bare: no settings]
  Pass pass[3][2][3][2];
  /// First half of a step. @param ends the one before ends first @returns square of the largest speed against the flow
  double (*begin_step)(const DiscMotionPass&, bool ends);
  /// Second half of a step: damping against the affine flow, half a kick; keeps the accelerations.
  void (*end_step)(const DiscMotionPass&);
};

const DiscKernels& disc_kernels_of_two_lanes();
const DiscKernels& disc_kernels_of_four_lanes();
const DiscKernels& disc_kernels_of_eight_lanes();

}  // namespace polargrain::dem
