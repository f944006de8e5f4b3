// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing.hpp"

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include "common/error.hpp"
#include "python/binding/arrays.hpp"
#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;

/// One value of each grain.
template <class Value>
Array column(const Packing& packing, Value value) {
  Array array(static_cast<py::ssize_t>(packing.grains.size()));
  for (std::size_t k = 0; k < packing.grains.size(); ++k)
    array.mutable_data()[k] = static_cast<double>(value(packing.grains[k]));
  return array;
}

/// Centres, two or three columns.
Array positions(const Packing& packing) {
  const auto grains = static_cast<py::ssize_t>(packing.grains.size());
  Array array({grains, static_cast<py::ssize_t>(packing.dimension)});
  auto values = array.mutable_unchecked<2>();
  for (py::ssize_t k = 0; k < grains; ++k) {
    const Grain& grain = packing.grains[static_cast<std::size_t>(k)];
    values(k, 0) = grain.position.x();
    values(k, 1) = grain.position.y();
    if (packing.dimension == 3) values(k, 2) = grain.height;
  }
  return array;
}

}  // namespace

void add_packing(py::module_& module) {
  py::class_<Packing>(module, "Packing")
      .def_readonly("dimension", &Packing::dimension)
      .def_readonly("thickness", &Packing::thickness)
      .def_readonly("pressure", &Packing::pressure)
      .def_property_readonly("box",
                             [](const Packing& packing) {
                               return packing.dimension == 3 ? array_of(packing.base_vectors())
                                                             : array_of(packing.box);
                             })
      .def_property_readonly("positions", positions)
      .def_property_readonly(
          "radii", [](const Packing& p) { return column(p, [](const Grain& g) { return g.radius; }); })
      .def_property_readonly(
          "masses", [](const Packing& p) { return column(p, [](const Grain& g) { return g.mass; }); })
      .def_property_readonly("volume", &Packing::volume)
      .def_property_readonly("grain_volume", &Packing::grain_volume)
      .def("__len__", [](const Packing& packing) { return packing.grains.size(); });
  module.def("read_packing", &read_packing, py::call_guard<py::gil_scoped_release>());
}

}  // namespace polargrain::python
