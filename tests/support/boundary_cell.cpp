// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/boundary_cell.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/plane_in_space.hpp"
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

/// The boundary turns its grains.
CellControl turning(CellControl control) {
  control.rotations = CellRotations::controlled;
  return control;
}

class BoundaryCell final : public CellService {
 public:
  explicit BoundaryCell(const CellDefinition& definition);
  CellReply initial() override { return initial_; }
  CellReply evaluate(const CellRequest& request) override;

 private:
  void find_boundary();
  [[nodiscard]] CellResponse respond();

  QuasiStatic protocol_;
  Packing packing_;
  Driver driver_;
  std::vector<bool> held_;
  Eigen::Vector2d span_ = Eigen::Vector2d::Zero();  // of the outermost centres in the packing, m
  CellReply initial_;
};

BoundaryCell::BoundaryCell(const CellDefinition& definition)
    : protocol_(turning(definition.control)),
      packing_(taken_out(definition.packing)),
      driver_(packing_, definition.script, definition.script_file, definition.contact_library) {
  find_boundary();
  driver_.strain().hold(held_);
  driver_.set_up();
  driver_.settle_time_step(definition.control.damping);
  initial_.response = respond();
  const double pressure = -0.5 * (initial_.response.stress(0, 0) + initial_.response.stress(1, 1));
  const double density = driver_.grains() * driver_.mean_mass() / (driver_.grain_area() * packing_.thickness);
  protocol_.take_scales({driver_.mean_mass(), driver_.mean_radius(), density}, driver_.contacts(), pressure);
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
  if (const std::string fault = out_of_plane_fault(request.increment); !fault.empty()) throw RunError(fault);
  const Increment<2> increment = in_plane(request.increment);
  driver_.strain().begin(protocol_.begin(box, increment, driver_.strain().time_step(), span_.norm()),
                         protocol_.damping_rate(), protocol_.rotation_of(increment));
  driver_.strain().hold(held_);
  driver_.set_up();

  Equilibrium now;
  do {
    const int steps = protocol_.steps_to_next_look();
    driver_.run(steps);
    protocol_.advance(steps);
    now = driver_.equilibrium();
  } while (!protocol_.ended(now.unbalanced_force_ratio, now.unbalanced_moment_ratio));
  CellReply reply;
  reply.response = respond();
  if (!protocol_.at_rest(now.unbalanced_force_ratio, now.unbalanced_moment_ratio)) {
    reply.response.quality = Quality::unreliable;
    reply.response.message = "the cell with a prescribed boundary did not come to rest";
  }
  reply.diagnostics.unbalanced_force_ratio = now.unbalanced_force_ratio;
  reply.diagnostics.unbalanced_moment_ratio = now.unbalanced_moment_ratio;
  reply.diagnostics.dem_steps = protocol_.done();
  reply.state = save_state(lammps, driver_.strain().box());
  return reply;
}

CellResponse BoundaryCell::respond() {
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
  Response<2> response;
  response.stress << stress(0, 0), stress(1, 1), 0.0, stress(0, 1), stress(1, 0), frame * couple_stress;
  return in_space(response, KnownComponents::plane);
}

}  // namespace

std::unique_ptr<CellService> make_boundary_cell_service(const CellDefinition& definition) {
  return std::make_unique<BoundaryCell>(definition);
}

}  // namespace polargrain::dem
