// SPDX-License-Identifier: GPL-2.0-or-later
// fix time_step/contacts: its step against what a specimen between platens bears, and its words.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "tests/integration/command.hpp"
#include "tests/support/specimen_lattice.hpp"

namespace {

using namespace polargrain::testing;

constexpr double kShare = 0.8;  // of the stable step, that is taken

/// A number that stands behind some words; NaN without them.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.rfind(words);
  return at == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                 : std::stod(text.substr(at + words.size()));
}

/// A lattice between platens of some stiffness, seated with dashpots and drag, and scripts that go on from it
/// without any.
class Seated {
 public:
  explicit Seated(const std::string& platens) : scratch_("specimen_time_step") {
    write_lattice(scratch_.path() / "lattice.data");
    std::string material = content(std::filesystem::path(SPECIMEN_INPUTS) / "material.in");
    const auto replace = [&material](const std::string& from, const std::string& to) {
      material.replace(material.find(from), from.size(), to);
    };
    replace("modulus 6e8 damping", "modulus " + platens + " damping");
    replace("fix             step      all time_step/contacts", "include step.in");
    file("material.in", material);
    file("step.in", "fix step all time_step/contacts\n");
    file("seating.in",
         head("read_data lattice.data", "0.2") +
             "fix drag all viscous 30\nrun 6000\nreset_timestep 0\nwrite_restart seated.restart\n");
    const ScriptRun run = run_liggghts_script(scratch_.path(), "seating.in", "");
    EXPECT_EQ(run.status, 0) << run.text;
  }

  /// Goes on for some steps, so slowly that nothing moves. @param step the lines that set the time step
  ScriptRun go_on(const std::string& step, int steps) {
    file("step.in", step + "\n");
    file("on.in", head("read_restart seated.restart", "0") + "fix_modify apparatus compress 1e-9\nrun " +
                      std::to_string(steps) +
                      "\nvariable unrest equal f_apparatus[9]\nprint \"unrest is ${unrest}\"\n");
    return run_liggghts_script(scratch_.path(), "on.in", "");
  }

 private:
  void file(const char* name, const std::string& text) { std::ofstream(scratch_.path() / name) << text; }
  static std::string head(const std::string& reading, const std::string& damping) {
    return "variable pressure index 1e4\nvariable friction index 0.5\nvariable rolling index 0\n"
           "variable rolling_model index off\nvariable rolling_force index off\n"
           "variable damping index " +
           damping +
           "\nunits si\ndimension 2\natom_style granular\natom_modify map array sort 0 0\n"
           "boundary f f p\nnewton off\ncommunicate single vel yes\n" +
           reading + "\ninclude material.in\n";
  }

  Scratch scratch_;
};

TEST(SpecimenTimeStep, IsTheShareOfWhereTheSpecimenBlowsUp) {
  // Platens as stiff as the grains, and stiffer by so much that the discs on them are the fastest of all.
  for (const char* platens : {"6e8", "6e9"}) {
    Seated specimen(platens);
    // Under another name than the one in the restart file: the step follows from the contacts as they are.
    const double taken =
        number_after(specimen.go_on("fix anew all time_step/contacts", 1).text, "polargrain: time step ");
    ASSERT_GT(taken, 0.0);
    // Three digits, rounded down: the stable step is up to 1 % larger.
    const auto unrest = [&](double share) {
      const ScriptRun run =
          specimen.go_on("timestep " + std::to_string(share * taken / kShare * 1e9) + "e-9", 3000);
      const double found = number_after(run.text, "unrest is ");
      return run.status == 0 ? found : std::numeric_limits<double>::infinity();  // lost grains, no membrane
    };
    const double below = unrest(0.98);
    const double above = unrest(1.03);
    std::cout << "[figure] platens of " << platens << " Pa: time step " << taken
              << " s; unbalanced after 3000 steps of 0.98 and 1.03 of the stable one " << below << ", "
              << above << "\n";
    EXPECT_LT(below, 1e-3);
    EXPECT_FALSE(above < 1e-2);
  }
}

TEST(SpecimenTimeStep, OfAScriptIsCheckedAgainstTheContacts) {
  Seated specimen("6e8");
  const auto with = [&](const std::string& step) {
    return specimen.go_on(step + "\nfix step all time_step/contacts", 1);
  };
  const ScriptRun far = with("timestep 1e-4");
  EXPECT_NE(far.status, 0);
  EXPECT_NE(
      far.text.find("The time step of the script, 0.0001 s, is unstable for these grains and contacts: the "
                    "largest stable one is "),
      std::string::npos)
      << far.text;
  const ScriptRun small = with("timestep 1e-6");
  EXPECT_EQ(small.status, 0);
  EXPECT_NE(small.text.find("times as many DEM steps as are needed: leave the line 'timestep' out"),
            std::string::npos)
      << small.text;
  EXPECT_NE(small.text.find("polargrain: time step 1e-06 s"), std::string::npos) << small.text;
}

TEST(SpecimenTimeStep, SaysWhatItNeeds) {
  Seated specimen("6e8");
  EXPECT_NE(specimen.go_on("fix anew all time_step/contacts often 3", 1)
                .text.find("expected 'fix ID all time_step/contacts', with 'every N' or without"),
            std::string::npos);
  const std::string wall =
      "fix floor all wall/gran model hooke/radii tangential history primitive type 1 yplane -1";
  EXPECT_NE(
      specimen.go_on(wall + "\nfix anew all time_step/contacts", 1)
          .text.find("does not know how stiff the walls of fix wall/gran are: give a 'timestep' instead"),
      std::string::npos);
}

}  // namespace
