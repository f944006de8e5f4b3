// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fem/element/corner_shape.hpp"
#include "fem/output/smooth.hpp"
#include "fem/output/stress_measures.hpp"
#include "fem/output/vtu.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::fem {
namespace {

/// sqrt(2/3 e_ij e_ij) with e the deviator of the symmetric strain, in the plane with eps_33 = 0.
double deviatoric_strain(const Vector7& strain) {
  const double mean = (strain(k11) + strain(k22) + strain(k33)) / 3.0;
  const double shear = 0.5 * (strain(k12) + strain(k21));
  double square = 2.0 * shear * shear;
  for (const int i : {k11, k22, k33}) square += (strain(i) - mean) * (strain(i) - mean);
  return std::sqrt(2.0 / 3.0 * square);
}
double deviatoric_strain(const Vector18& strain) {
  Eigen::Matrix3d e = Eigen::Map<const Eigen::Matrix3d>(strain.data());
  e = (0.5 * (e + e.transpose())).eval();
  e -= (e.trace() / 3.0) * Eigen::Matrix3d::Identity();
  return std::sqrt(2.0 / 3.0) * e.norm();
}

double volume_strain(const Vector7& strain) {
  return strain.head<3>().sum();
}
double volume_strain(const Vector18& strain) {
  return strain(0) + strain(4) + strain(8);
}

const std::vector<std::string> kVector{"1", "2", "3"};

/// Names of the components of stresses, and of couple stresses.
template <int dim>
std::vector<std::string> tensor_names() {
  if constexpr (dim == 2) return {"11", "22", "33", "12", "21"};
  return {"11", "12", "13", "21", "22", "23", "31", "32", "33"};
}
template <int dim>
std::vector<std::string> couple_names() {
  if constexpr (dim == 2) return {"1", "2"};
  return tensor_names<3>();
}

/// The values of materials that are quantities in space, so that they can be smoothed. The others count things, or say
/// what an integration point is or does.
const std::vector<std::string> kSmoothed{"void_ratio",    "coordination_number", "sliding_fraction",
                                         "mean_rotation", "plastic_shear",       "friction",
                                         "dilatancy",     "error_estimate"};

/// A field at the integration points, and where it is known.
struct PointField {
  Field field;
  std::vector<bool> known;  ///< by point; empty: at all of them
};

/// A field of the values of `quantity` at each point, component by component; 0 where the element is not there.
template <int dim, class Quantity>
Field point_field(const Solver<dim>& solver, Field field, Quantity quantity) {
  for (std::size_t point = 0; point < solver.points(); ++point)
    for (int i = 0; i < field.components; ++i)
      field.values.push_back(solver.is_there(point) ? quantity(point, i) : 0.0);
  return field;
}

/// Averages over the volume of each element.
template <int dim>
Field element_averages(const Solver<dim>& solver, const Field& at_points) {
  const std::size_t elements = solver.problem().mesh.elements.size();
  const auto width = static_cast<std::size_t>(at_points.components);
  Field field = at_points;
  field.values.assign(elements * width, 0.0);
  std::vector<double> volume(elements, 0.0);
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto e = static_cast<std::size_t>(solver.element_of_point(point));
    volume[e] += solver.volume_of_point(point);
    for (std::size_t i = 0; i < width; ++i) {
      field.values[e * width + i] += solver.volume_of_point(point) * at_points.values[point * width + i];
    }
  }
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] /= volume[i / width];
  return field;
}

/// NodalFields. Between corners that carry one it is interpolated; 0 where it is not known.
template <int dim>
std::vector<Field> scalar_fields(const Solver<dim>& solver) {
  const Problem<dim>& problem = solver.problem();
  const FieldPlaces<dim> places = problem.places();
  std::vector<Field> fields;
  for (std::size_t k = 0; k < problem.fields.size(); ++k) {
    std::vector<double> values(problem.mesh.nodes.size(), 0.0);
    for (const int node : problem.fields[k].nodes)
      values[static_cast<std::size_t>(node)] = solver.state().displacement(places.entry(k, node));
    for (const Element<dim>& element : problem.mesh.elements) {
      const auto corners = element.type->corners;
      const auto carries = [&](int node) { return places.entry(k, node) >= 0; };
      if (!std::all_of(element.nodes.begin(), element.nodes.begin() + corners, carries)) continue;
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        if (carries(element.nodes[a])) continue;
        const Eigen::VectorXd shape =
            corner_shape_functions<dim>(*element.type, element.type->node_positions[a]).value;
        double value = 0.0;
        for (int c = 0; c < corners; ++c)
          value += shape(c) * values[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(c)])];
        values[static_cast<std::size_t>(element.nodes[a])] = value;
      }
    }
    fields.push_back({problem.fields[k].name, 1, std::move(values), problem.fields[k].unit});
  }
  return fields;
}

template <int dim>
std::vector<Field> nodal_fields(const Solver<dim>& solver) {
  Field displacement{"displacement", 3, {}, "m", kVector};
  Field rotation{"micro_rotation", 1, {}, "rad"};
  Field axis{"micro_rotation_vector", 3, {}, "rad", kVector};
  const Eigen::VectorXd values = solver.shown_displacement();
  const Eigen::Index mechanics = solver.problem().places().mechanics();
  for (Eigen::Index i = 0; i < mechanics; i += Cosserat<dim>::dofs) {
    if constexpr (dim == 2) {
      displacement.values.insert(displacement.values.end(), {values(i), values(i + 1), 0.0});
      rotation.values.push_back(values(i + 2));
      axis.values.insert(axis.values.end(), {0.0, 0.0, values(i + 2)});
    } else {
      displacement.values.insert(displacement.values.end(), {values(i), values(i + 1), values(i + 2)});
      axis.values.insert(axis.values.end(), {values(i + 3), values(i + 4), values(i + 5)});
    }
  }
  std::vector<Field> fields{std::move(displacement)};
  if constexpr (dim == 2) fields.push_back(std::move(rotation));
  fields.push_back(std::move(axis));
  for (Field& scalar : scalar_fields(solver)) fields.push_back(std::move(scalar));
  return fields;
}

/// All names that some material shows, each once, in the order of the points.
template <int dim>
std::vector<std::string> material_field_names(const Solver<dim>& solver) {
  std::vector<const Material<dim>*> seen;
  std::vector<std::string> names;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const Material<dim>* material = solver.material_of_point(point).first;
    if (std::find(seen.begin(), seen.end(), material) != seen.end()) continue;
    seen.push_back(material);
    for (std::string& name : material->field_names()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    }
  }
  return names;
}

/// The fields of the materials; 0 where the material of a point does not have a field.
template <int dim>
std::vector<PointField> material_fields(const Solver<dim>& solver) {
  const std::vector<std::string> names = material_field_names(solver);
  std::map<std::string, std::size_t> places;
  std::vector<PointField> fields;
  for (const std::string& name : names) {
    places[name] = fields.size();
    fields.push_back(
        {{name, 1, std::vector<double>(solver.points(), 0.0)}, std::vector<bool>(solver.points(), false)});
  }
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto [material, number] = solver.material_of_point(point);
    const std::vector<std::string> own = material->field_names();
    std::vector<double> own_values(own.size(), 0.0);
    material->fields(number, own_values);
    for (std::size_t i = 0; i < own.size(); ++i) {
      PointField& field = fields[places.at(own[i])];
      field.field.values[point] = own_values[i];
      field.known[point] = true;
    }
  }
  return fields;
}

/// Stresses, strains and what materials show, at the integration points.
template <int dim>
std::vector<PointField> basic_fields(const Solver<dim>& solver) {
  using Counts = Cosserat<dim>;
  const SolverState<dim>& state = solver.state();
  const auto stress = [&](std::size_t point, int i) { return state.responses[point].stress(i); };
  const auto strain = [&](std::size_t point, int i) { return state.strain[point](i); };
  std::vector<PointField> fields;
  const auto add = [&](Field field, auto quantity) {
    fields.push_back({point_field(solver, std::move(field), quantity), {}});
  };
  add({"stress", Counts::stresses, {}, "Pa", tensor_names<dim>()}, stress);
  add({"couple_stress", Counts::couples, {}, "N/m", couple_names<dim>()},
      [&](std::size_t point, int i) { return stress(point, Counts::stresses + i); });
  add({"strain", Counts::stresses, {}, "1", tensor_names<dim>()}, strain);
  add({"curvature", Counts::couples, {}, "rad/m", couple_names<dim>()},
      [&](std::size_t point, int i) { return strain(point, Counts::stresses + i); });
  add({"relative_rotation", 3, {}, "rad", kVector}, [&](std::size_t point, int i) {
    if (dim == 2 && i != 2) return 0.0;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    return 0.5 * (strain(point, Counts::stress_place(k, j)) - strain(point, Counts::stress_place(j, k)));
  });
  add({"deviatoric_strain", 1, {}, "1"},
      [&](std::size_t point, int) { return deviatoric_strain(state.strain[point]); });
  add({"volume_strain", 1, {}, "1"},
      [&](std::size_t point, int) { return volume_strain(state.strain[point]); });
  for (PointField& field : material_fields(solver)) fields.push_back(std::move(field));
  return fields;
}

/// Adds what can be read off the stress, the first of the fields.
void add_plane_measures(std::vector<Field>& fields, const Field& stress) {
  Field p{"p", 1, {}, "Pa"};
  Field q{"q", 1, {}, "Pa"};
  Field ratio{"stress_ratio", 1, {}, "1"};
  Field friction{"mobilised_friction_angle", 1, {}, "degree"};
  Field principal{"principal_stress", 3, {}, "Pa", {"1", "2", "33"}};
  Field first{"principal_direction_1", 3, {}, "1", kVector};
  Field second{"principal_direction_2", 3, {}, "1", kVector};
  for (std::size_t k = 0; k < stress.values.size(); k += 5) {
    Vector7 of_entity = Vector7::Zero();
    for (int i = 0; i < 5; ++i) of_entity(i) = stress.values[k + static_cast<std::size_t>(i)];
    const StressMeasures found = measures_of(of_entity);
    p.values.push_back(found.pressure);
    q.values.push_back(found.deviatoric);
    ratio.values.push_back(found.ratio);
    friction.values.push_back(found.mobilised_friction);
    principal.values.insert(principal.values.end(), found.principal.begin(), found.principal.end());
    for (const auto& [field, direction] :
         {std::pair(&first, found.first_direction), std::pair(&second, found.second_direction)})
      field->values.insert(field->values.end(), {direction(0), direction(1), 0.0});
  }
  for (Field* const field : {&p, &q, &ratio, &friction, &principal, &first, &second})
    fields.push_back(std::move(*field));
}

/// The same in space.
void add_space_measures(std::vector<Field>& fields, const Field& stress) {
  Field p{"p", 1, {}, "Pa"};
  Field q{"q", 1, {}, "Pa"};
  Field ratio{"stress_ratio", 1, {}, "1"};
  Field lode{"lode_angle", 1, {}, "degree"};
  Field friction{"mobilised_friction_angle", 1, {}, "degree"};
  Field principal{"principal_stress", 3, {}, "Pa", kVector};
  std::array<Field, 3> directions;
  for (std::size_t i = 0; i < 3; ++i)
    directions[i] = {"principal_direction_" + kVector[i], 3, {}, "1", kVector};
  for (std::size_t k = 0; k < stress.values.size(); k += 9) {
    Vector18 of_entity = Vector18::Zero();
    std::copy_n(stress.values.begin() + static_cast<std::ptrdiff_t>(k), 9, of_entity.begin());
    const SpaceStressMeasures found = measures_in_space(of_entity);
    p.values.push_back(found.pressure);
    q.values.push_back(found.deviatoric);
    ratio.values.push_back(found.ratio);
    lode.values.push_back(found.lode_angle);
    friction.values.push_back(found.mobilised_friction);
    principal.values.insert(principal.values.end(), found.principal.begin(), found.principal.end());
    for (int i = 0; i < 3; ++i) {
      const auto direction = found.directions.col(i);
      directions[static_cast<std::size_t>(i)].values.insert(
          directions[static_cast<std::size_t>(i)].values.end(), {direction(0), direction(1), direction(2)});
    }
  }
  for (Field* const field :
       {&p, &q, &ratio, &lode, &friction, &principal, &directions[0], &directions[1], &directions[2]})
    fields.push_back(std::move(*field));
}

template <int dim>
void add_stress_measures(std::vector<Field>& fields, const Field& stress) {
  if constexpr (dim == 2) {
    add_plane_measures(fields, stress);
  } else {
    add_space_measures(fields, stress);
  }
}

/// A nodal field where the integration points are, as the elements interpolate it.
template <int dim>
Field interpolated(const Solver<dim>& solver, const Field& at_nodes) {
  const Mesh<dim>& mesh = solver.problem().mesh;
  const auto width = static_cast<std::size_t>(at_nodes.components);
  Field field = at_nodes;
  field.values.clear();
  for (const Element<dim>& element : mesh.elements) {
    for (const QuadraturePoint<dim>& point : element.type->quadrature) {
      const Eigen::VectorXd shape = element.type->shape_functions(point.position).value;
      for (std::size_t i = 0; i < width; ++i) {
        double value = 0.0;
        for (std::size_t a = 0; a < element.nodes.size(); ++a)
          value += shape(static_cast<Eigen::Index>(a)) *
                   at_nodes.values[static_cast<std::size_t>(element.nodes[a]) * width + i];
        field.values.push_back(value);
      }
    }
  }
  return field;
}

/// Where pores hold water: the total stress, and the flow. `stress` is the effective one.
template <int dim>
void add_water_fields(const Solver<dim>& solver, std::vector<PointField>& fields) {
  using Counts = Cosserat<dim>;
  const PoreWater<dim>* const water = pore_water_of(solver.problem());
  if (water == nullptr) return;
  const std::vector<Field> scalars = scalar_fields(solver);
  const std::vector<double> pressure =
      interpolated(solver, *std::ranges::find(scalars, kPorePressure, &Field::name)).values;
  std::vector<bool> wet(solver.points(), false);
  Field velocity{"flow_velocity", 3, std::vector<double>(3 * solver.points(), 0.0), "m/s", kVector};
  std::vector<std::size_t> first{0};
  for (const Element<dim>& element : solver.problem().mesh.elements)
    first.push_back(first.back() + element.type->quadrature.size());
  for (std::size_t e = 0; e < water->elements(); ++e) {
    const auto element = static_cast<std::size_t>(water->mesh_element(e));
    for (std::size_t point = first[element]; point < first[element + 1]; ++point) {
      if (!solver.is_there(point)) continue;
      wet[point] = true;
      const auto v = water->velocity(e, point - first[element], solver.state().displacement);
      std::copy(v.begin(), v.end(), velocity.values.begin() + static_cast<std::ptrdiff_t>(3 * point));
    }
  }
  std::array<bool, Counts::stresses> normal{};
  for (int i = 0; i < dim; ++i) normal[static_cast<std::size_t>(Counts::stress_place(i, i))] = true;
  if constexpr (dim == 2) normal[k33] = true;
  Field total{"total_stress", Counts::stresses, {}, "Pa", tensor_names<dim>()};
  total = point_field(solver, std::move(total), [&](std::size_t point, int i) {
    const double stress = solver.state().responses[point].stress(i);
    return wet[point] && normal[static_cast<std::size_t>(i)] ? stress - pressure[point] : stress;
  });
  fields.push_back({std::move(total), {}});
  fields.push_back({std::move(velocity), std::move(wet)});
}

/// All that is shown at the integration points, the stress first.
template <int dim>
std::vector<PointField> fields_at_points(const Solver<dim>& solver) {
  std::vector<PointField> fields = basic_fields(solver);
  add_water_fields(solver, fields);
  return fields;
}

}  // namespace

template <int dim>
Fields collect_fields(const Solver<dim>& solver) {
  Fields fields;
  fields.points = nodal_fields(solver);
  for (const PointField& of : fields_at_points(solver)) {
    fields.cells.push_back(element_averages(solver, of.field));
    if (of.known.empty() || std::ranges::find(kSmoothed, of.field.name) != kSmoothed.end())
      fields.points.push_back(smoothed(solver, of.field, of.known));
  }
  const auto stress = [](const std::vector<Field>& of) {
    return *std::ranges::find(of, "stress", &Field::name);
  };
  add_stress_measures<dim>(fields.points, stress(fields.points));
  add_stress_measures<dim>(fields.cells, stress(fields.cells));
  if (solver.problem().stages.size() > 1)
    fields.cells.push_back(element_averages(
        solver, point_field(solver, {"is_there", 1, {}, "1"}, [](std::size_t, int) { return 1.0; })));
  return fields;
}

template <int dim>
PlacedFields collect_point_fields(const Solver<dim>& solver) {
  PlacedFields placed;
  Field nodes{"", dim, {}};
  for (const typename Cosserat<dim>::Place& node : solver.problem().mesh.nodes)
    nodes.values.insert(nodes.values.end(), node.begin(), node.end());
  const std::vector<double> places = interpolated(solver, nodes).values;
  for (std::size_t k = 0; k < places.size(); k += dim)
    placed.places.emplace_back(places[k], places[k + 1], dim == 2 ? 0.0 : places[k + dim - 1]);

  std::vector<Field>& fields = placed.fields;
  for (const Field& field : nodal_fields(solver)) fields.push_back(interpolated(solver, field));
  fields.push_back(point_field(solver, {"volume", 1, {}, dim == 2 ? "m^2" : "m^3"},
                               [&](std::size_t point, int) { return solver.volume_of_point(point); }));
  std::vector<PointField> basic = fields_at_points(solver);
  const Field stress = basic.front().field;
  for (PointField& of : basic) fields.push_back(std::move(of.field));
  add_stress_measures<dim>(fields, stress);
  return placed;
}

template Fields collect_fields<2>(const Solver<2>& solver);
template Fields collect_fields<3>(const Solver<3>& solver);
template PlacedFields collect_point_fields<2>(const Solver<2>& solver);
template PlacedFields collect_point_fields<3>(const Solver<3>& solver);

}  // namespace polargrain::fem
