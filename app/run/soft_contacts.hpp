// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

namespace polargrain::fem {
template <int dim>
class Solver;
}

namespace polargrain::app {

/// Says, in a sentence for people, that grains of a committed cell overlap by more than contacts are meant to
/// (docs/user_guide.md, packings): which element, and by how much. Empty without such grains, and where no material has cells.
template <int dim>
std::string soft_contacts(const fem::Solver<dim>& solver);

}  // namespace polargrain::app
