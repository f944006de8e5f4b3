// SPDX-License-Identifier: GPL-2.0-or-later
// The one file that uses Gmsh's library. It is a module, loaded when a case names a mesh file: the library
// brings a hundred others, which would make every worker start more slowly.
#include <gmsh.h>
#include <stdlib.h>

#include <cerrno>
#include <exception>
#include <filesystem>
#include <string>
#include <system_error>

#include "fem/mesh/gmsh_content.hpp"

namespace polargrain::fem {
namespace {

/// Gmsh keeps one model for the whole program; it is ours for the life of this object.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);  // options of the user's own would change what is read
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

/// The mesh by another name, alone in a folder: Gmsh runs FILE.opt, and whatever commands are in there, with FILE.
class Alone {
 public:
  explicit Alone(const char* file) {
    std::string name = std::filesystem::temp_directory_path() / "polargrain_mesh_XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    folder_ = name;
    std::filesystem::create_symlink(std::filesystem::absolute(file), path());
  }
  ~Alone() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "mesh.msh"; }

 private:
  std::filesystem::path folder_;
};

void read_nodes(GmshContent& content) {
  std::vector<std::size_t> tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    content.nodes.push_back({tags[i], {x[3 * i], x[3 * i + 1], x[3 * i + 2]}});
  }
}

void read_blocks(GmshContent& content) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, entity] : entities) {
    std::vector<int> kinds;
    std::vector<std::vector<std::size_t>> elements;
    std::vector<std::vector<std::size_t>> nodes;
    gmsh::model::mesh::getElements(kinds, elements, nodes, dimension, entity);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      if (elements[k].empty()) continue;
      content.blocks.push_back({dimension, entity, kinds[k], nodes[k].size() / elements[k].size(), nodes[k]});
    }
  }
}

void read_groups(GmshContent& content) {
  gmsh::vectorpair tags;
  gmsh::model::getPhysicalGroups(tags);
  for (const auto& [dimension, tag] : tags) {
    GmshContent::Group group{dimension, "", {}};
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    if (group.name.empty()) group.name = std::to_string(tag);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    content.groups.push_back(group);
  }
}

}  // namespace
}  // namespace polargrain::fem

extern "C" void polargrain_read_gmsh_file(const char* file, polargrain::fem::GmshContent* content) {
  using namespace polargrain::fem;
  try {
    const Alone alone(file);
    const Session session;
    try {
      gmsh::open(alone.path());
      read_nodes(*content);
      read_blocks(*content);
      read_groups(*content);
    } catch (...) {  // Gmsh throws different types in different versions
      gmsh::logger::getLastError(content->error);
      if (content->error.empty()) content->error = "unknown error";
    }
  } catch (const std::exception& error) {
    content->error = error.what();
  } catch (...) {
    content->error = "Gmsh's library does not start";
  }
}
