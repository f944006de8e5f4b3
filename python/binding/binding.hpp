// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <pybind11/pybind11.h>

namespace polargrain::python {

// The parts of the module `polargrain._cells`, a file each. The interface for users is made of it in polargrain/*.py, where it is
// documented.
void add_packing(pybind11::module_& module);
void add_definition(pybind11::module_& module);
void add_state(pybind11::module_& module);
void add_engines(pybind11::module_& module);
void add_band(pybind11::module_& module);

}  // namespace polargrain::python
