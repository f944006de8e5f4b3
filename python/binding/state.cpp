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
  py::class_<State, std::shared_ptr<State>>(
      module, "State",
      R"(All that a cell needs to go on: its box, its grains, the histories of their contacts.

A value: it never changes, keeping one is saving, giving one back to a cell is going back. States can be compared,
pickled, and sent to other processes and machines of the same type. What is in them is the business of the engine.

bytes -- as they are kept
name  -- 32 hexadecimal digits; equal states have equal names
len() -- number of bytes)")
      .def_property_readonly("bytes", &bytes_of)
      .def_property_readonly("name", [](const State& state) { return state.name().text(); })
      .def_static("of_bytes", &state_of, py::arg("bytes"), "The state whose `bytes` these are.")
      .def("__len__", &State::size)
      .def(
          "__eq__", [](const State& one, const State& other) { return one.name() == other.name(); },
          py::is_operator())
      .def("__hash__", [](const State& state) { return state.name().low; })
      .def("__repr__",
           [](const State& state) { return "<polargrain.State " + state.name().text().substr(0, 8) + ">"; })
      .def(py::pickle(&bytes_of, &state_of));
}

}  // namespace polargrain::python
