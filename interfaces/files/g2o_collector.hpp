// Collects the elements of a g2o file of one dimension, and makes the graph.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "common/error.hpp"
#include "interfaces/files/g2o_fields.hpp"
#include "interfaces/files/g2o_graph.hpp"

namespace swiftlet::interfaces {

/// Throws InputError: at once for elements that are wrong in themselves, at the end for elements that refer to missing
/// ones.
template <typename Graph>
class G2oCollector {
 public:
  using Pose = typename Graph::Pose;
  static constexpr bool kPlane = Graph::kErrors == 3;
  static constexpr std::size_t kInformationNumbers = Graph::kErrors * (Graph::kErrors + 1) / 2;

  explicit G2oCollector(const G2oOptions& options) : options_(options) {}

  void addVertex(G2oFields& fields, int line, GraphFormat format) {
    fields.expectNumbers(1 + poseNumbers(format));
    const int column = fields.column();
    const std::int64_t id = fields.id();
    const auto [it, is_new] = vertices_.try_emplace(id, Vertex{static_cast<int>(graph_.ids.size()), line});
    if (!is_new)
      throw fields.problem(
          column, common::Message("g2o.vertex-twice", "vertex {} stands in line {} already", id, it->second.line));
    graph_.ids.push_back(id);
    graph_.poses.push_back(poseIn(fields, format));
  }

  void addEdge(G2oFields& fields, int line, GraphFormat format) {
    fields.expectInformation(2 + poseNumbers(format), kInformationNumbers, informationHint(format));
    const int column = fields.column();
    const std::int64_t from = fields.id(), to = fields.id();
    if (from == to)
      throw fields.problem(column,
                           common::Message("g2o.edge-to-itself", "the edge leads from vertex {} to itself", from));
    typename Graph::Edge edge;
    edge.T_from_to = poseIn(fields, format);
    edge.information = definite(fields, format);
    if (format == GraphFormat::kToro) edge.information = fromToro(edge);
    graph_.edges.push_back(edge);
    ends_.push_back({from, to, line, column});
  }

  std::size_t indefiniteEdges() const { return indefinite_edges_; }
  bool empty() const { return graph_.ids.empty() && graph_.edges.empty(); }

  /// `left_out` is for the error where no edge was read: "; not used: 20 EDGE_SE2_XY".
  Graph finish(const std::string& file, const std::map<std::int64_t, common::SourceLocation>& fixed,
               const std::string& left_out) {
    if (graph_.edges.empty())
      throw common::InputError(
          {file}, "", common::Message("g2o.no-edges", "holds vertices, but no edges connect them{}", left_out));
    if (first_problem_) throw indefiniteError();
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
  using Information = typename Graph::Information;

  static std::size_t poseNumbers(GraphFormat format) { return kPlane ? 3 : format == GraphFormat::kToro ? 6 : 7; }

  static const char* informationHint(GraphFormat format) {
    if (!kPlane)
      return "write its upper triangle row by row; for edges of equal weight it is "
             "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";
    return format == GraphFormat::kToro
               ? "write its xx, xy, yy, yaw yaw, x yaw and y yaw; for edges of equal weight it is 1 0 1 1 0 0"
               : "write its upper triangle row by row; for edges of equal weight it is 1 0 0 1 0 1";
  }

  static Pose poseIn(G2oFields& fields, GraphFormat format) {
    if constexpr (kPlane) {
      return fields.pose2();
    } else {
      return format == GraphFormat::kToro ? fields.pose3OfAngles() : fields.pose3();
    }
  }

  static Information informationIn(G2oFields& fields, GraphFormat format) {
    if constexpr (kPlane)
      if (format == GraphFormat::kToro) return fields.toroInformation();
    return fields.template information<Information>();
  }

  /// TORO's information of an edge in the plane belongs to the error in the frame where the edge starts (its
  /// treeoptimizer2), g2o's to that in the frame where it ends. In space TORO's is about angles, g2o's about the vector
  /// part of a quaternion, which is half of them.
  static Information fromToro(const typename Graph::Edge& edge) {
    if constexpr (kPlane) {
      return common::turned(edge.information, -edge.T_from_to.yaw_rad);
    } else {
      Information information = edge.information;
      information.template bottomRows<3>() *= 2.0;
      information.template rightCols<3>() *= 2.0;
      return information;
    }
  }

  static bool isPositiveDefinite(const Information& information) {
    const Eigen::LLT<Information> llt(information);
    return llt.info() == Eigen::Success && llt.matrixLLT().allFinite();
  }

  /// The information of an edge, if it is valid: see indefiniteError.
  Information definite(G2oFields& fields, GraphFormat format) {
    const int column = fields.column();
    Information information = informationIn(fields, format);
    if (isPositiveDefinite(information)) return information;
    ++indefinite_edges_;
    Information diagonal = information.diagonal().asDiagonal();
    if (options_.ignore_cross_terms && isPositiveDefinite(diagonal)) return diagonal;
    if (++refused_edges_ == 1)
      first_problem_ =
          fields.problem(column, common::Message("g2o.indefinite", "the information is not positive definite"))
              .problems()
              .front();
    return diagonal;
  }

  common::InputError indefiniteError() const {
    common::Problem problem = *first_problem_;
    problem.message +=
        fmt::format("{}; this holds for {} of {} edges", options_.ignore_cross_terms ? ", not even its diagonal" : "",
                    refused_edges_, graph_.edges.size());
    if (!options_.ignore_cross_terms) problem.hint = "--ignore-cross-terms uses the diagonals of these alone";
    return common::InputError(std::move(problem));
  }

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
    throw common::InputError(location, element, common::Message("g2o.no-vertex", "there is no vertex {}", id),
                             "every vertex needs a line");
  }

  Graph graph_;
  std::unordered_map<std::int64_t, Vertex> vertices_;
  std::vector<Ends> ends_;
  G2oOptions options_;
  std::size_t indefinite_edges_ = 0;  ///< Edges whose information in the file is not positive definite.
  std::size_t refused_edges_ = 0;     ///< Edges that cannot be used even with the diagonal of their information alone.
  std::optional<common::Problem> first_problem_;  ///< The first edge whose information cannot be used.
};

}  // namespace swiftlet::interfaces
