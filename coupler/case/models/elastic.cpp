// SPDX-License-Identifier: GPL-2.0-or-later
// model: elastic - isotropic Cosserat elasticity (docs/theory.md, A.4)
#include "fem/material/elastic.hpp"

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cosserat_moduli.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::coupler {
namespace {

class ElasticRecipe : public MaterialRecipe {
 public:
  explicit ElasticRecipe(const fem::ElasticParameters& parameters) : parameters_(parameters) {}
  [[nodiscard]] std::shared_ptr<fem::Material> make(Pool*) const override {
    return std::make_shared<fem::LocalMaterial<fem::ElasticLaw>>(fem::ElasticLaw(parameters_));
  }
  [[nodiscard]] bool holds_micro_rotations() const override {
    return parameters_.cosserat_shear_modulus > 0.0;
  }

 private:
  fem::ElasticParameters parameters_;
};

std::unique_ptr<MaterialRecipe> read(const std::string&, Section& section, Faults& faults,
                                     const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  fem::ElasticParameters parameters;
  parameters.young_modulus = section.quantity("E", Dimension::pressure, Limit::positive);
  parameters.poisson_ratio = section.quantity("nu", Dimension::number, Limit::any);
  read_cosserat_moduli(section, files, parameters);
  const double confining = section.quantity_or("confining", Dimension::pressure, Limit::any, 0.0);
  for (int i : {k11, k22, k33}) parameters.initial_stress[i] = -confining;
  if (faults.size() != faults_before) return nullptr;
  for (const std::string& message : fem::faults(parameters)) {
    faults.push_back(section.entry().fault(section.name() + ": " + message));
  }
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<ElasticRecipe>(parameters);
}

}  // namespace

MaterialModel elastic_model() {
  return {"elastic", "isotropic Cosserat elasticity: E, nu, Gc, lc", read};
}

}  // namespace polargrain::coupler
