// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/structure_files.hpp"

#include <fmt/format.h>

#include "app/commands/csv_file.hpp"
#include "fem/beam/anchor.hpp"
#include "fem/beam/beam.hpp"
#include "fem/interface/interface.hpp"
#include "fem/output/vtu.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

/// Gathers rows of the table and points of the VTK file.
template <int dim>
class StructureFiles {
 public:
  void add(const fem::Interface<dim>& interface) {
    for (const fem::InterfacePointResult<dim>& point : interface.results()) {
      const double shear = dim == 2 ? point.traction(0) : point.traction.template head<dim - 1>().norm();
      row("interface", interface.settings().name, point.geometry.place,
          {exact(point.traction(dim - 1)), exact(shear), exact(point.gap), exact(point.slip),
           exact(point.mobilised), "", "", "", exact(point.pore_pressure)});
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      place.head<dim>() = point.geometry.place;
      points_.places.push_back(place);
      Eigen::Vector3d traction = Eigen::Vector3d::Zero();
      traction.head<dim>() = point.geometry.axes.transpose() * point.traction;
      tractions_.insert(tractions_.end(), traction.begin(), traction.end());
      normal_.push_back(point.traction(dim - 1));
      shear_.push_back(shear);
      gap_.push_back(point.gap);
      slip_.push_back(point.slip);
      mobilised_.push_back(point.mobilised);
      water_.push_back(point.pore_pressure);
    }
  }
  void add(const fem::Beam& beam, const fem::Problem<2>& problem) {
    for (const fem::BeamResult& end : beam.results(problem))
      row("beam", beam.short_name(), end.place,
          {"", "", "", "", "", exact(end.axial), exact(end.shear), exact(end.moment), ""});
  }
  void add(const fem::Anchor<dim>& anchor) {
    rows_ += csv_row(
        {"anchor", anchor.short_name(), "", "", "", "", "", "", "", "", exact(anchor.force()), "", "", ""});
  }

  void write(const std::filesystem::path& directory, int step) {
    if (rows_.empty()) return;
    const std::string head =
        csv_row({"kind", "name", "x1", "x2", "x3", "normal_stress", "shear_stress", "gap", "slip",
                 "mobilised", "axial_force", "shear_force", "moment", "water_pressure"});
    fem::write_file(directory / fmt::format("structures-{:05}.csv", step), head + rows_);
    if (points_.places.empty()) return;
    points_.fields = {{"traction", 3, std::move(tractions_), "Pa", {"1", "2", "3"}},
                      {"normal_stress", 1, std::move(normal_), "Pa"},
                      {"shear_stress", 1, std::move(shear_), "Pa"},
                      {"gap", 1, std::move(gap_), "m"},
                      {"slip", 1, std::move(slip_), "m"},
                      {"mobilised", 1, std::move(mobilised_), "1"},
                      {"water_pressure", 1, std::move(water_), "Pa"}};
    fem::write_vtu(directory / fmt::format("interfaces-{:05}.vtu", step), points_);
  }

 private:
  template <class Place>
  void row(const std::string& kind, const std::string& name, const Place& place,
           std::vector<std::string> values) {
    std::vector<std::string> cells{kind, name};
    for (Eigen::Index i = 0; i < 3; ++i) cells.push_back(i < place.size() ? exact(place(i)) : "0");
    cells.insert(cells.end(), values.begin(), values.end());
    rows_ += csv_row(cells);
  }

  std::string rows_;
  fem::PlacedFields points_;
  std::vector<double> tractions_;
  std::vector<double> normal_;
  std::vector<double> shear_;
  std::vector<double> gap_;
  std::vector<double> slip_;
  std::vector<double> mobilised_;
  std::vector<double> water_;
};

}  // namespace

template <int dim>
void write_structures(const std::filesystem::path& directory, int step, const fem::Solver<dim>& solver) {
  StructureFiles<dim> files;
  for (const auto& contribution : solver.problem().contributions) {
    if (const auto* const interface = dynamic_cast<const fem::Interface<dim>*>(contribution.get()))
      files.add(*interface);
    if (const auto* const anchor = dynamic_cast<const fem::Anchor<dim>*>(contribution.get()))
      files.add(*anchor);
    if constexpr (dim == 2)
      if (const auto* const beam = dynamic_cast<const fem::Beam*>(contribution.get()))
        files.add(*beam, solver.problem());
  }
  files.write(directory, step);
}

template void write_structures<2>(const std::filesystem::path&, int, const fem::Solver<2>&);
template void write_structures<3>(const std::filesystem::path&, int, const fem::Solver<3>&);

}  // namespace polargrain::app
