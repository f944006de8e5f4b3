// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "fem/beam/beam_section.hpp"
#include "fem/element/element_type.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/contribution.hpp"

namespace polargrain::fem {

/// The nodal field with the rotations of beams, rad.
inline constexpr const char* kBeamRotation = "rotation of beams";

/// One beam element: the nodes of a side of an element, ends first, and the entries of nodal vectors with their rotations.
struct BeamElement {
  const ElementType<1>* type;
  std::vector<int> nodes;
  std::vector<int> rotations;
};

/// Forces in a beam at an end of an element.
struct BeamResult {
  Eigen::Vector2d place;  ///< m
  double along;           ///< way along the beam from its first node, m
  double moment;          ///< M, N m per m: positive where the side to the left of the way is compressed
  double axial;           ///< N, N per m, tension positive
  double shear;           ///< V, N per m: positive where the part behind is pushed to the left of the way
};

/// A wall, plate or lining of the plane: Timoshenko beams with a rotation of their own (a nodal field), small deformation.
/// Displacement and rotation are quadratic on sides with a middle node (2 points) and linear on others (1 point), as in the
/// ground, so that nothing locks. A beam that a stage places is free of forces as it is then. Moments at nodes come from the nodal forces of elements: the
/// points would miss the peak below a concentrated load. N and V are in balance with these and with what the element carries.
class Beam : public Contribution<2> {
 public:
  Beam(const Mesh<2>& mesh, std::string name, const BeamSection& section, std::vector<BeamElement> elements);

  [[nodiscard]] std::string name() const override { return "the beam '" + name_ + "'"; }
  [[nodiscard]] const std::string& short_name() const { return name_; }
  [[nodiscard]] std::size_t elements() const override { return parts_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return parts_[e].entries; }
  void allocate() override;
  [[nodiscard]] bool takes_stages() const override { return true; }
  void set_stage(int stage, const std::vector<char>&) override { active_ = this->life.holds(stage); }
  void begin_stage(const StageBegin<2>& now) override;
  [[nodiscard]] bool is_active(std::size_t) const override { return active_; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  void commit() override;
  void revert() override;
  /// Tells once where a moment at a node is above Mp: points within elements have yielded, and the hinge resists by more.
  [[nodiscard]] std::vector<std::string> take_notes() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] std::vector<std::pair<int, int>> joined_nodes() const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<2>& problem) const override;

  /// Both ends of each element in turn.
  [[nodiscard]] std::vector<BeamResult> results(const Problem<2>& problem) const;
  /// Whether a point has yielded.
  [[nodiscard]] bool yields() const;

 private:
  struct Point {
    double length;                                       ///< share of the length, m
    Eigen::Matrix<double, 3, Eigen::Dynamic> strain_of;  ///< strains per value of the entries
    double plastic_curvature = 0.0;
    BeamAnswer answer{BeamVector::Zero(), Eigen::Matrix3d::Zero(), 0.0};
  };
  struct Part {
    BeamElement element;
    std::vector<int> entries;  ///< displacements of the nodes in turn, then the rotations
    std::vector<Point> points;
    std::array<Eigen::Vector2d, 2> tangents;  ///< at both ends
    std::array<Eigen::Vector2d, 2> places;
    double length = 0.0;
    Eigen::VectorXd forces;  ///< of the last evaluation
    Eigen::VectorXd committed_forces;
    Eigen::VectorXd born;  ///< values of the entries at which it has no forces; empty: zero
  };

  /// Tells of moments above Mp, and again when they have grown by a tenth.
  void note_largest_moment();
  /// Loads along an element, as forces on its nodes in turn.
  [[nodiscard]] static Eigen::VectorXd carried_by(const Part& part, const Problem<2>& problem);

  std::string name_;
  BeamSection section_;
  std::vector<Part> parts_;
  bool active_ = true;       ///< in the stage
  double told_ratio_ = 0.0;  ///< the largest moment that a note has told, over Mp
  std::vector<std::string> notes_;
};

}  // namespace polargrain::fem
