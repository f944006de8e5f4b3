// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/adaptivity_options.hpp"

#include "coupler/case/models/scheme_section.hpp"

namespace polargrain::coupler {

AdaptivityOptions read_adaptivity_options(Section& material, Faults& faults) {
  SchemeSection adaptive(material, "adaptive", faults);
  Section& section = adaptive.keys();
  AdaptivityOptions options;
  options.tolerance =
      section.quantity_or("tolerance", Dimension::number, Limit::not_negative, options.tolerance);
  section.require_below("tolerance", 1.0, "it is a share of the confining pressure, 3 % is '3 %' or 0.03");
  if (section.find("reference_pressure") != nullptr) {
    options.reference_pressure =
        section.quantity_or("reference_pressure", Dimension::pressure, Limit::positive, 0.0);
  }
  options.audit = section.quantity_or("audit", Dimension::number, Limit::not_negative, options.audit);
  if (options.audit > 1.0) section.fault("audit", "audit: is a share of the points, at most 1 (100 %)");
  options.seed = static_cast<std::uint64_t>(section.whole_or("seed", 0, static_cast<int>(options.seed)));
  adaptive.finish();
  return options;
}

void check_adaptivity_options(Section& material, Faults& faults) {
  for_its_faults(faults, [&] { read_adaptivity_options(material, faults); });
}

}  // namespace polargrain::coupler
