// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/record.hpp"
#include "common/state.hpp"

namespace polargrain {

/// A disc, or a sphere in a single layer or in space.
struct Grain {
  std::int64_t id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double radius = 0.0;                                 ///< m
  double mass = 0.0;                                   ///< kg
  double moment_of_inertia = 0.0;                      ///< kg m^2, about e_3
  double height = 0.0;                                 ///< x3 of the centre, m; 0 in a plane packing
};

template <RecordOf<Grain> Record, class Visit>
void describe(Record& grain, Visit&& visit) {
  visit(FieldNotes{"id", "", "number of the grain"}, grain.id);
  visit(FieldNotes{"x", "m", "centre in the plane", "1 2"}, grain.position);
  visit(FieldNotes{"radius", "m", "radius"}, grain.radius);
  visit(FieldNotes{"mass", "kg", "mass"}, grain.mass);
  visit(FieldNotes{"moment_of_inertia", "kg m2", "moment of inertia about e_3"}, grain.moment_of_inertia);
  visit(FieldNotes{"height", "m", "x3 of the centre; 0 in a plane packing"}, grain.height);
}

/// The prepared initial state of a cell: grains in a periodic box.
struct Packing {
  /// 2: a plane packing, of discs. 3: spheres in a box that is periodic in x3 too, with the height
  /// `thickness`.
  int dimension = 2;
  /// Columns are the base vectors of the periodic box, m.
  Eigen::Matrix2d box = Eigen::Matrix2d::Zero();
  /// Out-of-plane thickness, m; stresses are per this true thickness.
  double thickness = 0.0;
  /// Components along x1 and x2 of the third base vector, m; 0 in a plane packing.
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  std::vector<Grain> grains;
  /// Mean normal stress at rest when it was made, compression positive, Pa; 0: not recorded.
  double pressure = 0.0;
  /// Velocities and contact histories of a packing made with friction, as dem/ keeps them: the forces of
  /// its tangential springs belong to its equilibrium. Null: grains at rest, no tangential forces.
  StatePointer state;

  [[nodiscard]] double volume() const { return box.determinant() * thickness; }
  /// The base vectors in space as columns, m: both vectors of the plane, and the third along e_3 by the thickness, leaning.
  [[nodiscard]] Eigen::Matrix3d base_vectors() const;
  /// Sum of the volumes of the grains, m^3: of spheres in space, of discs as high as the box in a plane packing.
  [[nodiscard]] double grain_volume() const;
  /// Sum of the masses of the grains, kg.
  [[nodiscard]] double grain_mass() const;
  /// Mean radius of the grains, m.
  [[nodiscard]] double mean_radius() const;
};

template <RecordOf<Packing> Record, class Visit>
void describe(Record& packing, Visit&& visit) {
  visit(FieldNotes{"dimension", "", "2: plane; 3: spheres in a box that is periodic in x3 too"},
        packing.dimension);
  visit(FieldNotes{"box", "m", "base vectors of the periodic box as columns", "_11 _12 _21 _22"},
        packing.box);
  visit(FieldNotes{"thickness", "m", "out of plane; stresses are per this thickness"}, packing.thickness);
  visit(FieldNotes{"lean", "m", "in-plane components of the third base vector", "_1 _2"}, packing.lean);
  visit(FieldNotes{"grains", "", "the grains"}, packing.grains);
  visit(FieldNotes{"pressure", "Pa",
                   "mean normal stress at rest when it was made, compression positive; 0: not recorded"},
        packing.pressure);
  visit(FieldNotes{"state", "", "velocities and contact histories of a packing made with friction"},
        packing.state);
}

/// Reads a packing: from HDF5 when the name ends in .h5 (common/packing_file.hpp), else from CSV: a first
/// line `# cell ... xx=... xy=... yx=... yy=... z=... p=...` with the base vectors as columns (xy: x
/// component of the second vector) and the pressure (may be left out), a line of column names
/// `id,x,y,r,mass,Izz`, then one grain a line. Spheres in space have the nine components xx to zz of their
/// base vectors in the first line (yx 0 or not, zx and zy 0) and the columns `id,x,y,z,r,mass,Izz`.
/// @throws InputError naming file and line when the file is missing, a number does not parse, a radius or
/// mass is not positive, the box has no area, or two grains share an id.
Packing read_packing(const std::filesystem::path& file);

}  // namespace polargrain
