// SPDX-License-Identifier: GPL-2.0-or-later
// Which commands of an input script a cell may use. How the engine reads a line is that of LIGGGHTS 3.8 (Input::parse,
// Input::substitute, Input::nextword).
#include "grains_io/script.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace polargrain {
namespace {

/// Lines of the faults of a script, "2 5".
std::string lines_at_fault(const std::string& text, const ScriptRules& rules = {}) {
  std::string lines;
  for (const Fault& fault : script_faults(text, "cell.in", rules)) {
    EXPECT_EQ(fault.file, "cell.in");
    lines += (lines.empty() ? "" : " ") + std::to_string(fault.line);
  }
  return lines;
}

std::string alone(const std::string& command) {
  return lines_at_fault("units si\n" + command + "\nnewton off\n");
}

TEST(script, what_a_contact_law_needs_is_allowed) {
  for (const char* const command :
       {"read_data ${packing}", "fix m all property/global contactModulus peratomtypepair 1 ${modulus}",
        "fix integrate all nve/sphere", "pair_style gran model hooke/radii tangential history",
        "pair_coeff * *", "variable friction index 0.5", "variable rest equal 0.01-PI*1e-4",
        "variable packing index packing.data", "region all block -1 1 -1 1 -1 1 units box",
        "group second id 2", "print \"a text # with ${friction}\" screen yes",
        "if \"${friction} > 0\" then \"variable mu index 1\" else \"print 2\"",
        "thermo_style custom step atoms", "fix c all property/global x scalar 1 # shell touch x",
        "timestep 1e-5", "# shell touch x", ""}) {
    EXPECT_EQ(alone(command), "") << command;
  }
}

TEST(script, what_can_do_more_is_found) {
  for (const char* const command : {"shell touch x",
                                    "  shell touch x",
                                    "\tshell touch x",
                                    "\vshell touch x",
                                    "\"shell\" touch x",
                                    "'shell' touch x",
                                    "log x",
                                    "dump 1 all custom 1 x id",
                                    "write_restart x",
                                    "write_data x",
                                    "write_dump all custom x id",
                                    "restart 1 x",
                                    "jump x",
                                    "label x",
                                    "next x",
                                    "include x",
                                    "read_data x",
                                    "read_data ${packing} add",
                                    "read_data ${data}",
                                    "read_restart x",
                                    "read_dump x",
                                    "run 1 every 1 \"shell touch x\"",
                                    "quit",
                                    "clear",
                                    "partition yes 1 shell touch x",
                                    "print \"x\" file x",
                                    "print \"x\" append x",
                                    "print \"x\" screen ${x}",
                                    "print ${x}",
                                    "variable x getenv HOME",
                                    "variable x file x",
                                    "variable x python f",
                                    "variable x system ls",
                                    "variable x atomfile x",
                                    "variable x uloop 2",
                                    "variable x universe a b",
                                    "variable packing string x",
                                    "fix p all print 1 hello file x",
                                    "fix a all ave/time 1 1 1 c_x file x",
                                    "fix m all mesh/surface file x type 1",
                                    "fix_modify m file x",
                                    "region r mesh/tet file x",
                                    "pair_style table linear 10",
                                    "processors * * * file x",
                                    "compute c all ke",
                                    "thermo_log x",
                                    "suffix x"}) {
    EXPECT_EQ(alone(command), "2") << command;
  }
}

TEST(script, what_hides_is_found) {
  // The line of a command is its last one, as in the engine's messages.
  EXPECT_EQ(alone("she&\nll touch x"), "3");
  EXPECT_EQ(alone("fix p all &\n  print 1 hello file x"), "3");
  for (const char* const command :
       {"${x} touch x", "$x touch x", "sh${x} touch x", "$(1) touch x", "\"${x}\" touch x",
        "if \"1 == 1\" then \"shell touch x\"", "if \"0 == 1\" then \"print 1\" else \"shell touch x\"",
        "if \"0 == 1\" then \"print 1\" elif \"1 == 1\" \"shell touch x\"",
        "if 1 then \"print 1\" \"shell touch x\"", "if 1 then \"${x} touch x\"", "if ${x} then \"print 1\"",
        "if 1 then ${x}",
        // One value may be several words: what stands behind it is then something else.
        "fix ${x} all nve/sphere", "fix a ${x} nve/sphere", "fix a all ${x}", "variable ${x} index 1",
        "variable a ${x} 1", "region ${x} block 0 1 0 1 0 1", "pair_style ${x}",
        // Comments and quotation marks that the engine ends elsewhere than they seem to end.
        "print \"it's\" # 'screen yes", "print 'a\" # file x", "print a\"b # c\" file x", "print \"open",
        "print \"a\"file x", "if 1 then \"print 'x' file x\""}) {
    EXPECT_EQ(alone(command), "2") << command;
  }
}

TEST(script, faults_name_what_is_known_and_repeat_nothing_else) {
  const std::vector<Fault> known = script_faults("units si\nshell touch x\n", "cell.in", {});
  ASSERT_EQ(known.size(), 1u);
  EXPECT_EQ(known.front().text(),
            "cell.in:2: the command 'shell' is not among those that set up a cell; remove it, or give "
            "--trust-scripts if you have read this script");
  const std::string secret = "root:$6$secret:19000:0:99999:7:::\nunits secret\nsecret words\n";
  for (const bool trusted : {false, true}) {
    for (const Fault& fault : script_faults(secret, "shadow", {trusted, {}})) {
      EXPECT_EQ(fault.text().find("secret"), std::string::npos) << fault.text();
    }
  }
  EXPECT_EQ(script_faults("root:$6$secret:19000\nmore\n", "shadow", {true, {}}).front().text(),
            "shadow: this is not a LIGGGHTS input script: it holds no command of LIGGGHTS");
  EXPECT_EQ(script_faults(std::string("units si\n\0", 10), "binary", {true, {}}).size(), 1u);
}

TEST(script, trust_and_the_engine_at_hand_allow_more) {
  EXPECT_EQ(lines_at_fault("units si\nshell touch x\n${x}\n", {true, {}}), "");
  EXPECT_EQ(lines_at_fault("young 5\nshell touch x\n", {false, {"young"}}), "2");
}

TEST(script, marks_say_where_lines_come_from) {
  const auto commands =
      commands_of_script("units si\n#@ part.in:1\nfix a &\n all b\n#@ cell.in:3\nshell x\n", "cell.in");
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(commands[1].file, "part.in");
  EXPECT_EQ(commands[1].line, 2);
  EXPECT_EQ(commands[1].text, "fix a  all b");
  EXPECT_EQ(commands[2].file, "cell.in");
  EXPECT_EQ(commands[2].line, 3);
}

TEST(script, those_of_this_project_need_no_trust) {
  int scripts = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(POLARGRAIN_SOURCE_DIRECTORY "/liggghts_inputs/cells")) {
    if (entry.path().extension() != ".in") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const Fault& fault : script_faults(text, entry.path().string(), {})) ADD_FAILURE() << fault.text();
    ++scripts;
  }
  EXPECT_GE(scripts, 4);
}

}  // namespace
}  // namespace polargrain
