// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/grains/grain_replay.hpp"

#include "common/error.hpp"

namespace polargrain::app {

GrainReplay::GrainReplay(const CellDefinition& cell, CellServiceFactory make, const CellPaths::Ways& ways)
    : cell_(cell), make_(std::move(make)), ways_(ways), made_(ways.kept) {
  cell_.control.tangent = CellTangent::none;  // no state depends on it
  start_from_packing();
}

void GrainReplay::start_from_packing() {
  engine_ = nullptr;
  engine_ = make_(cell_);
  const StatePointer packing = engine_->initial().state;
  packing_ = shown_ = packing->name();
  made_[packing_] = packing;
}

GrainView GrainReplay::view(const ContentName& state) {
  const bool is_packing = state == packing_ || state == ContentName{};
  if (is_packing && shown_ != packing_) start_from_packing();
  if (!is_packing && shown_ != state) {
    // Back to what is there, then forth. The last piece is always repeated: the grains shown are those at its end.
    std::vector<ContentName> way{state};
    do {
      const auto origin = ways_.origins.find(way.back());
      if (origin == ways_.origins.end() || way.size() > ways_.origins.size())
        throw RunError(
            ways_.begin_in_other_run
                ? "the run begins with the grains at the end of another one ('start_from'), and how they came to be stands there "
                  "alone: ask for grains of that run, or of one that begins with its packing"
                : "how its grains came to be was not kept from the start: the packing is another one now, or a part of the run "
                  "was made by an older version");
      way.push_back(origin->second.start == ContentName{} ? packing_ : origin->second.start);
    } while (made_.count(way.back()) == 0);
    for (std::size_t k = way.size() - 1; k > 0; --k) evaluate(way[k], way[k - 1]);
  }
  auto* const shows = dynamic_cast<ShowsGrains*>(engine_.get());
  if (shows == nullptr) throw RunError("this engine shows no grains");
  return shows->view();
}

void GrainReplay::evaluate(const ContentName& from, const ContentName& to) {
  const CellReply reply = engine_->evaluate({made_.at(from), ways_.origins.at(to).increment});
  if (!reply.state || reply.state->name() != to)
    throw RunError(
        "the grains did not come to the state that they had in the run: it was made by another version of the program, or by "
        "a processor that computes otherwise");
  made_[to] = reply.state;
  shown_ = to;
}

}  // namespace polargrain::app
