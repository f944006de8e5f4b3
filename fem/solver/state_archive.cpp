// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/state_archive.hpp"

#include <algorithm>
#include <array>

#include "common/packed_values.hpp"
#include "common/record_archive.hpp"

namespace polargrain::fem {
namespace {

constexpr std::size_t kScalars = 5;
constexpr std::size_t kDynamics = 5;

std::span<const double> values_of(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

template <int dim>
void write_state(ArchiveWriter& archive, const SolverState<dim>& state) {
  const std::array<double, kScalars> scalars{state.time, state.reference_force, state.next_step,
                                             state.external_work, state.internal_work};
  archive.write("time_reference_force_next_step_works", std::span<const double>(scalars));
  archive.write("displacement", values_of(state.displacement));
  archive.write("last_increment", values_of(state.last_increment));
  archive.write("mass", values_of(state.mass));
  archive.write("velocity", values_of(state.velocity));
  archive.write("reactions", values_of(state.reactions));
  const Energies& energies = state.energies;
  const std::array<double, kDynamics> dynamics{state.seconds, energies.internal, energies.external,
                                               energies.damped, energies.absorbed};
  archive.write("seconds_and_energies", std::span<const double>(dynamics));
  archive.write("held", values_of(state.held));
  archive.write("given_mass", values_of(state.given_mass));
  archive.write("dashpots", std::span<const double>(state.dashpots));
  std::vector<double> strain;
  for (const typename Cosserat<dim>::Vector& point : state.strain)
    strain.insert(strain.end(), point.begin(), point.end());
  archive.write("strain", std::span<const double>(strain));
  if (state.contributed.size() > 0) archive.write("contributed", values_of(state.contributed));
  write_records(archive, "responses", std::span<const Response<dim>>(state.responses));
}

template <int dim>
SolverState<dim> read_state(ArchiveReader& archive, const FieldPlaces<dim>& places, std::size_t points,
                            bool has_contributions) {
  SolverState<dim> state;
  const std::vector<double> scalars =
      read_lists(archive, "time_reference_force_next_step_works", 1, kScalars);
  state.time = scalars[0];
  state.reference_force = scalars[1];
  state.next_step = scalars[2];
  state.external_work = scalars[3];
  state.internal_work = scalars[4];
  const auto nodal_size = static_cast<std::size_t>(places.size());
  state.displacement = vector_of(read_lists(archive, "displacement", nodal_size, 1));
  // Empty before the first step.
  if (const std::vector<double> last = archive.doubles("last_increment"); !last.empty()) {
    state.last_increment = vector_of(read_lists(archive, "last_increment", nodal_size, 1));
  }
  state.mass = vector_of(archive.doubles("mass"));
  state.velocity = vector_of(archive.doubles("velocity"));
  state.reactions = vector_of(archive.doubles("reactions"));
  const std::vector<double> dynamics = read_lists(archive, "seconds_and_energies", 1, kDynamics);
  state.seconds = dynamics[0];
  state.energies = {
      .internal = dynamics[1], .external = dynamics[2], .damped = dynamics[3], .absorbed = dynamics[4]};
  state.held = vector_of(archive.doubles("held"));
  state.given_mass = vector_of(archive.doubles("given_mass"));
  state.dashpots = archive.doubles("dashpots");
  const std::vector<double> strain = read_lists(archive, "strain", points, Cosserat<dim>::components);
  state.strain.resize(points);
  for (std::size_t i = 0; i < points; ++i)
    std::copy_n(&strain[Cosserat<dim>::components * i], Cosserat<dim>::components, state.strain[i].data());
  state.responses = read_records<Response<dim>>(archive, "responses", points);
  if (has_contributions) state.contributed = vector_of(read_lists(archive, "contributed", nodal_size, 1));
  return state;
}

template void write_state<2>(ArchiveWriter& archive, const SolverState<2>& state);
template void write_state<3>(ArchiveWriter& archive, const SolverState<3>& state);
template SolverState<2> read_state<2>(ArchiveReader& archive, const FieldPlaces<2>& places,
                                      std::size_t points, bool has_contributions);
template SolverState<3> read_state<3>(ArchiveReader& archive, const FieldPlaces<3>& places,
                                      std::size_t points, bool has_contributions);

}  // namespace polargrain::fem
