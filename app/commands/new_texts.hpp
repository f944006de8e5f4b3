// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::app {

/// The values that the texts of a new case are filled with.
struct NewCase {
  std::string scheme = "cell";  ///< model of the material: cell, adaptive or informed
  int grains = 400;
  double pressure = 100e3;  ///< of the packing and around the body, Pa, positive in compression
  double width = 0.4;       ///< of the specimen, m
  double height = 0.8;      ///< of the specimen, m
  int columns = 5;          ///< elements along the width
  int rows = 10;            ///< elements along the height, in space 8 points each
  bool rolling = false;     ///< whether contacts resist rolling
  bool spheres = false;     ///< in space, in the place of discs
};

/// Text of the specification of the packing, for `polargrain pack`; its script is cell.in beside it.
std::string packing_text(const NewCase& what);
/// Text of a case of biaxial compression between rough plates.
std::string biaxial_text(const NewCase& what);
/// Text of a case of a footing on grains; its mesh is footing.msh beside it.
std::string footing_text(const NewCase& what);
/// Text of a case of triaxial compression of a square column in space, between rough plates.
std::string triaxial_in_space_text(const NewCase& what);
/// Text of a case of a square footing on grains in space, of which a quarter is computed.
std::string footing_in_space_text(const NewCase& what);
/// The case of a quay wall, with boxes of grains behind the wall. @param of_law its text with the same law everywhere
std::string quay_on_grains_text(const NewCase& what, std::string of_law);
/// Text of a specification of an element test of the packing.
std::string element_text(const NewCase& what);
/// Text of a case on a mesh of the user's own: the lowest boundary is held, all others carry the pressure of the
/// packing, which rises on the highest one. @param file name of the mesh, beside the case
/// @throws InputError when the mesh has no named boundary
std::string mesh_text(const NewCase& what, const fem::Mesh<2>& mesh, const std::string& file);

}  // namespace polargrain::app
