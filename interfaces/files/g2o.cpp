#include "interfaces/files/g2o.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Pose2;
using common::Pose3;

// What stands on a line after its tag: for a vertex its id and pose, for an edge two ids, a pose and an information.
constexpr std::array<const char*, 3> kPose2Fields = {"x", "y", "yaw"};
constexpr std::array<const char*, 7> kPose3Fields = {"x", "y", "z", "qx", "qy", "qz", "qw"};

/// Other elements of g2o: landmarks, priors, calibration and raw data. They are left out, and said to be.
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
                                                        "PARAMS_SE2OFFSET",
                                                        "PARAMS_SE3OFFSET",
                                                        "PARAMS_CAMERACALIB",
                                                        "EDGE_PROJECT_DISPARITY",
                                                        "ROBOTLASER1",
                                                        "VERTEX_ODOM_DIFFERENTIAL",
                                                        "EDGE_PROJECT_DEPTH",
                                                        "DATA_END",
                                                        "VERTEX_TAG"};
const std::vector<std::string> kUsedTags = {"VERTEX_SE2", "EDGE_SE2", "VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", "FIX"};

/// The words of a line, read from the left; throws where one is not what is asked for.
class Fields {
 public:
  Fields(const LineReader& lines, std::vector<Word> words) : lines_(lines), words_(std::move(words)) {}

  std::string tag() const { return std::string(words_[0].text); }
  std::size_t size() const { return words_.size(); }
  std::size_t left() const { return words_.size() - next_; }
  int column() const { return words_[std::min(next_, words_.size() - 1)].column; }

  void expectNumbers(std::size_t count) const {
    if (left() != count) throw problem(words_.back().column, fmt::format("{} numbers instead of {}", left(), count));
  }

  std::int64_t id() {
    const Word& word = words_[next_++];
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.text.data(), word.text.data() + word.text.size(), value);
    if (error != std::errc() || end != word.text.data() + word.text.size() || value < 0)
      throw problem(word.column, fmt::format("`{}` is not an id, expected 0, 1, 2 ...", word.text));
    return value;
  }

  double number(const char* name) {
    const Word& word = words_[next_++];
    double value = 0.0;
    if (!parseNumber(word.text, value))
      throw problem(word.column, fmt::format("{}: `{}` is not a finite number", name, word.text));
    return value;
  }

  common::InputError problem(int column, const std::string& message) const {
    return lines_.problemAt(column, tag(), message);
  }

 private:
  const LineReader& lines_;
  std::vector<Word> words_;
  std::size_t next_ = 1;
};

Pose2 readPose(Fields& fields, const Pose2&) {
  std::array<double, 3> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = fields.number(kPose2Fields[i]);
  return {v[0], v[1], common::wrapAngle(v[2])};
}

Pose3 readPose(Fields& fields, const Pose3&) {
  const int column = fields.column();
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = fields.number(kPose3Fields[i]);
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  if (!(rotation.norm() > 1e-6) || !std::isfinite(rotation.norm()))
    throw fields.problem(column, fmt::format("a rotation of length {}", rotation.norm()));
  return {rotation.normalized(), {v[0], v[1], v[2]}};
}

template <typename Matrix>
Matrix readInformation(Fields& fields) {
  const int column = fields.column();
  Matrix information;
  for (int row = 0; row < Matrix::RowsAtCompileTime; ++row)
    for (int col = row; col < Matrix::ColsAtCompileTime; ++col)
      information(row, col) = information(col, row) = fields.number("information");
  if (const Eigen::LLT<Matrix> llt(information); llt.info() != Eigen::Success || !llt.matrixLLT().allFinite())
    throw fields.problem(column, "the information is not positive definite");
  return information;
}

/// Vertices and edges of one dimension as they come, and then as a graph.
template <typename Graph>
class Collector {
 public:
  using Pose = typename Graph::Pose;
  static constexpr std::size_t kPoseNumbers = Graph::kErrors == 3 ? 3 : 7;
  static constexpr std::size_t kInformationNumbers = Graph::kErrors * (Graph::kErrors + 1) / 2;

  void addVertex(Fields& fields, int line) {
    fields.expectNumbers(1 + kPoseNumbers);
    const int column = fields.column();
    const std::int64_t id = fields.id();
    const auto [it, is_new] = vertices_.try_emplace(id, Vertex{static_cast<int>(graph_.ids.size()), line});
    if (!is_new) throw fields.problem(column, fmt::format("vertex {} stands in line {} already", id, it->second.line));
    graph_.ids.push_back(id);
    graph_.poses.push_back(readPose(fields, Pose{}));
  }

  void addEdge(Fields& fields, int line) {
    fields.expectNumbers(2 + kPoseNumbers + kInformationNumbers);
    const int column = fields.column();
    const std::int64_t from = fields.id(), to = fields.id();
    if (from == to) throw fields.problem(column, fmt::format("the edge leads from vertex {} to itself", from));
    typename Graph::Edge edge;
    edge.T_from_to = readPose(fields, Pose{});
    edge.information = readInformation<typename Graph::Information>(fields);
    graph_.edges.push_back(edge);
    ends_.push_back({from, to, line, column});
  }

  bool empty() const { return graph_.ids.empty() && graph_.edges.empty(); }

  Graph finish(const std::string& file, const std::map<std::int64_t, common::SourceLocation>& fixed) {
    if (graph_.edges.empty())
      throw common::InputError(common::Problem{{file}, "", "holds vertices but no edges, nothing ties them", ""});
    if (graph_.ids.empty()) takeVerticesFromEdges();
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const Ends& ends = ends_[i];
      graph_.edges[i].from = indexOf(ends.from, "edge", {file, ends.line, ends.column});
      graph_.edges[i].to = indexOf(ends.to, "edge", {file, ends.line, ends.column});
    }
    for (const auto& [id, location] : fixed) graph_.fixed.push_back(indexOf(id, "FIX", location));
    std::sort(graph_.fixed.begin(), graph_.fixed.end());
    return std::move(graph_);
  }

 private:
  struct Vertex {
    int index = 0;
    int line = 0;
  };
  struct Ends {
    std::int64_t from = 0;
    std::int64_t to = 0;
    int line = 0;
    int column = 0;
  };

  void takeVerticesFromEdges() {
    std::set<std::int64_t> ids;
    for (const Ends& ends : ends_) ids.insert({ends.from, ends.to});
    for (const std::int64_t id : ids) {
      vertices_.emplace(id, Vertex{static_cast<int>(graph_.ids.size()), 0});
      graph_.ids.push_back(id);
    }
  }

  int indexOf(std::int64_t id, const char* element, const common::SourceLocation& location) const {
    const auto found = vertices_.find(id);
    if (found != vertices_.end()) return found->second.index;
    throw common::InputError(
        common::Problem{location, element, fmt::format("there is no vertex {}", id), "every vertex needs a line"});
  }

  Graph graph_;
  std::unordered_map<std::int64_t, Vertex> vertices_;
  std::vector<Ends> ends_;
};

class Reading {
 public:
  explicit Reading(LineReader lines) : lines_(std::move(lines)) {}

  G2oFile run() {
    for (std::string_view line; lines_.next(line);) {
      auto words = wordsOf(line.substr(0, line.find('#')));
      if (!words.empty()) add(Fields(lines_, std::move(words)));
    }
    G2oFile file;
    if (!plane_.empty()) {
      file.graph = plane_.finish(lines_.name(), fixed_);
    } else if (!space_.empty()) {
      file.graph = space_.finish(lines_.name(), fixed_);
    } else {
      throw common::InputError(
          common::Problem{{lines_.name()},
                          "",
                          "holds no pose graph, expected VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT or EDGE_SE3:QUAT",
                          ""});
    }
    for (const auto& [tag, left_out] : left_out_) file.warnings.push_back(warningOf(tag, left_out));
    return file;
  }

 private:
  struct LeftOut {
    int first_line = 0;
    int lines = 0;
  };

  void add(Fields fields) {
    const int line = lines_.lineNumber();
    const std::string tag = fields.tag();
    if (tag == "VERTEX_SE2") {
      of(plane_, space_.empty(), fields).addVertex(fields, line);
    } else if (tag == "EDGE_SE2") {
      of(plane_, space_.empty(), fields).addEdge(fields, line);
    } else if (tag == "VERTEX_SE3:QUAT") {
      of(space_, plane_.empty(), fields).addVertex(fields, line);
    } else if (tag == "EDGE_SE3:QUAT") {
      of(space_, plane_.empty(), fields).addEdge(fields, line);
    } else if (tag == "FIX") {
      if (fields.left() == 0) throw fields.problem(1, "expected the ids of the vertices that do not move");
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
  static Collector<Graph>& of(Collector<Graph>& collector, bool other_is_empty, const Fields& fields) {
    if (!other_is_empty) throw fields.problem(1, "the file mixes elements of the plane (SE2) and of space (SE3)");
    return collector;
  }

  std::string warningOf(const std::string& tag, const LeftOut& left_out) const {
    const std::string count = fmt::format("{} line{}", left_out.lines, left_out.lines == 1 ? " is" : "s are");
    common::Problem warning{{lines_.name(), left_out.first_line}, tag, fmt::format("not used, {} left out", count), ""};
    if (!kUnusedTags.contains(tag)) {
      warning.message = fmt::format("unknown tag, {} left out", count);
      warning.hint = common::didYouMean(tag, kUsedTags);
    }
    return toString(warning);
  }

  LineReader lines_;
  Collector<G2oGraph2D> plane_;
  Collector<G2oGraph3D> space_;
  std::map<std::int64_t, common::SourceLocation> fixed_;
  std::map<std::string, LeftOut> left_out_;
};

}  // namespace

G2oFile readG2o(const std::filesystem::path& file) { return readG2o(LineReader(file)); }

G2oFile readG2o(LineReader lines) { return Reading(std::move(lines)).run(); }

}  // namespace swiftlet::interfaces
