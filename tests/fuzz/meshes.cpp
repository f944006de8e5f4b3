// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes: when the first byte is even a file for Gmsh's own reader, else what a library less careful than Gmsh might
// hand over. Refused with an InputError, or a mesh that all can be asked of.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "common/error.hpp"
#include "fem/mesh/gmsh.hpp"
#include "fem/mesh/gmsh_content.hpp"

namespace {

using namespace polargrain::fem;

/// Nodes, blocks and groups, a byte a number.
GmshContent content_of(const std::uint8_t* data, std::size_t size) {
  std::size_t place = 0;
  const auto next = [&]() -> std::uint8_t { return place < size ? data[place++] : 0; };
  GmshContent content;
  for (int nodes = next() % 32; nodes > 0; --nodes) {
    const std::size_t tag = next();
    const double x = next();
    const double y = next();
    content.nodes.push_back({tag, {x, y, 0.0}});
  }
  for (int blocks = next() % 8; blocks > 0; --blocks) {
    GmshContent::Block& block = content.blocks.emplace_back();
    block.dimension = next() % 4;
    block.entity = next() % 4;
    block.kind = next() % 20;
    block.nodes_per_element = next() % 10;
    for (int nodes = next() % 64; nodes > 0; --nodes) block.nodes.push_back(next());
  }
  for (int groups = next() % 8; groups > 0; --groups) {
    GmshContent::Group& group = content.groups.emplace_back();
    group.dimension = next() % 4;
    group.name = std::string(1, static_cast<char>(next()));
    for (int entities = next() % 4; entities > 0; --entities) group.entities.push_back(next() % 4);
  }
  return content;
}

void ask_all_of(const Mesh<2>& mesh) {
  (void)distorted_elements(mesh);
  for (const std::string& name : mesh.boundary_and_node_set_names())
    for (const int node : mesh.nodes_on(name)) (void)mesh.nodes.at(static_cast<std::size_t>(node));
  for (const auto& [name, elements] : mesh.regions)
    for (const int element : elements) (void)mesh.element_positions(element);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::string file = "/dev/shm/polargrain_fuzz_mesh_" + std::to_string(getpid()) + ".msh";
  try {
    if (data[0] % 2 == 1) {
      ask_all_of(mesh_of("made_up.msh", content_of(data + 1, size - 1)));
    } else {
      std::ofstream(file, std::ios::binary | std::ios::trunc)
          .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
      ask_all_of(read_gmsh(file));
    }
  } catch (const polargrain::InputError&) {  // refused, as it should be
  }
  unlink(file.c_str());
  return 0;
}
