// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/parts.hpp"

#include <array>
#include <cstring>
#include <unordered_set>

namespace polargrain::coupler {
namespace {
/// Contacts or DEM steps, and seconds, of an evaluation: far beyond what there can be, and small enough to be
/// added up.
constexpr std::int64_t kMostCounted = std::int64_t{1} << 40;
constexpr double kMostSeconds = 1e9;
}  // namespace

void write(ArrayWriter&& writer, const Increment& increment) {
  const auto& h = increment.displacement_gradient;
  const std::array<double, 7> values{h(0, 0),
                                     h(0, 1),
                                     h(1, 0),
                                     h(1, 1),
                                     increment.micro_rotation,
                                     increment.curvature(0),
                                     increment.curvature(1)};
  writer.numbers(values);
}

Increment read_increment(const msgpack::object& object) {
  ArrayReader reader(object, "an increment");
  const std::array<double, 7> v = reader.finite_numbers<7>();
  reader.end();
  Increment increment;
  increment.displacement_gradient << v[0], v[1], v[2], v[3];
  increment.micro_rotation = v[4];
  increment.curvature << v[5], v[6];
  return increment;
}

void write(ArrayWriter&& writer, const Packing& packing) {
  std::vector<std::int64_t> ids;
  std::vector<double> values;
  for (const Grain& grain : packing.grains) {
    ids.push_back(grain.id);
    values.insert(values.end(),
                  {grain.position(0), grain.position(1), grain.radius, grain.mass, grain.moment_of_inertia});
  }
  const std::array<double, 6> box{packing.box(0, 0), packing.box(1, 0), packing.box(0, 1), packing.box(1, 1),
                                  packing.thickness, packing.pressure};
  writer.numbers(box).block(std::as_bytes(std::span(ids))).numbers(values).state(packing.state);
}

Packing read_packing(const msgpack::object& object) {
  ArrayReader reader(object, "a packing");
  const std::array<double, 6> box = reader.finite_numbers<6>();
  const std::span<const std::byte> id_bytes = reader.block();
  if (id_bytes.size() % sizeof(std::int64_t) != 0)
    throw ProtocolError("the grain ids of a packing are cut short");
  std::vector<std::int64_t> ids(id_bytes.size() / sizeof(std::int64_t));
  if (!ids.empty()) std::memcpy(ids.data(), id_bytes.data(), id_bytes.size());
  const std::vector<double> values = reader.finite_numbers(5 * ids.size());
  StatePointer state = reader.state();
  reader.end();
  if (ids.empty()) throw ProtocolError("a packing has no grains");
  if (std::unordered_set<std::int64_t>(ids.begin(), ids.end()).size() != ids.size()) {
    throw ProtocolError("two grains of a packing have one id");
  }
  Packing packing;
  packing.box << box[0], box[2], box[1], box[3];
  packing.thickness = box[4];
  packing.pressure = box[5];
  packing.state = std::move(state);
  if (!(packing.volume() > 0.0) || !(packing.thickness > 0.0)) throw ProtocolError("a packing has no volume");
  packing.grains.resize(ids.size());
  for (std::size_t g = 0; g < ids.size(); ++g) {
    const double* v = &values[5 * g];
    packing.grains[g] = {ids[g], {v[0], v[1]}, v[2], v[3], v[4]};
    if (!(v[2] > 0.0) || !(v[3] > 0.0)) throw ProtocolError("a grain has no size or no mass");
  }
  return packing;
}

void write(ArrayWriter&& writer, const CellControl& control) {
  const std::array<double, 4> values{control.inertial_number, control.unbalanced_force_ratio,
                                     control.unbalanced_moment_ratio, control.damping};
  writer.numbers(values)
      .whole_signed(control.least_steps)
      .whole_signed(control.most_relaxation_steps)
      .whole(static_cast<std::uint64_t>(control.tangent))
      .whole(static_cast<std::uint64_t>(control.rotations))
      .whole(static_cast<std::uint64_t>(control.loop));
}

static int read_count(ArrayReader& reader) {
  const std::int64_t value = reader.whole_signed();
  if (value < 0 || value > INT32_MAX) throw ProtocolError("a count of a cell's control is out of range");
  return static_cast<int>(value);
}

CellControl read_control(const msgpack::object& object) {
  ArrayReader reader(object, "a cell's control");
  const std::array<double, 4> v = reader.finite_numbers<4>();
  CellControl control{v[0], v[1], v[2], v[3], 0, 0, CellTangent::none, CellRotations::free,
                      CellLoop::automatic};
  control.least_steps = read_count(reader);
  control.most_relaxation_steps = read_count(reader);
  const std::uint32_t tangent = reader.whole32();
  if (tangent > static_cast<std::uint32_t>(CellTangent::condensed))
    throw ProtocolError("no such kind of tangent");
  control.tangent = static_cast<CellTangent>(tangent);
  const std::uint32_t rotations = reader.whole32();
  if (rotations > static_cast<std::uint32_t>(CellRotations::controlled))
    throw ProtocolError("no such control of rotations");
  control.rotations = static_cast<CellRotations>(rotations);
  const std::uint32_t loop = reader.whole32();
  if (loop > static_cast<std::uint32_t>(CellLoop::plain)) throw ProtocolError("no such loop over grains");
  control.loop = static_cast<CellLoop>(loop);
  reader.end();
  return control;
}

void write(ArrayWriter&& writer, const CellDefinition& cell) {
  writer.text(cell.name).text(cell.script_file).text(cell.script);
  write(writer.part(), cell.packing);
  write(writer.part(), cell.control);
}

CellDefinition read_definition(const msgpack::object& object) {
  ArrayReader reader(object, "a cell definition");
  CellDefinition cell;
  cell.name = reader.text();
  cell.script_file = reader.text();
  cell.script = reader.text();
  cell.packing = read_packing(reader.part());
  cell.control = read_control(reader.part());
  reader.end();
  return cell;
}

void write(ArrayWriter&& writer, const Response& response) {
  writer.numbers({response.stress.data(), 7})
      .numbers({response.tangent.data(), 49})
      .whole_signed(static_cast<int>(response.quality))
      .text(response.message)
      .numbers({&response.step_factor, 1});
}

Response read_response(const msgpack::object& object) {
  ArrayReader reader(object, "a response");
  Response response;
  const std::array<double, 7> stress = reader.numbers<7>();
  const std::array<double, 49> tangent = reader.numbers<49>();
  const std::int64_t quality = reader.whole_signed();
  if (quality < -1 || quality > 1) throw ProtocolError("no such quality of a response");
  response.quality = static_cast<Quality>(quality);
  response.message = reader.words();
  response.step_factor = reader.finite_numbers<1>()[0];
  reader.end();
  if (!(response.step_factor > 0.0 && response.step_factor <= 1.0))
    throw FalseMessage("a response proposes a part of its increment that is none");
  // A failed response has no numbers worth anything; all others are going to be used.
  if (response.quality != Quality::failed) {
    require_finite(stress, "a stress");
    require_finite(tangent, "a tangent");
  }
  response.stress = Eigen::Map<const Vector7>(stress.data());
  response.tangent = Eigen::Map<const Matrix7>(tangent.data());
  return response;
}

void write(ArrayWriter&& writer, const CellDiagnostics& d) {
  const std::array<double, 14> values{d.unbalanced_force_ratio,
                                      d.unbalanced_moment_ratio,
                                      d.void_ratio,
                                      d.coordination_number,
                                      d.sliding_fraction,
                                      d.multiplier,
                                      d.engine_seconds,
                                      d.rolling_fraction,
                                      d.rattlers,
                                      d.mean_rotation,
                                      d.rotation_spread,
                                      d.fabric[0],
                                      d.fabric[1],
                                      d.fabric[2]};
  writer.numbers(values).whole_signed(d.contacts).whole_signed(d.dem_steps);
}

CellDiagnostics read_diagnostics(const msgpack::object& object) {
  ArrayReader reader(object, "a cell's diagnostics");
  const std::array<double, 14> v = reader.finite_numbers<14>();
  CellDiagnostics d{v[0], v[1], v[2], v[3], v[4], v[5],  0,
                    0,    v[6], v[7], v[8], v[9], v[10], {v[11], v[12], v[13]}};
  d.contacts = reader.whole_signed();
  d.dem_steps = reader.whole_signed();
  reader.end();
  if (d.contacts < 0 || d.contacts > kMostCounted || d.dem_steps < 0 || d.dem_steps > kMostCounted ||
      !(d.engine_seconds >= 0.0 && d.engine_seconds <= kMostSeconds)) {
    throw FalseMessage("a cell's diagnostics count what no cell can have done");
  }
  return d;
}

}  // namespace polargrain::coupler
