// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain report: the page is taken apart, and its numbers are held against the files of the run.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/faults/killer.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

using Json = nlohmann::json;

class ReportTest : public ::testing::Test {
 protected:
  ReportTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(directory() / "case.yaml",
          "title: Compression of <rock>\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}\n"
          "materials: {rock: {model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm}}\n"
          "regions: {all: rock}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u2]}\n"
          "  - {on: bottom_left, fix: [u1]}\n"
          "  - {on: top, move: {u2: -8 mm}}\n"
          "steps: {count: 5, tolerance: 1e-10}\n"
          "monitors:\n"
          "  top_force: {on: top, reaction: u2}\n"
          "  shortening: {on: top, displacement: u2}\n"
          "  axial_strain: -shortening / 0.8 m\n"
          "output: {every: 2}\n");
    const Outcome outcome = polargrain("run case.yaml -o out --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string page(const std::string& file = "out/report.html") const {
    const Outcome check =
        run_in(directory(), "/usr/bin/python3 " HTML_CHECK " '" + (directory() / file).string() + "'");
    EXPECT_EQ(check.status, 0) << check.out << check.errors;
    return content(directory() / file);
  }
  /// The data of all charts and pictures of a page.
  static std::vector<Json> data_of(const std::string& page) {
    const std::string begin = "<script type='application/json'>";
    std::vector<Json> all;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
      at += begin.size();
      all.push_back(Json::parse(page.substr(at, page.find("</script>", at) - at)));
    }
    return all;
  }
  /// The chart of y against x.
  static Json chart_of(const std::string& page, const std::string& x, const std::string& y) {
    for (const Json& data : data_of(page))
      if (data.contains("series") && data["x"]["title"] == x && data["y"]["title"] == y) return data;
    ADD_FAILURE() << "there is no chart of " << y << " against " << x;
    return {};
  }
  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  Scratch scratch_;
};

// Plane strain, sides free: e22 = -0.01 and e11 = nu / (1 - nu) 0.01, so that s22 = -E / (1 - nu^2) 0.01.
TEST_F(ReportTest, ShowsTheNumbersOfTheRun) {
  const Outcome outcome = polargrain("report out");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(outcome.out, "out/report.html\n");
  const std::string text = page();
  EXPECT_NE(text.find("<h1>Compression of &lt;rock&gt;</h1>"), std::string::npos);
  EXPECT_EQ(text.find("http-equiv"), std::string::npos);

  const Json force = chart_of(text, "axial_strain", "top_force")["series"][0]["points"];
  ASSERT_EQ(force.size(), 6U);
  EXPECT_NEAR(force[5][0].get<double>(), 0.01, 1e-15);
  // In balance to 1e-10 of the force.
  EXPECT_NEAR(force[5][1].get<double>(), -0.4 * 100e6 / (1.0 - 0.0625) * 0.01, 1e-4);
  EXPECT_EQ(chart_of(text, "axial_strain", "top_force")["y"]["unit"], "N/m");
  EXPECT_EQ(chart_of(text, "axial_strain", "shortening")["y"]["unit"], "m");
  EXPECT_EQ(text.find("further curves"), std::string::npos)
      << "the case has no table: no curve is folded away";
  const Json iterations = chart_of(text, "step", "iterations and cuts of the step")["series"];
  EXPECT_EQ(iterations[0]["points"][3], Json({3, 1}));
  EXPECT_EQ(iterations[1]["points"][3], Json({3, 0}));
  EXPECT_EQ(chart_of(text, "step", "residual of the iteration")["series"][0]["points"].size(), 5U);

  Json mesh;
  for (const Json& data : data_of(text))
    if (data.contains("outlines")) mesh = data;
  ASSERT_EQ(mesh["outlines"].size(), 8U);
  // 2 by 4 elements of 8 nodes: 5 by 9 places without the 8 centres.
  EXPECT_NE(text.find("<tr><td>nodes</td><td class='number'>37</td></tr>"), std::string::npos);
  // Q8: corners and middle nodes in turns. The first two corners of a side have its middle node between them.
  const auto node = [&](int k, int i) {
    return mesh["nodes"][2 * mesh["outlines"][0][k].get<int>() + i].get<double>();
  };
  for (const int i : {0, 1}) EXPECT_NEAR(node(1, i), 0.5 * (node(0, i) + node(2, i)), 1e-6);
  ASSERT_EQ(mesh["frames"].size(), 4U);
  EXPECT_EQ(mesh["frames"][1]["name"], "step 2, time 0.4");
  double lowest = 0.0;
  for (std::size_t k = 1; k < mesh["nodes"].size(); k += 2)
    lowest = std::min(lowest, mesh["frames"][3]["moved"][k].get<double>());
  EXPECT_NEAR(lowest, -0.008, 1e-8);  // six digits are written
  const auto field = [&](const std::string& name) {
    for (std::size_t k = 0; k < mesh["fields"].size(); ++k)
      if (mesh["fields"][k]["name"] == name) return k;
    ADD_FAILURE() << "no field " << name;
    return std::size_t{0};
  };
  // Deviator of (0.00333, -0.01, 0): (5.556, -7.778, 2.222) e-3; sqrt(2/3) of its norm. Four digits are written.
  EXPECT_NEAR(mesh["frames"][3]["values"][field("deviatoric_strain")][5].get<double>(), 8.0123e-3, 1e-6);
  EXPECT_EQ(mesh["fields"][field("p")]["unit"], "Pa");
  EXPECT_NE(text.find("mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}"), std::string::npos)
      << "the case file is shown";
  // A run into the same directory leaves no page of the one before.
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out/report.html"));
}

// The effect of names in an element, in an attribute of either quotation mark, in a script and in its JSON. The page is taken
// apart by a reader of HTML: it has the elements of the same page with plain names, and no attribute that runs anything.
TEST_F(ReportTest, NamesAreNamesWhereverTheyStand) {
  const auto shape_of = [&](const std::string& file) {
    return run_in(directory(), "/usr/bin/python3 " HTML_CHECK " '" + (directory() / file).string() + "'").out;
  };
  const std::string plain = content(directory() / "case.yaml");
  ASSERT_EQ(polargrain("report out -o plain.html").status, 0);
  const std::string shape = shape_of("plain.html");
  for (const std::string name :
       {"f' autofocus onfocus=alert(4) x='", "<script>alert(1)</script>",
        "</script><script>alert(2)</script>", "<!--<script>", "]]>", "&lt;b&gt;",
        "<img src=x onerror=alert(3)>", "</canvas></figure>", "`${alert(5)}`", "\\u003c/script>",
        "&#39;onclick&#39;", "x' onmouseover='alert(6)", "</title><h1>", "</pre><b>"}) {
    std::string quoted;
    for (const char c : name) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    std::string text = plain;
    text.replace(text.find("Compression of <rock>"), 21, "'" + quoted + "'");
    text.replace(text.find("  top_force:"), 12, "  'n" + quoted + "':");
    write(directory() / "case.yaml", text);
    const Outcome ran = polargrain("run case.yaml -o out --quiet");
    ASSERT_EQ(ran.status, 0) << ran.errors;
    ASSERT_EQ(polargrain("report out").status, 0);
    const std::string html = page();
    EXPECT_EQ(shape_of("out/report.html"), shape) << name;
    // The browser shows the name itself.
    EXPECT_EQ(chart_of(html, "axial_strain", "n" + name)["series"][0]["points"].size(), 6U) << name;
  }
}

TEST_F(ReportTest, NamesAreNoCommandsOfLatex) {
  std::string text = content(directory() / "case.yaml");
  text.replace(text.find("  top_force:"), 12, "  'n\\input{secret}^~#':");
  write(directory() / "case.yaml", text);
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  ASSERT_EQ(polargrain("report out").status, 0);
  EXPECT_NE(page().find("n\\textbackslash{}input\\{secret\\}\\^{}\\~{}\\#, N/m"), std::string::npos);
}

// A summary of which somebody has made something else.
TEST_F(ReportTest, NamesASummaryThatNoRunWrites) {
  const std::string good = content(directory() / "out/summary.json");
  for (const auto& [what, with] :
       {std::pair<std::string, std::string>{"\"title\": \"Compression of <rock>\"", "\"title\": [1]"},
        {"\"proof\": {", "\"proof\": 3, \"former\": {"},
        {"\"total\": ", "\"total\": \"long\", \"former\": "},
        {"\"settings\": []", "\"settings\": 7"},
        {"\"materials\": {}", "\"materials\": {\"all\": 1}"}}) {
    std::string bad = good;
    ASSERT_NE(bad.find(what), std::string::npos) << what << good;
    write(directory() / "out/summary.json", bad.replace(bad.find(what), what.size(), with));
    const Outcome outcome = polargrain("report out");
    EXPECT_EQ(outcome.errors.find("terminate"), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.errors.find("error: [json"), std::string::npos) << outcome.errors;
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 2) << with << outcome.errors;
  }
}

// The table of the case says which curves come first. Over time nothing was moved; the shortening tells it.
TEST_F(ReportTest, DrawsOverTheValueThatWasMovedAndFoldsAwayTheOthers) {
  std::string text = content(directory() / "case.yaml");
  const auto replace = [&text](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("  axial_strain: -shortening / 0.8 m\n",
          "  stress: top_force / 0.4 m\n  double_force: 2 * top_force\n");
  replace("output: {every: 2}", "output: {table: [top_force, shortening]}");
  write(directory() / "listed.yaml", text);
  ASSERT_EQ(polargrain("run listed.yaml -o listed --quiet").status, 0);
  ASSERT_EQ(polargrain("report listed").status, 0);
  const std::string shown = page("listed/report.html");
  const Json force = chart_of(shown, "shortening", "top_force");
  EXPECT_EQ(force["x"]["unit"], "m");
  EXPECT_EQ(chart_of(shown, "shortening", "stress")["y"]["unit"], "Pa");
  EXPECT_EQ(chart_of(shown, "shortening", "double_force")["y"]["unit"], "") << "a 2 may stand for any unit";
  EXPECT_NEAR(force["series"][0]["points"][5][0].get<double>(), -0.008, 1e-15);
  const std::size_t folded = shown.find("<summary>5 further curves</summary>");
  ASSERT_NE(folded, std::string::npos);
  EXPECT_LT(shown.find("top_force against shortening"), folded);
  EXPECT_GT(shown.find("volume_strain against shortening"), folded);
}

TEST_F(ReportTest, SaysWhatWarningsMean) {
  std::ofstream(directory() / "out/run.log", std::ios::app)
      << "[2026-01-01 00:00:00.000] [run] [info] step 7\n"
         "[2026-01-01 00:00:00.000] [run] [warning]   2 corrections asked for strains beyond 0.05 and were shortened\n"
         "[2026-01-01 00:00:00.000] [run] [info] step 9\n"
         "[2026-01-01 00:00:00.000] [run] [warning]   5 corrections asked for strains beyond 0.05 and were shortened\n"
         "[2026-01-01 00:00:00.000] [run] [warning]   nobody has heard of 3 <things>\n"
         "[2026-01-01 00:00:00.000] [run] [error] step 9 did not converge\n";
  ASSERT_EQ(polargrain("report out").status, 0);
  const std::string text = page();
  EXPECT_NE(text.find("<td class='number'>2</td><td>7 to 9</td>"
                      "<td>2 corrections asked for strains beyond 0.05 and were shortened</td>"),
            std::string::npos)
      << text.substr(text.find("<h2>Warnings"), 1500);
  EXPECT_NE(text.find("larger strain than steps: largest_strain allows"), std::string::npos);
  EXPECT_NE(text.find("nobody has heard of 3 &lt;things&gt;"), std::string::npos);
  // The most serious first.
  const std::size_t serious = text.find("<tr class='front'><td>serious</td>");
  const std::size_t look = text.find("<tr><td>look</td>");
  const std::size_t usual = text.find("<tr><td>usual</td>");
  ASSERT_NE(usual, std::string::npos);
  EXPECT_LT(serious, look);
  EXPECT_LT(look, usual);
}

TEST_F(ReportTest, LaysRunsOverEachOther) {
  ASSERT_EQ(polargrain("run case.yaml -o softer --quiet --set materials.rock.E=50e6").status, 0);
  ASSERT_EQ(polargrain("report out --compare softer -o both.html --field q").status, 0);
  const std::string text = page("both.html");
  const Json series = chart_of(text, "axial_strain", "top_force")["series"];
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0]["name"], "out");
  EXPECT_EQ(series[1]["name"], "softer");
  // Gc and lc have no part in a homogeneous strain.
  EXPECT_NEAR(series[1]["points"][5][1].get<double>() / series[0]["points"][5][1].get<double>(), 0.5, 1e-9);
  std::size_t pictures = 0;
  for (const Json& data : data_of(text)) {
    if (!data.contains("outlines")) continue;
    ++pictures;
    EXPECT_EQ(data["fields"].size(), 1U);
  }
  EXPECT_EQ(pictures, 2U);
  EXPECT_NE(text.find("\\begin{tabular}{lrr}"), std::string::npos);
  EXPECT_NE(text.find("top\\_force"), std::string::npos);
}

TEST_F(ReportTest, FollowsARunAtWork) {
  // A run holds its directory.
  const int lock = open((directory() / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  std::filesystem::remove(directory() / "out/report.html");
  Beside live("env -C '" + directory().string() + "' " FAKE_POLARGRAIN " report out --live >/dev/null");
  // It would go on as long as the run does.
  // The page may not be there yet, so its form is not looked at before.
  const auto page_is_whole = [this] {
    return content(directory() / "out/report.html").find("</html>") != std::string::npos;
  };
  EXPECT_TRUE(await(live, page_is_whole));
  kill(live.id(), SIGINT);
  EXPECT_NE(live.wait(), 0);
  const std::string text = page();
  EXPECT_NE(text.find("<meta http-equiv='refresh' content='5'>"), std::string::npos);
  EXPECT_NE(text.find("at work, step 5 committed (time 1)"), std::string::npos);
  close(lock);
  EXPECT_EQ(polargrain("report out --live").status, 0);
  EXPECT_EQ(page().find("http-equiv"), std::string::npos);
}

TEST_F(ReportTest, NamesWhatIsWrong) {
  const auto errors = [&](const std::string& arguments) {
    const Outcome outcome = polargrain("report " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    return outcome.errors;
  };
  EXPECT_NE(errors("nowhere").find("nowhere: holds no result of `polargrain run`"), std::string::npos);
  EXPECT_NE(errors("").find("which result? Name the directory"), std::string::npos);
  EXPECT_NE(errors("out --field colour").find("has no field 'colour'; it has stress, couple_stress"),
            std::string::npos)
      << errors("out --field colour");
  EXPECT_NE(errors("out --x colour").find("there is no column 'colour'"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out/report.html"));
}

}  // namespace
}  // namespace polargrain::testing
