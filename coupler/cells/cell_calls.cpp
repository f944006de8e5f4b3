// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_calls.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <utility>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

template <int dim>
CellCalls<dim> calls_of(Pool& pool, std::uint32_t definition) {
  if (dim == 3 && pool.definition(definition).packing.dimension != 3)
    throw RunError("elements in space need cells of spheres");
  return {[&pool, definition] { return of_dimension<dim>(pool.initial(definition)); },
          [&pool, definition](std::span<const PointRequest<dim>> cells, std::span<const std::size_t> points) {
            std::vector<PoolRequest> requests;
            for (std::size_t k = 0; k < cells.size(); ++k)
              requests.push_back({definition, in_space(cells[k]), points[k]});
            std::vector<PointReply<dim>> replies;
            for (CellReply& reply : pool.evaluate(requests))
              replies.push_back(of_dimension<dim>(std::move(reply)));
            return replies;
          },
          [&pool](std::span<const StatePointer> states) { return pool.collect(states); },
          [&pool, definition] { return pool.initial(definition); },
          [&pool, definition](std::span<const CellRequest> cells, std::span<const std::size_t> points) {
            std::vector<PoolRequest> requests;
            for (std::size_t k = 0; k < cells.size(); ++k)
              requests.push_back({definition, cells[k], points[k]});
            std::vector<CellReply> replies = pool.evaluate(requests);
            std::vector<StatePointer> states;
            for (const CellReply& reply : replies) states.push_back(reply.state);
            states = pool.collect(states);
            for (std::size_t k = 0; k < replies.size(); ++k) replies[k].state = states[k];
            return replies;
          }};
}

PlaneReply in_plane(const PointReply<3>& reply) {
  CellResponse response;
  response.set_components(reply.response.stress);
  response.tangent = reply.response.tangent;
  static_cast<Trust&>(response) = reply.response;
  return {of_dimension<2>(response), true, reply.diagnostics, reply.state};
}

CellCalls<2> in_plane(const CellCalls<3>& calls) {
  return {[calls] { return in_plane(calls.initial()); },
          [calls](std::span<const PlaneRequest> requests, std::span<const std::size_t> points) {
            std::vector<PointRequest<3>> asked;
            for (const PlaneRequest& request : requests) {
              const CellRequest cell = in_space(request);
              Increment<3> increment;
              static_cast<CellIncrement&>(increment) = cell.increment;
              increment.configuration = request.increment.configuration;
              asked.push_back({cell.state, increment});
            }
            std::vector<PlaneReply> replies;
            for (const PointReply<3>& reply : calls.evaluate(asked, points))
              replies.push_back(in_plane(reply));
            return replies;
          },
          calls.collect};
}

template <int dim>
PointReply<dim> packing_at_rest(const CellCalls<dim>& calls, std::vector<std::string>& notes) {
  PointReply<dim> packing = calls.initial();
  if (packing.response.quality == Quality::failed)
    throw RunError(
        fmt::format("the packing of a cell cannot be brought to rest: {}", packing.response.message));
  std::istringstream remarks(std::exchange(packing.response.message, {}));
  for (std::string remark; std::getline(remarks, remark);) notes.push_back(remark);
  return packing;
}

template <int dim>
void collect(const CellCalls<dim>& calls, std::span<StatePointer* const> states) {
  if (!calls.collect) return;
  std::vector<StatePointer> wanted;
  for (const StatePointer* const state : states) wanted.push_back(*state);
  const std::vector<StatePointer> here = calls.collect(wanted);
  for (std::size_t s = 0; s < states.size(); ++s) *states[s] = here[s];
}

template CellCalls<2> calls_of<2>(Pool&, std::uint32_t);
template CellCalls<3> calls_of<3>(Pool&, std::uint32_t);
template PointReply<2> packing_at_rest(const CellCalls<2>&, std::vector<std::string>&);
template PointReply<3> packing_at_rest(const CellCalls<3>&, std::vector<std::string>&);
template void collect(const CellCalls<2>&, std::span<StatePointer* const>);
template void collect(const CellCalls<3>&, std::span<StatePointer* const>);

}  // namespace polargrain::coupler
