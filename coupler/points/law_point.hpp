// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "element/material_point.hpp"
#include "fem/material/material.hpp"
#include "fem/material/strain_driven.hpp"

namespace polargrain::coupler {

/// A material of finite elements as the one point of a laboratory test, in small deformation: strains add up, the
/// micro-rotation follows the continuum, so that stresses are symmetric. Laws that answer in place are strained along
/// e_3 too; others (cells, adaptive, informed) in their plane alone.
class LawPoint : public element::MaterialPoint {
 public:
  /// @param pressure isotropic stress to start from, Pa, compression positive; nothing: the material's own
  explicit LawPoint(std::shared_ptr<fem::Material<2>> material, std::optional<double> pressure = {});

  [[nodiscard]] element::Room room() const override {
    return strain_driven_ != nullptr ? element::Room::axes : element::Room::plane_strain;
  }
  [[nodiscard]] bool is_large() const override { return false; }
  CellResponse initial() override { return evaluate({}); }
  CellResponse evaluate(const CellIncrement& increment) override;
  void commit() override { material_->commit(); }
  [[nodiscard]] std::vector<std::string> field_names() const override { return material_->field_names(); }
  [[nodiscard]] std::vector<double> fields() const override;

 private:
  std::shared_ptr<fem::Material<2>> material_;
  fem::StrainDriven* strain_driven_ = nullptr;  ///< the same material; null: it knows the plane alone
};

/// Whether a material can be strained along e_3, before there is a point of it.
element::Room room_of(const fem::Material<2>& material);

}  // namespace polargrain::coupler
