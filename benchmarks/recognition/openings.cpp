#include "benchmarks/recognition/openings.hpp"

#include <ctime>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>

#include <fmt/core.h>

#include "common/quantile.hpp"
#include "perception/recognition/object_tracker.hpp"
#include "perception/recognition/opening_recognizer.hpp"

namespace swiftlet::benchmarks {
namespace {

using perception::HouseItem;
using perception::HouseScene;
using perception::ItemInView;
using perception::Passage;
using perception::PlacedItem;
using perception::Recognized;

/// A recognition belongs to an opening whose middle, along the wall, is this near.
constexpr double kSame_m = 0.25;
constexpr double kCovered_px = 40.0;

const char* nameOf(HouseItem kind) {
  constexpr const char* kNames[] = {"open window", "open door", "closed window", "closed door",
                                    "mirror",      "picture",   "shelf"};
  return kNames[static_cast<std::size_t>(kind)];
}

struct Counts {
  int right = 0, wrong = 0, sure_right = 0, sure_wrong = 0;
  std::map<std::string, int> wrong_of;
  std::array<int, 4> due{}, found{};        ///< By distance, from 1, 2, 3 and 4 m on: open, whole, 40 px.
  std::array<int, 3> due_at{}, found_at{};  ///< By incidence, from 0, 20 and 40 degrees on.
  int due_named = 0, named = 0;             ///< Window as window, door as door.
  int closed_due = 0, closed_found = 0, closed_wrong = 0;
  std::vector<double> error_near_m, error_m, size_error_m, nees, ms;
};

double processorMs() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// The item at a place of the wall; null without one.
const PlacedItem* itemAt(const HouseScene& scene, const Eigen::Vector3d& place) {
  const PlacedItem* nearest = nullptr;
  for (const PlacedItem& item : scene.items) {
    const double off_m = std::abs(place.y() - item.centre_m().y());
    if (off_m > 0.5 * (item.left_m - item.right_m)) continue;
    nearest = &item;
  }
  return std::abs(place.x()) < 0.3 ? nearest : nullptr;
}

bool isAt(const PlacedItem& item, const Eigen::Vector3d& place) {
  return std::abs(place.x()) < kSame_m && std::abs(place.y() - item.centre_m().y()) < kSame_m;
}

class Counter {
 public:
  explicit Counter(bool verbose) : verbose_(verbose) {}

  void add(const HouseScene& scene, const std::vector<Recognized>& found, const simulation::RayCaster& rays,
           bool heights) {
    std::vector<const Recognized*> taken(scene.items.size(), nullptr);
    for (const Recognized& one : found) addRecognized(scene, one, taken);
    for (std::size_t i = 0; i < scene.items.size(); ++i) addItem(scene, i, taken[i], rays, heights);
  }
  Counts counts;

 private:
  void addRecognized(const HouseScene& scene, const Recognized& one, std::vector<const Recognized*>& taken) {
    const Eigen::Vector3d place = scene.T_house_camera() * one.T_sensor_object.position_m;
    const PlacedItem* item = itemAt(scene, place);
    if (one.what == "mirror") return;
    if (one.passage == Passage::kClosed) {
      const bool right = item && (item->kind == HouseItem::kClosedDoor || item->kind == HouseItem::kClosedWindow);
      if (right) taken[static_cast<std::size_t>(item - scene.items.data())] = &one;
      if (!right) ++counts.closed_wrong;
      return;
    }
    if (item && item->isOpen() && isAt(*item, place)) {
      ++counts.right;
      if (one.confidence > perception::kSureOpening) ++counts.sure_right;
      taken[static_cast<std::size_t>(item - scene.items.data())] = &one;
      return;
    }
    ++counts.wrong;
    if (one.confidence > perception::kSureOpening) ++counts.sure_wrong;
    ++counts.wrong_of[item ? nameOf(item->kind) : "elsewhere"];
    if (verbose_)
      std::printf("room %d: false %s at %.2f %.2f %.2f, %.2f x %.2f, on %s\n", static_cast<int>(scene.index),
                  one.what.c_str(), place.x(), place.y(), place.z(), one.size_m.x(), one.size_m.y(),
                  item ? nameOf(item->kind) : "nothing");
  }

  void addItem(const HouseScene& scene, std::size_t i, const Recognized* found, const simulation::RayCaster& rays,
               bool heights) {
    const PlacedItem& item = scene.items[i];
    const Eigen::Vector3d from = scene.T_house_body.position_m;
    const Eigen::Vector2d off = (item.centre_m() - from).head<2>();
    const double distance_m = off.norm(),
                 incidence_deg = std::abs(std::atan2(off.y(), off.x())) * 180.0 / std::numbers::pi;
    if (distance_m < 1.0 || distance_m >= 5.0 || incidence_deg > 60.0) return;
    const ItemInView view = inView(scene, item, rays);
    if (!view.whole || view.size_px < kCovered_px) return;
    if (item.kind == HouseItem::kClosedDoor || item.kind == HouseItem::kClosedWindow) {
      ++counts.closed_due;
      if (found) ++counts.closed_found;
    }
    if (!item.isOpen()) return;
    const auto far = static_cast<std::size_t>(distance_m) - 1,
               turned = static_cast<std::size_t>(std::min(2.0, incidence_deg / 20.0));
    ++counts.due[far];
    ++counts.due_at[turned];
    if (!found && verbose_)
      std::printf("room %d: missed %s %.2f x %.2f at %.1f m, %.0f deg, %.0f px\n", static_cast<int>(scene.index),
                  nameOf(item.kind), item.left_m - item.right_m, item.top_m - item.bottom_m, distance_m, incidence_deg,
                  view.size_px);
    if (!found) return;
    ++counts.found[far];
    ++counts.found_at[turned];
    measure(scene, item, *found, distance_m, heights);
  }

  void measure(const HouseScene& scene, const PlacedItem& item, const Recognized& found, double distance_m,
               bool heights) {
    Eigen::Vector3d error = scene.T_house_camera() * found.T_sensor_object.position_m - item.centre_m();
    if (!heights) error.z() = 0.0;
    counts.error_m.push_back(error.norm());
    if (distance_m < 2.5) counts.error_near_m.push_back(error.norm());
    counts.size_error_m.push_back(std::abs(found.size_m.x() - (item.left_m - item.right_m)));
    if (!heights) return;
    ++counts.due_named;
    const bool door = item.kind == HouseItem::kOpenDoor;
    if (found.what == (door ? "door" : "window")) ++counts.named;
    const Eigen::Vector3d in_camera = scene.T_house_camera().rotation.conjugate() * error;
    const Eigen::Matrix3d covariance = found.covariance.bottomRightCorner<3, 3>();
    counts.nees.push_back(in_camera.dot(covariance.inverse() * in_camera) / 3.0);
  }

  bool verbose_;
};

std::string percent(int part, int whole) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f (%d of %d)", whole > 0 ? 100.0 * part / whole : 0.0, part, whole);
  return text;
}

std::string spread(const std::vector<double>& values, double scale) {
  if (values.empty()) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%.1f / %.1f (%d)", scale * common::quantile(values, 0.5),
                scale * common::quantile(values, 0.95), static_cast<int>(values.size()));
  return text;
}

template <std::size_t n>
int sum(const std::array<int, n>& values) {
  int all = 0;
  for (const int value : values) all += value;
  return all;
}

void print(const char* title, const Counts& c) {
  std::printf("\n| %s | |\n| --- | --- |\n", title);
  std::printf("| precision, %% | %s |\n", percent(c.right, c.right + c.wrong).c_str());
  if (c.due_named > 0)
    std::printf("| of the sure ones, %% | %s |\n", percent(c.sure_right, c.sure_right + c.sure_wrong).c_str());
  for (const auto& [what, count] : c.wrong_of) std::printf("| false at: %s | %d |\n", what.c_str(), count);
  std::printf("| recall, %% | %s |\n", percent(sum(c.found), sum(c.due)).c_str());
  for (std::size_t i = 0; i < c.due.size(); ++i)
    std::printf("| from %d to %d m | %s |\n", static_cast<int>(i) + 1, static_cast<int>(i) + 2,
                percent(c.found[i], c.due[i]).c_str());
  for (std::size_t i = 0; i < c.due_at.size(); ++i)
    std::printf("| at %d to %d degrees | %s |\n", 20 * static_cast<int>(i), 20 * static_cast<int>(i) + 20,
                percent(c.found_at[i], c.due_at[i]).c_str());
  std::printf("| centre, cm, median / 95 %%, below 2.5 m | %s |\n", spread(c.error_near_m, 100.0).c_str());
  std::printf("| centre, cm, median / 95 %% | %s |\n", spread(c.error_m, 100.0).c_str());
  std::printf("| width, cm, median / 95 %% | %s |\n", spread(c.size_error_m, 100.0).c_str());
  if (c.due_named > 0) {
    std::printf("| window and door told apart, %% | %s |\n", percent(c.named, c.due_named).c_str());
    std::printf("| closed ones found, %% | %s |\n", percent(c.closed_found, c.closed_due).c_str());
    std::printf("| closed ones that are none | %d |\n", c.closed_wrong);
    std::printf("| error squared over its covariance, median / 95 %% | %s |\n", spread(c.nees, 1.0).c_str());
  }
  std::printf("| ms a frame, median / 95 %% | %s |\n", spread(c.ms, 1.0).c_str());
}

/// What is confirmed after several looks.
struct TrackCounts {
  int right = 0, wrong = 0, due = 0, found = 0;
  std::map<std::string, int> wrong_of;
  std::vector<double> error_m;
};

/// Looks at one item of the room from several places, and judges what is confirmed as open.
void follow(const HouseScene& scene, const simulation::RayCaster& rays, bool verbose, TrackCounts& counts) {
  perception::OpeningRecognizer recognizer({});
  perception::ObjectTracker tracker;
  const common::KeyPoses keys{1, {{}}};
  std::vector<int> due(scene.items.size(), 0);
  std::vector<std::string> said(scene.items.size());
  for (const HouseScene& one : perception::looksAround(scene, rays)) {
    const perception::HouseView view = perception::look(one, rays);
    const std::vector<Recognized> recognized = recognizer.recognize(
        {nullptr, &view.scan, &view.frame, one.R_level_camera, one.T_camera_laser(), &view.behind_m});
    for (const Recognized& each : recognized)
      if (const PlacedItem* item = itemAt(scene, one.T_house_camera() * each.T_sensor_object.position_m))
        said[static_cast<std::size_t>(item - scene.items.data())] +=
            fmt::format(" {} {} {:.2f};", each.what, toString(each.passage), each.confidence);
    tracker.add(recognized, {0, one.T_house_camera(), 0.0, 0.0, {}, keys});
    for (std::size_t i = 0; i < scene.items.size(); ++i) {
      const ItemInView seen = perception::inView(one, scene.items[i], rays);
      if (scene.items[i].isOpen() && seen.whole && seen.size_px >= kCovered_px) ++due[i];
    }
  }
  std::vector<bool> found(scene.items.size(), false);
  for (const common::RecognizedObject& opening : tracker.objects(keys)) {
    if (opening.passage != Passage::kOpen) continue;
    const Eigen::Vector3d& centre_m = opening.T_map_object.position_m;
    const PlacedItem* item = itemAt(scene, centre_m);
    if (item && item->isOpen() && isAt(*item, centre_m)) {
      ++counts.right;
      found[static_cast<std::size_t>(item - scene.items.data())] = true;
      counts.error_m.push_back((centre_m - item->centre_m()).head<2>().norm());
    } else {
      ++counts.wrong;
      ++counts.wrong_of[item ? nameOf(item->kind) : "elsewhere"];
      if (verbose)
        std::printf("room %d: false on %s:%s\n", static_cast<int>(scene.index), item ? nameOf(item->kind) : "nothing",
                    item ? said[static_cast<std::size_t>(item - scene.items.data())].c_str() : "");
    }
  }
  // Three looks confirm.
  for (std::size_t i = 0; i < due.size(); ++i) {
    if (due[i] < 3) continue;
    ++counts.due;
    if (found[i]) ++counts.found;
    if (!found[i] && verbose)
      std::printf("room %d: missed %s %.2f x %.2f:%s\n", static_cast<int>(scene.index), nameOf(scene.items[i].kind),
                  scene.items[i].left_m - scene.items[i].right_m, scene.items[i].top_m - scene.items[i].bottom_m,
                  said[i].c_str());
  }
}

}  // namespace

void followOpenings(const OpeningRun& run) {
  TrackCounts counts;
  for (std::uint64_t i = run.first; i < run.first + run.rooms; ++i) {
    const HouseScene scene = perception::drawHouse(run.houses, run.seed, i);
    const simulation::RayCaster rays(scene.world);
    follow(scene, rays, run.verbose, counts);
  }
  std::printf("\n| tracked | |\n| --- | --- |\n");
  std::printf("| precision, %% | %s |\n", percent(counts.right, counts.right + counts.wrong).c_str());
  for (const auto& [what, count] : counts.wrong_of) std::printf("| false at: %s | %d |\n", what.c_str(), count);
  std::printf("| recall of those that three looks show whole, %% | %s |\n", percent(counts.found, counts.due).c_str());
  std::printf("| centre, horizontally, cm, median / 95 %% | %s |\n", spread(counts.error_m, 100.0).c_str());
}

void countOpenings(const OpeningRun& run) {
  perception::OpeningRecognizer by_depth({});
  perception::ScanOpeningRecognizer by_scan({});
  Counter with_scan(false), alone(false), scans(false), turned_round(run.verbose);
  for (std::uint64_t i = run.first; i < run.first + run.rooms; ++i) {
    const HouseScene scene = perception::drawHouse(run.houses, run.seed, i);
    const simulation::RayCaster rays(scene.world);
    const perception::HouseView view = perception::look(scene, rays);
    const auto look = [&](perception::Recognizer& recognizer, const perception::Observation& observation,
                          Counter& counter, bool heights) {
      const double begin_ms = processorMs();
      std::vector<Recognized> found = recognizer.recognize(observation);
      counter.counts.ms.push_back(processorMs() - begin_ms);
      if (!heights)
        for (Recognized& one : found) one.T_sensor_object = scene.T_camera_laser() * one.T_sensor_object;
      counter.add(scene, found, rays, heights);
    };
    look(by_depth, {nullptr, &view.scan, &view.frame, scene.R_level_camera, scene.T_camera_laser()}, with_scan, true);
    look(by_depth, {nullptr, &view.scan, &view.frame, scene.R_level_camera, scene.T_camera_laser(), &view.behind_m},
         turned_round, true);
    look(by_depth, {nullptr, nullptr, &view.frame, scene.R_level_camera, {}}, alone, true);
    look(by_scan, {nullptr, &view.scan, nullptr, scene.R_level_camera, scene.T_camera_laser()}, scans, false);
  }
  print("depth and scan", with_scan.counts);
  print("depth and scan, having looked behind before", turned_round.counts);
  print("depth alone", alone.counts);
  print("scan alone", scans.counts);
}

}  // namespace swiftlet::benchmarks
