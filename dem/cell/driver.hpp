// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <string>

#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/grain_engine.hpp"
#include "dem/cell/quasi_static.hpp"

namespace polargrain::dem {

/// One engine with one packing of discs in a periodic box that follows a path: the common part of cells and of the making
/// of packings. The box is the packing's, at rest.
class Driver : public GrainEngine {
 public:
  Driver(const Packing& packing, const std::string& script, const std::string& script_file,
         const ContactLibraryFile& contact_library = {},
         const std::function<void(Engine&)>& after_script = {});

  FixCellStrain& strain() { return *strain_; }
  [[nodiscard]] const FixCellStrain& strain() const { return *strain_; }

  /// Of the recorded contacts and the last force pass.
  [[nodiscard]] Equilibrium equilibrium() const;

  [[nodiscard]] double grain_area() const { return grain_area_; }  ///< sum, m^2
  [[nodiscard]] double volume() const;                             ///< of the box now, m^3

 private:
  double grain_area_ = 0.0;
  double thickness_ = 0.0;
  FixCellStrain* strain_ = nullptr;
};

}  // namespace polargrain::dem
