// Cases in which a localized robot must detect whether its pose is still right.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perception/localization/localizer.hpp"
#include "perception/localization/scan_support.hpp"
#include "tests/localization/buildings.hpp"

namespace swiftlet::test {

enum class CaseKind {
  kUndisturbed,       ///< Nothing happens.
  kChangedFurniture,  ///< 20 to 35 % of the beams end on things that are not in the map. Nothing else happens.
  kKidnapped,         ///< Carried elsewhere in the building, unnoticed by its odometry.
  kKidnappedChanged,  ///< Carried elsewhere, and the furniture has changed.
  kWrongMap,          ///< Given a start in a map of another building.
  kTwin,              ///< Starts anywhere between two identical wings, without a given start.
};
inline const char* toString(CaseKind kind) {
  switch (kind) {
    case CaseKind::kUndisturbed:
      return "undisturbed";
    case CaseKind::kChangedFurniture:
      return "changed furniture";
    case CaseKind::kKidnapped:
      return "kidnapped";
    case CaseKind::kKidnappedChanged:
      return "kidnapped, changed furniture";
    case CaseKind::kWrongMap:
      return "wrong map";
    case CaseKind::kTwin:
      return "twin corridors";
  }
  return "?";
}

/// A pose farther than this from the truth is wrong.
inline constexpr double kWrong_m = 1.0;
inline constexpr double kWrong_rad = 0.5;
/// The time within which a wrong pose must be noticed.
inline constexpr double kNotice_s = 2.0;
inline constexpr double kScan_s = 0.1;

inline Building buildingOf(std::uint64_t seed, bool large_hall) { return large_hall ? hall(seed) : offices(seed); }

/// Adds furniture until the given share of beams is disturbed.
inline PlanarWorld changedFurniture(const Building& building, double share, std::uint64_t seed) {
  common::RandomStream random(seed, "changed furniture");
  const Walks walks(building);
  std::vector<common::Pose2> views;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2d at = walks.somewhere(random);
    views.push_back({at.x(), at.y(), random.uniform(-3.1, 3.1)});
  }
  struct Beam {
    Eigen::Vector3d from_m, direction;
    double before_m, now_m;
  };
  std::vector<Beam> beams;
  for (const common::Pose2& view : views)
    for (int k = 0; k < 90; ++k) {
      const Eigen::Vector3d from(view.x_m, view.y_m, 1.0), to(std::cos(0.0698 * k), std::sin(0.0698 * k), 0.0);
      const double range_m = building.world.cast(from, to);
      beams.push_back({from, to, range_m, range_m});
    }
  PlanarWorld world = building.world;
  double disturbed = 0.0;
  for (int i = 0; i < 200 && disturbed < share; ++i) {
    const auto which = static_cast<std::size_t>(random.uniform() * static_cast<double>(building.rooms.size()));
    PlanarWorld box;
    addFurniture(box, building.rooms[which], 1, random);
    world.walls.insert(world.walls.end(), box.walls.begin(), box.walls.end());
    int changed = 0;
    for (Beam& beam : beams) {
      beam.now_m = std::min(beam.now_m, box.cast(beam.from_m, beam.direction));
      changed += beam.before_m - beam.now_m > 0.3 ? 1 : 0;
    }
    disturbed = static_cast<double>(changed) / static_cast<double>(beams.size());
  }
  return world;
}

/// The result of one case.
struct CaseResult {
  CaseKind kind = CaseKind::kUndisturbed;
  std::uint64_t seed = 0;
  /// Stretches in which the pose was wrong although it was accepted at their beginning, or in which the map is of
  /// another place. They count as noticed if the localizer gave the pose up within kNotice_s.
  int wrong = 0, noticed = 0;
  int alarms = 0, false_alarms = 0;  ///< Times it reported to be lost, and how often the pose was right then.
  double worst_delay_s = 0.0;
  bool refuted = false;                                 ///< The map was called that of another place.
  int scans = 0, localized = 0, falsely_localized = 0;  ///< Numbers of scans. The last one counts those with a wrong
                                                        ///< pose that was accepted for longer than kNotice_s.
  std::vector<double> error_m;                          ///< Position errors while localized and not wrong.
  std::vector<std::string> story;
};

/// The features of every scan at the estimated pose, for calibration.
struct SupportSample {
  bool wrong = false;
  perception::ScanSupport support;
};

/// A walk of `duration_s`, scored scan by scan.
class LostCase {
 public:
  LostCase(CaseKind kind, std::uint64_t seed, perception::LocalizerConfig config = {}) : kind_(kind), seed_(seed) {
    result_.kind = kind;
    result_.seed = seed;
    common::RandomStream random(seed, "case");
    const bool large = random.chance(0.35);
    mapped_ = kind == CaseKind::kTwin ? twinWings(seed) : buildingOf(seed, large);
    truth_building_ = kind == CaseKind::kWrongMap ? buildingOf(seed + 1'000'003, random.chance(0.35)) : mapped_;
    if (kind == CaseKind::kChangedFurniture || kind == CaseKind::kKidnappedChanged)
      truth_building_.world = changedFurniture(mapped_, random.uniform(0.20, 0.30), seed);
    world_ = truth_building_.world;
    walks_ = std::make_unique<Walks>(truth_building_);
    walker_ = std::make_unique<Walker>(*walks_, seed);
    localizer_ = std::make_unique<perception::Localizer>(mapOf(mapped_), common::Pose2{}, config, seed);
    field_ = std::make_unique<perception::MapField>(mapOf(mapped_));
    carried_s_ = random.uniform(6.0, 10.0);
    start(random);
  }

  CaseResult run(double duration_s = 20.0, std::vector<SupportSample>* samples = nullptr) {
    DriftingOdometry odometry(seed_);
    common::RandomStream noise(seed_, "scans");
    bool carried = false;
    for (double t = 0.0; t < duration_s; t += kScan_s) {
      const bool kidnapped = kind_ == CaseKind::kKidnapped || kind_ == CaseKind::kKidnappedChanged;
      if (kidnapped && !carried && t >= carried_s_) {
        carried = true;
        walker_->carry(walker_->somewhereElse(2.5), noise.uniform(-3.1, 3.1));
      }
      const auto scan = levelScan(world_, walker_->pose(), common::Time::fromSeconds(t), noise);
      const auto estimate = localizer_->add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
      judge(t, odometry.pose(), estimate);
      if (samples != nullptr && estimate.state == perception::LocalizationState::kLocalized)
        samples->push_back({wrong_, perception::supportOf(*field_, scan.points_level_m, estimate.T_map_body)});
      const common::Pose2 before = walker_->pose();
      walker_->advance(kScan_s);
      odometry.step(between(before, walker_->pose()));
    }
    // A pose that became wrong in the last moments cannot have been noticed yet.
    if (wrong_since_s_ && duration_s - *wrong_since_s_ <= kNotice_s) --result_.wrong;
    return result_;
  }

 private:
  void start(common::RandomStream& random) {
    if (kind_ == CaseKind::kTwin) return;
    common::Pose2 told = walker_->pose();
    if (kind_ == CaseKind::kWrongMap) {
      const Eigen::Vector2d at = Walks(mapped_).somewhere(random);
      told = {at.x(), at.y(), random.uniform(-3.1, 3.1)};
    }
    T_map_odom_ = told * DriftingOdometry(seed_).pose().inverse();
    localizer_->startAt(told, Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal());
  }

  bool isWrong(const common::Pose2& T_map_body) const {
    const common::Pose2 error = between(walker_->pose(), T_map_body);
    return kind_ == CaseKind::kWrongMap || error.position_m().norm() > kWrong_m || std::abs(error.yaw_rad) > kWrong_rad;
  }

  /// The pose before this scan, moved by the odometry, may be wrong by now; the estimate says whether it is still
  /// accepted.
  void judge(double t, const common::Pose2& T_odom_body, const perception::LocalizationEstimate& estimate) {
    const bool believed = estimate.state == perception::LocalizationState::kLocalized;
    const bool wrong_before = T_map_odom_ && isWrong(*T_map_odom_ * T_odom_body);
    wrong_ = believed && isWrong(estimate.T_map_body);
    ++result_.scans;
    result_.refuted |= estimate.refuted;
    result_.localized += believed ? 1 : 0;
    if (estimate.event)
      result_.story.push_back(std::to_string(t).substr(0, 5) + " s " + toString(estimate.event->state) + ": " +
                              estimate.event->reason);
    if (T_map_odom_ && !believed) {
      ++result_.alarms;
      result_.false_alarms += wrong_before ? 0 : 1;
    }
    if ((wrong_before || wrong_) && !wrong_since_s_) {
      wrong_since_s_ = t;
      ++result_.wrong;
    }
    if (wrong_since_s_ && !wrong_) {
      const double delay_s = t - *wrong_since_s_;
      result_.worst_delay_s = std::max(result_.worst_delay_s, delay_s);
      if (delay_s <= kNotice_s) ++result_.noticed;
      wrong_since_s_.reset();
    }
    if (wrong_since_s_ && t - *wrong_since_s_ > kNotice_s) ++result_.falsely_localized;
    if (believed && !wrong_)
      result_.error_m.push_back((estimate.T_map_body.position_m() - walker_->pose().position_m()).norm());
    T_map_odom_.reset();
    if (believed) T_map_odom_ = estimate.T_map_odom;
  }

  CaseKind kind_;
  std::uint64_t seed_;
  Building mapped_, truth_building_;
  PlanarWorld world_;
  std::unique_ptr<Walks> walks_;
  std::unique_ptr<Walker> walker_;
  std::unique_ptr<perception::Localizer> localizer_;
  std::unique_ptr<perception::MapField> field_;
  double carried_s_ = 0.0;
  CaseResult result_;
  std::optional<double> wrong_since_s_;
  std::optional<common::Pose2> T_map_odom_;  ///< As accepted at the last scan.
  bool wrong_ = false;
};

}  // namespace swiftlet::test
