// SPDX-License-Identifier: GPL-2.0-or-later
// A run to start from that has not come to its end, or that is of another continuum, of other contacts or of a larger body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/status_of_run.hpp"

namespace polargrain::app {
namespace {

void add(const Scene& scene, double weight, const std::string& finding, const std::string& remedy,
         Remarks& remarks) {
  remarks.push_back(
      {Rank::doubtful, weight, scene.place({"start_from"}).fault("start_from: " + finding), remedy});
}

void compare_continua(const Scene& scene, const coupler::RunBefore& before, Remarks& remarks) {
  const bool was_classical = before.continuum == fem::Continuum::cauchy;
  if (was_classical == scene.is_classical()) return;
  add(scene, 1.0,
      was_classical
          ? fmt::format(
                "'{}' is of the classical continuum, and this case has micro-rotations: they begin at 0 rad, "
                "with couple stresses of 0 N/m, whatever has turned there",
                before.name)
          : fmt::format(
                "'{}' has micro-rotations and couple stresses, and this case is of the classical continuum: "
                "they are lost, and the first step starts with what they leave out of balance",
                before.name),
      fmt::format("give both runs one 'continuum': '{}' has {}", before.name,
                  was_classical ? "cauchy" : "cosserat"),
      remarks);
}

/// Ground that is cut off has carried some of the loads.
void compare_bodies(const Scene& scene, const coupler::RunBefore& before, Remarks& remarks) {
  if (before.least.empty()) return;
  constexpr double kSlack = 1e-3;
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i) {
      double least = HUGE_VAL;
      double largest = -HUGE_VAL;
      for (const auto& node : problem.mesh.nodes) {
        least = std::min(least, node(static_cast<Eigen::Index>(i)));
        largest = std::max(largest, node(static_cast<Eigen::Index>(i)));
      }
      const double there = before.largest[i] - before.least[i];
      if (!(largest - least < (1.0 - kSlack) * there)) continue;
      add(scene, there / (largest - least),
          fmt::format(
              "the body in '{}' measures {:.4g} m along {}, this one {:.4g} m: the ground that is left out has carried "
              "something, which is let go at once",
              before.name, there, i + 1, largest - least),
          "keep that body, and remove ground in a stage: {name: cut, remove: REGION, count: 5}", remarks);
      return;
    }
  });
}

void compare_scripts(const Scene& scene, const coupler::RunBefore& before, Remarks& remarks) {
  for (const std::string& region : before.other_scripts)
    add(scene, 1.0,
        fmt::format(
            "the contact script of region '{}' is another one than in '{}': grains go on from where other contacts "
            "had left them",
            region, before.name),
        "name the script of that run; where contacts are meant to change, keep its contact model", remarks);
}

/// How grains came to be is kept by the run in which they did.
void look_at_grains(const Scene& scene, Remarks& remarks) {
  if (scene.the_case().output_grains.empty()) return;
  remarks.push_back(
      {Rank::doubtful, 1.0,
       scene.place({"output", "grains"})
           .fault(
               "output: no grains are shown in a run with 'start_from': how they came to be stands in the run "
               "before alone"),
       "leave 'grains' out, or run both parts in one case, in stages"});
}

}  // namespace

void end_of_run_before(const Scene& scene, Remarks& remarks) {
  const std::filesystem::path& directory = scene.the_case().start_from;
  if (directory.empty()) return;
  if (scene.the_case().run_before) {
    compare_continua(scene, *scene.the_case().run_before, remarks);
    compare_bodies(scene, *scene.the_case().run_before, remarks);
    compare_scripts(scene, *scene.the_case().run_before, remarks);
  }
  look_at_grains(scene, remarks);
  const std::string status = status_of_run(directory);
  if (status == "done") return;
  remarks.push_back(
      {Rank::doubtful, 1.0,
       scene.place({"start_from"})
           .fault(fmt::format("start_from: the run in '{}' has not come to its end{}: this one starts "
                              "from its last checkpoint, where its loads may be others",
                              directory.filename().string(),
                              status.empty() ? "" : fmt::format(" (status '{}')", status))),
       "go on with that run (--resume), or see in run.log below 'starting from' which step this is"});
}

}  // namespace polargrain::app
