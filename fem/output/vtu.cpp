// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/vtu.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <span>

#include "common/error.hpp"
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

template <class Value>
std::span<const std::byte> bytes_of(const std::vector<Value>& values) {
  return std::as_bytes(std::span(values));
}

/// VTK's form of compressed data in one block: number of blocks, their size, the size of a last smaller one (absent), the size of the
/// compressed block; then the block.
std::string deflated(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> block(size);
  // The fastest level: higher ones take some per cent off, for many times the time.
  if (compress2(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_BEST_SPEED) != Z_OK)
    throw RunError("there is no memory to compress fields in");
  block.resize(size);
  const std::vector<std::uint64_t> header{1, bytes.size(), 0, size};
  return base64(bytes_of(header)) + base64(block);
}

/// The arrays of a file, of the inline binary form.
class Arrays {
 public:
  explicit Arrays(bool compressed) : compressed_(compressed) {}

  /// Not compressed: the number of bytes as UInt64, then the bytes, as one base64 text.
  /// @param attributes further ones @param notes elements that follow the bytes
  template <class T>
  [[nodiscard]] std::string array(const std::string& name, int components, const std::vector<T>& values,
                                  const std::string& attributes = {}, const std::string& notes = {}) const {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">\n{}\n{}</DataArray>\n",
        kVtkType<T>, name, components, attributes, text_of(bytes_of(values)), notes);
  }

  [[nodiscard]] std::string field(const Field& field, std::string attributes = {}) const {
    for (std::size_t k = 0; k < field.component_names.size(); ++k)
      attributes += fmt::format(" ComponentName{}=\"{}\"", k, field.component_names[k]);
    std::string unit;
    if (!field.unit.empty())
      unit = fmt::format(
          "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n", field.unit);
    return array(field.name, field.components, field.values, attributes, unit);
  }

  [[nodiscard]] std::string fields(const std::vector<Field>& fields) const {
    std::string text;
    for (const Field& one : fields) text += field(one);
    return text;
  }

  [[nodiscard]] std::string positions(const std::vector<Eigen::Vector3d>& places) const {
    std::vector<double> positions;
    for (const Eigen::Vector3d& place : places) positions.insert(positions.end(), place.begin(), place.end());
    return array("Points", 3, positions);
  }

 private:
  [[nodiscard]] std::string text_of(std::span<const std::byte> bytes) const {
    if (compressed_) return deflated(bytes);
    const std::uint64_t size = bytes.size();
    std::vector<std::byte> all(sizeof(size) + size);
    std::memcpy(all.data(), &size, sizeof(size));
    if (size > 0) std::memcpy(all.data() + sizeof(size), bytes.data(), size);
    return base64(all);
  }

  bool compressed_;
};

/// The cells in the sense of VTK: which places each joins.
struct Cells {
  std::vector<std::int64_t> places;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
  std::set<std::string> elements;  ///< names of their types, which VTK does not tell apart: H8 and H8R
};

template <int dim>
Cells cells_of(const Mesh<dim>& mesh) {
  Cells cells;
  for (const Element<dim>& element : mesh.elements) {
    cells.places.insert(cells.places.end(), element.nodes.begin(), element.nodes.end());
    cells.ends.push_back(static_cast<std::int64_t>(cells.places.size()));
    cells.types.push_back(static_cast<std::uint8_t>(element.type->vtk_cell_type));
    cells.elements.insert(element.type->name);
  }
  return cells;
}

void write_grid(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& places,
                const Cells& cells, const Fields& fields, const Arrays& arrays, const std::string& attributes,
                const std::vector<Field>& whole) {
  std::string of_whole;
  for (const Field& field : whole) of_whole += arrays.field(field, " NumberOfTuples=\"1\"");
  if (!whole.empty()) of_whole = "<FieldData>\n" + of_whole + "</FieldData>\n";
  // An attribute that VTK passes over.
  const std::string elements =
      cells.elements.empty() ? "" : fmt::format(" elements=\"{}\"", fmt::join(cells.elements, " "));
  write_file(
      file, fmt::format("<?xml version=\"1.0\"?>\n"
                        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                        "header_type=\"UInt64\"{}>\n<UnstructuredGrid>\n{}"
                        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                        "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
                        "<Points>\n{}</Points>\n<Cells{}>\n{}{}{}</Cells>\n"
                        "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
                        attributes, of_whole, places.size(), cells.ends.size(), arrays.fields(fields.points),
                        arrays.fields(fields.cells), arrays.positions(places), elements,
                        arrays.array("connectivity", 1, cells.places), arrays.array("offsets", 1, cells.ends),
                        arrays.array("types", 1, cells.types)));
}

}  // namespace

template <int dim>
void write_vtu(const std::filesystem::path& file, const Mesh<dim>& mesh, const Fields& fields) {
  std::vector<Eigen::Vector3d> places;
  for (const typename Cosserat<dim>::Place& node : mesh.nodes)
    places.emplace_back(node(0), node(1), dim == 2 ? 0.0 : node(dim - 1));
  write_grid(file, places, cells_of<dim>(mesh), fields, Arrays(false), "", {});
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
  write_grid(file, fields.places, cells, {fields.fields, fields.cell_fields}, Arrays(true),
             " compressor=\"vtkZLibDataCompressor\"", fields.whole);
}

void PvdCollection::add(double time, const std::filesystem::path& vtu) {
  entries_.emplace_back(time, vtu);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const auto& [entry_time, path] : entries_) {
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", entry_time, path.generic_string());
  }
  write_file(file_, text + "</Collection>\n</VTKFile>\n");
}

template void write_vtu<2>(const std::filesystem::path& file, const Mesh<2>& mesh, const Fields& fields);
template void write_vtu<3>(const std::filesystem::path& file, const Mesh<3>& mesh, const Fields& fields);

}  // namespace polargrain::fem
