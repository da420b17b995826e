#include "perception/slam2d/slam_graph.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace swiftlet::perception {
namespace {

using common::Pose2;

double largerSigma(const Eigen::Matrix3d& covariance) {
  const double a = covariance(0, 0), b = covariance(1, 1), c = covariance(0, 1);
  return std::sqrt(std::max(0.0, 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + c * c)));
}

/// Continues the projection from one end of an edge to the other.
ProjectedUncertainty projectedAlong(const SlamGraph& graph, const SlamEdge& edge, const ProjectedUncertainty& from) {
  const int other = edge.from == from.key ? edge.to : edge.from;
  const Pose2& here = graph.keys[static_cast<std::size_t>(from.key)].T_map_body;
  const Pose2& there = graph.keys[static_cast<std::size_t>(other)].T_map_body;
  const double edge_yaw_rad = graph.keys[static_cast<std::size_t>(edge.from)].T_map_body.yaw_rad;
  // Against the direction of the edge, its own heading error rotates the step as well.
  Eigen::Matrix3d own = common::turned(edge.covariance, edge_yaw_rad);
  if (edge.to == from.key) own = propagated(own, here, there, Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d covariance = propagated(from.covariance_map, here, there, own);
  return {other, covariance, largerSigma(covariance)};
}

}  // namespace

void SlamGraph::add(SlamEdge edge) {
  const int index = static_cast<int>(edges.size());
  keys[static_cast<std::size_t>(edge.from)].edges.push_back(index);
  keys[static_cast<std::size_t>(edge.to)].edges.push_back(index);
  edges.push_back(std::move(edge));
}

void SlamGraph::remove(int edge) {
  edges.erase(edges.begin() + edge);
  for (KeyScan& key : keys) {
    std::erase(key.edges, edge);
    for (int& index : key.edges)
      if (index > edge) --index;
  }
}

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

std::vector<ProjectedUncertainty> projectUncertainty(const SlamGraph& graph, int start, double max_sigma_m,
                                                     std::span<const int> wanted) {
  struct Reached {
    ProjectedUncertainty uncertainty;
    bool done = false;
  };
  std::vector<Reached> reached;
  // Index into `reached`, which holds only the few key scans that are near.
  std::vector<std::int32_t> index_of(graph.keys.size(), -1);
  std::vector<char> is_wanted(wanted.empty() ? 0 : graph.keys.size(), 0);
  for (const int key : wanted) is_wanted[static_cast<std::size_t>(key)] = 1;
  auto missing = std::count(is_wanted.begin(), is_wanted.end(), 1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](const ProjectedUncertainty& uncertainty) {
    std::int32_t& index = index_of[static_cast<std::size_t>(uncertainty.key)];
    if (index < 0) {
      index = static_cast<std::int32_t>(reached.size());
      reached.push_back({uncertainty});
    } else {
      Reached& known = reached[static_cast<std::size_t>(index)];
      if (uncertainty.sigma_m >= known.uncertainty.sigma_m) return;
      known.uncertainty = uncertainty;
    }
    open.push({uncertainty.sigma_m, uncertainty.key});
  };
  const auto isDone = [&](int key) {
    const std::int32_t index = index_of[static_cast<std::size_t>(key)];
    return index >= 0 && reached[static_cast<std::size_t>(index)].done;
  };
  reach({start, Eigen::Matrix3d::Zero(), 0.0});

  std::vector<ProjectedUncertainty> result;
  while (!open.empty()) {
    const auto [sigma, key] = open.top();
    open.pop();
    Reached& here = reached[static_cast<std::size_t>(index_of[static_cast<std::size_t>(key)])];
    if (here.done) continue;
    if (sigma > max_sigma_m) break;
    here.done = true;
    result.push_back(here.uncertainty);
    if (!wanted.empty() && is_wanted[static_cast<std::size_t>(key)] != 0 && --missing == 0) break;
    for (const int index : graph.keys[static_cast<std::size_t>(key)].edges) {
      const SlamEdge& edge = graph.edges[static_cast<std::size_t>(index)];
      if (!isDone(edge.from == key ? edge.to : edge.from)) reach(projectedAlong(graph, edge, result.back()));
    }
  }
  return result;
}

void drawAttached(SlicedMap& map, const Pose2& T_map_key, const AttachedScan& attached) {
  map.draw(*attached.scan, T_map_key * attached.T_key_body);
  for (const Eigen::Vector2d& place_key_m : attached.gone_key_m) map.forget(T_map_key * place_key_m);
}

SlicedMap drawMap(const SlamGraph& graph, const GridDrawingConfig& config) {
  struct Item {
    const AttachedScan* attached;
    const KeyScan* key;
  };
  std::vector<Item> items;
  for (const KeyScan& key : graph.keys)
    for (const AttachedScan& attached : key.drawn) items.push_back({&attached, &key});
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.attached->scan->stamp < b.attached->scan->stamp; });
  SlicedMap map(config);
  for (const Item& item : items) drawAttached(map, item.key->T_map_body, *item.attached);
  return map;
}

optimization::PoseEdge2D toPoseEdge(const SlamEdge& edge) {
  return {edge.from, edge.to, edge.T_from_to, edge.covariance.inverse(), edge.loop};
}

optimization::PoseGraph2D toPoseGraph(const SlamGraph& graph) {
  optimization::PoseGraph2D result;
  for (const KeyScan& key : graph.keys) result.poses.push_back(key.T_map_body);
  for (const SlamEdge& edge : graph.edges) result.edges.push_back(toPoseEdge(edge));
  return result;
}

std::vector<int>::const_iterator newestPass(const std::vector<int>& keys) {
  auto begin = keys.end();
  while (begin != keys.begin() && (begin == keys.end() || !areOfTwoPasses(*(begin - 1), *begin))) --begin;
  return begin;
}

}  // namespace swiftlet::perception
