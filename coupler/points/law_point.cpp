// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/points/law_point.hpp"

#include "common/plane_in_space.hpp"

namespace polargrain::coupler {

element::Room room_of(const fem::Material<2>& material) {
  const auto* const driven = dynamic_cast<const fem::StrainDriven*>(&material);
  return driven != nullptr && driven->takes_any_strain() ? element::Room::axes : element::Room::plane_strain;
}

LawPoint::LawPoint(std::shared_ptr<fem::Material<2>> material, std::optional<double> pressure)
    : material_(std::move(material)) {
  if (room_of(*material_) == element::Room::axes)
    strain_driven_ = dynamic_cast<fem::StrainDriven*>(material_.get());
  material_->allocate(1);
  if (!pressure) return;
  Vector7 stress = Vector7::Zero();
  stress.head<3>().setConstant(-*pressure);
  material_->set_initial_stress(0, stress);
}

CellResponse LawPoint::evaluate(const CellIncrement& increment) {
  const Eigen::Matrix3d& h = increment.displacement_gradient;
  Response<2> response;
  if (strain_driven_ != nullptr) {
    Vector7 strain = Vector7::Zero();
    strain.head<3>() = h.diagonal();
    strain[k12] = strain[k21] = 0.5 * (h(0, 1) + h(1, 0));
    response = strain_driven_->evaluate_strain(strain);
  } else {
    Increment<2> plane;
    plane.displacement_gradient = h.topLeftCorner<2, 2>();
    plane.micro_rotation = 0.5 * (h(1, 0) - h(0, 1));
    material_->evaluate({&plane, 1}, {&response, 1});
  }
  return in_space(response, KnownComponents::all);
}

std::vector<double> LawPoint::fields() const {
  std::vector<double> values(material_->field_names().size());
  material_->fields(0, values);
  return values;
}

}  // namespace polargrain::coupler
