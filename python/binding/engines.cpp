// SPDX-License-Identifier: GPL-2.0-or-later
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <optional>

#include "common/record_table.hpp"
#include "coupler/hosts/hosted_cells.hpp"
#include "python/binding/arrays.hpp"
#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;
using coupler::DefinitionPointer;
using coupler::HostedCells;
using coupler::HostedRequest;

/// A question as polargrain/*.py puts it: cell, state or None (the packing), displacement gradient, rotation, curvature.
using Question = std::tuple<std::shared_ptr<CellDefinition>, std::shared_ptr<State>, Array, Array, Array>;

/// Whether Python wants to go on: not after Ctrl-C.
class Wish {
 public:
  bool operator()() {
    const py::gil_scoped_acquire interpreter;
    if (!raised_ && PyErr_CheckSignals() != 0) {
      raised_.emplace();  // takes what is raised
    }
    return !raised_;
  }
  /// To be called with the interpreter's lock: raises what a handler of signals has raised.
  void raise() {
    if (raised_) throw py::error_already_set(*raised_);
  }

 private:
  std::optional<py::error_already_set> raised_;
};

/// Asks with the interpreter free for others.
template <class Ask>
auto asked(const Ask& ask) {
  Wish wish;
  try {
    const py::gil_scoped_release release;
    return ask([&wish] { return wish(); });
  } catch (const coupler::Cancelled&) {
    wish.raise();
    throw;
  }
}

std::vector<CellReply> evaluate(HostedCells& cells, const std::vector<Question>& questions) {
  std::vector<HostedRequest> requests;
  for (const auto& [definition, state, gradient, rotation, curvature] : questions) {
    CellIncrement increment;
    increment.displacement_gradient = matrix_of<Eigen::Matrix3d>(gradient);
    increment.rotation = matrix_of<Eigen::Vector3d>(rotation);
    increment.curvature = matrix_of<Eigen::Matrix3d>(curvature);
    requests.push_back({definition, {state, increment}});
  }
  return asked([&](const HostedCells::IsWanted& is_wanted) { return cells.evaluate(requests, is_wanted); });
}

CellReply initial(HostedCells& cells, const std::shared_ptr<CellDefinition>& definition) {
  return asked([&](const HostedCells::IsWanted& is_wanted) { return cells.initial(definition, is_wanted); });
}

std::unique_ptr<HostedCells> make(const std::vector<std::string>& worker_command, int workers,
                                  bool trust_scripts) {
  HostedCells::Options options;
  options.worker_command = worker_command;
  options.workers = workers;
  options.trust_scripts = trust_scripts;
  return std::make_unique<HostedCells>(options);
}

py::dict diagnostics(const CellReply& reply) {
  py::dict values;
  const std::vector<std::string> names = names_of_columns<CellDiagnostics>();
  const std::vector<double> numbers = values_of(reply.diagnostics);
  for (std::size_t k = 0; k < names.size(); ++k) values[py::str(names[k])] = numbers[k];
  return values;
}

py::dict counts(const HostedCells& cells) {
  const coupler::PoolCounts counts = cells.counts();
  py::dict values;
  values["evaluations"] = counts.evaluations;
  values["dem_steps"] = counts.dem_steps;
  values["workers_lost"] = counts.workers_lost;
  values["engine_seconds"] = counts.engine_seconds;
  return values;
}

const char* word_of(Quality quality) {
  return quality == Quality::good ? "good" : quality == Quality::unreliable ? "unreliable" : "failed";
}

}  // namespace

void add_engines(py::module_& module) {
  py::class_<CellReply>(module, "Reply")
      .def_property_readonly("stress", [](const CellReply& reply) { return array_of(reply.response.stress); })
      .def_property_readonly("couple_stress",
                             [](const CellReply& reply) { return array_of(reply.response.couple_stress); })
      .def_property_readonly("tangent",
                             [](const CellReply& reply) { return array_of(reply.response.tangent); })
      .def_property_readonly("quality",
                             [](const CellReply& reply) { return word_of(reply.response.quality); })
      .def_property_readonly("message", [](const CellReply& reply) { return reply.response.message; })
      .def_property_readonly("step_factor", [](const CellReply& reply) { return reply.response.step_factor; })
      .def_property_readonly("diagnostics", &diagnostics)
      .def_property_readonly(
          "state", [](const CellReply& reply) { return std::const_pointer_cast<State>(reply.state); });
  py::class_<HostedCells>(module, "Engines")
      .def(py::init(&make))
      .def("initial", &initial)
      .def("evaluate", &evaluate)
      .def("counts", &counts)
      .def("close", &HostedCells::close, py::call_guard<py::gil_scoped_release>());
  module.def("program_for_workers", [](const std::vector<std::string>& places) {
    return coupler::program_for_workers({places.begin(), places.end()});
  });
  module.def("diagnostics_notes", [] {
    py::dict notes;
    for (const Column& column : columns_of<CellDiagnostics>())
      notes[py::str(column.name)] = py::make_tuple(column.unit, column.meaning);
    return notes;
  });
}

}  // namespace polargrain::python
