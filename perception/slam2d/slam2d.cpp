#include "perception/slam2d/slam2d.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "common/check.hpp"
#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/slam2d/local_reference.hpp"
#include "perception/slam2d/progress.hpp"
#include "perception/slam2d/slam_task_data.hpp"
#include "perception/slam2d/uncertain_pose.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;
using common::Time;

/// A scan is matched to the map after this distance, rotation or time, and becomes a key scan where there is none near.
constexpr double kKeyScanDistance_m = 0.4, kKeyScanRotation_deg = 25.0, kKeyScanTime_s = 2.0;
/// A scan tilted more than this waits half as long again, so that a level one may come first: a tilted scan brings the
/// error of its attitude into the map.
constexpr double kLevelTilt_deg = 2.0, kPatience = 1.5;
/// A scan within this distance and rotation of a key scan does not become one, so that the graph does not grow in known
/// area (docs/decisions/scan_matching.md#021).
constexpr double kReuseDistance_m = 0.25, kReuseRotation_deg = 20.0;
/// Between key scans, a scan is drawn after this distance, rotation or time.
constexpr double kDrawDistance_m = 0.10, kDrawRotation_deg = 6.0, kDrawTime_s = 0.25;

bool isLevel(const ProjectedScan& scan, double tilt_deg) {
  return common::cosTilt(scan.T_odom_body.rotation) >= std::cos(tilt_deg * kRadPerDeg);
}

/// One optimizes; the others repair. A repair may bring stretches near to each other that then contradict others.
constexpr int kMostLastTasks = 4;
enum class Kind { kUsual, kLast, kRepair };

}  // namespace

struct Slam2d::Impl {
  explicit Impl(const Slam2dConfig& config_in)
      : config(config_in), reference(config_in.matcher), earlier_reference(config_in.matcher), map(config_in.grid) {}

  Pose2 T_map_body() const { return poseOf(anchor) * T_anchor_body; }
  const Pose2& poseOf(int key) const { return graph.keys[static_cast<std::size_t>(key)].T_map_body; }

  void follow(const Pose2& T_odom_body, const Eigen::Matrix3d& covariance_since_last);
  bool correct(const ProjectedScan& scan, SlamUpdate& update);
  void addKeyScan(const ProjectedScan& scan, const Pose2& pose, const std::vector<int>& matched_keys,
                  const MatchResult* match);
  MatchResult matchAround(const ProjectedScan& scan, std::vector<int>& keys);
  UncertainPose movedPose() const { return {T_map_body(), common::turned(covariance_anchor, poseOf(anchor).yaw_rad)}; }
  bool optimizationIsDue() const;
  void connectPasses(int other, const MatchResult& match);
  void setAnchor(int key, const Pose2& T_key_body, const Eigen::Matrix3d& covariance_key);
  std::optional<int> keyNear(std::span<const int> keys, const Pose2& pose) const;
  std::vector<GoneColumn> draw(const ProjectedScan& scan);
  SlamTask makeTask(std::vector<LoopCandidate> candidates, Kind kind);

  Slam2dConfig config;
  SlamGraph graph;
  LocalReference reference;
  /// Matches to earlier passes alone. Each reference keeps its own drawing.
  LocalReference earlier_reference;
  SlicedMap map;
  std::optional<double> flight_height_m;
  SlamCounts counts;

  // The pose of the vehicle. It is relative to a key scan, so that it follows when the graph is corrected.
  int anchor = -1;
  Pose2 T_anchor_body;
  Eigen::Matrix3d covariance_anchor = Eigen::Matrix3d::Zero();
  Pose2 T_odom_body;
  Pose2 T_map_odom;
  Time last_stamp;

  Progress last_match, last_drawn;
  double path_length_since_search_m = 0.0, path_length_since_optimization_m = 0.0;
  bool search_due = false;
  bool passes_connected = false;  ///< An edge has connected two passes since the last optimization.

  std::uint64_t tasks = 0;
  int last_tasks = 0;    ///< Taken since no more scans come.
  bool changed = false;  ///< By the last task.
  bool task_outstanding = false;
  std::vector<FoundLoop> rejected;  ///< Loop closures that were rejected.
  std::size_t task_keys = 0;
  int optimized_keys = 0;  ///< Key scans below this index were in the last optimization.
  std::vector<std::pair<int, AttachedScan>> drawn_since_task;
};

/// Moves the estimate by the motion that the filter has measured since the last scan.
void Slam2d::Impl::follow(const Pose2& T_odom_body_now, const Eigen::Matrix3d& covariance_since_last) {
  const Pose2 step = between(T_odom_body, T_odom_body_now);
  const Pose2 moved = T_anchor_body * step;
  const Eigen::Matrix3d step_covariance = stepCovarianceOrUnknown(covariance_since_last);
  covariance_anchor =
      propagated(covariance_anchor, T_anchor_body, moved, common::turned(step_covariance, T_anchor_body.yaw_rad));
  T_anchor_body = moved;
  T_odom_body = T_odom_body_now;
  path_length_since_search_m += step.position_m().norm();
  path_length_since_optimization_m += step.position_m().norm();
}

void Slam2d::Impl::setAnchor(int key, const Pose2& T_key_body, const Eigen::Matrix3d& covariance_key) {
  anchor = key;
  T_anchor_body = T_key_body;
  covariance_anchor = covariance_key;
}

/// The nearest of `keys` within the distance and rotation at which a key scan is reused.
std::optional<int> Slam2d::Impl::keyNear(std::span<const int> keys, const Pose2& pose) const {
  std::optional<int> nearest;
  double nearest_m = kReuseDistance_m;
  for (const int key : keys) {
    const Pose2 step = between(poseOf(key), pose);
    if (step.position_m().norm() > nearest_m || std::abs(step.yaw_rad) > kReuseRotation_deg * kRadPerDeg) continue;
    nearest_m = step.position_m().norm();
    nearest = key;
  }
  return nearest;
}

void Slam2d::Impl::addKeyScan(const ProjectedScan& scan, const Pose2& pose, const std::vector<int>& matched_keys,
                              const MatchResult* match) {
  const int key = static_cast<int>(graph.keys.size());
  auto copy = std::make_shared<ProjectedScan>(scan);
  // Matching needs only the end points; the drawn scan has the rest.
  copy->misses_level_m.clear();
  copy->no_returns_level_m.clear();
  copy->mirror.clear();
  graph.keys.push_back({std::move(copy), pose, {}, {}});
  if (key > 0) graph.add({anchor, key, T_anchor_body, edgeCovariance(covariance_anchor, config), false});
  if (match != nullptr) {
    // One match gives two edges, to the oldest and to the nearest key scan, each with half the weight.
    const auto distance_m = [&](int other) { return between(poseOf(other), pose).position_m().norm(); };
    const int nearest = *std::min_element(matched_keys.begin(), matched_keys.end(),
                                          [&](int a, int b) { return distance_m(a) < distance_m(b); });
    for (const int other : {matched_keys.front(), nearest}) {
      graph.add({other, key, between(poseOf(other), match->T_reference_body),
                 edgeCovariance(2.0 * common::turned(match->covariance, -poseOf(other).yaw_rad), config), false});
      if (matched_keys.front() == nearest) break;
    }
  }
  setAnchor(key, Pose2{}, Eigen::Matrix3d::Zero());
  ++counts.key_scans;
  if (path_length_since_search_m >= config.loops.spacing_m) search_due = true;
}

/// If `keys` are of several passes, matches the scan to the earlier passes alone when they show enough of it, otherwise
/// to the newest pass alone. A match to passes that do not agree yet would be a compromise between them. On return,
/// `keys` are those that were matched.
MatchResult Slam2d::Impl::matchAround(const ProjectedScan& scan, std::vector<int>& keys) {
  constexpr double kHalf_m = 0.15, kHalf_deg = 3.0;  // Half the search window.
  constexpr double kLeastOverlap = 0.75;             // Least share of the scan that overlaps an earlier pass.
  const SearchWindow window{kHalf_m, kHalf_deg * kRadPerDeg};
  const auto newest = newestPass(keys);
  if (newest == keys.begin()) return reference.match(graph, keys, scan, T_map_body(), window);
  std::vector<int> earlier(keys.cbegin(), newest);
  MatchResult match = earlier_reference.match(graph, earlier, scan, T_map_body(), window);
  if (!match.failed && !match.unobservable_motion && match.overlap >= kLeastOverlap) {
    keys = std::move(earlier);
    return match;
  }
  keys.erase(keys.cbegin(), newest);
  return reference.match(graph, keys, scan, T_map_body(), window);
}

/// Connects the anchor with a key scan of another pass: the edge is the motion since the anchor, continued by the
/// match. Two key scans are connected once only, so that the graph does not grow in known area.
void Slam2d::Impl::connectPasses(int other, const MatchResult& match) {
  const std::vector<int>& edges = graph.keys[static_cast<std::size_t>(anchor)].edges;
  if (std::any_of(edges.begin(), edges.end(), [&](int index) {
        const SlamEdge& edge = graph.edges[static_cast<std::size_t>(index)];
        return edge.from == other || edge.to == other;
      }))
    return;
  const Pose2 T_anchor_other = T_anchor_body * between(match.T_reference_body, poseOf(other));
  const Eigen::Matrix3d of_match =
      common::turned(match.covariance, T_anchor_body.yaw_rad - match.T_reference_body.yaw_rad);
  graph.add({anchor, other, T_anchor_other,
             edgeCovariance(propagated(covariance_anchor, T_anchor_body, T_anchor_other, of_match), config), false});
  passes_connected = true;
}

/// The local match: corrects the estimate by the older key scans around it. False if the scan was not used.
bool Slam2d::Impl::correct(const ProjectedScan& scan, SlamUpdate& update) {
  const std::vector<int> connected = connectedKeys(graph, anchor, T_map_body(), config);
  std::vector<int> keys = localReferenceKeys(graph, connected, anchor, T_map_body());
  const MatchResult match = matchAround(scan, keys);
  ++counts.graph_matches;
  if (match.failed) {
    ++counts.local_failures;
    if (match.points_used == 0 || T_anchor_body.position_m().norm() < kReuseDistance_m) return false;
    addKeyScan(scan, T_map_body(), {}, nullptr);
    update.key_scan = true;
    return true;
  }
  if (!match.unobservable_motion && areOfTwoPasses(keys.back(), static_cast<int>(graph.keys.size()) - 1))
    update.known_key = keys.back();
  const bool same_pass = !areOfTwoPasses(keys.back(), anchor);
  const UncertainPose pose =
      same_pass ? weightedMean(movedPose(), {match.T_reference_body, edgeCovariance(match.covariance, config)})
                : UncertainPose{match.T_reference_body, match.covariance};
  // The new anchor may be of the matched passes, or be one that the last optimization has aligned with them.
  std::vector<int> agreeing;
  std::copy_if(connected.begin(), connected.end(), std::back_inserter(agreeing),
               [&](int key) { return key < optimized_keys || (key >= keys.front() && key <= keys.back()); });
  if (const std::optional<int> near = keyNear(agreeing, pose.T_map_body)) {
    if (areOfTwoPasses(*near, anchor)) connectPasses(*near, match);
    setAnchor(*near, between(poseOf(*near), pose.T_map_body),
              edgeCovariance(common::turned(pose.covariance, -poseOf(*near).yaw_rad), config));
    search_due |= optimizationIsDue();
    return true;
  }
  passes_connected |= areOfTwoPasses(keys.front(), static_cast<int>(graph.keys.size()));
  addKeyScan(scan, pose.T_map_body, keys, &match);
  update.key_scan = true;
  return true;
}

std::vector<GoneColumn> Slam2d::Impl::draw(const ProjectedScan& scan) {
  constexpr std::size_t kScansPerKey = 16;  // Newest drawn scans that are kept with a key scan, to redraw the grid.
  AttachedScan attached{std::make_shared<const DrawnScan>(thinForDrawing(scan, config.grid)), T_anchor_body};
  if (config.live_map) map.draw(*attached.scan, T_map_body());
  std::vector<GoneColumn> gone = map.takeGone();
  const Pose2 T_key_map = poseOf(anchor).inverse();
  for (const GoneColumn& column : gone) attached.gone_key_m.push_back(T_key_map * column.place_map_m);
  if (task_outstanding) drawn_since_task.emplace_back(anchor, attached);
  std::deque<AttachedScan>& drawn = graph.keys[static_cast<std::size_t>(anchor)].drawn;
  drawn.push_back(std::move(attached));
  if (drawn.size() > kScansPerKey) {
    const std::vector<Eigen::Vector2d> kept = std::move(drawn.front().gone_key_m);
    drawn.pop_front();
    drawn.front().gone_key_m.insert(drawn.front().gone_key_m.begin(), kept.begin(), kept.end());
  }
  return gone;
}

Slam2d::Slam2d(const Slam2dConfig& config) : impl_(std::make_unique<Impl>(config)) {}
Slam2d::~Slam2d() = default;
Slam2d::Slam2d(Slam2d&&) noexcept = default;
Slam2d& Slam2d::operator=(Slam2d&&) noexcept = default;

SlamUpdate Slam2d::addScan(const ProjectedScan& scan, const Pose2& T_odom_body,
                           const Eigen::Matrix3d& covariance_since_last) {
  Impl& self = *impl_;
  SlamUpdate update;
  ++self.counts.scans;
  const bool first = self.graph.keys.empty();
  if (!isFinite(T_odom_body) || (!first && scan.stamp <= self.last_stamp) ||
      (first && static_cast<int>(scan.points_level_m.size()) < ScanMatcher::kMinPoints)) {
    ++self.counts.ignored_scans;
    update.T_map_body = first ? T_odom_body : self.T_map_body();
    return update;
  }
  self.last_stamp = scan.stamp;
  bool learned = false;
  if (first) {
    self.T_odom_body = T_odom_body;
    self.addKeyScan(scan, T_odom_body, {}, nullptr);  // The map frame starts equal to odom.
    update.key_scan = learned = true;
  } else {
    self.follow(T_odom_body, covariance_since_last);
    const double patience = isLevel(scan, kLevelTilt_deg) ? 1.0 : kPatience;
    if (self.last_match.exceeds(T_odom_body, scan.stamp, patience * kKeyScanDistance_m, patience * kKeyScanRotation_deg,
                                patience * kKeyScanTime_s)) {
      self.last_match = {T_odom_body, scan.stamp};
      learned = self.correct(scan, update);
    }
  }
  if (first) self.last_match = {T_odom_body, scan.stamp};
  if (learned || self.last_drawn.exceeds(T_odom_body, scan.stamp, kDrawDistance_m, kDrawRotation_deg, kDrawTime_s)) {
    update.gone = self.draw(scan);
    self.last_drawn = {T_odom_body, scan.stamp};
    update.drawn = true;
  }
  update.T_map_body = self.T_map_body();
  if (learned && !first) self.T_map_odom = update.T_map_body * T_odom_body.inverse();
  return update;
}

Pose2 Slam2d::T_map_odom() const { return impl_->T_map_odom; }

int Slam2d::anchor() const { return impl_->anchor; }
Pose2 Slam2d::T_anchor_body() const { return impl_->T_anchor_body; }

bool Slam2d::setFlightHeight(double height_m) {
  impl_->flight_height_m = height_m;
  return impl_->map.setFlightHeight(height_m);
}

common::OccupancyGrid Slam2d::snapshot() {
  Impl& self = *impl_;
  if (!self.config.live_map) {
    self.map = drawMap(self.graph, self.config.grid);
    if (self.flight_height_m) (void)self.map.setFlightHeight(*self.flight_height_m);
  }
  return self.map.atFlightHeight();
}

const SlamCounts& Slam2d::counts() const { return impl_->counts; }

std::vector<Slam2d::KeyPose> Slam2d::keyPoses() const {
  std::vector<KeyPose> poses;
  for (const KeyScan& key : impl_->graph.keys) poses.push_back({key.scan->stamp, key.T_map_body});
  return poses;
}

std::span<const SlamEdge> Slam2d::edges() const { return impl_->graph.edges; }

std::optional<SlamTask> Slam2d::takeTask() {
  Impl& self = *impl_;
  if (self.task_outstanding || !self.search_due) return std::nullopt;
  self.search_due = false;
  std::vector<LoopCandidate> candidates =
      loopCandidates(self.graph, static_cast<int>(self.graph.keys.size()) - 1, self.config);
  if (candidates.empty() && !self.optimizationIsDue()) return std::nullopt;
  self.path_length_since_search_m = 0.0;
  return self.makeTask(std::move(candidates), Kind::kUsual);
}

std::optional<SlamTask> Slam2d::takeLastTask() {
  SWIFTLET_CHECK(!impl_->task_outstanding);
  const int before = impl_->graph.keys.empty() ? kMostLastTasks : impl_->last_tasks++;
  if (before >= kMostLastTasks || (before > 0 && !impl_->changed)) return std::nullopt;
  return impl_->makeTask({}, before == 0 ? Kind::kLast : Kind::kRepair);
}

/// Whether an optimization is due that no loop closure asks for. The path length between two of them grows with the
/// graph, so that the work per metre is bounded.
bool Slam2d::Impl::optimizationIsDue() const {
  constexpr double kOptimizationPathPerKey_m = 0.02;  // Path length between two optimizations, for each key scan.
  return passes_connected &&
         path_length_since_optimization_m >= kOptimizationPathPerKey_m * static_cast<double>(graph.keys.size());
}

SlamTask Slam2d::Impl::makeTask(std::vector<LoopCandidate> candidates, Kind kind) {
  counts.loop_candidates += candidates.size();
  task_outstanding = true;
  task_keys = graph.keys.size();
  drawn_since_task.clear();
  auto data = std::make_shared<SlamTask::Data>();
  data->id = ++tasks;
  data->graph = graph;
  data->query = static_cast<int>(graph.keys.size()) - 1;
  data->candidates = std::move(candidates);
  data->rejected = rejected;
  data->is_last = kind == Kind::kLast;
  data->is_repair = kind == Kind::kRepair;
  data->optimize_graph = kind != Kind::kRepair && optimizationIsDue();
  if (data->optimize_graph) {
    passes_connected = false;
    path_length_since_optimization_m = 0.0;
  }
  data->config = config;
  return SlamTask{std::move(data)};
}

bool Slam2d::apply(const SlamResult& result) {
  Impl& self = *impl_;
  SWIFTLET_CHECK(self.task_outstanding && result.data != nullptr && result.data->id == self.tasks, self.tasks);
  self.task_outstanding = false;
  self.rejected = result.data->rejected;
  self.counts.loops_closed += result.accepted.size();
  self.counts.loops_rejected += result.data->rejected_edges.size();
  const std::vector<Pose2>& poses = result.data->T_map_key;
  if (self.changed = !poses.empty(); !self.changed) return false;
  self.optimized_keys = static_cast<int>(self.task_keys);
  // A later key scan keeps its pose relative to the one that its first edge comes from.
  std::vector<Pose2> T_map_before;
  for (const KeyScan& key : self.graph.keys) T_map_before.push_back(key.T_map_body);
  for (std::size_t i = 0; i < self.graph.keys.size(); ++i) {
    KeyScan& key = self.graph.keys[i];
    if (i < self.task_keys) {
      key.T_map_body = poses[i];
    } else {
      const int base = self.graph.edges[static_cast<std::size_t>(key.edges.front())].from;
      key.T_map_body = self.poseOf(base) * between(T_map_before[static_cast<std::size_t>(base)], T_map_before[i]);
    }
  }
  for (auto edge = result.data->rejected_edges.rbegin(); edge != result.data->rejected_edges.rend(); ++edge)
    self.graph.remove(*edge);
  for (const SlamEdge& closure : result.data->closures) self.graph.add(closure);
  self.reference.invalidate();
  self.earlier_reference.invalidate();
  if (result.data->map) {
    self.map = *result.data->map;
    if (self.flight_height_m) (void)self.map.setFlightHeight(*self.flight_height_m);
    for (const auto& [key, attached] : self.drawn_since_task) drawAttached(self.map, self.poseOf(key), attached);
    (void)self.map.takeGone();  // It was told when it went.
  }
  self.drawn_since_task.clear();
  self.T_map_odom = self.T_map_body() * self.T_odom_body.inverse();
  return true;
}

}  // namespace swiftlet::perception
