// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <typeindex>
#include <unordered_map>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// The parts of one engine, by type.
using EngineParts = std::unordered_map<std::type_index, std::shared_ptr<void>>;

/// @param lammps of an Engine
EngineParts& parts_of(LAMMPS_NS::LAMMPS& lammps);

/// The Part that belongs to this engine and to no other, made when it is first asked for: by it contact models, fixes and
/// cells of one engine share their data, while other engines of the process know nothing of it. It lives as long as
/// the engine does. Looking it up takes a search: code that needs it for every contact keeps the reference.
/// @param lammps of an Engine
template <typename Part>
Part& part_of(LAMMPS_NS::LAMMPS& lammps) {
  std::shared_ptr<void>& part = parts_of(lammps)[std::type_index(typeid(Part))];
  if (!part) part = std::make_shared<Part>();
  return *static_cast<Part*>(part.get());
}

}  // namespace polargrain::dem
