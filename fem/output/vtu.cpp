// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/vtu.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "fem/output/base64.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::fem {
namespace {

template <class T>
constexpr const char* kVtkType = nullptr;
template <>
constexpr const char* kVtkType<double> = "Float64";
template <>
constexpr const char* kVtkType<std::int64_t> = "Int64";
template <>
constexpr const char* kVtkType<std::uint8_t> = "UInt8";

/// A DataArray of the inline binary form: the number of bytes as UInt64, then the bytes, as one base64 text.
/// @param attributes further ones @param notes elements that follow the bytes
template <class T>
std::string data_array(const std::string& name, int components, const std::vector<T>& values,
                       const std::string& attributes = {}, const std::string& notes = {}) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::vector<std::byte> bytes(sizeof(size) + size);
  std::memcpy(bytes.data(), &size, sizeof(size));
  if (size > 0) std::memcpy(bytes.data() + sizeof(size), values.data(), size);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">\n{}\n{}</DataArray>\n",
      kVtkType<T>, name, components, attributes, base64(bytes), notes);
}

std::string field_array(const Field& field, std::string names = {}) {
  for (std::size_t k = 0; k < field.component_names.size(); ++k)
    names += fmt::format(" ComponentName{}=\"{}\"", k, field.component_names[k]);
  std::string unit;
  if (!field.unit.empty())
    unit = fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n",
                       field.unit);
  return data_array(field.name, field.components, field.values, names, unit);
}

std::string field_arrays(const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) text += field_array(field);
  return text;
}

std::string positions_array(const std::vector<Eigen::Vector3d>& places) {
  std::vector<double> positions;
  for (const Eigen::Vector3d& place : places) positions.insert(positions.end(), place.begin(), place.end());
  return data_array("Points", 3, positions);
}

/// What VTK calls cells: which places each joins.
struct Cells {
  std::vector<std::int64_t> places;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
};

Cells cells_of(const Mesh& mesh) {
  Cells cells;
  for (const Element& element : mesh.elements) {
    cells.places.insert(cells.places.end(), element.nodes.begin(), element.nodes.end());
    cells.ends.push_back(static_cast<std::int64_t>(cells.places.size()));
    cells.types.push_back(static_cast<std::uint8_t>(element.type->vtk_cell_type));
  }
  return cells;
}

void write_grid(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& places,
                const Cells& cells, const Fields& fields, const std::vector<Field>& whole = {}) {
  std::string of_whole;
  for (const Field& field : whole) of_whole += field_array(field, " NumberOfTuples=\"1\"");
  if (!whole.empty()) of_whole = "<FieldData>\n" + of_whole + "</FieldData>\n";
  write_file(file,
             fmt::format("<?xml version=\"1.0\"?>\n"
                         "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                         "header_type=\"UInt64\">\n<UnstructuredGrid>\n{}"
                         "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                         "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
                         "<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n"
                         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
                         of_whole, places.size(), cells.ends.size(), field_arrays(fields.points),
                         field_arrays(fields.cells), positions_array(places),
                         data_array("connectivity", 1, cells.places), data_array("offsets", 1, cells.ends),
                         data_array("types", 1, cells.types)));
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const Mesh& mesh, const Fields& fields) {
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector2d& node : mesh.nodes) places.emplace_back(node(0), node(1), 0.0);
  write_grid(file, places, cells_of(mesh), fields);
}

void write_vtu(const std::filesystem::path& file, const PlacedFields& fields) {
  constexpr std::uint8_t kVtkVertex = 1;
  constexpr std::uint8_t kVtkLine = 3;
  Cells cells;
  const auto end = [&cells](std::uint8_t type) {
    cells.ends.push_back(static_cast<std::int64_t>(cells.places.size()));
    cells.types.push_back(type);
  };
  for (std::size_t k = 0; k < fields.places.size(); ++k) {
    cells.places.push_back(static_cast<std::int64_t>(k));
    end(kVtkVertex);
  }
  for (const std::array<std::size_t, 2>& line : fields.lines) {
    cells.places.insert(cells.places.end(), line.begin(), line.end());
    end(kVtkLine);
  }
  write_grid(file, fields.places, cells, {fields.fields, fields.cell_fields}, fields.whole);
}

void PvdCollection::add(double time, const std::filesystem::path& vtu) {
  entries_.emplace_back(time, vtu);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const auto& [entry_time, path] : entries_) {
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", entry_time, path.generic_string());
  }
  write_file(file_, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace polargrain::fem
