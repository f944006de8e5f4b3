// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/report_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/page/page.hpp"
#include "app/report/report_remarks.hpp"
#include "app/report/log_notes.hpp"
#include "app/report/pictures.hpp"
#include "app/run/progress.hpp"
#include "app/run/proof.hpp"
#include "common/error.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;

/// What has no place on a logarithmic axis.
constexpr double kLeastResidual = 1e-17;

/// The x that is asked for, or one that suits all of the runs.
std::string x_of(const std::vector<RunResult>& results, const ReportContent& content) {
  const auto everywhere = [&](const std::string& name) {
    return std::ranges::all_of(results, [&](const RunResult& result) {
      return !result.history ||
             std::ranges::find(result.history->names(), name) != result.history->names().end();
    });
  };
  if (!content.x.empty()) {
    for (const RunResult& result : results)
      if (result.history) (void)result.history->column(content.x);  // says which ones there are
    return content.x;
  }
  for (const std::string& name : results.front().value_names())
    if (name != "volume_strain" && name.find("strain") != std::string::npos && everywhere(name)) return name;
  return "time";
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
    line.points.emplace_back(table.number(row, x_column), table.number(row, y_column));
  return line;
}

std::string curves(const std::vector<RunResult>& results, const std::string& x) {
  std::vector<std::string> names;
  for (const RunResult& result : results)
    for (const std::string& name : result.value_names())
      if (name != x && std::ranges::find(names, name) == names.end()) names.push_back(name);
  // Monitors are the user's own: before what every run has.
  const std::vector<std::string> of_every_run{"volume_strain", "external_work", "internal_work"};
  std::ranges::stable_partition(names, [&](const std::string& name) {
    return std::ranges::find(of_every_run, name) == of_every_run.end();
  });
  std::string text;
  for (const std::string& name : names) {
    std::vector<ChartSeries> series;
    for (const RunResult& result : results)
      if (has_column(result, name)) series.push_back(line_of(result.name, *result.history, x, name));
    text += chart({.title = x}, {.title = name}, series, results.size() > 1);
  }
  if (text.empty()) return "<p>No step has been committed yet.</p>\n";
  return "<div class='grid'>\n" + text + "</div>\n";
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
          std::max(kLeastResidual, result.iterations[k].*residual));
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
      for (const char* const name : {"force_residual", "moment_residual", "force_noise"}) {
        if (several && name != std::string_view("force_residual")) continue;
        ChartSeries line = line_of(called(name), *result.history, "step", name);
        if (std::ranges::all_of(line.points, [](const auto& point) { return point.second == 0.0; })) continue;
        for (auto& point : line.points) point.second = std::max(kLeastResidual, point.second);
        line.dashed = name == std::string_view("force_noise");
        residuals.push_back(std::move(line));
      }
    }
    if (result.iterations.empty()) continue;
    iterations.push_back(iterations_of(result, called("force"), &LoggedIteration::force_residual));
    if (!several)
      iterations.push_back(iterations_of(result, called("moment"), &LoggedIteration::moment_residual));
  }
  std::string text = "<div class='grid'>\n";
  if (!counts.empty())
    text += chart({.title = "step"}, {.title = "iterations and cuts of the step"}, counts, true) +
            chart({.title = "step"}, {.title = "residual at the end of the step", .logarithmic = true},
                  residuals, true);
  text += "</div>\n";
  if (!iterations.empty())
    text +=
        "<p>Every iteration: those of a step stand between its number and the next, from the predictor on; attempts that were "
        "cut are among them.</p>\n" +
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

/// Name, and a text for each run.
using KeyRow = std::vector<std::string>;

/// What a paper's table says of runs: what was computed, how well balanced, at what cost, and what came of it.
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
  add("elements", [&](std::size_t k) {
    return pictures[k].outlines.empty() ? "" : std::to_string(pictures[k].outlines.size());
  });
  add("nodes", [&](std::size_t k) {
    return pictures[k].nodes.empty() ? "" : std::to_string(pictures[k].nodes.size());
  });
  add("steps committed", of_summary("/steps_committed"));
  add("iterations", of_summary("/iterations"));
  add("cuts", of_summary("/cuts"));
  add("largest force residual", of_summary("/errors/largest_force_residual"));
  add("largest moment residual", of_summary("/errors/largest_moment_residual"));
  // A run without cells has none of these.
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
  std::vector<std::string> names;
  for (const RunResult& result : results)
    for (const std::string& name : result.value_names())
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  const auto value_at = [&](std::size_t k, const std::string& name, bool extreme) -> std::string {
    if (!has_column(results[k], name) || results[k].history->rows() == 0) return "";
    const std::vector<double> values = results[k].history->numbers(name);
    if (!extreme) return fmt::format("{:.6g}", values.back());
    const auto largest = std::ranges::max_element(values, {}, [](double value) { return std::abs(value); });
    const auto row = static_cast<std::size_t>(largest - values.begin());
    return fmt::format("{:.6g} at {:.4g}", *largest, results[k].history->numbers(x)[row]);
  };
  for (const std::string& name : names) {
    add(name + ", at the end", [&](std::size_t k) { return value_at(k, name, false); });
    if (name != x)
      add(fmt::format("{}, largest magnitude (at {})", name, x),
          [&](std::size_t k) { return value_at(k, name, true); });
  }
  return rows;
}

std::string for_latex(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("_%&#$").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string key_table(const std::vector<RunResult>& results, const std::vector<KeyRow>& rows) {
  std::vector<std::string> titles{""};
  for (const RunResult& result : results) titles.push_back(result.name);
  std::vector<TableRow> cells;
  std::string tabs = fmt::format("{}\n", fmt::join(titles, "\t"));
  std::string latex = "\\begin{tabular}{l" + std::string(results.size(), 'r') + "}\n";
  const auto latex_row = [&](const KeyRow& row) {
    std::vector<std::string> escaped_cells;
    for (const std::string& cell : row) escaped_cells.push_back(for_latex(cell));
    latex += fmt::format("{} \\\\\n", fmt::join(escaped_cells, " & "));
  };
  latex_row(titles);
  latex += "\\hline\n";
  for (const KeyRow& row : rows) {
    cells.push_back({row});
    tabs += fmt::format("{}\n", fmt::join(row, "\t"));
    latex_row(row);
  }
  latex += "\\end{tabular}\n";
  return table(titles, cells) + details("This table for LaTeX", "<pre>" + escaped(latex) + "</pre>\n") +
         details("This table with tabulators, for spreadsheets", "<pre>" + escaped(tabs) + "</pre>\n");
}

/// What a run was made from, as far as the summary tells.
std::string settings(const RunResult& result) {
  std::vector<TableRow> rows;
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) rows.push_back({{name, value}});
  };
  add("title", result.title());
  add("directory", result.directory.string());
  if (!result.summary.is_object()) {
    add("log", result.head);
    return table({"", ""}, rows);
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
  add("processor", figure(proof, "/processor"));
  const Json workers = proof.value("workers", Json::object());
  for (const auto& [worker, of] : workers.items())
    add(worker, fmt::format("{} evaluations, {}", figure(of, "/evaluations"), figure(of, "/processor")));
  const Json materials = summary.value("materials", Json::object());
  for (const auto& [region, figures] : materials.items())
    for (const auto& [name, value] : figures.items())
      add(fmt::format("region '{}': {}", region, name),
          value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "");
  std::string text = table({"", ""}, rows);
  const std::string case_file = figure(summary, "/case");
  const std::string recorded = figure(proof, "/case_file");
  if (!recorded.empty() && name_of_file(case_file) == recorded)
    text += details("The case file", "<pre>" + escaped(coupler::content_of(case_file)) + "</pre>\n");
  else if (!case_file.empty())
    text += "<p>The case file is not shown: it is not there any more as the run has read it.</p>\n";
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

std::string notes(const std::vector<RunResult>& results) {
  std::vector<TableRow> rows;
  for (const RunResult& result : results) {
    for (const LogNote& note : notes_of(result.warnings)) {
      const std::string steps = note.first_step == note.last_step
                                    ? fmt::format("{}", note.first_step)
                                    : fmt::format("{} to {}", note.first_step, note.last_step);
      rows.push_back({{result.name, std::to_string(note.count),
                       note.first_step < 0 ? "before the first" : steps, note.first, note.meaning}});
    }
  }
  if (rows.empty()) return "<p>None.</p>\n";
  std::string text = table({"run", "how often", "steps", "the first of them", "what it means"}, rows);
  return text.replace(text.find("<table>"), 7, "<table class='text'>");
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
  body += remarks_section(results);
  body +=
      "<h2>Curves</h2>\n<p>Drawing a rectangle with the mouse enlarges it, a double click shows all again.</p>\n" +
      curves(results, x);
  std::string meshes;
  for (const MeshPicture& picture : pictures)
    if (!picture.frames.empty() && !picture.fields.empty()) meshes += mesh_picture(picture);
  if (!meshes.empty()) body += "<h2>Fields</h2>\n<div class='grid'>\n" + meshes + "</div>\n";
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
