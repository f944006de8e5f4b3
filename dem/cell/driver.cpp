// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/driver.hpp"

#include <numbers>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

Driver::Driver(const Packing& packing, const std::string& script, const std::string& script_file,
               const ContactLibraryFile& contact_library, const std::function<void(Engine&)>& after_script)
    : GrainEngine(packing, script, script_file, contact_library, after_script, "cell/strain"),
      thickness_(packing.thickness) {
  for (const Grain& grain : packing.grains) grain_area_ += std::numbers::pi * grain.radius * grain.radius;
  strain_ = dynamic_cast<FixCellStrain*>(strain_fix());
  strain_->begin(BoxPath(Box::from_base_vectors(packing.box).reduced(), Eigen::Matrix2d::Zero(), 0), 0.0);
  start();
}

double Driver::volume() const {
  return strain_->box().area() * thickness_;
}

Equilibrium Driver::equilibrium() const {
  return equilibrium_of(contacts(), strain_->imbalance(), mean_radius(), 0.0, strain_->box().area(),
                        grain_area_);
}

}  // namespace polargrain::dem
