// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
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
  std::string unit = {};                          ///< "1" for a pure number; empty: not said
  std::vector<std::string> component_names = {};  ///< one a component; empty: no component has a name
};

/// The fields of one output time.
struct Fields {
  std::vector<Field> points;  ///< by node
  std::vector<Field> cells;   ///< by element
};

/// Fields of the committed state (docs/file_formats.md, fields). By node: displacement (u1, u2, 0), micro_rotation, the
/// same as a vector; by node smoothed (smooth.hpp) and by element as averages over the volume: stress and strain (11, 22, 33,
/// 12, 21), couple_stress, curvature, relative_rotation (theory, A.1; about e_3), volume_strain, deviatoric_strain (sqrt(2/3 e_ij e_ij) of the symmetric deviator),
/// the fields of the materials (Material::fields; 0 where the element's material does not have the field; at nodes only
/// quantities in space), and the StressMeasures of the stress so averaged or smoothed. In space tensors have nine components
/// (11, 12 .. 33), and rotations three.
template <int dim>
Fields collect_fields(const Solver<dim>& solver);

/// Fields at places of their own, and lines between them.
struct PlacedFields {
  std::vector<Eigen::Vector3d> places = {};            ///< m
  std::vector<Field> fields = {};                      ///< by place
  std::vector<std::array<std::size_t, 2>> lines = {};  ///< from place to place
  std::vector<Field> cell_fields = {};                 ///< by place, then by line
  std::vector<Field> whole = {};                       ///< of all of it together: VTK's field data
};

/// The same at the integration points, on the mesh as it was made, in the order of the solver, nothing averaged or smoothed; displacement and rotations
/// as the element has them there; `volume` (m^3; of the plane per unit thickness, m^2).
template <int dim>
PlacedFields collect_point_fields(const Solver<dim>& solver);

/// Writes a VTK unstructured grid (XML, base64), with names of components, and units under VTK's own key
/// vtkDataArray::UNITS_LABEL. The file appears complete or not at all.
/// @throws RunError when it cannot be written.
template <int dim>
void write_vtu(const std::filesystem::path& file, const Mesh<dim>& mesh, const Fields& fields);

/// The same for places: a vertex for each, then a line for each line. These are the large files: compressed (zlib).
void write_vtu(const std::filesystem::path& file, const PlacedFields& fields);

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
