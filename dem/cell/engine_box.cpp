// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/engine_box.hpp"

#include "dem/box/engine_grains.hpp"
#include "dem/cell/fast_loop.hpp"

namespace polargrain::dem {

template <int dim>
EngineBox<dim>::EngineBox(Driver<dim>& driver) : driver_(driver) {
  driver_.progress = [this] {
    if (this->progress) this->progress();
  };
}

template <int dim>
GrainMotion<dim> EngineBox<dim>::motion(int grain) const {
  return motion_of<dim>(*driver_.lammps().atom, grain);
}

template <int dim>
std::unique_ptr<GrainBox<dim>> choose_box(Driver<dim>& driver, CellLoop loop) {
  using Loop = FastLoop<dim>;
  LAMMPS_NS::LAMMPS& lammps = driver.lammps();
  const LawSelection selection = Loop::selection(lammps);
  if (loop == CellLoop::engine || !selection.combination) return std::make_unique<EngineBox<dim>>(driver);
  auto box = Loop::make(driver, *selection.combination, loop == CellLoop::plain);
  const FixCellStrain<dim>& strain = driver.strain();
  box->restore(Loop::snapshot(lammps, *selection.combination, strain.box(), strain.rotations()));
  box->set_up();
  return box;
}

template class EngineBox<2>;
template class EngineBox<3>;
template std::unique_ptr<GrainBox<2>> choose_box(Driver<2>&, CellLoop);
template std::unique_ptr<GrainBox<3>> choose_box(Driver<3>&, CellLoop);

}  // namespace polargrain::dem
