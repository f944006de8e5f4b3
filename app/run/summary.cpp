// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/csv_file.hpp"
#include "app/run/proof.hpp"
#include "common/error.hpp"
#include "common/processor.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// JSON knows no infinity and no NaN.
std::string number(double value) {
  return std::isfinite(value) ? exact(value) : "null";
}

/// Lines of `"key": value`, joined into an object.
class JsonObject {
 public:
  JsonObject& raw(const std::string& key, const std::string& value) {
    lines_.push_back(quoted(key) + ": " + value);
    return *this;
  }
  JsonObject& text(const std::string& key, const std::string& value) { return raw(key, quoted(value)); }
  JsonObject& real(const std::string& key, double value) { return raw(key, number(value)); }
  JsonObject& whole(const std::string& key, std::int64_t value) { return raw(key, std::to_string(value)); }
  [[nodiscard]] std::string finish(const std::string& indent) const {
    return fmt::format("{{\n{}  {}\n{}}}", indent, fmt::join(lines_, ",\n" + indent + "  "), indent);
  }

 private:
  std::vector<std::string> lines_;
};

std::string error_figures(const RunRecord& record) {
  double force = 0.0;
  double moment = 0.0;
  for (const CommittedStep& step : record.steps) {
    force = std::max(force, step.report.force_residual);
    moment = std::max(moment, step.report.moment_residual);
  }
  JsonObject errors;
  errors.real("largest_force_residual", force).real("largest_moment_residual", moment);
  if (!record.steps.empty()) {
    const MonitorValues& last = record.steps.back().values;
    errors.real("external_minus_internal_work",
                value_of(last, "external_work") - value_of(last, "internal_work"));
  }
  return errors.finish("  ");
}

std::string cost_figures(const RunRecord& record) {
  const Costs& c = record.costs;
  return JsonObject()
      .real("total", c.total)
      .real("grains", c.grains)
      .real("messages", c.messages)
      .real("waiting", c.waiting)
      .real("finite_elements", c.finite_elements)
      .real("rest", c.rest)
      .finish("  ");
}

std::string cell_figures(const coupler::PoolCounts& pool) {
  return JsonObject()
      .whole("evaluations", pool.evaluations)
      .whole("dem_steps", pool.dem_steps)
      .real("engine_seconds", pool.engine_seconds)
      .whole("states_sent", pool.states_sent)
      .whole("states_fetched", pool.states_fetched)
      .whole("evaluations_again", pool.evaluations_again)
      .whole("evaluations_checked", pool.evaluations_checked)
      .whole("bytes_sent", pool.bytes_sent)
      .whole("bytes_received", pool.bytes_received)
      .finish("  ");
}

std::string material_figures(const RunRecord& record) {
  JsonObject regions;
  for (const auto& [region, figures] : record.figures) {
    JsonObject material;
    for (const fem::Figure& figure : figures) material.real(figure.name, figure.value);
    regions.raw(region, material.finish("    "));
  }
  return regions.finish("  ");
}

std::string names_figure(const std::map<std::string, std::string>& names) {
  JsonObject object;
  for (const auto& [key, name] : names) object.text(key, name);
  return object.finish("    ");
}

/// What the result was made from, by whom, and what it is.
std::string proof_figures(const coupler::Case& the_case, const RunRecord& record) {
  JsonObject workers;
  for (const auto& [worker, done] : record.worker_records) {
    workers.raw(worker, JsonObject()
                            .whole("evaluations", done.evaluations)
                            .text("processor", done.processor)
                            .finish("      "));
  }
  std::vector<std::string> settings;
  for (const std::string& setting : record.settings) settings.push_back(quoted(setting));
  return JsonObject()
      .text("processor", processor_model())
      .text("case_file", name_of_file(the_case.file))
      .raw("settings", fmt::format("[{}]", fmt::join(settings, ", ")))
      .raw("files", names_figure(the_case.identity.files))
      .raw("results", names_figure(record.results))
      .raw("workers", workers.finish("    "))
      .finish("  ");
}

std::string last_values(const RunRecord& record) {
  JsonObject values;
  if (!record.steps.empty()) {
    for (const auto& [name, value] : record.steps.back().values) values.real(name, value);
  }
  return values.finish("  ");
}

}  // namespace

void write_summary(const std::filesystem::path& file, const coupler::Case& the_case,
                   const RunRecord& record) {
  const std::string text = JsonObject()
                               .text("program", "polargrain " POLARGRAIN_VERSION)
                               .text("case", the_case.file.string())
                               .text("title", the_case.title)
                               .text("status", record.status)
                               .text("message", record.message)
                               .whole("steps_asked", the_case.steps())
                               .whole("steps_committed", record.steps.empty() ? 0 : record.steps.back().step)
                               .whole("iterations", record.iterations)
                               .whole("cuts", record.cuts)
                               .whole("substeps_within_noise", record.within_noise)
                               .whole("substeps_within_rounding", record.within_rounding)
                               .whole("corrections_limited", record.limited)
                               .whole("point_evaluations", record.evaluations)
                               .whole("workers", record.workers)
                               .raw("values", last_values(record))
                               .raw("errors", error_figures(record))
                               .raw("seconds", cost_figures(record))
                               .raw("cells", cell_figures(record.pool))
                               .raw("materials", material_figures(record))
                               .raw("proof", proof_figures(the_case, record))
                               .finish("");
  fem::write_file(file, text + '\n');
}

std::string table_text(const coupler::Case& the_case, const RunRecord& record) {
  constexpr std::size_t kMostRows = 20;
  std::string text = fmt::format("{:>6}", "step");
  for (const std::string& name : the_case.table) text += fmt::format("  {:>15}", name);
  text += fmt::format("  {:>17}\n", "Newton iterations");
  const std::size_t count = record.steps.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kMostRows - 1) / kMostRows);
  for (std::size_t s = 0; s < count; ++s) {
    if ((count - 1 - s) % stride != 0 && s != 0) continue;
    const CommittedStep& step = record.steps[s];
    text += fmt::format("{:>6}", step.step);
    for (const std::string& name : the_case.table)
      text += fmt::format("  {:>15.6g}", value_of(step.values, name));
    text += fmt::format("  {:>17}\n", step.report.iterations);
  }
  if (record.within_noise > 0) {
    text += fmt::format("{} substeps were accepted above the tolerance, within the noise of the stresses\n",
                        record.within_noise);
  }
  if (record.within_rounding > 0) {
    text += fmt::format("{} substeps were accepted above the tolerance, where only rounding is left\n",
                        record.within_rounding);
  }
  if (record.limited > 0) {
    text += fmt::format("{} corrections asked for too large a strain and were shortened or replaced\n",
                        record.limited);
  }
  return text;
}

std::string costs_text(const RunRecord& record) {
  const Costs& c = record.costs;
  std::string text = fmt::format("time spent (s, {:.1f} in all)\n", c.total);
  const auto part = [&](const char* name, double seconds) {
    text += fmt::format("  {:<34}{:>9.2f}  {:>5.1f} %\n", name, seconds, 100.0 * seconds / c.total);
  };
  if (record.pool.evaluations > 0) {
    part("grains", c.grains);
    part("messages", c.messages);
    part("workers waiting for the last cell", c.waiting);
  }
  part("finite elements", c.finite_elements);
  part("output and start", c.rest);
  if (record.pool.evaluations > 0) {
    const auto evaluations = static_cast<double>(record.pool.evaluations);
    text += fmt::format("cells: {} evaluations on {} workers, {:.4f} s and {:.0f} DEM steps each\n",
                        record.pool.evaluations, record.workers, record.pool.engine_seconds / evaluations,
                        static_cast<double>(record.pool.dem_steps) / evaluations);
    if (record.pool.evaluations_checked > 0)
      text += fmt::format("       {} of them were made by two workers, with the same bits\n",
                          record.pool.evaluations_checked);
  }
  return text;
}

std::string figures_text(const RunRecord& record) {
  std::string text;
  for (const auto& [region, figures] : record.figures) {
    text += fmt::format("material of region '{}'\n", region);
    for (const fem::Figure& figure : figures)
      text += fmt::format("  {:<34}{:>9.4g}\n", figure.name, figure.value);
  }
  return text;
}

}  // namespace polargrain::app
