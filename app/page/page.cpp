// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/page/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/page/assets.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;

Json axis(const ChartAxis& of) {
  return {{"title", of.title}, {"logarithmic", of.logarithmic}, {"percent", of.percent}};
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
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
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

std::string page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>\n"
      "<meta name='viewport' content='width=device-width, initial-scale=1'>\n<title>{0}</title>\n"
      "<style>\n{1}</style></head><body>\n<h1>{0}</h1>\n{2}"
      "<noscript><p>The charts are drawn by a script, which this browser does not run.</p></noscript>\n"
      "<script>{3}</script>\n<script>\n{4}</script>\n</body></html>\n",
      escaped(title), style_sheet(), body, chart_library(), chart_script());
}

}  // namespace polargrain::app
