// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/lengths.hpp"

#include <algorithm>

namespace polargrain::app {

double usual_element(const Scene& scene, const SceneRegion& region) {
  std::vector<double> sizes;
  for (const int element : region.elements)
    sizes.push_back(scene.body().elements[static_cast<std::size_t>(element)]);
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return *middle;
}

bool is_strong(const Scene& scene, const SceneRegion& region) {
  return region.cell != nullptr || scene.find({"materials", region.material, "friction_angle"}) != nullptr;
}

}  // namespace polargrain::app
