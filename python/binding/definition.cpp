// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <span>

#include "coupler/hosts/definition_of_words.hpp"
#include "coupler/protocol/messages.hpp"
#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;
using Words = std::vector<std::pair<std::string, std::string>>;

CellDefinition make(const Words& words, const std::optional<Packing>& packing,
                    const std::filesystem::path& directory, bool trust_scripts) {
  return coupler::definition_of({"", words, packing, directory, {trust_scripts, {}}});
}

/// Whole, as workers are sent it.
py::bytes bytes_of(const CellDefinition& definition) {
  return py::bytes(coupler::encode(coupler::Define{0, definition}));
}

CellDefinition definition_of_bytes(const py::bytes& bytes) {
  try {
    const std::string_view text = bytes;
    const coupler::Envelope envelope = coupler::decode(std::as_bytes(std::span(text)));
    if (const auto* const define = std::get_if<coupler::Define>(&envelope.message)) return define->cell;
  } catch (const coupler::ProtocolError& error) {
    throw RunError(fmt::format("these bytes are no cell of this version: {}", error.what()));
  }
  throw RunError("these bytes are no cell");
}

}  // namespace

void add_definition(py::module_& module) {
  py::class_<CellDefinition, std::shared_ptr<CellDefinition>>(module, "Definition")
      .def(py::init(&make))
      .def_readonly("packing", &CellDefinition::packing)
      .def_readonly("script", &CellDefinition::script)
      .def_readonly("script_file", &CellDefinition::script_file)
      .def_property_readonly("has_controlled_rotations",
                             [](const CellDefinition& definition) {
                               return definition.control.rotations == CellRotations::controlled;
                             })
      .def(py::pickle(&bytes_of, &definition_of_bytes));
}

}  // namespace polargrain::python
