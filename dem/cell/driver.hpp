// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <span>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/grain_engine.hpp"
#include "dem/cell/quasi_static.hpp"

namespace polargrain::dem {

/// One engine with one packing in a periodic box that follows a path: the common part of cells and of the making
/// of packings. The box is the packing's, at rest.
template <int dim>
class Driver : public GrainEngine {
 public:
  /// Without the contacts of the packing. @param after_script see GrainEngine
  Driver(const Packing& packing, const std::string& script, const std::string& script_file,
         const ContactLibraryFile& contact_library = {},
         const std::function<void(Engine&)>& after_script = {});
  /// With them, where it has any. @throws RunError when places or contacts do not belong to a packing of this script
  explicit Driver(const CellDefinition& definition);

  FixCellStrain<dim>& strain() { return *strain_; }
  [[nodiscard]] const FixCellStrain<dim>& strain() const { return *strain_; }

  /// @throws RunError when the state is not one of these grains and models
  void restore(const State& state);
  /// The grains as they are, in their reduced box; spheres are folded back into it.
  StatePointer save();

  /// Of the recorded contacts and the last force pass.
  [[nodiscard]] Equilibrium equilibrium() const;
  /// Areas of the discs, m^2, or volumes of the spheres, m^3, added up.
  [[nodiscard]] double grain_sizes() const { return grain_sizes_; }
  /// Of a plane packing along x3, m; 1 in space.
  [[nodiscard]] double depth() const { return depth_; }
  /// Places in the frame of the box, `dim` numbers a grain, m.
  [[nodiscard]] std::span<const double> places();

 private:
  double grain_sizes_ = 0.0;
  double depth_ = 1.0;
  FixCellStrain<dim>* strain_ = nullptr;
  std::vector<double> places_;
};

}  // namespace polargrain::dem
