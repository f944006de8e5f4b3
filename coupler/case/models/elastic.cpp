// SPDX-License-Identifier: GPL-2.0-or-later
// model: elastic - isotropic Cosserat elasticity (docs/theory.md, A.4)
#include "fem/material/elastic.hpp"

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cosserat_moduli.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
class ElasticRecipe : public MaterialRecipe {
 public:
  explicit ElasticRecipe(const fem::ElasticParameters<dim>& parameters) : parameters_(parameters) {}
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override {
    return make_local<2>(pool);
  }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return make_local<3>(pool);
  }
  [[nodiscard]] bool holds_micro_rotations() const override {
    return parameters_.cosserat_shear_modulus > 0.0;
  }
  [[nodiscard]] Slips slips() const override { return Slips::none; }

 private:
  template <int wanted>
  [[nodiscard]] std::shared_ptr<fem::Material<wanted>> make_local(Pool*) const {
    if constexpr (wanted == dim)
      return std::make_shared<fem::LocalMaterial<fem::ElasticLaw<dim>>>(fem::ElasticLaw<dim>(parameters_));
    throw RunError("an elastic material of another dimension was asked for");
  }

  fem::ElasticParameters<dim> parameters_;
};

template <int dim>
std::unique_ptr<MaterialRecipe> read_elastic(Section& section, Faults& faults, const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  fem::ElasticParameters<dim> parameters;
  read_elastic_parameters(section, files, parameters);
  if (faults.size() != faults_before) return nullptr;
  for (const std::string& message : fem::faults(parameters)) {
    faults.push_back(section.entry().fault(section.name() + ": " + message));
  }
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<ElasticRecipe<dim>>(parameters);
}

std::unique_ptr<MaterialRecipe> read_elastic_model(const std::string&, Section& section, Faults& faults,
                                                   const CaseFiles& files) {
  return files.dimension == 3 ? read_elastic<3>(section, faults, files)
                              : read_elastic<2>(section, faults, files);
}

}  // namespace

MaterialModel elastic_model() {
  return {"elastic", "isotropic Cosserat elasticity: E, nu, Gc, lc", read_elastic_model};
}

}  // namespace polargrain::coupler
