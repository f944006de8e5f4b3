// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fem/mesh/mesh.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// A named array of a file: `components` values an entity, entity after entity.
struct Field {
  std::string name;
  int components;
  std::vector<double> values;
};

/// The fields of one output time.
struct Fields {
  std::vector<Field> points;  ///< by node
  std::vector<Field> cells;   ///< by element
};

/// Fields of the committed state. By node: displacement (u1, u2, 0), micro_rotation. By element, averages
/// over the volume: stress and strain (11, 22, 33, 12, 21), couple_stress, curvature, deviatoric_strain
/// (sqrt(2/3 e_ij e_ij) of the symmetric deviator), and what the materials show (Material::fields; 0 where
/// the element's material does not have the field).
Fields collect_fields(const Solver& solver);

/// Writes a VTK unstructured grid (XML, base64). The file appears complete or not at all.
/// @throws RunError when it cannot be written.
void write_vtu(const std::filesystem::path& file, const Mesh& mesh, const Fields& fields);

/// The list of .vtu files over time that ParaView opens.
class PvdCollection {
 public:
  explicit PvdCollection(std::filesystem::path file) : file_(std::move(file)) {}
  /// Adds a file and rewrites the collection. @param vtu path relative to the collection.
  void add(double time, const std::filesystem::path& vtu);

 private:
  std::filesystem::path file_;
  std::vector<std::pair<double, std::filesystem::path>> entries_;
};

}  // namespace polargrain::fem
