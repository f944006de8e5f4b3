// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace polargrain {

/// The grains of a cell at its read-out and how they hold each other, in the laboratory frame. Places count from a corner
/// of the box. Components of discs out of the plane are zero.
struct GrainView {
  struct Grain {
    std::int64_t id = 0;                                 ///< as in the packing
    double radius = 0.0;                                 ///< m
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the image that lies in the box, m
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
    Eigen::Vector3d rotation =
        Eigen::Vector3d::Zero();                     ///< spins added up since the packing, right-handed, rad
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< rad/s
    int contacts = 0;                                ///< coordination number of the grain
  };
  /// As the stress was read from: the mean of branch times force over the volume is the stress of the cell.
  struct Contact {
    std::size_t first = 0;  ///< into `grains`
    std::size_t second = 0;
    Eigen::Vector3d branch =
        Eigen::Vector3d::Zero();  ///< from first to the image of second that it touches, m
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on first, by second, N
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of the rolling resistance on first, N m
    bool sliding = false;                              ///< the tangential spring is at its limit
    bool rolling = false;                              ///< the rolling spring is at its limit

    /// Compressive positive, N.
    [[nodiscard]] double normal_force() const { return -force.dot(branch.normalized()); }
    /// Its size, N.
    [[nodiscard]] double tangential_force() const {
      return (force + normal_force() * branch.normalized()).norm();
    }
  };
  int dimension = 2;  ///< 3: spheres in space
  Eigen::Matrix3d box =
      Eigen::Matrix3d::Zero();    ///< base vectors as columns, m; of discs the third is the thickness
  std::vector<Grain> grains;      ///< in the order of the engine
  std::vector<Contact> contacts;  ///< each once
};

/// An engine of cells whose grains can be looked at.
class ShowsGrains {
 public:
  virtual ~ShowsGrains() = default;
  /// Of its last evaluation, at read-out; before the first: of the packing at rest.
  [[nodiscard]] virtual GrainView view() = 0;
};

}  // namespace polargrain
