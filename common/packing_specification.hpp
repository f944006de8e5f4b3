// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "common/contact_library_file.hpp"
#include "common/packing.hpp"

namespace polargrain {

/// Damping while a packing is made, unless asked otherwise. Spheres in space rearrange by softer motions, which damping
/// that is made for a contact holds up: with 0.02 they take a third to a fifth of the steps that they take with 0.12.
inline constexpr double kDampingInPlane = 0.12;
inline constexpr double kDampingInSpace = 0.02;

/// How large the grains of a packing are.
struct SizeLaw {
  enum class Kind {
    uniform,    ///< radii = {least, largest}, each equally likely by number
    lognormal,  ///< radii = {least, median, largest}: the logarithm of the radius is normal, cut at both ends
    list,       ///< radii with their shares by number
    sieve       ///< radii ascending with the share by mass that is smaller: 0 ... 1 (grading curve)
  };
  Kind kind = Kind::uniform;
  std::vector<double> radii;   ///< m
  std::vector<double> shares;  ///< list: by number, any sum; sieve: ascending from 0 to 1
  double deviation = 0.0;      ///< lognormal: standard deviation of the logarithm
  bool spheres = false;        ///< sieve: masses go with the cube of the radius, not with the square
};

/// Grains that fall under gravity, along -x2, instead of being compressed from all sides.
struct Deposition {
  /// By which the packing is turned about x3 in the end, rad, counter-clockwise: the angle of the bedding planes against x1.
  double bedding_angle = 0.0;
  /// The box keeps its width and is compressed along the direction of the fall alone until that carries its stress, so that
  /// the lateral stresses are those at rest (K0). Else all stresses are brought about afterwards.
  bool keeps_width = false;
};

/// The request to `polargrain pack`: grains in a periodic box, compressed under given normal stresses.
struct PackingSpecification {
  std::string text;         ///< the user's file, kept with the packing
  std::string script_file;  ///< for messages
  std::string script;       ///< input script of a cell: contact model, time step
  ContactLibraryFile contact_library;
  int grains = 0;
  SizeLaw sizes;
  /// Spheres instead of discs of the thickness of the box: in a single layer (dimension 2) or in space (3).
  bool spheres = false;
  int dimension = 2;
  double density = 0.0;    ///< of the grains, kg/m^3
  double thickness = 0.0;  ///< m; not in dimension 3
  double pressure = 0.0;   ///< mean of the axes, Pa, positive in compression
  /// Normal stress of each axis over the pressure; in a plane the third counts for nothing.
  std::array<double, 3> share_of_axis{1.0, 1.0, 1.0};
  /// When given, the packing comes to rest under this isotropic pressure first, Pa; then the box keeps its width and is
  /// compressed along its last axis alone until that carries `pressure`: lateral stresses are those at rest (K0).
  std::optional<double> one_dimensional_from;
  std::optional<Deposition> deposition;
  /// Of a packing that is settled: under the stresses that it records, and not under `pressure`, where it records any.
  bool keeps_stresses = false;
  /// Sliding friction while the packing is made: 0 gives the densest one.
  double friction = 0.0;
  /// Rolling friction while the packing is made, in place of the script's. Where the friction is looked for, it goes
  /// along in proportion.
  std::optional<double> rolling_friction;
  /// When given, the friction is looked for that leads to this void ratio, between 0 and `friction`; where
  /// the void ratio jumps over it, the grains are placed anew.
  std::optional<double> void_ratio;
  double void_ratio_tolerance = 2e-3;
  std::uint64_t seed = 1;
  double pressure_tolerance = 1e-3;      ///< relative, for the normal stress of each axis
  double unbalanced_force_ratio = 1e-3;  ///< mean unbalanced force over mean contact force; moments alike
  double inertial_number = 1.2e-2;       ///< greatest rate of compression, under the pressure aimed at
  double damping = kDampingInPlane;      ///< as CellControl::damping; more holds the slow motions up
  std::int64_t most_steps = 2'000'000;
  CellLoop loop = CellLoop::automatic;  ///< that steps spheres; discs are stepped by the engine's own
};

/// The values that a packing reached. No times: equal specifications give equal files.
struct PackingReached {
  double void_ratio = 0.0;           ///< in plane; of the volumes in dimension 3
  double coordination_number = 0.0;  ///< 2 contacts / grains
  double rattlers = 0.0;             ///< grains without a contact / grains
  double pressure = 0.0;             ///< mean of the axes, Pa
  double anisotropy = 0.0;           ///< (s11 - s22) / (s11 + s22), where it is largest of all pairs of axes
  double shear = 0.0;                ///< (s12 + s21) / (s11 + s22), where it is largest of all pairs
  double unbalanced_force_ratio = 0.0;
  double unbalanced_moment_ratio = 0.0;
  double friction = 0.0;   ///< while it was made
  double dem_steps = 0.0;  ///< of the last compression
  /// Symmetric parts of tensors in the laboratory, 11 22 33 12 13 23: stress, Pa, tension positive, and the mean of n_i n_j
  /// over the contacts. All zero: not recorded.
  std::array<double, 6> stress{};
  std::array<double, 6> fabric{};
};

/// A symmetric tensor as it is kept in PackingReached, and back.
inline std::array<double, 6> components(const Eigen::Matrix3d& symmetric) {
  return {symmetric(0, 0), symmetric(1, 1), symmetric(2, 2),
          symmetric(0, 1), symmetric(0, 2), symmetric(1, 2)};
}
inline Eigen::Matrix3d tensor(const std::array<double, 6>& components) {
  const auto [s11, s22, s33, s12, s13, s23] = components;
  Eigen::Matrix3d symmetric;
  symmetric << s11, s12, s13, s12, s22, s23, s13, s23, s33;
  return symmetric;
}

template <RecordOf<PackingReached> Record, class Visit>
void describe(Record& reached, Visit&& visit) {
  visit(FieldNotes{"void_ratio", "1", "in plane; of the volumes in dimension 3"}, reached.void_ratio);
  visit(FieldNotes{"coordination_number", "1", "2 contacts / grains"}, reached.coordination_number);
  visit(FieldNotes{"rattlers", "1", "grains without a contact / grains"}, reached.rattlers);
  visit(FieldNotes{"pressure", "Pa", "mean of the axes, compression positive"}, reached.pressure);
  visit(FieldNotes{"anisotropy", "1", "(s11 - s22) / (s11 + s22), where it is largest of all pairs of axes"},
        reached.anisotropy);
  visit(FieldNotes{"shear", "1", "(s12 + s21) / (s11 + s22)"}, reached.shear);
  visit(FieldNotes{"unbalanced_force_ratio", "1", "mean unbalanced force / mean contact force"},
        reached.unbalanced_force_ratio);
  visit(FieldNotes{"unbalanced_moment_ratio", "1",
                   "mean unbalanced moment / (mean contact force times mean radius)"},
        reached.unbalanced_moment_ratio);
  visit(FieldNotes{"friction", "1", "sliding friction while it was made"}, reached.friction);
  visit(FieldNotes{"dem_steps", "1", "of the last compression"}, reached.dem_steps);
  constexpr const char* kComponents = "_11 _22 _33 _12 _13 _23";
  visit(FieldNotes{"stress", "Pa", "in the laboratory, tension positive", kComponents}, reached.stress);
  visit(
      FieldNotes{"fabric", "1", "mean of n_i n_j over the contacts in the laboratory, trace 1", kComponents},
      reached.fabric);
}

struct PreparedPacking {
  Packing packing;
  PackingReached reached;
  std::string specification;  ///< text of the user's specification
  std::string stepping;       ///< which loop made it, in words (kSteppingNote); not in the file
};

/// Brings a packing to rest under a script and a pressure. @param specification script, pressure and definition of
/// rest; its other members are not used
using PackingSettler =
    std::function<PreparedPacking(const PackingSpecification& specification, const PreparedPacking& packing,
                                  const std::function<void(const PackingReached&)>& progress)>;

/// Makes a packing. @param progress called now and then with the values reached so far; may be empty
using PackingMaker = std::function<PreparedPacking(
    const PackingSpecification& specification, const std::function<void(const PackingReached&)>& progress)>;

}  // namespace polargrain
