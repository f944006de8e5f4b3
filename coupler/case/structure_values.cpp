// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/structure_values.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "fem/beam/anchor.hpp"
#include "fem/beam/beam.hpp"
#include "fem/interface/interface.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
double value_of(const fem::Interface<dim>& interface, const std::string& value) {
  if (value == "lever") return interface.lever();
  double pressure = 0.0;
  double water = 0.0;
  Eigen::Matrix<double, dim - 1, 1> shear = Eigen::Matrix<double, dim - 1, 1>::Zero();
  double slip = 0.0;
  double gap = 0.0;
  double mobilised = 0.0;
  typename Cosserat<dim>::Place in_face = Cosserat<dim>::Place::Zero();
  for (const fem::InterfacePointResult<dim>& point : interface.results()) {
    pressure -= point.geometry.area * point.traction(dim - 1);
    water += point.geometry.area * point.pore_pressure;
    shear += point.geometry.area * point.traction.template head<dim - 1>();
    in_face += point.geometry.area * (point.geometry.axes.template topRows<dim - 1>().transpose() *
                                      point.traction.template head<dim - 1>());
    slip = std::max(slip, point.slip);
    gap = std::max(gap, point.gap);
    mobilised = std::max(mobilised, point.mobilised);
  }
  if (value == "pressure") return pressure;
  if (value == "water") return water;
  if (value == "shear") return dim == 2 ? shear(0) : in_face.norm();
  if (value == "slip") return slip;
  return value == "gap" ? gap : mobilised;
}

double value_of(const fem::Beam& beam, const fem::Problem<2>& problem, const std::string& value) {
  double largest = 0.0;
  for (const fem::BeamResult& end : beam.results(problem)) {
    const double here = value == "moment" ? end.moment : value == "axial" ? end.axial : end.shear;
    if (std::abs(here) > std::abs(largest)) largest = here;
  }
  return largest;
}

}  // namespace

const std::vector<std::string>& values_of_structure(const std::string& kind) {
  static const std::vector<std::string> of_interface{"pressure", "shear",     "lever", "slip",
                                                     "gap",      "mobilised", "water"};
  static const std::vector<std::string> of_beam{"moment", "axial", "shear"};
  static const std::vector<std::string> of_anchor{"force"};
  return kind == "interface" ? of_interface : kind == "beam" ? of_beam : of_anchor;
}

template <int dim>
std::vector<std::string> structures_of(const fem::Problem<dim>& problem, const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& contribution : problem.contributions) {
    const fem::Contribution<dim>* const one = contribution.get();
    if (const auto* const interface = dynamic_cast<const fem::Interface<dim>*>(one);
        interface && kind == "interface")
      names.push_back(interface->settings().name);
    if (const auto* const anchor = dynamic_cast<const fem::Anchor<dim>*>(one); anchor && kind == "anchor")
      names.push_back(anchor->short_name());
    if constexpr (dim == 2)
      if (const auto* const beam = dynamic_cast<const fem::Beam*>(one); beam && kind == "beam")
        names.push_back(beam->short_name());
  }
  return names;
}

template <int dim>
double value_of_structure(const fem::Problem<dim>& problem, const std::string& structure,
                          const std::string& value) {
  for (const auto& contribution : problem.contributions) {
    const fem::Contribution<dim>* const one = contribution.get();
    if (const auto* const interface = dynamic_cast<const fem::Interface<dim>*>(one);
        interface && interface->settings().name == structure)
      return value_of<dim>(*interface, value);
    if (const auto* const anchor = dynamic_cast<const fem::Anchor<dim>*>(one);
        anchor && anchor->short_name() == structure)
      return anchor->force();
    if constexpr (dim == 2)
      if (const auto* const beam = dynamic_cast<const fem::Beam*>(one);
          beam && beam->short_name() == structure)
        return value_of(*beam, problem, value);
  }
  throw RunError("there is no interface, beam or anchor '" + structure + "'");
}

template std::vector<std::string> structures_of<2>(const fem::Problem<2>&, const std::string&);
template std::vector<std::string> structures_of<3>(const fem::Problem<3>&, const std::string&);
template double value_of_structure<2>(const fem::Problem<2>&, const std::string&, const std::string&);
template double value_of_structure<3>(const fem::Problem<3>&, const std::string&, const std::string&);

}  // namespace polargrain::coupler
