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
template <class T>
std::string data_array(const std::string& name, int components, const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::vector<std::byte> bytes(sizeof(size) + size);
  std::memcpy(bytes.data(), &size, sizeof(size));
  if (size > 0) std::memcpy(bytes.data() + sizeof(size), values.data(), size);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n</DataArray>\n",
      kVtkType<T>, name, components, base64(bytes));
}

std::string field_arrays(const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) text += data_array(field.name, field.components, field.values);
  return text;
}

std::string node_positions(const Mesh& mesh) {
  std::vector<double> positions;
  for (const Eigen::Vector2d& node : mesh.nodes) positions.insert(positions.end(), {node(0), node(1), 0.0});
  return data_array("Points", 3, positions);
}

std::string cells(const Mesh& mesh) {
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
  for (const Element& element : mesh.elements) {
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.end());
    ends.push_back(static_cast<std::int64_t>(nodes.size()));
    types.push_back(static_cast<std::uint8_t>(element.type->vtk_cell_type));
  }
  return data_array("connectivity", 1, nodes) + data_array("offsets", 1, ends) +
         data_array("types", 1, types);
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const Mesh& mesh, const Fields& fields) {
  write_file(file,
             fmt::format("<?xml version=\"1.0\"?>\n"
                         "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                         "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
                         "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                         "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
                         "<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n"
                         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
                         mesh.nodes.size(), mesh.elements.size(), field_arrays(fields.points),
                         field_arrays(fields.cells), node_positions(mesh), cells(mesh)));
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
