// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/state.hpp"

#include <span>
#include <string>

#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;

py::bytes bytes_of(const State& state) {
  const auto bytes = state.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::shared_ptr<State> state_of(const py::bytes& bytes) {
  const std::string_view text = bytes;
  const auto values = std::as_bytes(std::span(text));
  return std::make_shared<State>(std::vector(values.begin(), values.end()));
}

}  // namespace

void add_state(py::module_& module) {
  py::class_<State, std::shared_ptr<State>>(module, "State")
      .def_property_readonly("bytes", &bytes_of)
      .def_property_readonly("name", [](const State& state) { return state.name().text(); })
      .def_static("of_bytes", &state_of)
      .def("__len__", &State::size);
}

}  // namespace polargrain::python
