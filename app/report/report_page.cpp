// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/report_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/page/page.hpp"
#include "app/report/followed.hpp"
#include "app/report/log_notes.hpp"
#include "app/report/pictures.hpp"
#include "app/report/profiles.hpp"
#include "app/report/report_remarks.hpp"
#include "app/run/progress.hpp"
#include "app/run/proof.hpp"
#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;

/// The least value that a logarithmic axis shows.
constexpr double kLeastResidual = 1e-17;

/// Raises residuals to two decades below the least residual of forces: rounding may leave those of moments ten decades below
/// it, which would hide the rest. @returns a sentence about that, empty where no value was raised
std::string raise_small(std::vector<ChartSeries>& series) {
  double least = 1.0;
  for (const ChartSeries& line : series)
    if (line.name.find("force_noise") == std::string::npos && line.name.find("moment") == std::string::npos)
      for (const auto& [step, value] : line.points)
        if (value > 0.0) least = std::min(least, value);
  const double end = std::max(kLeastResidual, std::pow(10.0, std::floor(std::log10(least)) - 2.0));
  bool is_raised = false;
  for (ChartSeries& line : series)
    for (auto& [step, value] : line.points)
      if (value < end) {
        value = end;
        is_raised = true;
      }
  return is_raised ? fmt::format("<p>Residuals below {0:.0e} are drawn at {0:.0e}.</p>\n", end) : "";
}

/// The x that is asked for, or what was moved.
std::string x_of(const std::vector<RunResult>& results, const ReportContent& content) {
  if (content.x.empty()) return value_moved(results);
  for (const RunResult& result : results)
    if (result.history) (void)result.history->column(content.x);  // says which ones there are
  return content.x;
}

bool has_column(const RunResult& result, const std::string& name) {
  return result.history && std::ranges::find(result.history->names(), name) != result.history->names().end();
}

ChartSeries line_of(const std::string& name, const CsvTable& table, const std::string& x,
                    const std::string& y) {
  ChartSeries line;
  line.name = name;
  line.line = true;
  const std::size_t x_column = table.column(x);
  const std::size_t y_column = table.column(y);
  for (std::size_t row = 0; row < table.rows(); ++row)
    line.points.emplace_back(table.figure(row, x_column), table.figure(row, y_column));
  return line;
}

std::string charts_of(const std::vector<RunResult>& results, const std::string& x,
                      const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    std::vector<ChartSeries> series;
    for (const RunResult& result : results)
      if (has_column(result, name)) series.push_back(line_of(result.name, *result.history, x, name));
    text += chart({.title = x, .unit = unit_of_value(results, x)},
                  {.title = name, .unit = unit_of_value(results, name)}, series, results.size() > 1);
  }
  return "<div class='grid'>\n" + text + "</div>\n";
}

std::string curves(const std::vector<RunResult>& results, const std::string& x) {
  const FollowedNames names = followed_names(results, x);
  if (names.listed.empty()) return "<p>No step has been committed yet.</p>\n";
  std::string text = charts_of(results, x, names.listed);
  if (!names.others.empty())
    text +=
        details(fmt::format("{} further curves", names.others.size()), charts_of(results, x, names.others));
  return text;
}

/// Residuals of all iterations, those of a step between its number and the next.
ChartSeries iterations_of(const RunResult& result, const std::string& name,
                          double LoggedIteration::*residual) {
  ChartSeries line;
  line.name = name;
  line.line = true;
  for (std::size_t first = 0; first < result.iterations.size();) {
    std::size_t end = first;
    while (end < result.iterations.size() && result.iterations[end].step == result.iterations[first].step)
      ++end;
    for (std::size_t k = first; k < end; ++k)
      line.points.emplace_back(
          result.iterations[k].step + static_cast<double>(k - first) / static_cast<double>(end - first),
          result.iterations[k].*residual);
    first = end;
  }
  return line;
}

std::string convergence(const std::vector<RunResult>& results) {
  const bool several = results.size() > 1;
  std::vector<ChartSeries> counts;
  std::vector<ChartSeries> residuals;
  std::vector<ChartSeries> iterations;
  for (const RunResult& result : results) {
    const auto called = [&](const std::string& name) { return several ? result.name + ", " + name : name; };
    if (result.history) {
      for (const char* const name : {"iterations", "cuts"})
        counts.push_back(line_of(called(name), *result.history, "step", name));
      for (const char* const name : {"force_residual", "moment_residual", "force_noise", "error_estimate"}) {
        if (several && name != std::string_view("force_residual")) continue;
        if (std::ranges::find(result.history->names(), name) == result.history->names().end()) continue;
        ChartSeries line = line_of(called(name), *result.history, "step", name);
        if (std::ranges::all_of(line.points, [](const auto& point) { return point.second == 0.0; })) continue;
        line.dashed = name == std::string_view("force_noise");
        residuals.push_back(std::move(line));
      }
    }
    if (result.iterations.empty()) continue;
    iterations.push_back(iterations_of(result, called("force"), &LoggedIteration::force_residual));
    if (!several)
      iterations.push_back(iterations_of(result, called("moment"), &LoggedIteration::moment_residual));
  }
  std::string text = raise_small(residuals) + "<div class='grid'>\n";
  const std::string raised = raise_small(iterations);
  if (!counts.empty())
    text += chart({.title = "step"}, {.title = "iterations and cuts of the step"}, counts, true) +
            chart({.title = "step"}, {.title = "residual at the end of the step", .logarithmic = true},
                  residuals, true);
  text += "</div>\n";
  if (!iterations.empty())
    text +=
        "<p>All iterations, also of attempts that were cut. The iterations of a step stand between its number and the next "
        "number; the first is the predictor.</p>\n" +
        raised +
        chart({.title = "step"}, {.title = "residual of the iteration", .logarithmic = true}, iterations,
              true);
  return text;
}

/// A value of the summary; an empty text where it is not there.
std::string figure(const Json& of, const char* pointer, const char* pattern = "{:.6g}") {
  if (!of.is_object()) return "";
  const Json::json_pointer path(pointer);
  if (!of.contains(path)) return "";
  const Json& value = of.at(path);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return std::to_string(value.get<long>());
  return value.is_number() ? fmt::format(fmt::runtime(pattern), value.get<double>()) : "";
}

std::string cost(const std::vector<RunResult>& results) {
  constexpr std::pair<const char*, const char*> kParts[] = {{"grains", "grains"},
                                                            {"messages", "messages"},
                                                            {"waiting", "workers waiting for the last cell"},
                                                            {"finite_elements", "finite elements"},
                                                            {"rest", "output and start"},
                                                            {"total", "in all"}};
  std::vector<std::string> titles{"wall time, s"};
  for (const RunResult& result : results) titles.push_back(result.name);
  std::vector<TableRow> rows;
  for (const auto& [key, name] : kParts) {
    TableRow row{{name}};
    for (const RunResult& result : results) {
      double sum = 0.0;
      if (result.costs)
        for (const double seconds : result.costs->numbers(key)) sum += seconds;
      row.cells.push_back(result.costs ? fmt::format("{:.2f}", sum) : "");
    }
    rows.push_back(std::move(row));
  }
  std::vector<ChartSeries> series;
  for (const RunResult& result : results) {
    if (!result.costs) continue;
    if (results.size() > 1) {
      series.push_back(line_of(result.name, *result.costs, "step", "total"));
      continue;
    }
    for (const char* const key : {"total", "grains", "finite_elements"})
      series.push_back(line_of(key, *result.costs, "step", key));
  }
  std::string text = table(titles, rows);
  if (!series.empty()) text += chart({.title = "step"}, {.title = "wall time of the step, s"}, series, true);
  return text;
}

/// Name, and a text for each run; a row of the name alone begins a group.
using KeyRow = std::vector<std::string>;

/// The rows of a paper's table of runs: the model, how well balanced, at what cost, and the results.
std::vector<KeyRow> key_rows(const std::vector<RunResult>& results, const std::vector<MeshPicture>& pictures,
                             const std::string& x) {
  std::vector<KeyRow> rows;
  const auto add = [&](const std::string& name, auto of_run) {
    KeyRow row{name};
    for (std::size_t k = 0; k < results.size(); ++k) row.push_back(of_run(k));
    const bool is_empty =
        std::all_of(row.begin() + 1, row.end(), [](const std::string& cell) { return cell.empty(); });
    if (!is_empty) rows.push_back(std::move(row));
  };
  const auto of_summary = [&](const char* pointer) {
    return [&results, pointer](std::size_t k) { return figure(results[k].summary, pointer); };
  };
  const auto end_group = [&] {  // without a row it would be a headline of nothing
    if (!rows.empty() && rows.back().size() == 1) rows.pop_back();
  };
  const auto begin_group = [&](const std::string& name) {
    end_group();
    rows.push_back({name});
  };
  begin_group("Mesh and steps");
  add("elements", [&](std::size_t k) {
    return pictures[k].outlines.empty() ? "" : std::to_string(pictures[k].all_elements);
  });
  add("nodes", [&](std::size_t k) {
    const std::size_t components = static_cast<std::size_t>(pictures[k].dimension);
    return pictures[k].nodes.empty() ? "" : std::to_string(pictures[k].nodes.size() / components);
  });
  add("steps committed", of_summary("/steps_committed"));
  begin_group("Balance: residuals are shares of the forces, before a step was accepted");
  add("iterations of all steps", of_summary("/iterations"));
  add("steps cut", of_summary("/cuts"));
  add("largest force residual", of_summary("/errors/largest_force_residual"));
  add("largest moment residual", of_summary("/errors/largest_moment_residual"));
  begin_group("Explicit steps: how far they were from equilibrium, largest of all steps");
  add("estimated error of the reactions", of_summary("/quasi_static/error_estimate/largest"));
  add("the same, median of the steps", of_summary("/quasi_static/error_estimate/median"));
  add("steps beyond the error that is allowed", of_summary("/quasi_static/error_estimate/steps_beyond"));
  add("difference of the reactions of moved and held boundaries",
      of_summary("/quasi_static/reaction_difference/largest"));
  add("unbalanced ratio of the nodes", of_summary("/quasi_static/nodes_unbalanced/largest"));
  add("unbalanced ratio of the grains", of_summary("/quasi_static/grains_unbalanced/largest"));
  add("kinetic energy of the chosen masses over internal work",
      of_summary("/quasi_static/kinetic_share/largest"));
  add("share of the boxes that do not come to rest", of_summary("/quasi_static/hot_points/largest"));
  begin_group("Cost");
  // A run without cells has no such numbers.
  const auto of_cells = [&](const char* pointer) {
    return [&results, pointer](std::size_t k) {
      const std::string text = figure(results[k].summary, pointer);
      return text == "0" ? std::string() : text;
    };
  };
  add("evaluations of cells", of_cells("/cells/evaluations"));
  add("DEM steps", of_cells("/cells/dem_steps"));
  add("workers", of_cells("/workers"));
  add("wall time, s", of_summary("/seconds/total"));
  const FollowedNames followed = followed_names(results, "");
  std::vector<std::string> names = followed.listed;
  names.insert(names.end(), followed.others.begin(), followed.others.end());
  const auto with_unit = [&](const std::string& name) {
    const std::string unit = unit_of_value(results, name);
    return unit.empty() ? name : fmt::format("{}, {}", name, unit);
  };
  const auto value_at = [&](std::size_t k, const std::string& name, bool extreme) -> std::string {
    if (!has_column(results[k], name) || results[k].history->rows() == 0) return "";
    const ChartSeries line = line_of(name, *results[k].history, x, name);
    if (!extreme) return fmt::format("{:.6g}", line.points.back().second);
    // A quotient of what was zero yet is no number, and not the largest one.
    const auto largest = std::ranges::max_element(line.points, {}, [](const auto& point) {
      return std::isnan(point.second) ? -1.0 : std::abs(point.second);
    });
    return std::isnan(largest->second) ? ""
                                       : fmt::format("{:.6g} at {:.4g}", largest->second, largest->first);
  };
  begin_group("Values at the end");
  for (const std::string& name : names)
    add(with_unit(name), [&](std::size_t k) { return value_at(k, name, false); });
  begin_group(fmt::format("Largest magnitudes, and the {} there", x));
  for (const std::string& name : names)
    if (name != x) add(with_unit(name), [&](std::size_t k) { return value_at(k, name, true); });
  end_group();
  return rows;
}

/// Text for LaTeX: nothing in it is a command.
std::string for_latex(const std::string& text) {
  std::string out;
  for (const char c : plain_text(text)) {
    if (c == '\\')
      out += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      out += std::string("\\") + c + "{}";
    else
      out += (std::string_view("_%&#${}").find(c) != std::string_view::npos ? "\\" : "") + std::string(1, c);
  }
  return out;
}

/// A row with tabulators between its cells, and not in one of them.
std::string tab_row(const KeyRow& row) {
  std::vector<std::string> cells;
  for (const std::string& cell : row) cells.push_back(plain_text(cell));
  return fmt::format("{}\n", fmt::join(cells, "\t"));
}

std::string key_table(const std::vector<RunResult>& results, const std::vector<KeyRow>& rows) {
  std::vector<std::string> titles{""};
  for (const RunResult& result : results) titles.push_back(result.name);
  std::vector<TableRow> cells;
  std::string tabs = tab_row(titles);
  std::string latex = "\\begin{tabular}{l" + std::string(results.size(), 'r') + "}\n";
  const auto latex_row = [&](const KeyRow& row) {
    std::vector<std::string> escaped_cells;
    for (const std::string& cell : row) escaped_cells.push_back(for_latex(cell));
    latex += fmt::format("{} \\\\\n", fmt::join(escaped_cells, " & "));
  };
  latex_row(titles);
  latex += "\\hline\n";
  for (KeyRow row : rows) {
    cells.push_back({row, row.size() == 1 ? "group" : ""});
    row.resize(titles.size());
    tabs += tab_row(row);
    latex_row(row);
  }
  latex += "\\end{tabular}\n";
  return table(titles, cells) + details("This table for LaTeX", "<pre>" + escaped(latex) + "</pre>\n") +
         details("This table with tabulators, for spreadsheets", "<pre>" + escaped(tabs) + "</pre>\n");
}

/// The settings of a run, as far as the summary has them.
std::string settings(const RunResult& result) {
  std::vector<TableRow> rows;
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) rows.push_back({{name, value}});
  };
  const auto begin_group = [&](const std::string& name) { rows.push_back({{name}, "group"}); };
  begin_group("Run");
  add("title", result.title());
  add("directory", result.directory.string());
  if (!result.summary.is_object()) {
    add("log", result.head);
    return table({"", ""}, rows, TableOf::text);
  }
  const Json& summary = result.summary;
  add("program", figure(summary, "/program"));
  add("case", figure(summary, "/case"));
  const Json proof = summary.value("proof", Json::object());
  for (const Json& setting : proof.value("settings", Json::array()))
    add("--set", setting.is_string() ? setting.get<std::string>() : "");
  const Json files = proof.value("files", Json::object());
  for (const auto& [key, name] : files.items())
    add("file of " + key + ", XXH3", name.is_string() ? name.get<std::string>() : "");
  begin_group("Processors");
  add("coordinator", figure(proof, "/processor"));
  const Json workers = proof.value("workers", Json::object());
  for (const auto& [worker, of] : workers.items())
    add(worker, fmt::format("{} evaluations, {}", figure(of, "/evaluations"), figure(of, "/processor")));
  const Json materials = summary.value("materials", Json::object());
  for (const auto& [region, figures] : materials.items()) {
    const std::size_t before = rows.size();
    begin_group(fmt::format("Region '{}': figures of its material that are not zero", region));
    for (const auto& [name, value] : figures.items())
      add(name, value.is_number() && value != 0.0 ? fmt::format("{:.6g}", value.get<double>()) : "");
    if (rows.size() == before + 1) rows.pop_back();
  }
  std::string text = table({"", ""}, rows, TableOf::text);
  const std::string case_file = figure(summary, "/case");
  const std::string recorded = figure(proof, "/case_file");
  if (!recorded.empty() && name_of_file(case_file) == recorded)
    text += details("The case file", "<pre>" + escaped(coupler::content_of(case_file)) + "</pre>\n");
  else if (!case_file.empty())
    text += "<p>The case file is not shown: it was changed or removed after the run.</p>\n";
  return text;
}

std::string status(const RunResult& result) {
  if (result.is_at_work) {
    const std::size_t rows = result.history ? result.history->rows() : 0;
    return rows == 0
               ? "at work, no step committed yet"
               : fmt::format("at work, step {} committed (time {:.4g})",
                             result.history->cell(rows - 1, "step"), result.history->numbers("time").back());
  }
  if (!result.summary.is_object()) return "ended without a summary: killed, or its disk was full";
  const std::string message = figure(result.summary, "/message");
  return fmt::format("{}: {} of {} steps in {}{}", figure(result.summary, "/status"),
                     figure(result.summary, "/steps_committed"), figure(result.summary, "/steps_asked"),
                     result.summary.contains(Json::json_pointer("/seconds/total"))
                         ? duration_text(result.summary["seconds"]["total"].get<double>())
                         : "",
                     message.empty() ? "" : "; " + message);
}

/// The stages of construction of a run; empty where it has no stages.
std::string stages(const RunResult& result) {
  if (!result.summary.is_object() || !result.summary.contains("stages")) return "";
  std::vector<TableRow> rows;
  for (const Json& stage : result.summary["stages"]) {
    const int last = stage.value("last_step", 0);
    std::string time;
    if (result.history)
      for (std::size_t row = 0; row < result.history->rows(); ++row)
        if (result.history->figure(row, result.history->column("step")) == last)
          time = fmt::format("{:.6g}", result.history->numbers("time")[row]);
    rows.push_back({{stage.value("name", ""), fmt::format("{} to {}", stage.value("first_step", 0), last),
                     time.empty() ? "not reached" : time}});
  }
  return table({"stage", "steps", "time at its end"}, rows);
}

std::string notes(const std::vector<RunResult>& results) {
  struct Weighed {
    NoteWeight weight;
    TableRow row;
  };
  const bool several = results.size() > 1;
  std::vector<Weighed> weighed;
  for (const RunResult& result : results) {
    for (const LogNote& note : notes_of(result.warnings)) {
      const std::string steps = note.first_step == note.last_step
                                    ? fmt::format("{}", note.first_step)
                                    : fmt::format("{} to {}", note.first_step, note.last_step);
      weighed.push_back({note.weight,
                         {{name_of(note.weight), std::to_string(note.count),
                           note.first_step < 0 ? "before the first" : steps, note.first, note.meaning},
                          note.weight == NoteWeight::serious ? "front" : ""}});
      std::vector<std::string>& cells = weighed.back().row.cells;
      if (several) cells.insert(cells.begin() + 1, result.name);
    }
  }
  if (weighed.empty()) return "<p>The run gave no warning.</p>\n";
  std::ranges::stable_sort(weighed, std::ranges::greater{}, &Weighed::weight);
  std::vector<TableRow> rows;
  for (Weighed& one : weighed) rows.push_back(std::move(one.row));
  std::vector<std::string> titles{"weight", "how often", "steps", "the first of them", "meaning and remedy"};
  if (several) titles.insert(titles.begin() + 1, "run");
  return table(titles, rows, TableOf::text);
}

}  // namespace

std::string report_page(const std::vector<RunResult>& results, const ReportContent& content) {
  const std::string x = x_of(results, content);
  std::vector<MeshPicture> pictures;
  for (const RunResult& result : results) pictures.push_back(picture_of(result, content.fields));
  std::string body;
  for (const RunResult& result : results) {
    const std::string name = results.size() > 1 ? result.name + ": " : "";
    body += "<p>" + escaped(name + status(result)) + "</p>\n";
  }
  for (const RunResult& result : results) {
    const std::string of_run = stages(result);
    if (!of_run.empty()) body += (results.size() > 1 ? "<p>" + escaped(result.name) + "</p>\n" : "") + of_run;
  }
  body += remarks_section(results);
  body +=
      "<h2>Curves</h2>\n<p>Drawing a rectangle with the mouse enlarges it, a double click shows all again.</p>\n" +
      curves(results, x);
  std::string profiles;
  for (const RunResult& result : results) {
    const std::string of_run = profiles_section(result);
    if (!of_run.empty())
      profiles += (results.size() > 1 ? "<p>" + escaped(result.name) + "</p>\n" : "") + of_run;
  }
  if (!profiles.empty()) body += "<h2>Profiles</h2>\n" + profiles;
  std::string meshes;
  for (const MeshPicture& picture : pictures)
    if (!picture.frames.empty() && !picture.fields.empty()) meshes += mesh_picture(picture);
  if (!meshes.empty()) body += "<h2>Fields</h2>\n<div class='grid'>\n" + meshes + "</div>\n";
  for (const RunResult& result : results)
    if (result.is_in_space())
      body += fmt::format(
          "<p>{} is a body in space: drag its picture with the mouse to turn it. For cuts open <code>fields.pvd</code> "
          "in ParaView.</p>\n",
          escaped(result.name));
  std::string grains;
  for (const RunResult& result : results)
    if (content.grains) grains += content.grains(result);
  if (!grains.empty()) body += "<h2>Grains</h2>\n" + grains;
  body += "<h2>Figures</h2>\n" + key_table(results, key_rows(results, pictures, x));
  body += "<h2>Warnings</h2>\n" + notes(results);
  body += "<h2>Convergence</h2>\n" + convergence(results);
  body += "<h2>Cost</h2>\n" + cost(results);
  body += "<h2>Settings and versions</h2>\n";
  for (const RunResult& result : results) body += settings(result);
  std::string title = results.front().title();
  if (results.size() > 1) title = fmt::format("{} runs: {}", results.size(), title);
  return page(title, body, content.refresh_seconds);
}

}  // namespace polargrain::app
