// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "fem/interface/interface_face.hpp"
#include "fem/interface/interface_law.hpp"
#include "fem/solver/contribution.hpp"

namespace polargrain::fem {

/// The two sides of an interface on one face. A node may be on both: there the interface ends inside of the body.
template <int dim>
struct InterfaceFace {
  const ElementType<dim - 1>* type;
  std::vector<int> nodes_a;     ///< of the element whose outward normal is the normal of the interface
  std::vector<int> nodes_b;     ///< those at the same places
  std::vector<int> neighbours;  ///< elements on either side, one or two
  /// Entries of nodal vectors with the rotation of side b, one axis after the other for each node; empty: the interface leaves
  /// micro-rotations alone.
  std::vector<int> rotation_b = {};
  /// Where side b is a wall of beams: the ground's nodes on its other side, at the same places; empty where no ground is, and on the
  /// other side's faces.
  std::vector<int> nodes_across = {};
};

/// Name, law and friction of an interface.
struct InterfaceSettings {
  std::string name;
  /// Stiffnesses of zero are set to kStiffnessRatio times the stiffness of an element of the stiffer neighbour at rest,
  /// Eoed / h.
  InterfaceParameters parameters;
  /// Friction as a share of the mobilised friction of the neighbours at the start of each step, in the place of tan_friction.
  std::optional<double> share = {};
  /// Where rotations are joined (InterfaceFace::rotation_b): rotation of side a against b over the slip, rad/m, positive where the
  /// ground rolls along the wall; 0: it turns with the wall.
  double turning = 0.0;
  /// Whether the ground is one body along it until the stage that places it (Contribution::life); a rigid wall beside the ground
  /// is only there from then on.
  bool parts_ground = false;
  std::set<int> single_nodes = {};  ///< toes: nodes of side a that are on both sides of a wall of beams
};

inline constexpr double kStiffnessRatio = 30.0;

/// A point of an interface as it was committed.
template <int dim>
struct InterfacePointResult {
  InterfacePoint<dim> geometry;
  std::size_t face;
  FaceVector<dim> traction;  ///< Pa
  FaceVector<dim> jump;      ///< m
  double gap;                ///< m, 0 where it is closed
  double slip;               ///< way of sliding so far, m
  double mobilised;          ///< share of the strength
  Contact contact;
  double pore_pressure = 0.0;  ///< of the water between the sides, Pa, compression positive
};

/// Friction between two sides of a curve (in space a surface): an interface of zero thickness. Small deformation.
/// Its faces come and go with the elements beside them. A face that comes with fill is free of stress; one that is there from the
/// start, or that a stage places into the ground, carries the stress that the ground has there.
/// Its law knows effective stresses. Water between the sides pushes them apart (interface_water.cpp).
/// An open point keeps kOpenStiffness of its stiffness in the tangent alone, so that a body that only the interface holds
/// does not make it singular.
template <int dim>
class Interface : public Contribution<dim> {
 public:
  Interface(const Mesh<dim>& mesh, InterfaceSettings settings, std::vector<InterfaceFace<dim>> faces);

  [[nodiscard]] std::string name() const override { return "the interface '" + settings_.name + "'"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return elements_[e].entries; }
  void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed) override;
  void allocate() override;
  [[nodiscard]] bool takes_stages() const override { return true; }
  [[nodiscard]] bool is_there(std::size_t e, int stage, const std::vector<char>& there) const override;
  [[nodiscard]] std::vector<std::pair<int, int>> tied_nodes(int stage) const override;
  void set_stage(int stage, const std::vector<char>& there) override;
  void begin_stage(const StageBegin<dim>& now) override;
  void begin_at_rest(const StageBegin<dim>& now) override;
  [[nodiscard]] bool is_active(std::size_t e) const override { return elements_[e].active; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] std::vector<std::pair<int, int>> joined_nodes() const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;
  bool add_forces_on_face(const std::vector<int>& nodes, Eigen::VectorXd& forces) const override;
  [[nodiscard]] std::vector<std::string> take_notes() override;

  /// The pore water of a problem (add_pore_water) presses on the faces from now on, and fills the gap between them. Before the
  /// solver is made.
  void take_water(const Problem<dim>& problem);

  /// Tells of other walls at nodes of side b. Where one of them stands before this one comes, the ground does not hang on the node,
  /// but together across it.
  void meet(std::map<int, std::vector<std::shared_ptr<const Contribution<dim>>>> walls) {
    met_ = std::move(walls);
  }

  /// From now on friction, cohesion and tensile strength are those of the settings over a factor. A share of the ground's friction
  /// follows the ground.
  void divide_strength(double factor);

  [[nodiscard]] const InterfaceSettings& settings() const { return settings_; }
  [[nodiscard]] const InterfaceFace<dim>& face(std::size_t e) const { return elements_[e].face; }
  [[nodiscard]] std::vector<InterfacePointResult<dim>> results() const;
  /// Force of side a on side b, N (in the plane N/m), along the axes of the mesh.
  [[nodiscard]] typename Cosserat<dim>::Place force() const;
  /// Height of the resultant of the normal stress above the lowest point, m; 0 without normal stress.
  [[nodiscard]] double lever() const;

 private:
  struct Point {
    InterfacePoint<dim> geometry;
    InterfaceParameters parameters;
    InterfaceState<dim> committed;
    InterfaceAnswer<dim> answer;  ///< to the last jump
    InterfaceAnswer<dim> committed_answer;
    FaceVector<dim> jump;
    FaceVector<dim> committed_jump;
    FaceVector<dim> birth = FaceVector<dim>::Zero();  ///< jump from which its slip counts
    double pressure = 0.0;                            ///< of the water
    double committed_pressure = 0.0;
    Eigen::VectorXd wet_shape;  ///< share of each of Element::pressures
  };
  struct Element {
    InterfaceFace<dim> face;
    std::vector<int> entries;  ///< each once
    std::vector<int> places;   ///< in `entries`: of displacements of a, of b, rotations of a, of b
    std::vector<Point> points;
    double size;                      ///< of the face, m
    double rotation_stiffness = 0.0;  ///< of relative rotation, N/m^2 (per area): kt size^2
    bool active = true;               ///< in the stage
    bool knows_stiffness = false;     ///< that is not given, by its neighbours at rest
    std::vector<int> pressures;       ///< in `entries`: of the corners with water, of a, of b
    Eigen::MatrixXd push;  ///< internal forces of displacements of a, of b, per pressure, m^2; empty: dry
  };

  [[nodiscard]] static std::vector<int> all_entries(const InterfaceFace<dim>& face);
  using Rolling = Eigen::Matrix<double, Cosserat<dim>::rotations, dim - 1>;
  /// Rotations of the ground against the wall over the tangential slip at a point, rad/m.
  [[nodiscard]] Rolling rolling(const Point& point) const;
  [[nodiscard]] Eigen::VectorXd forces_of(const Element& element, const Eigen::VectorXd& values) const;
  void set_stiffness(Element& element, double stiffness);
  /// Jump at a point, in the axes of the face. @param values of the element's entries
  [[nodiscard]] static FaceVector<dim> jump_at(const Element& element, const Point& point,
                                               const Eigen::VectorXd& values);
  static void forget(Point& point);
  [[nodiscard]] bool is_dry() const;
  /// Number in the entries of an element, added where it is not among them.
  [[nodiscard]] static int place_of(Element& element, int entry);
  /// Pressure at a point: the mean of the sides that have water. @param values of the element's entries
  [[nodiscard]] static double pressure_at(const Element& element, const Point& point,
                                          const Eigen::VectorXd& values);
  /// Forces of the water on the faces, and what the gap takes in.
  static void add_water(const Element& element, const NodalStep& step, NodalForces& forces);
  static void add_water_tangent(const Element& element, Eigen::MatrixXd& tangent);
  /// Stress vector of the ground at the points of faces that are born in it, along the axes of the mesh.
  void carry_stress_of_ground(const StageBegin<dim>& now, const std::vector<std::size_t>& born);
  void carry_nodal_forces(const StageBegin<dim>& now, const std::vector<std::size_t>& born);
  /// The stress of the elements beside a face. Not nodal forces: at a corner several interfaces share them.
  void carry_stress_of_points(const StageBegin<dim>& now, const std::vector<std::size_t>& born);

  InterfaceSettings settings_;
  std::vector<Element> elements_;
  std::map<int, std::vector<std::shared_ptr<const Contribution<dim>>>> met_;
  bool told_slip_ = false;
  std::vector<std::string> notes_;
};

}  // namespace polargrain::fem
