#include "interfaces/files/g2o.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interfaces/files/g2o_collector.hpp"
#include "interfaces/files/g2o_fields.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;

/// Other elements of g2o: landmarks, priors, calibration and raw data. They are left out with a warning.
const std::set<std::string, std::less<>> kUnusedTags = {"VERTEX_XY",
                                                        "EDGE_SE2_XY",
                                                        "EDGE_BEARING_SE2_XY",
                                                        "EDGE_PRIOR_SE2",
                                                        "EDGE_PRIOR_SE2_XY",
                                                        "EDGE_SE2_PRIOR",
                                                        "EDGE_SE2_OFFSET",
                                                        "VERTEX_TRACKXYZ",
                                                        "EDGE_SE3_TRACKXYZ",
                                                        "EDGE_SE3_PRIOR",
                                                        "EDGE_SE3_OFFSET",
                                                        "VERTEX_SE3:EXPMAP",
                                                        "EDGE_SE3:EXPMAP",
                                                        "VERTEX_SIM3:EXPMAP",
                                                        "EDGE_SIM3:EXPMAP",
                                                        "PARAMS_SE2OFFSET",
                                                        "PARAMS_SE3OFFSET",
                                                        "PARAMS_CAMERACALIB",
                                                        "EDGE_PROJECT_DISPARITY",
                                                        "ROBOTLASER1",
                                                        "VERTEX_ODOM_DIFFERENTIAL",
                                                        "EDGE_PROJECT_DEPTH",
                                                        "DATA_END",
                                                        "VERTEX_TAG",
                                                        "EQUIV"};

/// An element that is read.
struct Element {
  bool is_edge = false;
  bool in_plane = true;
  GraphFormat format = GraphFormat::kG2o;
};

const std::map<std::string, Element, std::less<>> kElements = {
    {"VERTEX_SE2", {false, true, GraphFormat::kG2o}},       {"EDGE_SE2", {true, true, GraphFormat::kG2o}},
    {"VERTEX_SE3:QUAT", {false, false, GraphFormat::kG2o}}, {"EDGE_SE3:QUAT", {true, false, GraphFormat::kG2o}},
    {"VERTEX2", {false, true, GraphFormat::kToro}},         {"EDGE2", {true, true, GraphFormat::kToro}},
    {"VERTEX", {false, true, GraphFormat::kToro}},          {"EDGE", {true, true, GraphFormat::kToro}},
    {"VERTEX3", {false, false, GraphFormat::kToro}},        {"EDGE3", {true, false, GraphFormat::kToro}},
};

/// More kinds of unused elements than this are not named where nothing else is in a file.
constexpr std::size_t kMostNamed = 4;
constexpr std::size_t kMostTagBytes = 40;

class Reading {
 public:
  Reading(LineReader lines, const G2oOptions& options) : lines_(std::move(lines)), plane_(options), space_(options) {}

  G2oFile run() {
    for (std::string_view line; lines_.next(line);) {
      auto words = wordsOf(line.substr(0, line.find('#')));
      if (!words.empty()) add(G2oFields(lines_, std::move(words)));
    }
    G2oFile file;
    if (!plane_.empty()) {
      file.graph = plane_.finish(lines_.name(), fixed_, leftOut());
    } else if (!space_.empty()) {
      file.graph = space_.finish(lines_.name(), fixed_, leftOut());
    } else {
      throw common::InputError(
          {lines_.name()}, "",
          Message("g2o.no-graph",
                  "holds no pose graph, expected EDGE_SE2 or EDGE_SE3:QUAT of g2o, EDGE2 or EDGE3 of TORO{}",
                  leftOut()));
    }
    file.indefinite_edges = plane_.indefiniteEdges() + space_.indefiniteEdges();
    for (const auto& [tag, left_out] : left_out_) file.warnings.push_back(warningOf(tag, left_out));
    return file;
  }

 private:
  struct LeftOut {
    int first_line = 0;
    int lines = 0;
  };

  void add(G2oFields fields) {
    const int line = lines_.lineNumber();
    const std::string tag = fields.tag();
    if (const auto known = kElements.find(tag); known != kElements.end()) {
      known->second.in_plane ? addTo(plane_, space_.empty(), known->second, fields)
                             : addTo(space_, plane_.empty(), known->second, fields);
    } else if (tag == "FIX") {
      if (fields.left() == 0)
        throw fields.problem(1, Message("g2o.no-fixed", "expected the ids of the vertices that do not move"));
      while (fields.left() > 0) {
        const int column = fields.column();
        fixed_.emplace(fields.id(), common::SourceLocation{lines_.name(), line, column});
      }
    } else {
      LeftOut& left_out = left_out_[tag];
      if (left_out.lines++ == 0) left_out.first_line = line;
    }
  }

  template <typename Graph>
  void addTo(G2oCollector<Graph>& collector, bool other_is_empty, const Element& element, G2oFields& fields) {
    if (!other_is_empty)
      throw fields.problem(1, Message("g2o.mixed", "the file mixes elements of the plane (SE2) and of space (SE3)"));
    if (element.is_edge)
      collector.addEdge(fields, lines_.lineNumber(), element.format);
    else
      collector.addVertex(fields, lines_.lineNumber(), element.format);
  }

  /// "; not used: 20 EDGE_SE2_XY, 5 VERTEX_XY", the most frequent first; empty if every line was used.
  std::string leftOut() const {
    std::vector<std::pair<int, std::string>> counts;
    for (const auto& [tag, left_out] : left_out_) counts.emplace_back(-left_out.lines, tag);
    std::sort(counts.begin(), counts.end());
    std::string text;
    for (std::size_t i = 0; i < std::min(counts.size(), kMostNamed); ++i)
      text += fmt::format("{} {} {}", i == 0 ? "; not used:" : ",", -counts[i].first,
                          counts[i].second.substr(0, kMostTagBytes));
    return counts.size() > kMostNamed ? text + " ..." : text;
  }

  std::string warningOf(const std::string& tag, const LeftOut& left_out) const {
    const std::string count = fmt::format("{} line{}", left_out.lines, left_out.lines == 1 ? " is" : "s are");
    common::Problem warning{
        {lines_.name(), left_out.first_line}, tag, Message("g2o.not-used", "not used, {} left out", count), ""};
    if (!kUnusedTags.contains(tag)) {
      warning.message = Message("g2o.unknown-tag", "unknown tag, {} left out", count);
      std::vector<std::string> used = {"FIX"};
      for (const auto& element : kElements) used.push_back(element.first);
      // The text after the colon defines how a motion is written: another one may be its inverse, and is no slip.
      const std::size_t colon = tag.find(':');
      if (colon == std::string::npos || common::nearestWord(tag.substr(colon), std::vector<std::string>{":QUAT"}))
        warning.hint = common::didYouMean(tag, used);
    }
    return toString(warning);
  }

  LineReader lines_;
  G2oCollector<G2oGraph2D> plane_;
  G2oCollector<G2oGraph3D> space_;
  std::map<std::int64_t, common::SourceLocation> fixed_;
  std::map<std::string, LeftOut> left_out_;
};

}  // namespace

G2oFile readG2o(const std::filesystem::path& file, const G2oOptions& options) {
  return readG2o(LineReader(file), options);
}

G2oFile readG2o(LineReader lines, const G2oOptions& options) { return Reading(std::move(lines), options).run(); }

}  // namespace swiftlet::interfaces
