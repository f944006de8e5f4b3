// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "common/packing.hpp"
#include "common/packing_specification.hpp"
#include "dem/cell/packing_check.hpp"

namespace polargrain::dem {

/// Friction while a packing is made.
struct MakingFriction {
  double sliding = 0.0;
  std::optional<double> rolling;  ///< empty: the script's, or no rolling without sliding friction
};

class FixGravity;

/// Directions i, j of the shears s_ij and h_ij of a box: 12, 13, 23.
constexpr std::array<std::array<int, 2>, 3> kPlanes{{{0, 1}, {0, 2}, {1, 2}}};

/// Grains in a periodic box of an engine of their own, that is strained to and fro until the stress is the
/// one asked for. Of a plane packing the third axis counts for nothing. All but `packing` is in the frame of the box, whose
/// first base vector lies along x1 (frame_of_packing_data).
class PressedBox {
 public:
  /// Values of the contacts at the end of a move. Stresses in Pa, tension positive.
  struct Look {
    int contacts = 0;
    Eigen::Vector3d stress = Eigen::Vector3d::Zero();  ///< normal stresses of the axes
    /// Shear stresses (s_ij + s_ji) / 2 of the planes 12, 13, 23; a plane box has the first.
    Eigen::Vector3d shear = Eigen::Vector3d::Zero();
    /// Affine stiffness of the axes against an isotropic strain, of the shears against h12, h13, h23; Pa.
    Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();
    Eigen::Vector3d shear_stiffness = Eigen::Vector3d::Zero();
    double normal_stiffness = 0.0;  ///< mean of the contacts, N/m
    double unbalanced_force_ratio = 0.0;
    double unbalanced_moment_ratio = 0.0;
    double coordination_number = 0.0;
    double rattlers = 0.0;
    double void_ratio = 0.0;
  };
  /// Of the contacts that Look tells of: not needed until the packing is made.
  struct Shape {
    Overlaps overlaps;
    /// Mean of n_i n_j over the contacts.
    Eigen::Matrix3d fabric = Eigen::Matrix3d::Zero();
  };

  virtual ~PressedBox() = default;
  /// Takes DEM steps while the box is strained smoothly and stands still in the last.
  /// @param strain of the axes @param shear h12, h13, h23 @param damping_rate viscous, 1/s
  virtual void move(const Eigen::Vector3d& strain, const Eigen::Vector3d& shear, int steps,
                    double damping_rate) = 0;
  [[nodiscard]] virtual Look look() const = 0;
  [[nodiscard]] virtual Shape shape() const = 0;
  /// Grains and box as they are, in the laboratory; with `keep_contacts` the state of the contacts as well.
  virtual Packing packing(bool keep_contacts) = 0;

  [[nodiscard]] virtual double mean_mass() const = 0;    ///< kg
  [[nodiscard]] virtual double mean_radius() const = 0;  ///< m
  [[nodiscard]] virtual double time_step() const = 0;    ///< s
  /// Where the script leaves the time step to this program: takes the one that suits the contacts as they are
  /// and those that may come (StiffestContact). Else checks the script's. @param damping_rate viscous, 1/s
  virtual void renew_time_step(double damping_rate) = 0;
  /// Which loop takes the steps, in words (stepping_note).
  [[nodiscard]] virtual const std::string& stepping() const = 0;
  /// Lets the grains of a box that was made with Fall::yes fall, as FixGravity::begin.
  void begin_fall(double acceleration, double floor_stiffness, double damping);
  [[nodiscard]] double unrest() const;  ///< FixGravity::unrest

 protected:
  FixGravity* gravity_ = nullptr;  // null unless the box was made with Fall::yes
};

/// Whether the grains of a box fall under gravity.
enum class Fall { no, yes };

/// Discs, or spheres in a single layer. @param friction sliding friction in place of the script's; empty: the
/// script's own
std::unique_ptr<PressedBox> make_plane_box(const PackingSpecification& specification, const Packing& packing,
                                           const std::optional<MakingFriction>& friction,
                                           Fall fall = Fall::no);
/// Spheres in space.
std::unique_ptr<PressedBox> make_space_box(const PackingSpecification& specification, const Packing& packing,
                                           const std::optional<MakingFriction>& friction,
                                           Fall fall = Fall::no);
/// The one that the dimension asks for.
std::unique_ptr<PressedBox> make_pressed_box(const PackingSpecification& specification,
                                             const Packing& packing,
                                             const std::optional<MakingFriction>& friction,
                                             Fall fall = Fall::no);

/// The same grains in a box so much smaller that those of a loose packing overlap: the contacts that the
/// first forces find there tell how stiff contacts are before there are any. Not for steps.
Packing pressed_together(Packing packing);

class Engine;
/// Puts the friction that a packing is made with in place of the script's. To be called before the models read their
/// parameters.
void set_friction(Engine& engine, const MakingFriction& friction);

}  // namespace polargrain::dem
