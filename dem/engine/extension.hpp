// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

#include "dem/engine/liggghts.hpp"
#include "dem/engine/private_access.hpp"

namespace polargrain::dem {

/// Something that every engine of this program gets when it is made: an object of namespace scope in the file that
/// defines it, which is among those of polargrain_engine_extensions (dem/CMakeLists.txt).
class Extension {
 public:
  explicit Extension(std::function<void(LAMMPS_NS::LAMMPS&)> add);
};

/// The fix of a class, by the name that scripts give it.
template <typename OwnFix>
Extension fix_extension(const char* style) {
  return Extension([style](LAMMPS_NS::LAMMPS& engine) {
    fix_table(*engine.modify)[style] = [](LAMMPS_NS::LAMMPS* lammps, int count,
                                          char** words) -> LAMMPS_NS::Fix* {
      return new OwnFix(lammps, count, words);
    };
  });
}

}  // namespace polargrain::dem
