// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/element/element_type.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"
#include "fem/water/permeability.hpp"

namespace polargrain::fem {

/// The water of a region; its pores are full.
struct WaterOfRegion {
  Permeability permeability = Permeability::constant(0.0);
  double void_ratio = 0.7;      ///< e at the start; follows the volume strain from there
  double bulk_modulus = 2.2e9;  ///< Kw of the water, Pa; infinite: it does not yield
  bool undrained = false;       ///< no water flows, whatever the permeability
};

/// Water that is brought in through a boundary.
struct WaterFlux {
  std::string on;   ///< boundary
  TimeTable value;  ///< m/s, into the body
};

/// A boundary that free water may leave dry. Below the level p is that of the water; above it water leaves where p > 0, and does
/// not come in.
struct OpenSide {
  std::string on;                        ///< boundary
  TimeTable level;                       ///< height of the free water, m
  std::shared_ptr<const Lifetime> life;  ///< stages that have it, read when they begin; null: all
  /// In a stage the depth goes over from that of another level, as the forces of the water do.
  double level_before = -HUGE_VAL;  ///< m
  double start = 0.0;               ///< of the stage, s
  double end = 0.0;                 ///< the same; not behind the start: the level holds at once

  [[nodiscard]] bool holds(int stage) const { return !life || life->holds(stage); }
  /// Of the water over a place, m; 0: dry.
  [[nodiscard]] double depth(double time, double height) const {
    const double depth = std::max(level.at(time) - height, 0.0);
    if (time >= end) return depth;
    const double share = std::max((time - start) / (end - start), 0.0);
    return share * depth + (1.0 - share) * std::max(level_before - height, 0.0);
  }
};

struct PoreWaterOptions {
  double unit_weight = 9.81e3;  ///< of water, N/m^3
  /// Weight of the end of a step: 1 damps, 1/2 is of second order in time and rings behind sudden changes.
  double theta = 1.0;
  /// Height of the water table at the start, along the last axis, m: p is hydrostatic then, and gravity acts on the water. Empty:
  /// p is the excess over whatever is hydrostatic, zero at the start.
  std::optional<double> table = {};
  std::vector<WaterFlux> fluxes = {};
  std::vector<OpenSide> open_sides = {};
  /// Pa that pressures may change in a step, by their last rate; 0: steps are as long as asked for.
  double pressure_change = 0.0;
  double shortest_step = 0.0;  ///< s; no step is made shorter for that, and the first one is as long
};

/// Name of the field of pore pressures (Pa, compression positive).
inline constexpr const char* kPorePressure = "pore_pressure";

/// Saturated pores that water flows through (Biot): the stress of the mesh is the effective one, the total one less p on the
/// normal stresses. Displacements are quadratic, p is linear on the same elements (Taylor and Hood); boundaries are closed
/// where nothing is said. In large
/// deformation on the moved mesh, fluxes through the undeformed areas; where gravity acts on the water, ground loses the weight
/// of the water that is squeezed out. Regions with water may go in a stage, and their fluxes with them; regions that come are dry. docs/theory/water.md
template <int dim>
class PoreWater final : public Contribution<dim> {
 public:
  /// @param field number of the field of pore pressures @param regions which the field belongs to
  PoreWater(const Problem<dim>& problem, std::size_t field, std::map<std::string, WaterOfRegion> regions,
            PoreWaterOptions options);

  /// Adds a side to those of the options: stages are read when the water is there. @param problem that it was made for
  void open_side(const Problem<dim>& problem, OpenSide side);

  [[nodiscard]] std::string name() const override { return "pore water"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return elements_[e].entries; }
  void allocate() override;
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  void commit() override;
  void revert() override {}
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] double longest_step() const override;
  [[nodiscard]] bool takes_stages() const override { return true; }
  [[nodiscard]] bool is_there(std::size_t e, int, const std::vector<char>& there) const override {
    return there.empty() || there[static_cast<std::size_t>(elements_[e].number)] != 0;
  }
  void set_stage(int stage, const std::vector<char>& there) override;
  [[nodiscard]] bool is_active(std::size_t e) const override { return elements_[e].is_there; }
  [[nodiscard]] bool depends_on_duration() const override { return true; }
  /// Open sides go by the pressure that comes, so their rows are not linear.
  [[nodiscard]] bool takes_explicit_steps() const override { return options_.open_sides.empty(); }
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;
  [[nodiscard]] std::vector<std::string> take_notes() override;

  /// Elements of the mesh that hold water, in the order of elements().
  [[nodiscard]] int mesh_element(std::size_t e) const { return elements_[e].number; }
  [[nodiscard]] const PoreWaterOptions& options() const { return options_; }
  /// Volume that has left the ground through a node since the start: m^3, in the plane per m of thickness. Zero where the node
  /// is closed. @param entry of its pressure in nodal vectors
  [[nodiscard]] double outflow(int entry) const { return outflow_(entry - first_entry_); }
  /// The same a second, m^3/s or m^2/s, mean over the last committed step; 0 where it had no duration.
  [[nodiscard]] double flow(int entry) const { return flow_(entry - first_entry_); }
  /// Volume of water an area and second by Darcy's law, m/s, at a point of an element. @param nodal committed nodal values
  [[nodiscard]] typename Cosserat<dim>::Place velocity(std::size_t e, std::size_t point,
                                                       const Eigen::VectorXd& nodal) const;
  [[nodiscard]] const std::map<std::string, WaterOfRegion>& regions() const { return regions_; }
  /// k at the first point of an element, m/s; 0 where it is undrained.
  [[nodiscard]] double permeability(std::size_t e) const;

 private:
  /// A point of an element.
  struct Point {
    double volume;
    double first_volume;         ///< undeformed
    double void_ratio;           ///< committed
    double trial_void_ratio;     ///< of the last evaluation
    double trial_pressure;       ///< the same, in large deformation
    Eigen::VectorXd divergence;  ///< volume strain = divergence . displacements of the element
    Eigen::VectorXd weights;     ///< shape functions of the displacements
    ShapeFunctions<dim> shape;   ///< of the corners, gradients by position
  };
  /// A corner on an open side.
  struct OpenCorner {
    Eigen::Index corner;
    double height;       ///< m
    std::size_t side;    ///< of the options
    double conductance;  ///< volume let out by the excess of p, m^3/Pa, of the last evaluation; 0: closed
  };
  struct ElementOfWater {
    int number;  ///< in the mesh
    const WaterOfRegion* water;
    bool is_there = true;  ///< in the stage
    const ElementType<dim>* type;
    VectorRows<dim> nodes;     ///< undeformed
    std::vector<int> entries;  ///< displacements, then pressures
    std::vector<int> moved;    ///< entries of the displacements
    std::vector<int> pressed;  ///< entries of the pressures
    std::vector<Point> points;
    std::vector<OpenCorner> open;
    Eigen::MatrixXd coupling;    ///< Q: a row a displacement, a column a pressure, m^2
    Eigen::MatrixXd storage;     ///< S
    Eigen::MatrixXd conduction;  ///< H
    Eigen::VectorXd weight;      ///< h_g
  };
  /// A flux of 1 m/s on a side of an element, at the pressures of its nodes.
  struct UnitFlux {
    int element;
    std::vector<int> entries;
    std::vector<double> values;
    const TimeTable* table;
  };
  void add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places, std::size_t field, int number,
                   const WaterOfRegion& water);
  void add_flux(const Problem<dim>& problem, const FieldPlaces<dim>& places, std::size_t field,
                const WaterFlux& flux);
  void add_open_corners(const Problem<dim>& problem, std::size_t side);
  /// Lets water through the open sides beside an element. @param pressures of its corners at the end of the step, Pa
  /// @param outside takes the volume that leaves, negative, by pressure
  void pass_open_sides(ElementOfWater& element, const NodalStep& step, const Eigen::VectorXd& pressures,
                       NodalForces& forces, Eigen::VectorXd& outside);
  /// Whether the ground weighs less when water has left it. Body loads know the first volume alone.
  [[nodiscard]] bool loses_weight(const ElementOfWater& element) const {
    return is_large_ && options_.table && !element.water->undrained;
  }
  [[nodiscard]] bool stands(int element) const {
    return is_there_.empty() || is_there_[static_cast<std::size_t>(element)] != 0;
  }
  /// Positions of the nodes with their displacements.
  static VectorRows<dim> positions(const ElementOfWater& element, const Eigen::VectorXd& nodal);
  /// Volumes, gradients and coupling where the nodes are.
  void place(ElementOfWater& element, const VectorRows<dim>& nodes) const;
  /// In large deformation: places the element at both ends of the step. @returns volume lost to each pressure, negative
  Eigen::VectorXd squeeze(ElementOfWater& element, const NodalStep& step) const;
  /// Storage and conduction of the committed void ratios.
  void refresh(ElementOfWater& element) const;

  std::map<std::string, WaterOfRegion> regions_;
  PoreWaterOptions options_;
  bool is_large_;
  std::vector<ElementOfWater> elements_;
  std::vector<UnitFlux> fluxes_;
  std::vector<char> is_there_;  ///< by element of the mesh; empty: all are
  int stage_ = 0;
  Eigen::Index first_entry_;  ///< of the pressures in nodal vectors
  Eigen::VectorXd outflow_;   ///< by pressure, committed
  Eigen::VectorXd flow_;      ///< the same, a second
  Eigen::VectorXd trial_outflow_;
  double duration_ = 0.0;  ///< of the last evaluation
  double change_ = 0.0;    ///< largest one of a pressure, of the last evaluation
  double longest_ = 0.0;   ///< longest_step() by the last committed step; 0: no committed step in this stage
  double least_pressure_ = 0.0;  ///< of the last evaluation
  bool told_of_suction_ = false;
  bool tells_of_suction_ = false;
};

/// Gives a problem its pore pressures: field, contribution, pressures at the start. To be called once, when mesh and regions are
/// known; prescribed pressures (Problem::prescribed_fields of kPorePressure) come before or after.
template <int dim>
std::shared_ptr<PoreWater<dim>> add_pore_water(Problem<dim>& problem,
                                               std::map<std::string, WaterOfRegion> regions,
                                               const PoreWaterOptions& options);

/// The water of a problem; null without water.
template <int dim>
const PoreWater<dim>* pore_water_of(const Problem<dim>& problem);

}  // namespace polargrain::fem
