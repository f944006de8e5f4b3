// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/gmsh.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/trial.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/gmsh_content.hpp"
#include "fem/mesh/gmsh_tags.hpp"

namespace polargrain::fem {
namespace {

/// An element of Gmsh's that is read: its number in Gmsh's manual, "MSH file format", ours, and the place of each of our nodes
/// among Gmsh's (empty: the same order).
struct Offered {
  int kind;
  std::string_view element;
  std::vector<std::size_t> order = {};
};

/// @param chosen of the elements with one shape and several quadratures
template <int dim>
std::vector<Offered> offered(std::string_view chosen) {
  const bool one_point = chosen == kOnePoint<dim>;
  const std::string_view serendipity = one_point ? kSerendipity<dim> : chosen;
  if constexpr (dim == 2) {
    return {{16, serendipity}, {3, one_point ? chosen : "Q4"}, {9, "T6"}};
  } else {
    return {{17, serendipity, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
            {5, one_point ? chosen : "H8"},
            {11, "T10", {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
            {18, "W15", {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}}};
  }
}

/// The remedy for elements that are not read, by their numbers.
const std::map<int, const char*> kRefused{
    {2, "triangles of 3 nodes, too stiff to be offered: set Mesh.ElementOrder = 2"},
    {10, "quadrilaterals of 9 nodes: set Mesh.SecondOrderIncomplete = 1 to get 8"},
    {4, "tetrahedra of 4 nodes, too stiff to be offered: set Mesh.ElementOrder = 2"},
    {6,
     "wedges of 6 nodes, too stiff to be offered: set Mesh.ElementOrder = 2 and Mesh.SecondOrderIncomplete = 1"},
    {12, "hexahedra of 27 nodes: set Mesh.SecondOrderIncomplete = 1 to get 20"},
    {13, "wedges of 18 nodes: set Mesh.SecondOrderIncomplete = 1 to get 15"},
    {7, "pyramids, which are not offered: mesh with hexahedra and wedges, or with tetrahedra alone"},
    {14, "pyramids, which are not offered: mesh with hexahedra and wedges, or with tetrahedra alone"},
    {19, "pyramids, which are not offered: mesh with hexahedra and wedges, or with tetrahedra alone"}};

/// How the entities of Gmsh that carry the elements and their sides are called.
template <int dim>
constexpr const char* kBody = dim == 2 ? "surface" : "volume";
template <int dim>
constexpr const char* kOutline = dim == 2 ? "curve" : "surface";

constexpr const char* kModule = "polargrain_gmsh.so";

/// Loads the module once; it stays for the life of the program.
GmshReaderFunction reader_function(const std::filesystem::path& mesh_file,
                                   const std::vector<std::filesystem::path>& places) {
  std::vector<std::string> failures;
  for (const std::filesystem::path& place : places) {
    const std::filesystem::path module = place / kModule;
    std::error_code error;
    if (!std::filesystem::is_regular_file(module, error)) {
      failures.push_back(fmt::format("not in {}", place.string()));
      continue;
    }
    if (void* handle = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
      if (void* function = dlsym(handle, kGmshReaderName)) {
        return reinterpret_cast<GmshReaderFunction>(function);  // NOLINT: dlsym gives no other type
      }
    }
    failures.emplace_back(dlerror());
  }
  throw InputError(Fault{mesh_file.string(), 0,
                         fmt::format("mesh files need the module {}, which cannot be loaded ({}); install "
                                     "Gmsh's library (Debian: libgmsh-dev) and build again",
                                     kModule, fmt::join(failures, "; "))});
}

/// Makes the mesh of what the library has read: elements of the dimension of the problem, boundaries of their sides, sets of
/// nodes of everything below.
template <int dim>
class Reader {
 public:
  Reader(std::filesystem::path file, std::string_view chosen, GmshContent content)
      : file_(std::move(file)), offered_(offered<dim>(chosen)), content_(std::move(content)) {}

  Mesh<dim> read() {
    if (!content_.error.empty()) fail(fmt::format("Gmsh cannot read it: {}", content_.error));
    if (dim == 2 && dimension_of(content_) == 3) fail("it has volume elements; a plane mesh is needed here");
    read_nodes();
    read_elements();
    find_sides();
    read_boundaries();
    read_node_sets();
    drop_unused_nodes();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(Fault{file_.string(), 0, message});
  }

  void read_nodes() {
    for (const auto& [tag, position] : content_.nodes) {
      for (std::size_t i = 0; i < dim; ++i)
        if (!std::isfinite(position[i]))
          fail(fmt::format("node {} has a coordinate that is not finite", tag));
      if (dim == 2 && position[2] != 0.0)
        fail(
            "a node leaves the plane z = 0: plane meshes are needed; for a body in space name its volumes, "
            "Physical Volume(\"ground\") = {1};, and make the mesh with gmsh -3");
      node_of_tag_[tag] = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back(Eigen::Map<const typename Cosserat<dim>::Place>(position.data()));
    }
  }

  /// The element of a kind, with its nodes in our order.
  Element<dim> element_of(int kind, const std::vector<int>& nodes) const {
    const auto found = std::ranges::find(offered_, kind, &Offered::kind);
    if (found == offered_.end()) {
      const auto refused = kRefused.find(kind);
      fail(refused != kRefused.end()
               ? fmt::format("it has {}", refused->second)
               : fmt::format("it has {} elements of Gmsh's kind {}, which is not offered", kBody<dim>, kind));
    }
    Element<dim> element{&element_type<dim>(found->element), nodes};
    if (nodes.size() != element.type->node_positions.size()) fail("it has elements with nodes missing");
    for (std::size_t a = 0; a < found->order.size(); ++a) element.nodes[a] = nodes[found->order[a]];
    return element;
  }

  /// Calls visit(kind, nodes of one element) for all elements of an entity.
  template <class Visit>
  void for_each_element(int dimension, int entity, Visit visit) const {
    for (const GmshContent::Block& block : content_.blocks) {
      if (block.dimension != dimension || block.entity != entity) continue;
      const auto least = static_cast<std::size_t>(dimension + 1);  // corners of the simplest one
      if (block.nodes_per_element < least || block.nodes.size() % block.nodes_per_element != 0)
        fail("it has elements with nodes missing");
      for (std::size_t first = 0; first < block.nodes.size(); first += block.nodes_per_element) {
        std::vector<int> nodes;
        for (std::size_t a = 0; a < block.nodes_per_element; ++a) {
          const auto node = node_of_tag_.find(block.nodes[first + a]);
          if (node == node_of_tag_.end())
            fail(fmt::format("an element has the node {}, which is not there", block.nodes[first + a]));
          nodes.push_back(node->second);
        }
        visit(block.kind, std::move(nodes));
      }
    }
  }

  /// Calls visit(name, entity) for all entities of all physical groups of a dimension.
  template <class Visit>
  void for_each_group(int dimension, Visit visit) const {
    for (const GmshContent::Group& group : content_.groups) {
      if (group.dimension != dimension) continue;
      for (const int entity : group.entities) visit(group.name, entity);
    }
  }

  /// The number of an element, which is added unless it is there: files of version 2 have it once for each of its groups.
  int number_of(int kind, const std::vector<int>& nodes) {
    std::vector<int> sorted = nodes;
    std::ranges::sort(sorted);
    const auto [known, is_new] =
        element_of_nodes_.try_emplace(std::move(sorted), static_cast<int>(mesh_.elements.size()));
    if (is_new) {
      mesh_.elements.push_back(element_of(kind, nodes));
      turn_round_if_mirrored(known->second);
    }
    return known->second;
  }

  void read_elements() {
    std::map<int, std::vector<int>> elements_of_entity;
    const auto add_entity = [&](int entity) {
      if (elements_of_entity.contains(entity)) return;
      std::vector<int>& numbers = elements_of_entity[entity];
      for_each_element(dim, entity, [&](int kind, const std::vector<int>& nodes) {
        numbers.push_back(number_of(kind, nodes));
      });
    };
    for_each_group(dim, [&](const std::string& name, int entity) {
      add_entity(entity);
      std::vector<int>& region = mesh_.regions[name];
      region.insert(region.end(), elements_of_entity[entity].begin(), elements_of_entity[entity].end());
    });
    for (auto& [name, region] : mesh_.regions) {
      std::ranges::sort(region);
      region.erase(std::ranges::unique(region).begin(), region.end());
    }
    const bool has_names = !mesh_.regions.empty();
    for (const GmshContent::Block& block : content_.blocks) {
      if (block.dimension != dim) continue;
      if (has_names && !block.nodes.empty() && !elements_of_entity.contains(block.entity))
        fail(fmt::format(
            "its {} {} has elements and no physical name, while others have one: name it too, or remove it from the "
            "mesh (without Mesh.SaveAll Gmsh leaves out what has no name)",
            dim == 2 ? "surface" : "volume", block.entity));
      add_entity(block.entity);
    }
    if (mesh_.elements.empty())
      fail(fmt::format(
          "it has no {0} elements: once the script for Gmsh gives a physical name, Gmsh writes named parts only; "
          "add Physical {1}(\"ground\") = {{1}}; with the number of the {0}, and make the mesh again",
          kBody<dim>, dim == 2 ? "Surface" : "Volume"));
    std::vector<int>& all = mesh_.regions["all"];
    all.resize(mesh_.elements.size());
    std::iota(all.begin(), all.end(), 0);
  }

  /// Clockwise elements, and hexahedra drawn the other way: swaps the first two coordinates of the reference element.
  void turn_round_if_mirrored(int number) {
    Element<dim>& element = mesh_.elements[static_cast<std::size_t>(number)];
    double volume = 0.0;
    for (const PointGeometry<dim>& point :
         point_geometries<dim>(*element.type, mesh_.element_positions(number)))
      volume += point.volume;
    if (volume >= 0.0) return;
    const auto& positions = element.type->node_positions;
    const std::vector<int> nodes = element.nodes;
    for (std::size_t a = 0; a < positions.size(); ++a) {
      typename Cosserat<dim>::Place mirrored = positions[a];
      std::swap(mirrored(0), mirrored(1));
      const auto other = std::ranges::find(positions, mirrored);
      element.nodes[a] = nodes[static_cast<std::size_t>(other - positions.begin())];
    }
  }

  /// Of the nodes of a side: the corners, in rising order.
  static std::vector<int> corners_of(std::vector<int> nodes, int corners) {
    nodes.resize(static_cast<std::size_t>(corners));
    std::ranges::sort(nodes);
    return nodes;
  }

  void find_sides() {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      for (std::size_t side = 0; side < mesh_.elements[e].type->sides.size(); ++side) {
        const BoundarySide found{static_cast<int>(e), static_cast<int>(side)};
        side_of_corners_.try_emplace(corners_of(mesh_.side_nodes(found), mesh_.side_of(found).type->corners),
                                     found);
      }
    }
  }

  void read_boundaries() {
    std::set<std::pair<std::string, const BoundarySide*>> listed;  // a load acts once on a side listed twice
    for_each_group(dim - 1, [&](const std::string& name, int entity) {
      std::vector<BoundarySide>& boundary = mesh_.boundaries[name];
      for_each_element(dim - 1, entity, [&](int kind, const std::vector<int>& nodes) {
        const bool is_triangle = kind == 2 || kind == 9;
        const int corners = dim == 2 ? 2 : is_triangle ? 3 : 4;
        if (nodes.size() < static_cast<std::size_t>(corners)) fail("it has elements with nodes missing");
        const auto side = side_of_corners_.find(corners_of(nodes, corners));
        if (side == side_of_corners_.end()) {
          fail(fmt::format("the {} '{}' has a piece that is no side of any element", kOutline<dim>, name));
        }
        if (listed.emplace(name, &side->second).second) boundary.push_back(side->second);
      });
    });
  }

  /// Points, and in space curves.
  void read_node_sets() {
    for (int dimension = 0; dimension < dim - 1; ++dimension)
      for_each_group(dimension, [&](const std::string& name, int entity) {
        if (dim == 3 && mesh_.boundaries.contains(name))
          fail(fmt::format("a surface and a curve or point have the name '{}': give each its own", name));
        for_each_element(dimension, entity, [&](int, const std::vector<int>& nodes) {
          std::vector<int>& set = mesh_.node_sets[name];
          set.insert(set.end(), nodes.begin(), nodes.end());
        });
      });
  }

  /// Gmsh keeps nodes of construction points; an unknown without an element would make the tangent singular.
  void drop_unused_nodes() {
    std::vector<int> number(mesh_.nodes.size(), -1);
    for (const Element<dim>& element : mesh_.elements) {
      for (const int node : element.nodes) number[static_cast<std::size_t>(node)] = 0;
    }
    std::vector<typename Cosserat<dim>::Place> kept;
    for (std::size_t node = 0; node < number.size(); ++node) {
      if (number[node] < 0) continue;
      number[node] = static_cast<int>(kept.size());
      kept.push_back(mesh_.nodes[node]);
    }
    mesh_.nodes = std::move(kept);
    for (Element<dim>& element : mesh_.elements) {
      for (int& node : element.nodes) node = number[static_cast<std::size_t>(node)];
    }
    for (auto& [name, nodes] : mesh_.node_sets) {
      for (int& node : nodes) {
        node = number[static_cast<std::size_t>(node)];
        if (node < 0) fail(fmt::format("the point '{}' belongs to no element", name));
      }
    }
    std::vector<int>& all = mesh_.node_sets["all"];
    all.resize(mesh_.nodes.size());
    std::iota(all.begin(), all.end(), 0);
  }

  std::filesystem::path file_;
  std::vector<Offered> offered_;
  GmshContent content_;
  Mesh<dim> mesh_;
  std::map<std::size_t, int> node_of_tag_;
  std::map<std::vector<int>, int> element_of_nodes_;  ///< by its nodes in rising order
  std::map<std::vector<int>, BoundarySide> side_of_corners_;
};

/// Whether Gmsh takes the file for a mesh by its content too: a file that begins in another way it runs as a script, whatever
/// its name.
bool begins_as_a_mesh(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line == "$MeshFormat" || line == "$Comments" || line == "$NOD";
}

}  // namespace

std::vector<std::filesystem::path> gmsh_module_places() {
  std::vector<std::filesystem::path> places;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    places.push_back(program.parent_path());
    places.push_back(program.parent_path().parent_path() / "lib" / "polargrain");
  }
  return places;
}

GmshContent read_gmsh_content(const std::filesystem::path& file,
                              const std::vector<std::filesystem::path>& module_places) {
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw InputError(Fault{file.string(), 0, reason});
  // Gmsh takes a text of any other name for one of its scripts, and would run it.
  if (file.extension() != ".msh") throw InputError(Fault{file.string(), 0, "expected a mesh file, NAME.msh"});
  if (!begins_as_a_mesh(file))
    throw InputError(
        Fault{file.string(), 0, "this is no mesh that Gmsh has written: its first line is not $MeshFormat"});
  const GmshReaderFunction read = reader_function(file, module_places);
  GmshContent content;
  try {
    try_in_own_process([&] { read(file.c_str(), &content); });
  } catch (const RunError& error) {
    throw InputError(Fault{file.string(), 0, fmt::format("the mesh is damaged: {}", error.what())});
  }
  read(file.c_str(), &content);
  if (content.error.empty())
    if (const auto fault = entity_of_several_groups(file)) throw InputError(*fault);
  return content;
}

int dimension_of(const GmshContent& content) {
  return std::ranges::any_of(content.blocks, [](const auto& block) { return block.dimension == 3; }) ? 3 : 2;
}

template <int dim>
Mesh<dim> read_gmsh(const std::filesystem::path& file, std::string_view chosen,
                    const std::vector<std::filesystem::path>& module_places) {
  return mesh_of<dim>(file, read_gmsh_content(file, module_places), chosen);
}

template <int dim>
Mesh<dim> mesh_of(const std::filesystem::path& file, GmshContent content, std::string_view chosen) {
  return Reader<dim>(file, chosen, std::move(content)).read();
}

template Mesh<2> read_gmsh<2>(const std::filesystem::path& file, std::string_view chosen,
                              const std::vector<std::filesystem::path>& module_places);
template Mesh<3> read_gmsh<3>(const std::filesystem::path& file, std::string_view chosen,
                              const std::vector<std::filesystem::path>& module_places);
template Mesh<2> mesh_of<2>(const std::filesystem::path& file, GmshContent content, std::string_view chosen);
template Mesh<3> mesh_of<3>(const std::filesystem::path& file, GmshContent content, std::string_view chosen);

}  // namespace polargrain::fem
