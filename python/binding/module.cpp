// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/error.hpp"
#include "python/binding/binding.hpp"

namespace polargrain::python {
namespace {

namespace py = pybind11;

/// Errors of the program as those of polargrain/errors.py, with the same words.
void add_errors(py::module_& module) {
  static py::handle input_error;
  static py::handle run_error;
  const py::module_ errors = py::module_::import("polargrain.errors");
  input_error = errors.attr("InputError").cast<py::object>().release();
  run_error = errors.attr("RunError").cast<py::object>().release();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const InputError& error) {
      py::list faults;
      for (const Fault& fault : error.faults())
        faults.append(py::make_tuple(fault.file, fault.line, fault.message));
      PyErr_SetObject(input_error.ptr(), input_error(error.what(), faults).ptr());
    } catch (const RunError& error) {
      PyErr_SetString(run_error.ptr(), error.what());
    }
  });
  module.attr("__all__") = py::list();
}

}  // namespace
}  // namespace polargrain::python

PYBIND11_MODULE(_cells, module) {
  using namespace polargrain::python;
  add_errors(module);
  add_packing(module);
  add_definition(module);
  add_state(module);
  add_engines(module);
  add_band(module);
}
