#include "apps/optimize_report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/recorded_log.hpp"
#include "common/table.hpp"

namespace swiftlet::apps {
namespace {

constexpr std::size_t kListedInText = 10;

std::string listOf(const std::vector<ContradictedEdge>& edges) {
  std::string text;
  for (std::size_t i = 0; i < std::min(edges.size(), kListedInText); ++i)
    text += fmt::format("  {} -> {}: {:.0f} standard deviations\n", edges[i].from, edges[i].to, edges[i].sigmas);
  if (edges.size() > kListedInText) text += fmt::format("  and {} more\n", edges.size() - kListedInText);
  return text;
}

std::string robustText(const OptimizeReport& report) {
  const std::size_t refused = report.contradicted.size();
  std::string text = fmt::format("{} of {} kept, {} refused{}\n", report.closures - refused,
                                 plural(report.closures, "closure", "closures"), refused, refused > 0 ? ":" : "");
  text += listOf(report.contradicted);
  if (report.verdict == GraphVerdict::kCannotTell)
    text += report.variance_factor > 1.0
                ? fmt::format(
                      "cannot tell which closures are right: those that are kept are {:.3g} times as far off as "
                      "their information says\n",
                      std::sqrt(report.variance_factor))
                : "cannot tell which closures are right: those that were refused may be\n";
  return text;
}

std::string plainText(const OptimizeReport& report) {
  if (report.contradicted.empty()) {
    if (report.variance_factor <= 1.0) return "";
    return fmt::format(
        "chi2 {:.6g}, {} degrees of freedom: closures are {:.3g} times as far off as their information says, all "
        "alike\n",
        report.chi2_final, report.degrees_of_freedom, std::sqrt(report.variance_factor));
  }
  const std::string count = plural(report.contradicted.size(), "closure is", "closures are");
  return fmt::format("chi2 {:.6g}, {} degrees of freedom: {} contradicted by the other edges:\n{}{}\n",
                     report.chi2_final, report.degrees_of_freedom, count, listOf(report.contradicted),
                     "--robust leaves out those that are wrong, where it can tell");
}

}  // namespace

const char* toString(GraphVerdict verdict) {
  switch (verdict) {
    case GraphVerdict::kConverged:
      return "converged";
    case GraphVerdict::kNotConverged:
      return "not converged";
    case GraphVerdict::kContradictory:
      return "contradictory";
    case GraphVerdict::kCannotTell:
      return "cannot tell";
  }
  return "";
}

std::string jsonOf(const OptimizeReport& report, const interfaces::G2oFile& file) {
  nlohmann::json json{{"graph", report.graph},
                      {"vertices", report.vertices},
                      {"edges", report.edges},
                      {"closures", report.closures},
                      {"dimension", report.dimension},
                      {"degrees_of_freedom", report.degrees_of_freedom},
                      {"chi2_initial", report.chi2_initial},
                      {"chi2_final", report.chi2_final},
                      {"variance_factor", report.variance_factor},
                      {"start", report.start},
                      {"iterations", report.iterations},
                      {"loose_parts", report.loose_parts},
                      {"seconds", report.seconds},
                      {"verdict", toString(report.verdict)},
                      {"converged", report.verdict == GraphVerdict::kConverged},
                      {"robust", report.robust},
                      {"warnings", file.warnings},
                      {"indefinite_edges", file.indefinite_edges}};
  nlohmann::json& edges = json[report.robust ? "refused_edges" : "worst_edges"] = nlohmann::json::array();
  for (const ContradictedEdge& edge : report.contradicted)
    edges.push_back({{"from", edge.from}, {"to", edge.to}, {"sigmas", edge.sigmas}});
  if (!report.written.empty()) json["written"] = report.written;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string textOf(const OptimizeReport& report) {
  const common::Table table{"",
                            {"graph", "vertices", "edges", "dimension", "chi2 initial", "chi2 final", "start",
                             "converged", "iterations in all", "seconds"},
                            {{{std::filesystem::path(report.graph).filename().string()},
                              {fmt::format("{}", report.vertices)},
                              {fmt::format("{}", report.edges)},
                              {fmt::format("{}", report.dimension)},
                              {fmt::format("{:.6g}", report.chi2_initial)},
                              {fmt::format("{:.8g}", report.chi2_final)},
                              {report.start},
                              {report.verdict == GraphVerdict::kConverged      ? "yes"
                               : report.verdict == GraphVerdict::kNotConverged ? "no"
                                                                               : toString(report.verdict)},
                              {fmt::format("{}", report.iterations)},
                              {fmt::format("{:.2f}", report.seconds)}}}};
  std::string text = toText(table) + (report.robust ? robustText(report) : plainText(report));
  if (report.verdict == GraphVerdict::kNotConverged) text += "it did not converge; more --max-iterations may help\n";
  if (!report.written.empty()) text += fmt::format("written {}\n", report.written);
  return text;
}

}  // namespace swiftlet::apps
