// SPDX-License-Identifier: GPL-2.0-or-later
#include <numbers>

#include "band/local_strain.hpp"
#include "band/shear_band.hpp"
#include "python/binding/arrays.hpp"
#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;

std::vector<Eigen::Vector2d> places(const Array& array) {
  const auto values = array.unchecked<2>();
  std::vector<Eigen::Vector2d> all;
  for (py::ssize_t k = 0; k < values.shape(0); ++k) all.emplace_back(values(k, 0), values(k, 1));
  return all;
}

py::dict find_band(const Array& positions, const Array& shear, const Array& areas, double contrast) {
  band::Samples samples;
  for (const Eigen::Vector2d& position : places(positions)) {
    const auto k = static_cast<py::ssize_t>(samples.size());
    band::Sample sample;
    sample.position = position;
    sample.area = areas.data()[k];
    sample.shear = shear.data()[k];
    samples.push_back(sample);
  }
  const band::BandSearch search = band::find_band(samples, {contrast});
  py::dict found;
  found["found"] = search.band.has_value();
  if (!search.band) {
    found["reason"] = search.reason;
    return found;
  }
  found["inclination_degrees"] = search.band->inclination * 180.0 / std::numbers::pi;
  found["thickness"] = search.band->thickness;
  found["resolution"] = search.band->resolution;
  found["centre"] = py::make_tuple(search.band->centre.x(), search.band->centre.y());
  found["peak_shear"] = search.band->peak;
  found["background_shear"] = search.band->background;
  return found;
}

Array displacement_gradients(const Array& positions, const Array& displacements, double radius) {
  const auto gradients = band::displacement_gradients(places(positions), places(displacements), radius);
  Eigen::Matrix<double, Eigen::Dynamic, 4> rows(static_cast<Eigen::Index>(gradients.size()), 4);
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const Eigen::Matrix2d& h = gradients[static_cast<std::size_t>(k)];
    rows.row(k) << h(0, 0), h(0, 1), h(1, 0), h(1, 1);
  }
  return array_of(rows);
}

}  // namespace

void add_band(py::module_& module) {
  module.def("find_band", &find_band);
  module.def("displacement_gradients", &displacement_gradients);
}

}  // namespace polargrain::python
