// SPDX-License-Identifier: GPL-2.0-or-later
// model: elastoplastic - Cosserat cone matched to Mohr-Coulomb (docs/theory/plasticity.md)
#include "fem/material/elastoplastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cone_match.hpp"
#include "coupler/case/models/cosserat_moduli.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/slip_driven_cone.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
class ElastoplasticRecipe : public MaterialRecipe {
 public:
  ElastoplasticRecipe(fem::ElastoplasticParameters<dim> parameters, fem::MohrCoulombHardening strength,
                      fem::ConeMatch match, std::string note, bool spread)
      : parameters_(std::move(parameters)),
        strength_(std::move(strength)),
        match_(match),
        note_(std::move(note)),
        spread_(spread) {}
  [[nodiscard]] Slips slips() const override { return spread_ ? Slips::spread : Slips::own; }
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override {
    return make_local<2>(pool);
  }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return make_local<3>(pool);
  }
  [[nodiscard]] bool holds_micro_rotations() const override {
    return parameters_.elastic.cosserat_shear_modulus > 0.0;
  }
  [[nodiscard]] std::string note() const override { return note_; }
  [[nodiscard]] Weakened weakened(double factor) const override {
    fem::ElastoplasticParameters<dim> parameters = parameters_;
    const fem::MohrCoulombHardening strength = fem::divided(strength_, factor);
    parameters.cone = fem::hardening_cone(strength, match_);
    return {
        std::make_shared<ElastoplasticRecipe<dim>>(std::move(parameters), strength, match_, note_, spread_)};
  }

 private:
  template <int wanted>
  [[nodiscard]] std::shared_ptr<fem::Material<wanted>> make_local(Pool*) const {
    if constexpr (wanted == dim) {
      if (spread_) return std::make_shared<fem::SlipDrivenCone<dim>>(parameters_);
      return std::make_shared<fem::LocalMaterial<fem::ElastoplasticLaw<dim>>>(
          fem::ElastoplasticLaw<dim>(parameters_));
    }
    throw RunError("an elastoplastic material of another dimension was asked for");
  }

  fem::ElastoplasticParameters<dim> parameters_;
  fem::MohrCoulombHardening strength_;
  fem::ConeMatch match_;
  std::string note_;
  bool spread_;
};

/// The strength that a cone has where it was not matched; empty where that is no surprise.
std::string note_on(const std::string& name, const fem::HardeningCone& cone, fem::ConeMatch match) {
  if (match != fem::ConeMatch::triaxial_compression) return {};
  double steepest = 0.0;
  for (const double gamma_p : fem::merged_knots({&cone.friction}))
    steepest = std::max(steepest, cone.friction.at(gamma_p).value);
  const std::optional<double> angle = fem::angle_in_extension({steepest, 0.0, 0.0});
  if (angle) return {};
  return fmt::format(
      "{}: this cone has no limit in triaxial extension, as each from 36.9 degrees of friction in compression on; where "
      "extension matters, take 'match: triaxial_extension' or 'inner'",
      name);
}

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

template <int dim>
std::unique_ptr<MaterialRecipe> read_law(Section& section, Faults& faults, const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  fem::ElastoplasticParameters<dim> parameters;
  read_elastic_parameters(section, files, parameters.elastic);
  const double shear =
      section.quantity_if("hardening_shear", Dimension::number, Limit::positive).value_or(0.1);
  const fem::MohrCoulombHardening mohr_coulomb{
      strength(section, "friction_angle", Dimension::angle, Limit::not_negative, kDegrees, shear),
      strength(section, "dilatancy_angle", Dimension::angle, Limit::any, kDegrees, shear),
      strength(section, "cohesion", Dimension::pressure, Limit::not_negative, 1.0, shear)};
  const fem::ConeMatch match = read_match(section, dim);
  if (section.find("invariants") != nullptr) {
    const std::vector<double> a = section.quantities("invariants", 3, Dimension::number, Limit::any);
    parameters.weights = {a[0], a[1], a[2]};
  }
  if (faults.size() != faults_before) return nullptr;
  std::vector<std::string> messages;
  try {
    parameters.cone = fem::hardening_cone(mohr_coulomb, match);
    messages = fem::faults(parameters);
    if (files.spreads_slips)
      for (const std::string& message : fem::slip_faults(parameters)) messages.push_back(message);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) messages.push_back(fault.message);
  }
  for (const std::string& message : messages) {
    faults.push_back(section.entry().fault(section.name() + ": " + message));
  }
  if (!messages.empty()) return nullptr;
  std::string note = note_on(section.name(), parameters.cone, match);
  return std::make_unique<ElastoplasticRecipe<dim>>(std::move(parameters), mohr_coulomb, match,
                                                    std::move(note), files.spreads_slips);
}

std::unique_ptr<MaterialRecipe> read_elastoplastic_model(const std::string&, Section& section, Faults& faults,
                                                         const CaseFiles& files) {
  return files.dimension == 3 ? read_law<3>(section, faults, files) : read_law<2>(section, faults, files);
}

}  // namespace

MaterialModel elastoplastic_model() {
  return {"elastoplastic", "Cosserat cone: elastic parameters, friction_angle, dilatancy_angle, cohesion",
          read_elastoplastic_model};
}

}  // namespace polargrain::coupler
