// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/boundary_cell.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/driver.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

constexpr double kLayer = 0.6;  ///< mean diameters

/// The packing in the middle of a box so large that no grain meets an image.
Packing taken_out(Packing packing) {
  if (packing.box(0, 1) != 0.0 || packing.box(1, 0) != 0.0)
    throw RunError("a cell with a prescribed boundary needs a packing in a box without tilt");
  const double margin = 4.0 * packing.mean_radius();
  packing.box += 2.0 * margin * Eigen::Matrix2d::Identity();
  for (Grain& grain : packing.grains) grain.position += Eigen::Vector2d::Constant(margin);
  packing.state = nullptr;
  return packing;
}

class BoundaryCell final : public CellService {
 public:
  explicit BoundaryCell(const CellDefinition& definition);
  CellReply initial() override { return initial_; }
  CellReply evaluate(const CellRequest& request) override;

 private:
  void find_boundary();
  [[nodiscard]] Response respond();

  CellControl control_;
  Packing packing_;
  Driver driver_;
  std::vector<bool> held_;
  Eigen::Vector2d span_ = Eigen::Vector2d::Zero();  // of the outermost centres in the packing, m
  double time_of_grain_ = 0.0;
  double damping_rate_ = 0.0;
  CellReply initial_;
};

BoundaryCell::BoundaryCell(const CellDefinition& definition)
    : control_(definition.control),
      packing_(taken_out(definition.packing)),
      driver_(packing_, definition.script, definition.script_file, definition.contact_library) {
  find_boundary();
  driver_.strain().hold(held_);
  driver_.set_up();
  driver_.settle_time_step(control_.damping);
  damping_rate_ = driver_.damping_rate(control_.damping);
  initial_.response = respond();
  const double pressure = -0.5 * (initial_.response.stress(k11) + initial_.response.stress(k22));
  const double density = driver_.grains() * driver_.mean_mass() / (driver_.grain_area() * packing_.thickness);
  time_of_grain_ = 2.0 * driver_.mean_radius() * std::sqrt(density / pressure);
  initial_.state = save_state(driver_.lammps(), driver_.strain().box());
}

void BoundaryCell::find_boundary() {
  const LAMMPS_NS::Atom& atom = *driver_.lammps().atom;
  Eigen::Vector2d low(atom.x[0][0], atom.x[0][1]);
  Eigen::Vector2d high = low;
  for (int k = 0; k < atom.nlocal; ++k) {
    const Eigen::Vector2d place(atom.x[k][0], atom.x[k][1]);
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  span_ = high - low;
  const double layer = kLayer * 2.0 * driver_.mean_radius();
  held_.assign(static_cast<std::size_t>(atom.nlocal), false);
  for (int k = 0; k < atom.nlocal; ++k) {
    const Eigen::Vector2d place(atom.x[k][0], atom.x[k][1]);
    held_[k] = (place - low).minCoeff() <= layer || (high - place).minCoeff() <= layer;
  }
}

CellReply BoundaryCell::evaluate(const CellRequest& request) {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  lammps.update->ntimestep = 0;
  const Box box = restore_state(lammps, request.state ? *request.state : *initial_.state).box;
  const Increment& increment = request.increment;
  const double size =
      std::max({increment.displacement_gradient.cwiseAbs().maxCoeff(), std::abs(increment.micro_rotation),
                increment.curvature.norm() * span_.norm()});
  const double steps = size * time_of_grain_ / (control_.inertial_number * driver_.strain().time_step());
  const int loading = std::max(control_.least_steps, static_cast<int>(std::min(steps, 1e8)));
  driver_.strain().begin(BoxPath(box, increment.displacement_gradient, loading), damping_rate_,
                         RotationLoading{increment.micro_rotation, increment.curvature});
  driver_.strain().hold(held_);
  driver_.set_up();

  driver_.run(loading);
  Equilibrium now = driver_.equilibrium();
  int relaxed = 0;
  const auto at_rest = [&] {
    return now.unbalanced_force_ratio <= control_.unbalanced_force_ratio &&
           now.unbalanced_moment_ratio <= control_.unbalanced_moment_ratio;
  };
  for (; !at_rest() && relaxed < control_.most_relaxation_steps; relaxed += kRelaxationChunk) {
    driver_.run(kRelaxationChunk);
    now = driver_.equilibrium();
  }
  CellReply reply;
  reply.response = respond();
  if (!at_rest()) {
    reply.response.quality = Quality::unreliable;
    reply.response.message = "the cell with a prescribed boundary did not come to rest";
  }
  reply.diagnostics.unbalanced_force_ratio = now.unbalanced_force_ratio;
  reply.diagnostics.unbalanced_moment_ratio = now.unbalanced_moment_ratio;
  reply.diagnostics.dem_steps = loading + relaxed;
  reply.state = save_state(lammps, driver_.strain().box());
  return reply;
}

Response BoundaryCell::respond() {
  const LAMMPS_NS::Atom& atom = *driver_.lammps().atom;
  const Box box = driver_.strain().box();
  const Eigen::Vector2d centre = 0.5 * box.base_vectors().rowwise().sum();
  const double volume = span_.prod() * packing_.thickness * box.area() / packing_.box.determinant();
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
  Eigen::Vector2d couple_stress = Eigen::Vector2d::Zero();
  for (int k = 0; k < atom.nlocal; ++k) {
    const Eigen::Vector2d place = Eigen::Vector2d(atom.x[k][0], atom.x[k][1]) - centre;
    const Eigen::Vector3d& reaction = driver_.strain().reactions()[k];
    stress += place * reaction.head<2>().transpose() / volume;
    couple_stress += place * reaction.z() / volume;
  }
  const Eigen::Matrix2d frame = box.frame();
  stress = frame * stress * frame.transpose();
  Response response;
  response.stress << stress(0, 0), stress(1, 1), 0.0, stress(0, 1), stress(1, 0), frame * couple_stress;
  return response;
}

}  // namespace

std::unique_ptr<CellService> make_boundary_cell_service(const CellDefinition& definition) {
  return std::make_unique<BoundaryCell>(definition);
}

}  // namespace polargrain::dem
