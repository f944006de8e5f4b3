// SPDX-License-Identifier: GPL-2.0-or-later
// The error of carrying an answer of a cell along its tangent (docs/adaptivity.md, 2): the demonstration's
// packing along a biaxial path in increments of 1e-3, and from several places on it the cell run over an
// offset against the answer that is carried there; how the settings of the cell change that; and the scatter
// of its answers. Shares of the confining pressure.
//
//   build/release/bench/carry_bench > carry.log      from the root of the project; the table goes to standard
//   error
//   build/release/bench/carry_bench SCRIPT PACKING.h5 ... > carry.log     of these packings, discs or spheres, how much
//                                                                         less a volume change is missed than shear
#include <fmt/format.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "bench/driven_cell.hpp"
#include "common/packing_file.hpp"
#include "coupler/adaptivity/error_estimate.hpp"
#include "coupler/adaptivity/grain_measure.hpp"
#include "coupler/cells/linearised.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain {
namespace {

constexpr double kPressure = 1e5;  ///< Pa, of the packing
constexpr double kIncrement = 1e-3;

/// @returns the error of the carried answer, a share of the pressure
double missed(DrivenCell& cell, const DrivenCell::Vector& offset) {
  const Vector7 carried =
      coupler::linearised_stress(cell.at().response, coupler::increment_of<2>(DrivenCell::gradient(offset)));
  return coupler::GrainMeasure<2>().stress(cell.answer(offset).response.stress - carried) / kPressure;
}

const DrivenCell::Vector kShear(0.0, 0.0, 1.0 / std::sqrt(2.0));  // of norm 1, as those that follow
const DrivenCell::Vector kDeviatoric = DrivenCell::Vector(1.0, -1.0, 0.0) / std::sqrt(2.0);
const DrivenCell::Vector kCompression = DrivenCell::Vector(-1.0, -1.0, 0.0) / std::sqrt(2.0);

/// The direction that leaves the lateral stresses as they are, of norm 1.
DrivenCell::Vector onward(const DrivenCell& cell) {
  DrivenCell::Matrix matrix = DrivenCell::tangent(cell.at().response);
  matrix.row(1) << 0.0, 1.0, 0.0;
  return matrix.partialPivLu().solve(DrivenCell::Vector(0.0, -1.0, 0.0)).normalized();
}

bool take_increment(DrivenCell& cell) {
  return cell.go({-kPressure, -kIncrement, 0.0}, {true, false, true}, {5e-3 * kPressure});
}

std::string table() {
  DrivenCell cell(test::demo_cell());
  std::string text =
      fmt::format("{:>10} {:>8} {:>8} {:>9} {:>9} {:>10} {:>10} {:>8}\n", "increments", "5e-4 on", "1e-3 on",
                  "5e-4 back", "1e-3 back", "shear 5e-4", "shear 1e-3", "zero");
  for (int done = 0; done <= 16; ++done) {
    if (done == 0 || done == 2 || done == 4 || done == 8 || done == 16) {
      const DrivenCell::Vector on = onward(cell);
      text += fmt::format("{:>10} {:>8.4f} {:>8.4f} {:>9.4f} {:>9.4f} {:>10.4f} {:>10.4f} {:>8.5f}\n", done,
                          missed(cell, 5e-4 * on), missed(cell, 1e-3 * on), missed(cell, -5e-4 * on),
                          missed(cell, -1e-3 * on), missed(cell, 5e-4 * kShear), missed(cell, 1e-3 * kShear),
                          missed(cell, 1e-12 * on));
    }
    if (!take_increment(cell)) return text + fmt::format("no balance behind increment {}\n", done);
  }
  return text;
}

/// How much less an isotropic compression is missed than a shear of the same size, at rest.
std::string volume() {
  DrivenCell cell(test::demo_cell());
  return fmt::format("at rest, strains of norm 1e-3: compression {:.4f}, deviatoric {:.4f}, shear {:.4f}\n",
                     missed(cell, 1e-3 * kCompression), missed(cell, 1e-3 * kDeviatoric),
                     missed(cell, 1e-3 * kShear));
}

/// The same of packings given, at rest and behind increments of axial strain, offsets of the size of an increment: the
/// error, the estimate's second term for it, and the weight of a volume change that follows where errors grow with the square of an offset
/// (GrainMeasure<2>::size). An increment is the shear strain whose elastic stress is a fifth of the pressure.
std::string volume_of(const std::string& script, const std::vector<std::string>& packings) {
  constexpr double kElasticStress = 0.2;
  std::string text = fmt::format("{:>20} {:>9} {:>10} {:>15} {:>15} {:>15} {:>7}\n", "packing", "increment",
                                 "increments", "compression", "deviatoric", "shear", "weight");
  for (const std::string& file : packings) {
    CellDefinition definition;
    definition.name = "sand";
    definition.script_file = script;
    definition.script = test::file_text(script);
    definition.packing = read_packing_file(file).packing;
    DrivenCell cell(definition);
    const Matrix7 elastic = cell.at().response.tangent;
    const double size =
        kElasticStress * kPressure / (DrivenCell::tangent(cell.at().response) * kShear).norm();
    const coupler::ErrorEstimate<2> estimate(coupler::GrainMeasure<2>(), elastic, 0.0);
    coupler::Departure<2> turned;
    turned.length = 1.0;
    const auto both = [&](const DrivenCell::Vector& direction) {
      const Increment<2> offset = coupler::increment_of<2>(DrivenCell::gradient(size * direction));
      return fmt::format("{:.4f} ({:.4f})", missed(cell, size * direction),
                         estimate.of(cell.at().response, turned, offset) / kPressure);
    };
    for (int done = 0; done <= 8; ++done) {
      if (done == 0 || done == 2 || done == 8) {
        const double sheared = missed(cell, size * kDeviatoric) + missed(cell, size * kShear);
        text += fmt::format("{:>20} {:>9.2g} {:>10} {:>15} {:>15} {:>15} {:>7.2f}\n", file, size, done,
                            both(kCompression), both(kDeviatoric), both(kShear),
                            std::sqrt(2.0 * missed(cell, size * kCompression) / sheared));
      }
      const DrivenCell::Vector on = onward(cell);
      if (!cell.go({-kPressure, -size, 0.0}, {true, false, true}, {5e-3 * kPressure})) {
        text += fmt::format("{:>20} no balance behind increment {}\n", file, done);
        break;
      }
      turned.direction =
          coupler::GrainMeasure<2>().strain(coupler::increment_of<2>(DrivenCell::gradient(on)));
    }
  }
  return text;
}

/// How the settings of a cell change what its tangent knows: the share of sliding contacts that it takes into
/// account.
std::string settings() {
  std::string text = fmt::format("{:>9} {:>8} {:>10} {:>8} {:>8} {:>8} {:>12}\n", "inertial", "damping",
                                 "tolerance", "sliding", "1e-3 on", "zero", "evaluations");
  for (const auto& [inertial_number, damping, tolerance] : {std::array{2.4e-3, 0.24, 5e-3},
                                                            {6e-4, 0.5, 5e-3},
                                                            {6e-4, 0.24, 5e-3},
                                                            {6e-4, 0.12, 5e-3},
                                                            {6e-4, 0.12, 1e-3},
                                                            {6e-4, 0.06, 5e-3},
                                                            {2e-4, 0.12, 5e-3},
                                                            {1e-4, 0.12, 1e-4}}) {
    CellDefinition definition = test::demo_cell();
    definition.control.inertial_number = inertial_number;
    definition.control.damping = damping;
    definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = tolerance;
    DrivenCell cell(definition);
    constexpr int kIncrements = 16;
    double sliding = 0.0;
    double on = 0.0;
    double zero = 0.0;
    int evaluations = 0;
    for (int k = 0; k < kIncrements; ++k) {
      const int before = cell.evaluations();
      if (!take_increment(cell)) text += fmt::format("no balance in increment {}\n", k);
      evaluations += cell.evaluations() - before;
      sliding += cell.at().diagnostics.sliding_fraction / kIncrements;
      on += missed(cell, 1e-3 * onward(cell)) / kIncrements;
      zero += missed(cell, DrivenCell::Vector::Constant(1e-13)) / kIncrements;
    }
    text +=
        fmt::format("{:>9.1e} {:>8} {:>10.0e} {:>8.3f} {:>8.4f} {:>8.5f} {:>12.2f}\n", inertial_number,
                    damping, tolerance, sliding, on, zero, static_cast<double>(evaluations) / kIncrements);
  }
  return text;
}

/// The scatter of a cell's answers: 30 increments from one state, which differ from 1e-3 onward by up to
/// `spread` of that in each component, about the plane through them that fits best. Standard deviations.
std::string scatter(double spread) {
  DrivenCell cell(test::demo_cell());
  for (int k = 0; k < 16; ++k)
    if (!take_increment(cell)) return "no balance\n";
  constexpr int kSamples = 30;
  const DrivenCell::Vector on = kIncrement * onward(cell);
  Eigen::Matrix<double, kSamples, 4> strains;
  Eigen::Matrix<double, kSamples, 3> stresses;
  std::mt19937 random(1);  // its numbers are the same everywhere
  const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
  for (int k = 0; k < kSamples; ++k) {
    const DrivenCell::Vector strain =
        on + spread * kIncrement * DrivenCell::Vector(uniform(), uniform(), uniform());
    strains.row(k) << 1.0, strain.transpose() / kIncrement;
    stresses.row(k) = DrivenCell::stress(cell.answer(strain).response).transpose() / kPressure;
  }
  const Eigen::Matrix<double, 4, 3> plane = strains.colPivHouseholderQr().solve(stresses);
  const Eigen::Matrix<double, kSamples, 3> off = stresses - strains * plane;
  const DrivenCell::Vector deviation =
      (off.colwise().squaredNorm() / (kSamples - 4.0)).cwiseSqrt().transpose();
  return fmt::format(
      "scatter of increments that differ by up to {:.0f} %: s11 {:.1e}, s22 {:.1e}, s12 {:.1e}\n",
      100.0 * spread, deviation(0), deviation(1), deviation(2));
}

}  // namespace
}  // namespace polargrain

int main(int count, char** arguments) {
  polargrain::dem::start_engine_process();
  if (count > 1) {
    std::fputs(polargrain::volume_of(arguments[1], {arguments + 2, arguments + count}).c_str(), stderr);
    return 0;
  }
  const std::string text = polargrain::table() + polargrain::volume() + "\n" + polargrain::settings() + "\n" +
                           polargrain::scatter(0.05) + polargrain::scatter(0.5);
  std::fputs(text.c_str(), stderr);  // the engine talks on standard output
}
