// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "band/sample.hpp"

namespace polargrain::band {

/// What is known of every place of a body at one time.
struct Frame {
  std::vector<Eigen::Vector2d>
      positions;  ///< of grains: where they are; of elements: of their points, undeformed, m
  std::vector<Eigen::Vector2d> displacements;  ///< of elements, since the start, m; of grains empty
  std::vector<Eigen::Matrix2d> strains;  ///< of elements, displacement gradient or strain; of grains empty
  std::vector<double> areas;             ///< of elements, m^2; of grains empty
  std::vector<double> rotations;         ///< since the start, rad
};

/// A LIGGGHTS dump with the columns id, x, y and f_turned (others are skipped), grains in the order of their
/// ids.
/// @throws InputError naming file and line
Frame read_grain_dump(const std::filesystem::path& file);

/// A field file of `polargrain run`: the 2 x 2 integration points of each quadrilateral (a triangle counts as
/// one point), displacement gradients from the nodes, micro-rotation.
/// @throws InputError naming the file when it is another kind of .vtu
Frame read_element_fields(const std::filesystem::path& file);

/// The frames of a result directory, of `polargrain run` (fields/step-*.vtu) or of a specimen made of grains
/// (grains/step-*.dump).
class Frames {
 public:
  /// @param strain_column column of history.csv with the axial strain (compression positive)
  /// @throws InputError when the folder has no frames, or history.csv no row for one of them
  Frames(const std::filesystem::path& directory, const std::string& strain_column);

  /// Axial strain of each frame, in the order of their steps.
  [[nodiscard]] const std::vector<double>& axial_strains() const { return axial_strains_; }
  /// The frame nearest to an axial strain.
  [[nodiscard]] std::size_t nearest(double axial_strain) const;
  /// What happened between two frames. Places stand where they were at the start of the test.
  /// @param current stand where they are at frame `from` instead
  [[nodiscard]] Samples increment(std::size_t from, std::size_t to, bool current) const;
  [[nodiscard]] bool of_grains() const { return of_grains_; }

 private:
  [[nodiscard]] Frame read(std::size_t index) const;
  [[nodiscard]] Samples grains(const Frame& first, const Frame& from, const Frame& to, bool current) const;

  std::vector<std::filesystem::path> files_;
  std::vector<double> axial_strains_;
  bool of_grains_ = false;
};

}  // namespace polargrain::band
