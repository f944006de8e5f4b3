// SPDX-License-Identifier: GPL-2.0-or-later
// Files and their names: links, devices, rows of names, the proof of a summary.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <limits>

#include "app/commands/csv_file.hpp"
#include "app/run/proof.hpp"
#include "common/content_hash.hpp"
#include "common/csv_table.hpp"
#include "common/regular_file.hpp"
#include "common/write_file.hpp"
#include "tests/integration/command.hpp"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class WrittenFiles : public ::testing::Test {
 protected:
  WrittenFiles() : scratch_("written") {}
  [[nodiscard]] fs::path at(const std::string& name) const { return scratch_.path() / name; }
  [[nodiscard]] std::string refusal(const fs::path& file) const {
    try {
      write_file(file, "new");
    } catch (const RunError& error) {
      return error.what();
    }
    return "none";
  }
  testing::Scratch scratch_;
};

TEST_F(WrittenFiles, ALinkStaysAndWhatItLeadsToIsReplaced) {
  fs::create_directory(at("far"));
  testing::write(at("far/file"), "old");
  fs::create_symlink("far/file", at("link"));
  fs::create_symlink(at("link"), at("second"));
  fs::create_symlink("far/nothing", at("dangling"));
  fs::create_hard_link(at("far/file"), at("kept"));
  write_file(at("second"), "new");
  EXPECT_TRUE(fs::is_symlink(at("link")) && fs::is_symlink(at("second")));
  EXPECT_EQ(testing::content(at("far/file")), "new");
  EXPECT_EQ(testing::content(at("kept")), "old") << "the file was replaced, not written over";
  write_file(at("dangling"), "new");
  EXPECT_EQ(testing::content(at("far/nothing")), "new");
  // With the former one kept beside it, as checkpoints are.
  write_file(at("link"), "newer", Durability::system, at("before"));
  EXPECT_EQ(testing::content(at("before")), "new");
  EXPECT_EQ(testing::content(at("link")), "newer");
}

TEST_F(WrittenFiles, NothingIsWaitedForNorReplaced) {
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_symlink("circle", at("circle"));
  fs::create_directory(at("folder"));
  fs::create_directory(at("folder/sub"));
  EXPECT_NE(refusal(at("pipe")).find("cannot be written"), std::string::npos);
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  EXPECT_NE(refusal(at("circle")).find("Too many levels"), std::string::npos);
  EXPECT_NE(refusal(at("folder")).find("cannot be put in place"), std::string::npos);
  // By links: should this fail, no device of the machine is lost.
  fs::create_symlink("/dev/full", at("full"));
  fs::create_symlink("/dev/null", at("null"));
  EXPECT_NE(refusal(at("full")).find("No space left"), std::string::npos);
  EXPECT_NE(refusal(at(std::string("x\0y", 3))), "none") << "a name with a NUL";
  write_file(at("null"), "new");
  EXPECT_TRUE(fs::is_character_file(at("null")) && fs::is_character_file(at("full")));
  // A link that somebody has put where the file is made.
  fs::create_symlink("victim", at("file.part"));
  testing::write(at("victim"), "old");
  EXPECT_NE(refusal(at("file")), "none");
  EXPECT_EQ(testing::content(at("victim")), "old");
}

TEST_F(WrittenFiles, InputsAreFiles) {
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_symlink("circle", at("circle"));
  testing::write(at("file"), "text");
  fs::create_symlink("file", at("link"));
  EXPECT_EQ(why_no_input(at("file")) + why_no_input(at("link")), "");
  EXPECT_EQ(why_no_input(at("nothing")), "there is no such file");
  EXPECT_EQ(why_no_input(at("file/below")), "there is no such file");
  for (const fs::path& file : {at("pipe"), fs::path("/dev/zero"), fs::path("/dev/null")})
    EXPECT_NE(why_no_input(file).find("is a pipe or a device"), std::string::npos) << file;
  EXPECT_NE(why_no_input(at("")).find("is a directory"), std::string::npos);
  EXPECT_NE(why_no_input(at("circle")).find("Too many levels"), std::string::npos);
  EXPECT_NE(why_no_input(at(std::string(300, 'x'))).find("too long"), std::string::npos);
  EXPECT_NE(why_no_input(at(std::string("file\0x", 6))).find("NUL"), std::string::npos);
}

TEST_F(WrittenFiles, RowsComeBackAsTheyWere) {
  const std::vector<std::string> names{"plain",   "a,b",        "say \"no\"", "# x", " blank", "blank ",
                                       "tab\tin", "\"quoted\"", "=1+1",       "",    "ü"};
  testing::write(at("table.csv"), app::csv_row(names) + app::csv_row(names));
  const CsvTable table(at("table.csv"));
  EXPECT_EQ(table.names(), names);
  ASSERT_EQ(table.rows(), 1U);
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(table.cell(0, k), names[k]);
  EXPECT_EQ(app::csv_row({"two\nlines\r"}), "\"two lines \"\n");
}

TEST_F(WrittenFiles, WhatIsNoNumberHasOneName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(app::exact(nan), "nan");
  EXPECT_EQ(app::exact(std::copysign(nan, -1.0)), "nan");
  testing::write(at("table.csv"), "a,b\nnan,1\n-inf,2\n1e3,x\n");
  const CsvTable table(at("table.csv"));
  EXPECT_TRUE(std::isnan(table.figure(0, 0)));
  EXPECT_EQ(table.figure(1, 0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.figure(2, 0), 1000.0);
  EXPECT_THROW((void)table.number(0, 0), InputError);
  EXPECT_THROW((void)table.figure(2, 1), InputError);
}

TEST_F(WrittenFiles, AFileHasTheNameOfItsBytes) {
  std::string bytes;
  for (std::size_t k = 0; k < 3'000'001; ++k) bytes += static_cast<char>(k * k >> 3);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20, bytes.size()}) {
    testing::write(at("file"), bytes.substr(0, size));
    EXPECT_EQ(content_hash(at("file")), name_of(std::as_bytes(std::span(bytes).first(size)))) << size;
  }
  EXPECT_THROW((void)content_hash(at("nothing")), RunError);
}

// ---- the proof of a summary

Json a_summary() {
  return Json::parse(R"({"title": "A run", "status": "done", "steps": 3, "empty": {}, "list": [1, 2.5, null],
    "values": {"force": -0.0, "ratio": 1.7976931348623157e308, "small": 5e-324},
    "proof": {"files": {"script": "00ff"}, "settings": ["a=1"], "summary": "old"}})");
}

/// Every value that stands somewhere in it, by its place.
std::vector<Json::json_pointer> places_in(const Json& value,
                                          const Json::json_pointer& here = Json::json_pointer()) {
  std::vector<Json::json_pointer> places;
  if (!value.is_structured() || value.empty()) return {here};
  const auto add = [&](const Json& part, const Json::json_pointer& place) {
    for (const auto& found : places_in(part, place)) places.push_back(found);
  };
  if (value.is_object())
    for (const auto& [key, part] : value.items()) add(part, here / key);
  else
    for (std::size_t k = 0; k < value.size(); ++k) add(value[k], here / k);
  places.push_back(here);
  return places;
}

TEST(ProofOfASummary, HoldsEveryValueButItself) {
  const Json summary = a_summary();
  const std::string name = app::name_of_summary(summary);
  EXPECT_EQ(name.size(), 32U);
  std::size_t changed = 0;
  for (const Json::json_pointer& place : places_in(summary)) {
    if (place.empty()) continue;
    for (const Json& other : {Json("other"), Json(nullptr), Json(4), Json::object({{"k", 1}})}) {
      Json tried = summary;
      if (tried[place] == other) continue;
      tried[place] = other;
      if (place.to_string() == "/proof/summary") {
        EXPECT_EQ(app::name_of_summary(tried), name);
      } else {
        EXPECT_NE(app::name_of_summary(tried), name) << place << ' ' << other;
        ++changed;
      }
    }
  }
  EXPECT_GT(changed, 50U);
}

TEST(ProofOfASummary, DoesNotDependOnHowItIsWritten) {
  const Json summary = a_summary();
  const Json sorted = Json::parse(nlohmann::json::parse(summary.dump()).dump());
  EXPECT_NE(sorted.dump(), summary.dump());
  EXPECT_EQ(app::name_of_summary(sorted), app::name_of_summary(summary));
  EXPECT_EQ(app::name_of_summary(Json::parse(summary.dump(8))), app::name_of_summary(summary));
  // A name that no file can have stands as the file has it.
  Json odd = summary;
  odd["value"] = std::numeric_limits<double>::quiet_NaN();
  odd["name"] = "\xff";
  const std::string written = odd.dump(2, ' ', false, Json::error_handler_t::replace);
  EXPECT_EQ(app::name_of_summary(Json::parse(written)), app::name_of_summary(odd));
}

}  // namespace
}  // namespace polargrain
