#include "apps/error_figures.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/rounding.hpp"

namespace swiftlet::apps {
namespace {

using evaluation::Statistics;

constexpr std::pair<const char*, double Statistics::*> kColumns[] = {
    {"mean", &Statistics::mean}, {"std", &Statistics::standard_deviation},
    {"rmse", &Statistics::rmse}, {"median", &Statistics::median},
    {"min", &Statistics::min},   {"max", &Statistics::max},
};

}  // namespace

Statistics inUnit(Statistics errors, double factor) {
  for (const auto& [name, figure] : kColumns) errors.*figure *= factor;
  return errors;
}

common::Table tableOf(const std::string& title, const std::vector<ErrorFigures>& figures) {
  common::Table table{title, {"error"}, {}};
  for (const auto& column : kColumns) table.columns.emplace_back(column.first);
  for (const ErrorFigures& row : figures) {
    table.rows.push_back({{fmt::format("{}, {}", row.name, row.unit)}});
    for (const auto& column : kColumns)
      table.rows.back().push_back({row.errors.count == 0 ? "" : fmt::format("{:.6f}", row.errors.*column.second)});
  }
  return table;
}

void addTo(nlohmann::json& json, const ErrorFigures& figures) {
  for (const auto& [name, figure] : kColumns) {
    nlohmann::json& value = json[fmt::format("{}{}_{}", figures.prefix, name, figures.unit)];
    if (figures.errors.count > 0) value = common::rounded(figures.errors.*figure, 9);
  }
}

}  // namespace swiftlet::apps
