// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/interface/interface.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "fem/element/dofs.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {
namespace {

constexpr double kOpenStiffness = 1e-6;  ///< see Interface

/// The largest stiffness against one-dimensional strain of an element, mean of its points.
template <int dim>
double stiffness_of(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed,
                    int element) {
  const auto e = static_cast<std::size_t>(element);
  double sum = 0.0;
  for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
    double largest = 0.0;
    for (int axis = 0; axis < dim; ++axis) {
      const int place = Cosserat<dim>::stress_place(axis, axis);
      largest = std::max(largest, committed[i].tangent(place, place));
    }
    sum += largest;
  }
  return sum / static_cast<double>(discretisation.first_point(e + 1) - discretisation.first_point(e));
}

template <int dim>
double volume_of(const Discretisation<dim>& discretisation, int element) {
  const auto e = static_cast<std::size_t>(element);
  double volume = 0.0;
  for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i)
    volume += discretisation.point(i).volume;
  return volume;
}

/// tan of the mobilised friction of a stress, of its principal values in the plane (in space: all); 0 without pressure.
template <int dim>
double mobilised_friction(const typename Cosserat<dim>::Vector& stress) {
  Eigen::Matrix<double, dim, dim> s;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      s(i, j) = 0.5 * (stress(Cosserat<dim>::stress_place(i, j)) + stress(Cosserat<dim>::stress_place(j, i)));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>> principal(s, Eigen::EigenvaluesOnly);
  const double least = principal.eigenvalues()(0);
  const double largest = principal.eigenvalues()(dim - 1);
  const double pressure = -(least + largest);
  if (!(pressure > 0.0)) return 0.0;
  const double sine = std::min((largest - least) / pressure, 1.0 - 1e-9);
  return sine / std::sqrt(1.0 - sine * sine);
}

}  // namespace

template <int dim>
std::vector<int> Interface<dim>::all_entries(const InterfaceFace<dim>& face) {
  std::vector<int> entries;
  for (const std::vector<int>* nodes : {&face.nodes_a, &face.nodes_b})
    for (const int node : *nodes)
      for (int i = 0; i < dim; ++i) entries.push_back(entry_of<dim>(node, static_cast<Dof>(i)));
  if (face.rotation_b.empty()) return entries;
  for (const int node : face.nodes_a)
    for (int k = 0; k < Cosserat<dim>::rotations; ++k) entries.push_back(entry_of<dim>(node) + dim + k);
  entries.insert(entries.end(), face.rotation_b.begin(), face.rotation_b.end());
  return entries;
}

template <int dim>
int Interface<dim>::place_of(Element& element, int entry) {
  const auto place = std::ranges::find(element.entries, entry);
  const auto number = static_cast<int>(place - element.entries.begin());
  if (place == element.entries.end()) element.entries.push_back(entry);
  return number;
}

template <int dim>
Interface<dim>::Interface(const Mesh<dim>& mesh, InterfaceSettings settings,
                          std::vector<InterfaceFace<dim>> faces)
    : settings_(std::move(settings)) {
  for (InterfaceFace<dim>& face : faces) {
    Element& element = elements_.emplace_back();
    for (const int entry : all_entries(face)) element.places.push_back(place_of(element, entry));
    VectorRows<dim> positions(static_cast<Eigen::Index>(face.nodes_a.size()), dim);
    for (std::size_t a = 0; a < face.nodes_a.size(); ++a)
      positions.row(static_cast<Eigen::Index>(a)) =
          mesh.nodes[static_cast<std::size_t>(face.nodes_a[a])].transpose();
    double area = 0.0;
    for (InterfacePoint<dim>& geometry : interface_points<dim>(*face.type, positions)) {
      area += geometry.area;
      Point& point = element.points.emplace_back();
      point.geometry = std::move(geometry);
      point.parameters = settings_.parameters;
    }
    element.size = dim == 2 ? area : std::sqrt(area);
    element.face = std::move(face);
    if (settings_.parameters.normal_stiffness > 0.0 && settings_.parameters.shear_stiffness > 0.0)
      set_stiffness(element, 0.0);
  }
  allocate();
}

template <int dim>
void Interface<dim>::set_stiffness(Element& element, double stiffness) {
  for (Point& point : element.points) {
    if (settings_.parameters.normal_stiffness <= 0.0) point.parameters.normal_stiffness = stiffness;
    if (settings_.parameters.shear_stiffness <= 0.0) point.parameters.shear_stiffness = stiffness;
  }
  element.rotation_stiffness =
      element.points.front().parameters.shear_stiffness * element.size * element.size;
}

template <int dim>
void Interface<dim>::divide_strength(double factor) {
  const InterfaceParameters& given = settings_.parameters;
  const auto curve =
      given.over_slip ? std::make_shared<const FrictionCurve>(given.over_slip->divided(factor)) : nullptr;
  for (Element& element : elements_)
    for (Point& point : element.points) {
      InterfaceParameters& own = point.parameters;
      own.tan_friction = given.tan_friction / factor;
      own.tan_dilation = std::min(given.tan_dilation, own.tan_friction);
      own.cohesion = given.cohesion / factor;
      own.tension = given.tension / factor;
      own.over_slip = curve;
    }
}

template <int dim>
void Interface<dim>::learn(const Discretisation<dim>& discretisation,
                           std::span<const Response<dim>> committed) {
  const bool sets_stiffness =
      settings_.parameters.normal_stiffness <= 0.0 || settings_.parameters.shear_stiffness <= 0.0;
  double least = HUGE_VAL;
  double largest = 0.0;
  for (Element& element : elements_) {
    if (!element.active) continue;
    if (sets_stiffness && !element.knows_stiffness) {
      element.knows_stiffness = true;
      double area = 0.0;
      for (const Point& point : element.points) area += point.geometry.area;
      double stiffness = 0.0;
      for (const int neighbour : element.face.neighbours)
        stiffness = std::max(stiffness, stiffness_of(discretisation, committed, neighbour) * area /
                                            volume_of(discretisation, neighbour));
      stiffness *= kStiffnessRatio;
      set_stiffness(element, stiffness);
      least = std::min(least, stiffness);
      largest = std::max(largest, stiffness);
    }
    if (!settings_.share) continue;
    typename Cosserat<dim>::Vector sum = Cosserat<dim>::Vector::Zero();
    for (const int neighbour : element.face.neighbours) {
      const auto e = static_cast<std::size_t>(neighbour);
      for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i)
        sum += committed[i].stress;
    }
    const double friction = *settings_.share * mobilised_friction<dim>(sum);
    for (Point& point : element.points) {
      point.parameters.tan_friction = friction;
      point.parameters.tan_dilation = std::min(settings_.parameters.tan_dilation, friction);
    }
  }
  if (largest > 0.0)
    notes_.push_back(
        fmt::format("{}: stiffness not given is {:.3g} to {:.3g} Pa/m, {:.0f} times that of the "
                    "elements beside it",
                    name(), least, largest, kStiffnessRatio));
}

template <int dim>
void Interface<dim>::allocate() {
  for (Element& element : elements_) {
    element.knows_stiffness = false;
    for (Point& point : element.points) forget(point);
  }
  told_slip_ = false;
  notes_.clear();
}

template <int dim>
FaceVector<dim> Interface<dim>::jump_at(const Element& element, const Point& point,
                                        const Eigen::VectorXd& values) {
  const auto nodes = static_cast<int>(element.face.nodes_a.size());
  typename Cosserat<dim>::Place jump = Cosserat<dim>::Place::Zero();
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < dim; ++i)
      jump(i) +=
          point.geometry.shape(a) * (values(element.places[static_cast<std::size_t>(dim * (nodes + a) + i)]) -
                                     values(element.places[static_cast<std::size_t>(dim * a + i)]));
  return point.geometry.axes * jump;
}

template <int dim>
std::string Interface<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  for (Element& element : elements_) {
    if (!element.active) continue;
    const Eigen::VectorXd values = step.end(element.entries);
    for (Point& point : element.points) {
      point.jump = jump_at(element, point, values);
      point.answer = respond<dim>(point.parameters, point.committed, point.jump);
      point.pressure = pressure_at(element, point, values);
    }
    const Eigen::VectorXd own = forces_of(element, values);
    forces.internal(element.entries) += own;
    forces.parts(element.entries) += own.cwiseAbs();
    add_water(element, step, forces);
  }
  return {};
}

template <int dim>
typename Interface<dim>::Rolling Interface<dim>::rolling(const Point& point) const {
  Rolling rolling;
  const typename Cosserat<dim>::Place normal = point.geometry.axes.row(dim - 1).transpose();
  for (int i = 0; i + 1 < dim; ++i) {
    const typename Cosserat<dim>::Place tangent = point.geometry.axes.row(i).transpose();
    if constexpr (dim == 2) {
      rolling(0, i) = normal(0) * tangent(1) - normal(1) * tangent(0);
    } else {
      rolling.col(i) = normal.cross(tangent);
    }
  }
  return settings_.turning * rolling;
}

template <int dim>
Eigen::VectorXd Interface<dim>::forces_of(const Element& element, const Eigen::VectorXd& values) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(element.entries.size()));
  const auto nodes = static_cast<int>(element.face.nodes_a.size());
  const auto add = [&](int place, double force) {
    forces(element.places[static_cast<std::size_t>(place)]) += force;
  };
  for (const Point& point : element.points) {
    const typename Cosserat<dim>::Place traction =
        point.geometry.area * (point.geometry.axes.transpose() * point.answer.traction);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        const double force = point.geometry.shape(a) * traction(i);
        add(dim * a + i, -force);
        add(dim * (nodes + a) + i, force);
      }
    if (element.face.rotation_b.empty()) continue;
    constexpr int rotations = Cosserat<dim>::rotations;
    const int first = 2 * dim * nodes;
    const Eigen::Matrix<double, dim - 1, 1> slip =
        (point.answer.state.plastic_jump - point.birth).template head<dim - 1>();
    const Eigen::Matrix<double, rotations, 1> rolled = rolling(point) * slip;
    for (int k = 0; k < rotations; ++k) {
      double difference = rolled(k);
      for (int a = 0; a < nodes; ++a)
        difference += point.geometry.shape(a) *
                      (values(element.places[static_cast<std::size_t>(first + rotations * (nodes + a) + k)]) -
                       values(element.places[static_cast<std::size_t>(first + rotations * a + k)]));
      const double moment = point.geometry.area * element.rotation_stiffness * difference;
      for (int a = 0; a < nodes; ++a) {
        add(first + rotations * a + k, -point.geometry.shape(a) * moment);
        add(first + rotations * (nodes + a) + k, point.geometry.shape(a) * moment);
      }
    }
  }
  return forces;
}

template <int dim>
Eigen::MatrixXd Interface<dim>::tangent(std::size_t e) const {
  const Element& element = elements_[e];
  const auto size = static_cast<Eigen::Index>(element.entries.size());
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  const auto nodes = static_cast<int>(element.face.nodes_a.size());
  // Shape functions of both sides with the signs of the jump.
  const auto signed_shape = [&](const Point& point, int a) {
    return a < nodes ? -point.geometry.shape(a) : point.geometry.shape(a - nodes);
  };
  const auto place = [&](int number) { return element.places[static_cast<std::size_t>(number)]; };
  for (const Point& point : element.points) {
    Eigen::Matrix<double, dim, dim> stiffness = point.answer.tangent;
    if (point.answer.contact == Contact::open) {
      stiffness.setIdentity();
      stiffness *= kOpenStiffness * point.parameters.shear_stiffness;
      stiffness(dim - 1, dim - 1) = kOpenStiffness * point.parameters.normal_stiffness;
    }
    const Eigen::Matrix<double, dim, dim> turned =
        point.geometry.area * (point.geometry.axes.transpose() * stiffness * point.geometry.axes);
    for (int a = 0; a < 2 * nodes; ++a)
      for (int b = 0; b < 2 * nodes; ++b) {
        const double factor = signed_shape(point, a) * signed_shape(point, b);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            tangent(place(dim * a + i), place(dim * b + j)) += factor * turned(i, j);
      }
    if (element.face.rotation_b.empty()) continue;
    constexpr int rotations = Cosserat<dim>::rotations;
    const int first = 2 * dim * nodes;
    for (int a = 0; a < 2 * nodes; ++a)
      for (int b = 0; b < 2 * nodes; ++b)
        for (int k = 0; k < rotations; ++k)
          tangent(place(first + rotations * a + k), place(first + rotations * b + k)) +=
              point.geometry.area * element.rotation_stiffness * signed_shape(point, a) *
              signed_shape(point, b);
    if (settings_.turning == 0.0) continue;
    // The slip is the jump less the elastic part of it.
    Eigen::Matrix<double, dim - 1, dim> slip =
        -point.answer.tangent.template topRows<dim - 1>() / point.parameters.shear_stiffness;
    slip.template leftCols<dim - 1>().diagonal().array() += 1.0;
    const Eigen::Matrix<double, rotations, dim> rolled = rolling(point) * slip * point.geometry.axes;
    for (int a = 0; a < 2 * nodes; ++a)
      for (int b = 0; b < 2 * nodes; ++b)
        for (int k = 0; k < rotations; ++k)
          for (int j = 0; j < dim; ++j)
            tangent(place(first + rotations * a + k), place(dim * b + j)) +=
                point.geometry.area * element.rotation_stiffness * signed_shape(point, a) *
                signed_shape(point, b) * rolled(k, j);
  }
  add_water_tangent(element, tangent);
  return tangent;
}

template <int dim>
void Interface<dim>::commit() {
  for (Element& element : elements_) {
    if (!element.active) continue;
    for (Point& point : element.points) {
      point.committed = point.answer.state;
      point.committed_answer = point.answer;
      point.committed_jump = point.jump;
      point.committed_pressure = point.pressure;
      if (told_slip_ || point.committed.slip <= 0.5 * element.size) continue;
      told_slip_ = true;
      notes_.push_back(
          fmt::format("{}: has slipped {:.3g} m at {}, more than half of a face there; its pairs of nodes "
                      "do not change, so forces are handed on at the places of the start",
                      name(), point.committed.slip, place_text<dim>(point.geometry.place)));
    }
  }
}

template <int dim>
void Interface<dim>::revert() {
  for (Element& element : elements_) {
    for (Point& point : element.points) {
      point.answer = point.committed_answer;
      point.jump = point.committed_jump;
      point.pressure = point.committed_pressure;
    }
  }
}

template <int dim>
void Interface<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  for (const Element& element : elements_) {
    for (const Point& point : element.points) {
      for (const FaceVector<dim>* vector :
           {&point.committed.initial_traction, &point.committed.plastic_jump, &point.committed_jump})
        values.insert(values.end(), vector->begin(), vector->end());
      values.insert(values.end(), {point.committed.slip, point.committed.has_opened ? 1.0 : 0.0,
                                   point.parameters.normal_stiffness, point.parameters.shear_stiffness,
                                   point.parameters.tan_friction, point.parameters.tan_dilation,
                                   static_cast<double>(point.committed_answer.contact)});
      values.insert(values.end(), point.committed_answer.traction.begin(),
                    point.committed_answer.traction.end());
    }
  }
  archive.write("points", std::span<const double>(values));
  if (settings_.turning != 0.0) {
    std::vector<double> births;
    for (const Element& element : elements_)
      for (const Point& point : element.points)
        births.insert(births.end(), point.birth.begin(), point.birth.end());
    archive.write("births", std::span<const double>(births));
  }
  if (is_dry()) return;
  std::vector<double> pressures;
  for (const Element& element : elements_)
    for (const Point& point : element.points) pressures.push_back(point.committed_pressure);
  archive.write("pressures", std::span<const double>(pressures));
}

template <int dim>
void Interface<dim>::restore(ArchiveReader& archive) {
  const std::vector<double> values = archive.doubles("points");
  std::size_t points = 0;
  for (const Element& element : elements_) points += element.points.size();
  constexpr std::size_t length = 4 * dim + 7;
  if (values.size() != length * points)
    throw RunError(fmt::format("{}: the checkpoint is of another interface", name()));
  auto value = values.begin();
  const auto take = [&](FaceVector<dim>& vector) {
    for (double& x : vector) x = *value++;
  };
  for (Element& element : elements_) {
    for (Point& point : element.points) {
      take(point.committed.initial_traction);
      take(point.committed.plastic_jump);
      take(point.committed_jump);
      point.committed.slip = *value++;
      point.committed.has_opened = *value++ != 0.0;
      point.parameters.normal_stiffness = *value++;
      point.parameters.shear_stiffness = *value++;
      point.parameters.tan_friction = *value++;
      point.parameters.tan_dilation = *value++;
      point.committed_answer.contact = static_cast<Contact>(static_cast<int>(*value++));
      take(point.committed_answer.traction);
      point.committed_answer.state = point.committed;
    }
    element.rotation_stiffness =
        element.points.front().parameters.shear_stiffness * element.size * element.size;
    element.knows_stiffness = element.rotation_stiffness > 0.0;
  }
  if (settings_.turning != 0.0) {
    const std::vector<double> births = read_lists(archive, "births", points, dim);
    auto birth = births.begin();
    for (Element& element : elements_)
      for (Point& point : element.points)
        for (double& x : point.birth) x = *birth++;
  }
  if (!is_dry()) {
    const std::vector<double> pressures = read_lists(archive, "pressures", points, 1);
    auto pressure = pressures.begin();
    for (Element& element : elements_)
      for (Point& point : element.points) point.committed_pressure = *pressure++;
  }
  revert();
}

template <int dim>
std::vector<std::pair<int, int>> Interface<dim>::joined_nodes() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Element& element : elements_)
    for (std::size_t a = 0; a < element.face.nodes_a.size(); ++a)
      if (element.face.nodes_a[a] != element.face.nodes_b[a])
        pairs.emplace_back(element.face.nodes_a[a], element.face.nodes_b[a]);
  return pairs;
}

template <int dim>
std::vector<std::string> Interface<dim>::faults(const Problem<dim>& problem) const {
  if (problem.deformation == Deformation::large)
    return {"interfaces are of small deformation; set 'deformation: small'"};
  return {};
}

template <int dim>
bool Interface<dim>::add_forces_on_face(const std::vector<int>& nodes, Eigen::VectorXd& forces) const {
  bool is_here = false;
  for (const Element& element : elements_) {
    if (!std::ranges::is_permutation(element.face.nodes_b, nodes)) continue;
    is_here = true;
    if (!element.active) continue;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto node = static_cast<Eigen::Index>(std::ranges::find(element.face.nodes_b, nodes[a]) -
                                                  element.face.nodes_b.begin());
      for (const Point& point : element.points) {
        FaceVector<dim> total = point.committed_answer.traction;
        total(dim - 1) -= point.committed_pressure;
        forces.segment<dim>(dim * static_cast<Eigen::Index>(a)) +=
            point.geometry.area * point.geometry.shape(node) * (point.geometry.axes.transpose() * total);
      }
    }
  }
  return is_here;
}

template <int dim>
std::vector<std::string> Interface<dim>::take_notes() {
  return std::exchange(notes_, {});
}

template <int dim>
std::vector<InterfacePointResult<dim>> Interface<dim>::results() const {
  std::vector<InterfacePointResult<dim>> all;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (!elements_[e].active) continue;
    for (const Point& point : elements_[e].points) {
      const InterfaceAnswer<dim>& answer = point.committed_answer;
      all.push_back({point.geometry, e, answer.traction, point.committed_jump,
                     gap<dim>(point.parameters, answer, point.committed_jump), point.committed.slip,
                     mobilised_share<dim>(point.parameters, answer), answer.contact,
                     point.committed_pressure});
    }
  }
  return all;
}

template <int dim>
typename Cosserat<dim>::Place Interface<dim>::force() const {
  typename Cosserat<dim>::Place sum = Cosserat<dim>::Place::Zero();
  for (const Element& element : elements_)
    for (const Point& point : element.points)
      sum -= point.geometry.area * (point.geometry.axes.transpose() * point.committed_answer.traction);
  return sum;
}

template <int dim>
double Interface<dim>::lever() const {
  double lowest = HUGE_VAL;
  double force = 0.0;
  double moment = 0.0;
  for (const Element& element : elements_) {
    if (!element.active) continue;
    for (const Point& point : element.points) {
      const double normal = point.geometry.area * point.committed_answer.traction(dim - 1);
      const double height = point.geometry.place(dim - 1);
      lowest = std::min(lowest, height);
      force += normal;
      moment += normal * height;
    }
  }
  return force == 0.0 ? 0.0 : moment / force - lowest;
}

template class Interface<2>;
template class Interface<3>;

}  // namespace polargrain::fem
