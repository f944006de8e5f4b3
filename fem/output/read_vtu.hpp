// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "fem/mesh/mesh.hpp"
#include "fem/output/vtu.hpp"

namespace polargrain::fem {

/// The content of a field file: a mesh without named parts, and its fields.
template <int dim>
struct FieldFile {
  Mesh<dim> mesh;
  Fields fields;
};

/// Reads a file of write_vtu, of the dimension. Elements are of the first type that element_names() has for their VTK type.
/// @throws InputError naming the file when it is another kind of file, or its arrays do not fit together
template <int dim = 2>
FieldFile<dim> read_vtu(const std::filesystem::path& file);

/// 3 where one of the cells has a volume, else 2. @throws InputError as read_vtu
int dimension_of_vtu(const std::filesystem::path& file);

/// The field of that name, or null.
const Field* find_field(const std::vector<Field>& fields, const std::string& name);

}  // namespace polargrain::fem
