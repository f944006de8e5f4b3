// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "app/page/assets.hpp"
#include "common/plain_text.hpp"
#include "common/regular_file.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;

/// Of each page: it tells them from files of others.
constexpr std::string_view kHeadOfPage = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>\n";

Json axis(const ChartAxis& of) {
  return {{"title", of.title}, {"unit", of.unit}, {"logarithmic", of.logarithmic}, {"percent", of.percent}};
}

Json one(const ChartSeries& of) {
  Json points = Json::array();
  for (const auto& [x, y] : of.points)
    if (std::isfinite(x) && std::isfinite(y)) points.push_back(Json::array({x, y}));
  return {{"name", of.name},     {"points", points},     {"line", of.line}, {"dashed", of.dashed},
          {"square", of.square}, {"named", of.is_named}, {"size", of.size}, {"colour", of.colour}};
}

/// JSON that may stand in a script element: nothing in it ends one.
std::string in_script(const Json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, Json::error_handler_t::replace))
    c == '<' ? text += "\\u003c" : text += c;
  return text;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : without_control_characters(text)) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string chart(const ChartAxis& x, const ChartAxis& y, const std::vector<ChartSeries>& series,
                  bool with_legend) {
  Json all = Json::array();
  for (const ChartSeries& of : series) all.push_back(one(of));
  const Json content{{"x", axis(x)}, {"y", axis(y)}, {"legend", with_legend}, {"series", all}};
  return fmt::format(
      "<figure class='chart'><canvas role='img' aria-label='{} against {}'></canvas>\n"
      "<script type='application/json'>{}</script></figure>\n",
      escaped(y.title), escaped(x.title), in_script(content));
}

std::string table(const std::vector<std::string>& titles, const std::vector<TableRow>& rows, TableOf of) {
  const auto is_number = [](const std::string& cell) {
    double value = 0.0;
    const char* const end = cell.data() + cell.size();
    const auto read = std::from_chars(cell.data(), end, value);
    const std::string_view rest(read.ptr, end);
    return read.ec == std::errc() && (rest.empty() || rest == " %" || rest.starts_with(" at "));
  };
  std::string text = "<div class='table'>";
  text += of == TableOf::text ? "<table class='text'>\n" : "<table>\n";
  const bool has_titles = !std::ranges::all_of(titles, &std::string::empty);
  if (has_titles) text += "<tr class='titles'>";
  for (const std::string& title : titles)
    if (has_titles) text += "<th>" + escaped(title) + "</th>";
  if (has_titles) text += "</tr>\n";
  for (const TableRow& row : rows) {
    text += row.style.empty() ? "<tr>" : "<tr class='" + escaped(row.style) + "'>";
    if (row.cells.size() == 1 && titles.size() > 1)
      text += fmt::format("<td colspan='{}'>{}</td>", titles.size(), escaped(row.cells.front()));
    else
      for (const std::string& cell : row.cells)
        text += (is_number(cell) ? "<td class='number'>" : "<td>") + escaped(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string details(const std::string& title, const std::string& body) {
  return "<details><summary>" + escaped(title) + "</summary>\n" + body + "</details>\n";
}

std::string mesh_picture(const MeshPicture& picture) {
  // Written with few digits: a picture has no more pixels, and the page stays small.
  const auto numbers = [](const auto& values, const char* pattern) {
    std::string text = "[";
    for (const double value : values) {
      if (text.size() > 1) text += ',';
      text += std::isfinite(value) ? fmt::format(fmt::runtime(pattern), value) : "null";
    }
    return text + "]";
  };
  const auto places = [&](const std::vector<double>& flat) { return numbers(flat, "{:.6g}"); };
  Json fields = Json::array();
  for (const MeshPicture::PictureField& field : picture.fields)
    fields.push_back({{"name", field.name}, {"unit", field.unit}});
  std::string frames;
  for (const MeshPicture::Frame& frame : picture.frames) {
    std::string values;
    for (const std::vector<double>& of_field : frame.values)
      values += (values.empty() ? "" : ",") + numbers(of_field, "{:.4g}");
    frames += fmt::format("{}{{\"name\":{},\"moved\":{},\"values\":[{}],\"hidden\":{}}}",
                          frames.empty() ? "" : ",\n", in_script(frame.name), places(frame.moved), values,
                          Json(frame.hidden).dump());
  }
  return fmt::format(
      "<figure class='mesh'><canvas role='img' aria-label='{}'></canvas>\n"
      "<script type='application/json'>{{\"title\":{},\"dimension\":{},\"nodes\":{},\n\"outlines\":{},\n\"elements\":{},\n\"fields\":{},\n\"frames\":[{}]}}"
      "</script></figure>\n",
      escaped(picture.title), in_script(picture.title), picture.dimension, places(picture.nodes),
      Json(picture.outlines).dump(), Json(picture.elements).dump(), in_script(fields), frames);
}

std::string page(const std::string& title, const std::string& body, int refresh_seconds) {
  return fmt::format(
      "{7}<meta name='viewport' content='width=device-width, initial-scale=1'>\n{5}<title>{0}</title>\n"
      "<style>\n{1}</style></head><body>\n<h1>{0}</h1>\n{2}"
      "<noscript><p>The charts are drawn by a script, which this browser does not run.</p></noscript>\n"
      "<script>{3}</script>\n<script>\n{4}</script>\n<script>\n{6}</script>\n</body></html>\n",
      escaped(title), style_sheet(), body, chart_library(), chart_script(),
      refresh_seconds > 0 ? fmt::format("<meta http-equiv='refresh' content='{}'>\n", refresh_seconds) : "",
      mesh_script(), kHeadOfPage);
}

std::string why_no_page(const std::filesystem::path& file, const std::string& remedy) {
  const std::string reason = why_not_own(file, kHeadOfPage, "page of polargrain");
  return reason.empty() ? reason : reason + "; " + remedy;
}

}  // namespace polargrain::app
