#include "perception/recognition/pattern_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "perception/recognition/picture_pyramid.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

/// Curves are searched in so many levels of the pyramid; their window then covers a quarter of the picture.
constexpr int kCurveLevels = 3;
constexpr int kLeastLevelSide_px = 30;
/// By how many grey levels a curve differs from the mean around it: twice the noise of a dark picture.
constexpr int kCurveContrast = 5;
/// A patch that correlates less with that of the template is another thing.
constexpr float kLeastPatchCorrelation = 0.6F;
/// A pose whose coarse correlation is less is not aligned.
constexpr double kLeastCoarseCorrelation = 0.3;
/// Poses that are aligned at the coarsest level, and at the finer ones.
constexpr std::size_t kMostCoarse = 16, kMostFine = 4;
/// Poses whose corners are nearer, as a share of the pattern's size, are the same hypothesis.
constexpr double kSamePlace = 0.06;
/// The smallest pattern that is looked for: below, no shape of it is one.
constexpr double kLeastSize_px = 16.0;
/// Sizes of the pattern at which it is aligned, one after the other.
constexpr double kCoarseSize_px = 22.0, kMiddleSize_px = 56.0, kFineSize_px = 160.0;

/// What an aligned pose must show (docs/recognition.md has the figures): most of the pattern's contrast in cells that
/// look as they should, and these together as the template.
constexpr double kLeastSeenShare = 0.62;
constexpr double kLeastSeenCorrelation = 0.85;
/// What hides a part is dark or bright. In another picture of the same colours there is ink where paper should be, and
/// paper where ink should be.
constexpr double kMostReversed = 0.004, kMostContradiction = 0.15;
/// Before the fine alignment less is enough.
constexpr double kPromisingShare = 0.3, kPromisingCorrelation = 0.7;

bool isPattern(const Evidence& evidence) {
  return evidence.seen_share >= kLeastSeenShare && evidence.seen_correlation >= kLeastSeenCorrelation &&
         std::min(evidence.missing_paper, evidence.missing_ink) <= kMostReversed &&
         evidence.missing_paper + evidence.missing_ink <= kMostContradiction;
}

Eigen::Matrix2d turn(double angle_rad) { return Eigen::Rotation2Dd(angle_rad).toRotationMatrix(); }

}  // namespace

PatternRecognizer::PatternRecognizer(const PatternTemplate& pattern)
    : pattern_(pattern), aligner_(pattern), shapes_(knownShapes(pattern)) {}

std::vector<PatternRecognizer::Hypothesis> PatternRecognizer::hypotheses(const std::vector<GrayImage>& levels,
                                                                         const common::PinholeCamera& camera) const {
  std::vector<Hypothesis> found;
  for (int level = 0; level < std::min(kCurveLevels, static_cast<int>(levels.size())); ++level) {
    const GrayImage& image = levels[static_cast<std::size_t>(level)];
    const double scale = static_cast<double>(1 << level);
    for (const ClosedCurve& curve : findClosedCurves(image, kCurveContrast)) {
      const auto patch = polarPatch(image, curve, kPatchRings);
      if (!patch) continue;
      for (const KnownShape& shape : shapes_) {
        const PatchMatch match = bestTurn(shape.patch, *patch, kLeastPatchCorrelation);
        if (match.correlation < kLeastPatchCorrelation) continue;
        AffineMap map;
        map.origin_px = (curve.middle_px + Eigen::Vector2d(0.5, 0.5)) * scale - Eigen::Vector2d(0.5, 0.5);
        map.linear = scale * curve.whitening.inverse() * turn(match.turn_rad) * shape.whitening_1_m;
        const auto poses = infinitesimalPoses(camera, map, shape.middle_m);
        if (!poses) continue;
        for (const PlanarPose& pose : *poses) {
          if (!pose.showsFace() || aligner_.size_px(camera, pose) < kLeastSize_px) continue;
          const double score = aligner_.coarseCorrelation(levels, camera, pose);
          if (score >= kLeastCoarseCorrelation) found.push_back({pose, score});
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  return found;
}

std::optional<AlignedPattern> PatternRecognizer::alignedFinely(const std::vector<GrayImage>& levels,
                                                               const common::PinholeCamera& camera,
                                                               const PlanarPose& start) const {
  const auto middle = aligner_.align(levels, camera, start, kMiddleSize_px);
  if (!middle) return std::nullopt;
  // Most hypotheses are something else, which shows before it is measured finely.
  const Evidence evidence = aligner_.evidence(levels, camera, middle->pose);
  if (evidence.seen_share < kPromisingShare || evidence.seen_correlation < kPromisingCorrelation) return std::nullopt;
  const double blur_px = aligner_.blur_px(levels, camera, middle->pose, kFineSize_px);
  auto best = aligner_.alignFinely(levels, camera, middle->pose, kFineSize_px, blur_px);
  if (!best) return std::nullopt;
  if (const auto other = aligner_.mirrored(camera, best->pose)) {
    const auto aligned = aligner_.alignFinely(levels, camera, *other, kFineSize_px, blur_px);
    if (aligned && aligned->cost < best->cost) best = aligned;
  }
  if (!best->pose.showsFace()) return std::nullopt;
  return best;
}

std::vector<Recognized> PatternRecognizer::recognize(const Observation& observation) {
  if (!hasWholePicture(observation)) return {};
  const common::PinholeCamera& camera = observation.picture->camera;
  const std::vector<GrayImage> levels = pyramidOf(observation.picture->gray, kLeastLevelSide_px);
  const auto is_among = [&](const std::vector<Hypothesis>& others, const PlanarPose& pose) {
    return std::any_of(others.begin(), others.end(), [&](const Hypothesis& other) {
      return aligner_.cornerDistance_px(camera, pose, other.pose) < kSamePlace * aligner_.size_px(camera, pose);
    });
  };

  std::vector<Hypothesis> tried, coarse;
  for (const Hypothesis& hypothesis : hypotheses(levels, camera)) {
    if (tried.size() >= kMostCoarse) break;
    if (is_among(tried, hypothesis.pose)) continue;
    tried.push_back(hypothesis);
    const auto aligned = aligner_.align(levels, camera, hypothesis.pose, kCoarseSize_px);
    if (!aligned || !aligned->pose.showsFace() || is_among(coarse, aligned->pose)) continue;
    coarse.push_back({aligned->pose, aligner_.evidence(levels, camera, aligned->pose).correlation});
  }
  std::stable_sort(coarse.begin(), coarse.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  if (coarse.size() > kMostFine) coarse.resize(kMostFine);

  std::vector<Recognized> recognized;
  std::vector<PlanarPose> accepted;
  for (const Hypothesis& hypothesis : coarse) {
    // Two prints do not overlap.
    const bool is_taken = std::any_of(accepted.begin(), accepted.end(), [&](const PlanarPose& other) {
      return aligner_.cornerDistance_px(camera, hypothesis.pose, other) < aligner_.size_px(camera, other);
    });
    const auto aligned = is_taken ? std::nullopt : alignedFinely(levels, camera, hypothesis.pose);
    if (!aligned || aligner_.size_px(camera, aligned->pose) < kLeastSize_px) continue;
    const Evidence evidence = aligner_.evidence(levels, camera, aligned->pose);
    if (!isPattern(evidence)) continue;
    accepted.push_back(aligned->pose);
    recognized.push_back({pattern_.name(), T_camera_plane(aligned->pose), inCameraAxes(aligned->covariance),
                          std::min(1.0, evidence.seen_share * evidence.seen_correlation)});
  }
  std::stable_sort(recognized.begin(), recognized.end(),
                   [](const Recognized& a, const Recognized& b) { return a.confidence > b.confidence; });
  return recognized;
}

}  // namespace swiftlet::perception
