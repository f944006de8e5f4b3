// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The engine keeps its table of fixes private and has no call that adds one, nor one that tells which loop runs
// behind a pair style. The language allows naming a
// private member in an explicit instantiation; this helper turns that into a pointer to the member.
#include <map>
#include <string>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);
using FixTable = std::map<std::string, FixCreator>;

namespace detail {
template <typename Tag, typename Tag::type Member>
struct Reveal {
  friend typename Tag::type member(Tag) { return Member; }
};
struct FixMapTag {
  using type = FixTable* LAMMPS_NS::Modify::*;
  friend type member(FixMapTag);
};
template struct Reveal<FixMapTag, &LAMMPS_NS::Modify::fix_map>;
struct PairImplementationTag {
  using type = LIGGGHTS::PairStyles::IGranularPairStyle* LAMMPS_NS::PairGranProxy::*;
  friend type member(PairImplementationTag);
};
template struct Reveal<PairImplementationTag, &LAMMPS_NS::PairGranProxy::impl>;
}  // namespace detail

/// The engine's table from the name of a fix in an input script to the function that makes it.
inline FixTable& fix_table(LAMMPS_NS::Modify& modify) {
  return *(modify.*member(detail::FixMapTag{}));
}

/// The loop over pairs of grains behind `pair_style gran`; null for another pair style.
inline LIGGGHTS::PairStyles::IGranularPairStyle* pair_implementation(LAMMPS_NS::Pair* pair) {
  auto* const proxy = dynamic_cast<LAMMPS_NS::PairGranProxy*>(pair);
  return proxy == nullptr ? nullptr : proxy->*member(detail::PairImplementationTag{});
}

}  // namespace polargrain::dem
