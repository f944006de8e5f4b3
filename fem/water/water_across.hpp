// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fem/element/element_type.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"
#include "fem/solver/ties_entries.hpp"

namespace polargrain::fem {

/// How water passes a curve along which the mesh is parted.
enum class Passage {
  permeable,   ///< freely: both sides have one pressure
  impervious,  ///< not at all
  leaky        ///< q = (p_a - p_b) / (unit weight . resistance)
};

/// A face with ground on both sides.
template <int dim>
struct AcrossFace {
  const ElementType<dim - 1>* type;
  std::vector<int> nodes_a;
  std::vector<int> nodes_b;  ///< at the same places
  int element_a;
  int element_b;
};

struct WaterAcrossOptions {
  std::string name;  ///< of the interface
  Passage passage = Passage::permeable;
  double resistance = 0.0;  ///< thickness over permeability, s; of a leaky one
  double unit_weight = 9.81e3;
  double theta = 1.0;  ///< PoreWaterOptions::theta
};

/// The flow of water across a curve with ground on both sides, with or without a wall between. Until the stage that begins its life
/// the curve is not there for water. Where ground has gone on one side, the other side is closed.
template <int dim>
class WaterAcross final : public StatelessContribution<dim>, public TiesEntries {
 public:
  /// Faces with a dry side are left out. @param problem with pore water (add_pore_water)
  WaterAcross(const Problem<dim>& problem, WaterAcrossOptions options,
              const std::vector<AcrossFace<dim>>& faces);

  [[nodiscard]] std::string name() const override { return "the water across '" + options_.name + "'"; }
  [[nodiscard]] std::size_t elements() const override { return faces_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return faces_[e].entries; }
  [[nodiscard]] bool takes_stages() const override { return true; }
  [[nodiscard]] bool is_there(std::size_t e, int stage, const std::vector<char>& there) const override;
  [[nodiscard]] std::vector<std::pair<int, int>> tied_entries(int stage) const override;
  void set_stage(int stage, const std::vector<char>& there) override;
  [[nodiscard]] bool is_active(std::size_t e) const override { return faces_[e].active; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  [[nodiscard]] bool depends_on_duration() const override { return true; }

  [[nodiscard]] const WaterAcrossOptions& options() const { return options_; }
  /// Faces with ground on one side alone in a stage: closed. @param there as elements_in_stage has it
  [[nodiscard]] std::size_t bare_faces(int stage, const std::vector<char>& there) const;

 private:
  struct Face {
    int element_a;
    int element_b;
    std::vector<std::pair<int, int>> pairs;  ///< entries of a and b
    std::vector<int> entries;                ///< each once
    Eigen::MatrixXd conduction;              ///< m^3/(s Pa), over `entries`; empty unless leaky
    bool active = true;
  };

  WaterAcrossOptions options_;
  std::vector<Face> faces_;
  double duration_ = 0.0;  ///< of the last evaluation
};

/// Puts it before the pore water of the problem, which sums up what leaves the ground.
template <int dim>
void add_water_across(Problem<dim>& problem, std::shared_ptr<WaterAcross<dim>> across);

}  // namespace polargrain::fem
