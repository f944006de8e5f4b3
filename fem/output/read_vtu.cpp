// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/read_vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <type_traits>

#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/regular_file.hpp"
#include "fem/output/base64.hpp"

namespace polargrain::fem {
namespace {

/// The elements of the project by what they are in VTK. @param named types of the file, which come first; others do not count
template <int dim>
std::map<int, const ElementType<dim>*> types_by_vtk(const std::string& named = "") {
  std::map<int, const ElementType<dim>*> types;
  const std::vector<std::string> known = element_names<dim>();
  const auto add = [&](const std::string& name) {
    const ElementType<dim>& type = element_type<dim>(name);
    types.try_emplace(type.vtk_cell_type, &type);
  };
  std::istringstream words(named);
  for (std::string name; words >> name;)
    if (std::ranges::find(known, name) != known.end()) add(name);
  for (const std::string& name : known) add(name);
  return types;
}

template <int dim>
class VtuReader {
 public:
  explicit VtuReader(const std::filesystem::path& file) : file_(file) {
    if (const std::string reason = why_no_input(file); !reason.empty()) fail(reason);
    const pugi::xml_parse_result result = document_.load_file(file.c_str());
    if (!result) fail(result.description());
    piece_ = document_.child("VTKFile").child("UnstructuredGrid").child("Piece");
    if (!piece_) fail("there is no unstructured grid in it");
  }

  /// Whether one of its cells is an element of the dimension.
  [[nodiscard]] bool has_elements() const {
    const std::map<int, const ElementType<dim>*> types = types_by_vtk<dim>();
    return std::ranges::any_of(array<std::uint8_t>("Cells", "types"),
                               [&](std::uint8_t kind) { return types.contains(kind); });
  }

  FieldFile<dim> read() const {
    FieldFile<dim> content;
    read_nodes(content.mesh);
    read_elements(content.mesh);
    content.fields.points = fields_of("PointData", content.mesh.nodes.size());
    content.fields.cells = fields_of("CellData", content.mesh.elements.size());
    return content;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({file_.string(), 0, "a field file of `polargrain run` was expected: " + what});
  }

  static std::string name_of(const pugi::xml_node& array) {
    return plain_text(array.attribute("Name").value());
  }

  /// The values of an array; a 64-bit number of bytes stands before them.
  template <class Value>
  std::vector<Value> values_of(const pugi::xml_node& array) const {
    const std::vector<std::byte> bytes = from_base64(array.child_value());
    std::uint64_t size = 0;
    if (bytes.size() >= sizeof(size)) std::memcpy(&size, bytes.data(), sizeof(size));
    if (bytes.size() < sizeof(size) || bytes.size() - sizeof(size) != size || size % sizeof(Value) != 0)
      fail(fmt::format("the array '{}' is cut or of another kind", name_of(array)));
    std::vector<Value> values(size / sizeof(Value));
    if (size > 0) std::memcpy(values.data(), bytes.data() + sizeof(size), size);
    if constexpr (std::is_floating_point_v<Value>) {
      if (!std::ranges::all_of(values, [](Value value) { return std::isfinite(value); }))
        fail(fmt::format("the array '{}' holds a number that is not finite", name_of(array)));
    }
    return values;
  }
  template <class Value>
  std::vector<Value> array(const char* section, const char* name) const {
    const pugi::xml_node found = piece_.child(section).find_child_by_attribute("DataArray", "Name", name);
    if (!found) fail(fmt::format("there is no array '{}'", name));
    return values_of<Value>(found);
  }

  void read_nodes(Mesh<dim>& mesh) const {
    const auto positions = array<double>("Points", "Points");
    for (std::size_t k = 0; k + 2 < positions.size(); k += 3)
      mesh.nodes.push_back(Eigen::Map<const Eigen::Vector3d>(&positions[k]).template head<dim>());
  }

  void read_elements(Mesh<dim>& mesh) const {
    const auto nodes = array<std::int64_t>("Cells", "connectivity");
    const auto ends = array<std::int64_t>("Cells", "offsets");
    const auto kinds = array<std::uint8_t>("Cells", "types");
    if (kinds.size() != ends.size()) fail("its cells do not fit together");
    const std::map<int, const ElementType<dim>*> types =
        types_by_vtk<dim>(piece_.child("Cells").attribute("elements").value());
    std::size_t begin = 0;
    for (std::size_t e = 0; e < kinds.size(); ++e) {
      const auto type = types.find(kinds[e]);
      if (type == types.end()) fail(fmt::format("cells of VTK type {} are not known", kinds[e]));
      const auto count = static_cast<std::size_t>(type->second->nodes);
      if (ends[e] < 0 || static_cast<std::uint64_t>(ends[e]) != begin + count || begin + count > nodes.size())
        fail(fmt::format("cell {} has not the nodes of its type", e));
      Element<dim>& element = mesh.elements.emplace_back(Element<dim>{type->second, {}});
      for (const std::size_t end = begin + count; begin < end; ++begin) {
        if (nodes[begin] < 0 || static_cast<std::uint64_t>(nodes[begin]) >= mesh.nodes.size())
          fail(fmt::format("cell {} has a node {} that is not there", e, nodes[begin]));
        element.nodes.push_back(static_cast<int>(nodes[begin]));
      }
    }
  }

  std::vector<Field> fields_of(const char* section, std::size_t entities) const {
    constexpr int kMostComponents = 1000;
    std::vector<Field> fields;
    for (const pugi::xml_node& node : piece_.child(section).children("DataArray")) {
      Field field{name_of(node), node.attribute("NumberOfComponents").as_int(1), values_of<double>(node)};
      if (field.components < 1 || field.components > kMostComponents ||
          field.values.size() != entities * static_cast<std::size_t>(field.components))
        fail(fmt::format("the array '{}' has not a value for each of {} entities", field.name, entities));
      field.unit =
          plain_text(node.find_child_by_attribute("InformationKey", "name", "UNITS_LABEL").child_value());
      fields.push_back(std::move(field));
    }
    return fields;
  }

  std::filesystem::path file_;
  pugi::xml_document document_;
  pugi::xml_node piece_;
};

}  // namespace

template <int dim>
FieldFile<dim> read_vtu(const std::filesystem::path& file) {
  return VtuReader<dim>(file).read();
}

int dimension_of_vtu(const std::filesystem::path& file) {
  return VtuReader<3>(file).has_elements() ? 3 : 2;
}

template FieldFile<2> read_vtu<2>(const std::filesystem::path&);
template FieldFile<3> read_vtu<3>(const std::filesystem::path&);

const Field* find_field(const std::vector<Field>& fields, const std::string& name) {
  const auto found = std::ranges::find(fields, name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace polargrain::fem
