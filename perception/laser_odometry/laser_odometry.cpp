#include "perception/laser_odometry/laser_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "common/config_fields.hpp"
#include "common/small_matrices.hpp"
#include "common/validation.hpp"
#include "perception/projection/leaning_walls.hpp"

namespace swiftlet::perception {

using common::kRadPerDeg;
using common::Pose2;

namespace {

/// Angular acceleration that widens the search with the time since the last match.
constexpr double kMaxAngularAcceleration_rad_s2 = 20.0;
/// Speed that widens the search with the time since all directions were seen, as the guess drifts (measured:
/// docs/decisions/scan_matching.md#080).
constexpr double kUnseenDrift_m_s = 0.5;
/// Half the least search window of the rotation; at most LaserOdometryConfig::max_window_deg.
constexpr double kGuessError_deg = 1.5;
/// A scan with a smaller share of supported points joins the local map.
constexpr double kMinOverlap = 0.75;
/// Value of kMinOverlap where the position is weakly fixed in one direction.
constexpr double kMinWeakOverlap = 0.93;
/// A position less certain than this in one direction is weakly fixed.
constexpr double kWeakSigma_m = 0.05;
/// A scan this far from the reference joins the local map.
constexpr double kMaxReferenceDistance_m = 2.0;
/// A scan turned this much against the reference joins the local map.
constexpr double kMaxReferenceRotation_deg = 60.0;
/// A scan tilted more than this is drawn with the error of its attitude, so that it joins the local map only when it
/// must.
constexpr double kLevelTilt_deg = 2.0;
/// A tilted scan joins the local map when its overlap is this much smaller than a level one's would have to be.
constexpr double kTiltedOverlapMargin = 0.15;
/// The local map is a section at one height. Among leaning walls it is drawn anew when the vehicle has climbed this
/// far, and after this time, as their planes become known better.
constexpr double kSection_m = 0.1, kSection_s = 0.5;
/// Key scans kept in the local map (16 and 32 were no better: docs/decisions/slam.md#017).
constexpr int kLocalMapScans = 8;

void countSearch(LaserOdometryCounts& counts, MatcherKind kind) {
  switch (kind) {
    case MatcherKind::kCorrelative:
      ++counts.correlative_searches;
      return;
    case MatcherKind::kGaussNewton:
      ++counts.gauss_newton_searches;
      return;
    case MatcherKind::kPointToLine:
      ++counts.point_to_line_searches;
      return;
  }
}

/// At this many half windows from the guess, the guess no longer supports a match (measured:
/// docs/decisions/scan_matching.md#023).
constexpr double kFarWindows = 6.0;

/// Matches that the estimate has refused for this long are compared with its own pose; single outliers are not
/// (docs/decisions/scan_matching.md#102).
constexpr double kRefused_s = 0.2;

/// How far an offset lies beyond its window: 0 inside, 1 far away.
double shareBeyond(double off, double window, double greatest_window) {
  const double far = std::clamp(kFarWindows * window, 0.5 * greatest_window, greatest_window);
  return off > window ? std::min(1.0, (off - window) / std::max(far - window, 1e-9)) : 0.0;
}

}  // namespace

void LaserOdometryConfig::describe(common::config::Fields& fields) {
  fields.section("matcher", matcher, "Matching of a scan to the local map.");
  fields("max_acceleration_m_s2", max_acceleration_m_s2, {0, 100},
         "Acceleration that widens the search with the time since the last match (Bachrach 2009, 5.1).");
  fields("max_window_m", max_window_m, {0.01, 5}, "Half the greatest search window.");
  fields("max_window_deg", max_window_deg, {0.1, 180}, "Half the greatest search window of the rotation.");
  fields("min_widened_quality", min_widened_quality, {0, 1},
         "Least quality of a match six times as far off as the first window reaches, since chance matches are likelier "
         "there; nearer ones need less, down to matcher.min_quality within the first window.");
  fields("widens", widens,
         "Whether a scan that does not match within what the motion since the last match allows is sought farther off. "
         "Where inertial samples predict, such a match is mostly another surface, as the other side of a wall.");
  fields(
      "widened_must_hold", widened_must_hold,
      "Whether a match beyond the first window must fix the position in all directions, as the guess no longer does.");
  fields("min_fit", min_fit, {0, 1},
         "A scan that fits worse than this joins the local map, which has become wrong about the place; it is sought "
         "farther off before.");
  fields("max_failures", max_failures, {1, 100'000},
         "After this many scans without a match the odometry starts anew from the present one.");
}

std::vector<common::Problem> LaserOdometryConfig::validate() const {
  return common::Validation()
      .atMost("guess_error_m", guess_error_m, "max_window_m", max_window_m)
      .atMost("guess_error_deg", kGuessError_deg, "max_window_deg", max_window_deg)
      .problems();
}

struct LaserOdometry::Impl {
  struct KeyScan {
    common::Time stamp;
    ProjectedScan scan;
    Pose2 T_local_body;
    Eigen::Matrix3d covariance_local;  ///< Of the pose relative to the map drawn before; zero for the first.
  };

  /// A pose around which a scan is searched.
  struct Guess {
    Pose2 T_local_body;
    SearchWindow window;

    /// Whether a pose lies within the half window; for its position the half window is scaled by `half_translations`.
    bool covers(const Pose2& pose_local, double half_translations = 1.0) const {
      const Pose2 off = between(T_local_body, pose_local);
      return off.position_m().norm() <= half_translations * window.half_translation_m &&
             std::abs(off.yaw_rad) <= window.half_rotation_rad;
    }
  };
  struct Found {
    MatchResult match;
    double margin = -1.0;  ///< Quality above the required one; below zero the match is rejected.
    /// The match was found from the other guess.
    bool otherwise = false;
  };

  Impl(const LaserOdometryConfig& config_in, const LeaningWalls* walls_in)
      : config(config_in), matcher(makeMatcher(config_in.matcher)), walls(walls_in) {}

  std::optional<RelativePose> start(const ProjectedScan& scan);
  SearchWindow usualWindow(common::Time now) const;
  Guess guessOf(const Pose2& T_last_now, const SearchWindow& window) const;
  Found find(const ProjectedScan& scan, const Guess& guess, const std::optional<Guess>& other);
  Found findWhereHeld(const ProjectedScan& scan, const Found& found, const Guess& held);
  Found matchIn(const SearchWindow& window, const ProjectedScan& scan, const Guess& guess, const Guess& about);
  double marginOf(const MatchResult& match, const Guess& guess, const Guess& about) const;
  bool canWiden(const SearchWindow& window) const;
  SearchWindow widened(const SearchWindow& window) const;
  void addKeyScan(const ProjectedScan& scan, const Pose2& T_local_body, const Eigen::Matrix3d& covariance_local);
  RelativePose relativeTo(const KeyScan& reference, const ProjectedScan& scan, const MatchResult& match) const;
  bool shouldJoin(const RelativePose& relative, const ProjectedScan& scan, const MatchResult& match) const;
  void drawLocalMap();
  bool amongLeaningWalls() const { return walls != nullptr && walls->any(); }
  void draw(const KeyScan& key);
  void chooseSection(const ProjectedScan& scan);
  bool isDoubtedInClimb(const ProjectedScan& scan, const MatchResult& match);

  LaserOdometryConfig config;
  std::unique_ptr<ScanMatcher> matcher;
  const LeaningWalls* walls;
  /// Of the local map among leaning walls.
  struct Section {
    double height_odom_m = 0.0;
    common::Time chosen;
    std::optional<common::Time> doubted_since;  ///< In a climb; until a scan fits well again.
  } section;
  LaserOdometryCounts counts;
  std::deque<KeyScan> key_scans;  ///< The last one is the reference.
  common::Time last_stamp, last_match;
  common::Time last_seen_whole;  ///< The last match that hid no translation.
  Pose2 last_T_odom_body;        ///< The predicted pose at the last match.
  Pose2 last_T_local_body;       ///< The matched pose at the last match.
  Pose2 held_T_local_body;       ///< The estimate's pose at that time, after the last match that it accepted.
  std::optional<common::Time> refused_since;
  int failures = 0;
};

void LaserOdometry::Impl::drawLocalMap() {
  matcher->clearReference();
  for (const KeyScan& key : key_scans) draw(key);
}

void LaserOdometry::Impl::draw(const KeyScan& key) {
  if (amongLeaningWalls())
    matcher->addReference(walls->sectionAt(key.scan, section.height_odom_m).scan, key.T_local_body);
  else
    matcher->addReference(key.scan, key.T_local_body);
}

void LaserOdometry::Impl::chooseSection(const ProjectedScan& scan) {
  const double height_m = scan.T_odom_body.position_m.z();
  if (std::abs(height_m - section.height_odom_m) <= kSection_m && (scan.stamp - section.chosen).seconds() <= kSection_s)
    return;
  section.height_odom_m = height_m;
  section.chosen = scan.stamp;
  drawLocalMap();
}

void LaserOdometry::Impl::addKeyScan(const ProjectedScan& scan, const Pose2& T_local_body,
                                     const Eigen::Matrix3d& covariance_local) {
  ++counts.references;
  key_scans.push_back({scan.stamp, scan, T_local_body, covariance_local});
  if (static_cast<int>(key_scans.size()) <= kLocalMapScans) {
    draw(key_scans.back());
    return;
  }
  // Half of the key scans are dropped at once, so that the map is rarely redrawn.
  const auto kept = static_cast<std::size_t>(kLocalMapScans) / 2 + 1;
  while (key_scans.size() > kept) key_scans.pop_front();
  drawLocalMap();
}

std::optional<RelativePose> LaserOdometry::Impl::start(const ProjectedScan& scan) {
  if (static_cast<int>(scan.points_level_m.size()) < ScanMatcher::kMinPoints) return std::nullopt;
  key_scans.clear();
  matcher->clearReference();
  addKeyScan(scan, Pose2{}, Eigen::Matrix3d::Zero());
  last_match = last_seen_whole = scan.stamp;
  last_T_odom_body = common::planar(scan.T_odom_body);
  last_T_local_body = held_T_local_body = Pose2{};
  refused_since.reset();
  failures = 0;
  RelativePose first;
  first.from = first.to = scan.stamp;
  first.reference_changed = true;
  return first;
}

/// The window that covers how far the vehicle may have moved from the prediction.
SearchWindow LaserOdometry::Impl::usualWindow(common::Time now) const {
  const double elapsed_s = (now - last_match).seconds();
  const double half_dt2 = 0.5 * elapsed_s * elapsed_s;
  // Along an unobservable translation the guess has drifted. Once it is observable again, the true pose may be that far
  // off.
  const double unseen_m = kUnseenDrift_m_s * (now - last_seen_whole).seconds();
  return {config.guess_error_m + config.max_acceleration_m_s2 * half_dt2 + unseen_m,
          kGuessError_deg * kRadPerDeg + kMaxAngularAcceleration_rad_s2 * half_dt2};
}

LaserOdometry::Impl::Guess LaserOdometry::Impl::guessOf(const Pose2& T_last_now, const SearchWindow& window) const {
  return {last_T_local_body * T_last_now,
          {std::min(config.max_window_m, window.half_translation_m),
           std::min(config.max_window_deg * kRadPerDeg, window.half_rotation_rad)}};
}

/// By how much the quality of a match exceeds the required one, which grows with the distance from the guess. With
/// `widened_must_hold`, a match beyond both windows is rejected if the scene leaves a direction unobservable, because
/// the guess cannot fix the position there.
double LaserOdometry::Impl::marginOf(const MatchResult& match, const Guess& guess, const Guess& about) const {
  if (match.failed) return -1.0;
  const auto isExpectedBy = [&](const Guess& by) { return by.covers(match.T_reference_body, std::numbers::sqrt2); };
  if (config.widened_must_hold && match.unobservable_motion && !isExpectedBy(guess) && !isExpectedBy(about))
    return -1.0;
  const Pose2 off = between(guess.T_local_body, match.T_reference_body);
  const double beyond =
      std::max(shareBeyond(off.position_m().norm(), guess.window.half_translation_m, config.max_window_m),
               shareBeyond(std::abs(off.yaw_rad), guess.window.half_rotation_rad, config.max_window_deg * kRadPerDeg));
  return match.quality - std::lerp(ScanMatcher::kMinQuality, config.min_widened_quality, beyond);
}

LaserOdometry::Impl::Found LaserOdometry::Impl::matchIn(const SearchWindow& window, const ProjectedScan& scan,
                                                        const Guess& guess, const Guess& about) {
  countSearch(counts, matcher->kind());
  const MatchResult match = matcher->match(scan, about.T_local_body, window);
  return {match, marginOf(match, guess, about), &about != &guess};
}

bool LaserOdometry::Impl::canWiden(const SearchWindow& window) const {
  return config.widens && (window.half_translation_m < config.max_window_m ||
                           window.half_rotation_rad < config.max_window_deg * kRadPerDeg);
}

SearchWindow LaserOdometry::Impl::widened(const SearchWindow& window) const {
  return {std::clamp(3.0 * window.half_translation_m, config.guess_error_m, config.max_window_m),
          std::clamp(3.0 * window.half_rotation_rad, kGuessError_deg * kRadPerDeg, config.max_window_deg * kRadPerDeg)};
}

/// The match with the greatest margin. If the best pose lies at the edge of the window or does not fit, the search goes
/// on: first around the other guess, then in wider windows around the better of the two.
LaserOdometry::Impl::Found LaserOdometry::Impl::find(const ProjectedScan& scan, const Guess& guess,
                                                     const std::optional<Guess>& other) {
  const auto isFound = [&](const Found& found) {
    return found.margin >= 0.0 && !found.match.at_window_edge && found.match.quality >= config.min_fit;
  };
  Found best = matchIn(guess.window, scan, guess, guess);
  if (isFound(best)) return best;
  const Guess* about = &guess;
  if (other && !guess.covers(other->T_local_body)) {
    const Found there = matchIn(other->window, scan, guess, *other);
    const bool neither = there.margin < 0.0 && best.margin < 0.0;
    if (neither ? there.match.quality > best.match.quality : there.margin > best.margin) {
      best = there;
      about = &*other;
    }
  }
  Found last = best;
  SearchWindow window = about->window;
  while (!isFound(last) && last.match.points_used > 0 && canWiden(window)) {
    window = widened(window);
    last = matchIn(window, scan, guess, *about);
    if (last.margin >= best.margin) best = last;
  }
  return best;
}

/// The match at the pose of the estimate, if it fits better than the one that was found.
LaserOdometry::Impl::Found LaserOdometry::Impl::findWhereHeld(const ProjectedScan& scan, const Found& found,
                                                              const Guess& held) {
  if (held.covers(found.match.T_reference_body)) return found;
  const Found there = matchIn(held.window, scan, held, held);
  return there.margin >= 0.0 && there.match.quality > found.match.quality ? there : found;
}

/// Both scans have errors of their own in the local map. The heading error of the reference also rotates the step
/// between the two.
RelativePose LaserOdometry::Impl::relativeTo(const KeyScan& reference, const ProjectedScan& scan,
                                             const MatchResult& match) const {
  RelativePose relative;
  relative.from = reference.stamp;
  relative.to = scan.stamp;
  relative.T_from_to = between(reference.T_local_body, match.T_reference_body);
  relative.covariance = common::turned(
      propagated(reference.covariance_local, reference.T_local_body, match.T_reference_body, match.covariance),
      -reference.T_local_body.yaw_rad);
  if (match.unobservable_motion)
    relative.unobservable_motion = common::turned(*match.unobservable_motion, -match.T_reference_body.yaw_rad);
  return relative;
}

/// Whether a scan joins the local map. A tilted one brings the error of its attitude into the map, so it joins only if
/// the overlap has become too small to wait for a level one.
bool LaserOdometry::Impl::shouldJoin(const RelativePose& relative, const ProjectedScan& scan,
                                     const MatchResult& match) const {
  const bool far = relative.T_from_to.position_m().norm() > kMaxReferenceDistance_m ||
                   std::abs(relative.T_from_to.yaw_rad) > kMaxReferenceRotation_deg * kRadPerDeg;
  const Eigen::Vector2d position =
      common::symmetricEigenvalues(Eigen::Matrix2d(match.covariance.topLeftCorner<2, 2>()));
  const bool weak = position(1) > kWeakSigma_m * kWeakSigma_m;
  if (!far && match.quality >= config.min_fit && match.overlap >= (weak ? kMinWeakOverlap : kMinOverlap)) return false;
  const bool tilted = common::cosTilt(scan.T_odom_body.rotation) < std::cos(kLevelTilt_deg * kRadPerDeg);
  return !tilted || match.overlap < kMinOverlap - kTiltedOverlapMargin;
}

/// Whether a scan fits badly because the vehicle climbs between walls that lean: some of them agree with a motion that
/// was none. While their planes are being learned, which takes a few centimetres of height, inertia knows better.
bool LaserOdometry::Impl::isDoubtedInClimb(const ProjectedScan& scan, const MatchResult& match) {
  constexpr double kClimbed_m = 0.03, kFitsWell = 0.8, kLearned_s = 0.3;
  if (walls == nullptr || walls->any()) return false;  // Not learned, or known.
  if (match.quality >= kFitsWell) section.doubted_since.reset();
  const double climbed_m = scan.T_odom_body.position_m.z() - key_scans.back().scan.T_odom_body.position_m.z();
  if (match.quality >= kFitsWell || std::abs(climbed_m) < kClimbed_m) return false;
  if (!section.doubted_since) section.doubted_since = scan.stamp;
  return (scan.stamp - *section.doubted_since).seconds() < kLearned_s;
}

LaserOdometry::LaserOdometry(const LaserOdometryConfig& config, const LeaningWalls* walls)
    : impl_(std::make_unique<Impl>(config, walls)) {}
LaserOdometry::~LaserOdometry() = default;
LaserOdometry::LaserOdometry(LaserOdometry&&) noexcept = default;
LaserOdometry& LaserOdometry::operator=(LaserOdometry&&) noexcept = default;

const LaserOdometryCounts& LaserOdometry::counts() const { return impl_->counts; }

void LaserOdometry::refused(bool by_estimate) {
  Impl& self = *impl_;
  if (by_estimate) {
    if (!self.refused_since) self.refused_since = self.last_match;
    return;
  }
  self.held_T_local_body = self.last_T_local_body;
  self.refused_since.reset();
}

std::optional<common::Time> LaserOdometry::lastMatch() const {
  return impl_->key_scans.empty() ? std::nullopt : std::optional(impl_->last_match);
}

std::optional<RelativePose> LaserOdometry::add(const ProjectedScan& scan, const std::optional<Pose2>& T_odom_last,
                                               const std::optional<SearchWindow>& first_window,
                                               const std::optional<OtherGuess>& other) {
  Impl& self = *impl_;
  ++self.counts.scans;
  const Pose2 T_odom_body = common::planar(scan.T_odom_body);
  if (!isFinite(T_odom_body)) {
    ++self.counts.failures;
    return std::nullopt;
  }
  if (self.key_scans.empty()) {
    self.last_stamp = scan.stamp;
    return self.start(scan);
  }
  if (scan.stamp <= self.last_stamp) {
    ++self.counts.out_of_order;
    return std::nullopt;
  }
  self.last_stamp = scan.stamp;

  const Pose2 T_last_odom = T_odom_last.value_or(self.last_T_odom_body).inverse();
  std::optional<Impl::Guess> other_guess;
  if (other) other_guess = self.guessOf(T_last_odom * other->T_odom_body, other->window);
  const Pose2 T_last_now = T_last_odom * T_odom_body;
  const Impl::Guess guess = self.guessOf(T_last_now, first_window.value_or(self.usualWindow(scan.stamp)));
  std::optional<LeaningWalls::Section> level;
  if (self.amongLeaningWalls()) {
    self.chooseSection(scan);
    level = self.walls->sectionAt(scan, self.section.height_odom_m);
  }
  const ProjectedScan& matched = level ? level->scan : scan;
  Impl::Found found = self.find(matched, guess, other_guess);
  const Pose2 held_T_local_now = self.held_T_local_body * T_last_now;
  if (self.refused_since && (scan.stamp - *self.refused_since).seconds() >= kRefused_s)
    found = self.findWhereHeld(matched, found, {held_T_local_now, guess.window});
  if (self.isDoubtedInClimb(scan, found.match)) found.margin = -1.0;
  const auto& [match, margin, otherwise] = found;
  if (margin < 0.0) {
    ++self.counts.failures;
    if (++self.failures < self.config.max_failures) return std::nullopt;
    auto restarted = self.start(scan);
    self.counts.restarts += restarted ? 1 : 0;
    return restarted;
  }
  self.failures = 0;
  self.last_match = scan.stamp;
  // In a hidden turn the guess drifts by what the gyroscopes drift, which the least window covers.
  if (!match.unobservable_motion || !isTranslation(*match.unobservable_motion)) self.last_seen_whole = scan.stamp;
  self.last_T_odom_body = otherwise ? other->T_odom_body : T_odom_body;
  self.last_T_local_body = match.T_reference_body;
  self.held_T_local_body = held_T_local_now;

  RelativePose relative = self.relativeTo(self.key_scans.back(), scan, match);
  relative.otherwise = otherwise;
  if (level) {
    // A lean is known to some fifth, and the error lasts as long as a tilt: for some ten scans.
    constexpr double kMovedShare = 0.6, kRange_m = 4.0;
    constexpr double kFits = 0.9, kOff_m = 0.5;
    const double off_m = kMovedShare * level->moved_m + kOff_m * std::max(0.0, kFits - match.quality);
    relative.covariance += common::planarCovariance(off_m, off_m / kRange_m);
  }
  if (self.shouldJoin(relative, scan, match)) {
    relative.reference_changed = true;
    // Along its unobservable motion the key scan itself defines the map. Its guess may have drifted relative to
    // older key scans there, but scans matched to this one are not affected.
    self.addKeyScan(scan, match.T_reference_body,
                    self.config.matcher.only_seen
                        ? common::withoutVarianceAlong(match.unobservable_motion, match.covariance)
                        : match.covariance);
  }
  return relative;
}

}  // namespace swiftlet::perception
