// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/grains/grain_files.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "common/csv_table.hpp"
#include "fem/output/vtu.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kVector{"1", "2", "3"};

/// The meaning of a vertex or a line of the file.
enum Kind { kGrain = 0, kContact = 1, kBox = 2, kEnd = 3 };

void add(fem::Field& field, const Eigen::Vector3d& value) {
  field.values.insert(field.values.end(), value.begin(), value.end());
}

/// Fills up a field with zeros for entities that it says nothing of.
void fill(std::vector<fem::Field>& fields, std::size_t entities) {
  for (fem::Field& field : fields)
    field.values.resize(entities * static_cast<std::size_t>(field.components), 0.0);
}

/// Edges of the box: four sides of a plane one.
std::vector<std::array<Eigen::Vector3d, 2>> edges_of(const GrainView& view) {
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
  for (int axis = 0; axis < view.dimension; ++axis) {
    const int corners = 1 << view.dimension;
    for (int corner = 0; corner < corners; ++corner) {
      if ((corner >> axis & 1) != 0) continue;
      Eigen::Vector3d from = Eigen::Vector3d::Zero();
      for (int other = 0; other < view.dimension; ++other)
        if ((corner >> other & 1) != 0) from += view.box.col(other);
      edges.push_back({from, from + view.box.col(axis)});
    }
  }
  return edges;
}

}  // namespace

void write_grains(const fs::path& file, const GrainView& view) {
  fem::PlacedFields placed;
  fem::Field id{"id", 1, {}, "1"};
  fem::Field diameter{"diameter", 1, {}, "m"};
  fem::Field radius{"radius", 1, {}, "m"};
  fem::Field rotation{"rotation", 3, {}, "rad", kVector};
  fem::Field velocity{"velocity", 3, {}, "m/s", kVector};
  fem::Field spin{"spin", 3, {}, "rad/s", kVector};
  fem::Field coordination{"coordination_number", 1, {}, "1"};
  for (const GrainView::Grain& grain : view.grains) {
    placed.places.push_back(grain.position);
    id.values.push_back(static_cast<double>(grain.id));
    diameter.values.push_back(2.0 * grain.radius);
    radius.values.push_back(grain.radius);
    add(rotation, grain.rotation);
    add(velocity, grain.velocity);
    add(spin, grain.spin);
    coordination.values.push_back(grain.contacts);
  }
  // Every line has ends of its own, so that a line across the box to an image looks like one, and a tube can take its
  // thickness from the force at its ends. Their diameter is zero: a glyph that is scaled by it shows grains only.
  fem::Field force_at_ends{"normal_force", 1, std::vector<double>(view.grains.size(), 0.0), "N"};
  const auto add_line = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double force) {
    placed.lines.push_back({placed.places.size(), placed.places.size() + 1});
    placed.places.push_back(from);
    placed.places.push_back(to);
    force_at_ends.values.insert(force_at_ends.values.end(), 2, force);
  };
  for (const GrainView::Contact& contact : view.contacts) {
    const Eigen::Vector3d& from = view.grains[contact.first].position;
    add_line(from, from + contact.branch, contact.normal_force());
  }
  for (const auto& [from, to] : edges_of(view)) add_line(from, to, 0.0);
  placed.fields = {id, diameter, radius, rotation, velocity, spin, coordination};
  fill(placed.fields, placed.places.size());
  placed.fields.push_back(force_at_ends);

  const std::size_t vertices = placed.places.size();
  fem::Field kind{"kind", 1, std::vector<double>(view.grains.size(), kGrain), "1"};
  kind.values.resize(vertices, kEnd);
  const auto of_lines = [vertices](const char* name, int components, const char* unit) {
    return fem::Field{name, components,
                      std::vector<double>(vertices * static_cast<std::size_t>(components), 0.0), unit,
                      components == 1 ? std::vector<std::string>{} : kVector};
  };
  fem::Field first = of_lines("first", 1, "1");
  fem::Field second = of_lines("second", 1, "1");
  fem::Field normal = of_lines("normal_force", 1, "N");
  fem::Field tangential = of_lines("tangential_force", 1, "N");
  fem::Field force = of_lines("force", 3, "N");
  fem::Field moment = of_lines("rolling_moment", 3, "N m");
  fem::Field sliding = of_lines("sliding", 1, "1");
  fem::Field rolling = of_lines("rolling_at_limit", 1, "1");
  for (const GrainView::Contact& contact : view.contacts) {
    kind.values.push_back(kContact);
    first.values.push_back(static_cast<double>(view.grains[contact.first].id));
    second.values.push_back(static_cast<double>(view.grains[contact.second].id));
    normal.values.push_back(contact.normal_force());
    tangential.values.push_back(contact.tangential_force());
    add(force, contact.force);
    add(moment, contact.moment);
    sliding.values.push_back(contact.sliding ? 1.0 : 0.0);
    rolling.values.push_back(contact.rolling ? 1.0 : 0.0);
  }
  kind.values.resize(vertices + placed.lines.size(), kBox);
  placed.cell_fields = {kind, first, second, normal, tangential, force, moment, sliding, rolling};
  fill(placed.cell_fields, vertices + placed.lines.size());
  fem::Field box{"box", 9, {}, "m", {"11", "12", "13", "21", "22", "23", "31", "32", "33"}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) box.values.push_back(view.box(i, j));
  placed.whole = {box, {"volume", 1, {view.box.determinant()}, "m^3"}};
  fem::write_vtu(file, placed);
}

fs::path grains_file(std::size_t point, int step) {
  return fs::path(fmt::format("point-{}", point)) / fmt::format("step-{:05}.vtu", step);
}

fs::path grains_collection(std::size_t point) {
  return fmt::format("point-{}.pvd", point);
}

void write_grains_collection(const fs::path& folder, std::size_t point, const fs::path& history) {
  const CsvTable steps(history);
  fem::PvdCollection collection(folder / grains_collection(point));
  for (std::size_t row = 0; row < steps.rows(); ++row) {
    const fs::path file = grains_file(point, static_cast<int>(steps.number(row, steps.column("step"))));
    if (fs::exists(folder / file)) collection.add(steps.number(row, steps.column("time")), file);
  }
}

}  // namespace polargrain::app
