// SPDX-License-Identifier: GPL-2.0-or-later
// model: elastoplastic - Cosserat cone matched to Mohr-Coulomb in plane strain (docs/theory/plasticity.md)
#include "fem/material/elastoplastic.hpp"

#include <fmt/format.h>

#include <numbers>

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cosserat_moduli.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::coupler {
namespace {

class ElastoplasticRecipe : public MaterialRecipe {
 public:
  explicit ElastoplasticRecipe(fem::ElastoplasticParameters parameters)
      : parameters_(std::move(parameters)) {}
  [[nodiscard]] std::shared_ptr<fem::Material> make(Pool*) const override {
    return std::make_shared<fem::LocalMaterial<fem::ElastoplasticLaw>>(fem::ElastoplasticLaw(parameters_));
  }
  [[nodiscard]] bool holds_micro_rotations() const override {
    return parameters_.elastic.cosserat_shear_modulus > 0.0;
  }

 private:
  fem::ElastoplasticParameters parameters_;
};

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// A value that stays; or [first, last]: straight from one to the other over the plastic shear
/// `hardening_shear`, then constant; or a table [[plastic shear, value], ...].
fem::PiecewiseLinear strength(Section& section, const std::string& key, Dimension dimension, Limit limit,
                              double factor, double hardening_shear) {
  const Entry* entry = section.find(key);
  if (entry == nullptr || entry->kind != Entry::Kind::sequence) {
    return factor * section.quantity(key, dimension, limit);
  }
  if (!entry->items.empty() && entry->items.front().kind == Entry::Kind::sequence) {
    std::vector<fem::PiecewiseLinear::Knot> knots;
    for (const auto& [gamma_p, value] : section.pairs(key, Dimension::number, dimension, limit)) {
      knots.push_back({gamma_p, factor * value});
    }
    return knots.empty() ? fem::PiecewiseLinear() : fem::PiecewiseLinear(std::move(knots));
  }
  const std::vector<double> ends = section.quantities(key, 2, dimension, limit);
  return fem::PiecewiseLinear::ramp(factor * ends[0], factor * ends[1], hardening_shear);
}

std::unique_ptr<MaterialRecipe> read(const std::string&, Section& section, Faults& faults,
                                     const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  fem::ElastoplasticParameters parameters;
  parameters.elastic.young_modulus = section.quantity("E", Dimension::pressure, Limit::positive);
  parameters.elastic.poisson_ratio = section.quantity("nu", Dimension::number, Limit::any);
  read_cosserat_moduli(section, files, parameters.elastic);
  const double confining = section.quantity_or("confining", Dimension::pressure, Limit::any, 0.0);
  for (int i : {k11, k22, k33}) parameters.elastic.initial_stress[i] = -confining;
  const double shear = section.quantity_or("hardening_shear", Dimension::number, Limit::positive, 0.1);
  const fem::MohrCoulombHardening mohr_coulomb{
      strength(section, "friction_angle", Dimension::angle, Limit::not_negative, kDegrees, shear),
      strength(section, "dilatancy_angle", Dimension::angle, Limit::any, kDegrees, shear),
      strength(section, "cohesion", Dimension::pressure, Limit::not_negative, 1.0, shear)};
  if (section.find("invariants") != nullptr) {
    const std::vector<double> a = section.quantities("invariants", 3, Dimension::number, Limit::any);
    parameters.weights = {a[0], a[1], a[2]};
  }
  if (faults.size() != faults_before) return nullptr;
  std::vector<std::string> messages;
  try {
    parameters.cone = fem::hardening_cone_from_plane_strain(mohr_coulomb);
    messages = fem::faults(parameters);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) messages.push_back(fault.message);
  }
  for (const std::string& message : messages) {
    faults.push_back(section.entry().fault(section.name() + ": " + message));
  }
  if (!messages.empty()) return nullptr;
  return std::make_unique<ElastoplasticRecipe>(std::move(parameters));
}

}  // namespace

MaterialModel elastoplastic_model() {
  return {"elastoplastic", "Cosserat cone: elastic parameters, friction_angle, dilatancy_angle, cohesion",
          read};
}

}  // namespace polargrain::coupler
