#include "perception/recognition/histogram_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/LU>

#include "common/random.hpp"
#include "perception/recognition/picture_pyramid.hpp"
#include "vision/corners.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

constexpr vision::CornerConfig kTemplateCorners{60, 8};
constexpr vision::CornerConfig kPictureCorners{300, 16};
/// The template is looked at in these widths and less, each half of the one before, down to the smallest.
constexpr int kLargestTemplate_px = 256, kSmallestTemplate_px = 32;
constexpr std::size_t kHistogramLevels = 3;
constexpr int kSmallestLevel_px = 60;
/// A descriptor belongs to the first class whose first member it correlates with by this.
constexpr float kClassCorrelation = 0.9F;
/// Standard deviation of a bin that a class has at least: a change of the view of a few degrees moves a bin by this.
constexpr double kLeastBinSigma = 0.06;
/// Mahalanobis distance a bin, beyond which no class is near.
constexpr double kGreatestDistance = 3.0;
/// Bins of the turns in which candidates vote, and cells of the pattern's middle as a share of its width: what a corner
/// says of its size is right within the square root of 2, which moves a middle by a fifth of the width.
constexpr int kTurnBins = 18;
constexpr double kCellShare = 0.4;
/// The bins with the most votes are searched, each with so many pairs of its candidates.
constexpr std::size_t kBins = 12;
constexpr int kPairTrials = 200;
/// Corners within this share of the pattern's width agree, at least by the first and at most by the second.
constexpr double kAgreementShare = 0.04, kLeastAgreement_px = 2.0, kMostAgreement_px = 6.0;
/// Orientations within two bins of the histogram agree, and sizes within a level and a half of the pyramid.
constexpr double kTurnTolerance_rad = 0.4, kSizeTolerance = 2.0;
/// Corners of the template in the picture that must agree: four define the homography, and chance adds some.
constexpr std::size_t kLeastAgreeing = 7;
/// As many agreeing corners are as sure as it gets.
constexpr double kSureCorners = 20.0;
constexpr double kLeastWidth_px = 16.0, kGreatestWidth_px = 700.0;

using Complex = std::complex<double>;
Complex onPaper(const PlanarMatch& match) { return {match.point_m.x(), -match.point_m.y()}; }
Complex inPicture(const PlanarMatch& match) { return {match.pixel.x(), match.pixel.y()}; }

double turnOf(int bins) {
  return 2.0 * std::numbers::pi * static_cast<double>(bins) / static_cast<double>(kOrientationBins);
}

Eigen::Vector2d atFullSize(const Eigen::Vector2d& pixel, std::size_t level) {
  const double scale = static_cast<double>(1 << level);
  return {(pixel.x() + 0.5) * scale - 0.5, (pixel.y() + 0.5) * scale - 0.5};
}

}  // namespace

HistogramRecognizer::HistogramRecognizer(const PatternTemplate& pattern) : pattern_(pattern) { learn(); }

void HistogramRecognizer::learn() {
  const std::vector<GrayImage> levels = pyramidOf(pattern_.picture(), kSmallestTemplate_px);
  std::size_t count = 0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const GrayImage& image = levels[level];
    if (image.width_px > kLargestTemplate_px) continue;
    for (const vision::Corner& corner : vision::findCorners(image, kTemplateCorners)) {
      const auto histogram = orientationHistogram(image, static_cast<int>(corner.pixel.x() + 0.5),
                                                  static_cast<int>(corner.pixel.y() + 0.5));
      if (!histogram) continue;
      auto own = std::find_if(classes_.begin(), classes_.end(), [&](const PatchClass& one) {
        return correlation(one.members.front().histogram, *histogram) >= kClassCorrelation;
      });
      if (own == classes_.end()) own = classes_.insert(classes_.end(), PatchClass());
      own->members.push_back({*histogram, pattern_.point_pattern_m(atFullSize(corner.pixel, level)),
                              pattern_.metresPerPixel() * static_cast<double>(1 << level)});
      ++count;
    }
  }
  for (PatchClass& one : classes_) {
    const double members = static_cast<double>(one.members.size());
    for (std::size_t i = 0; i < kOrientationBins; ++i) {
      double sum = 0.0, squares = 0.0;
      for (const Member& member : one.members) {
        const auto value = static_cast<double>(member.histogram.bins[i]);
        sum += value;
        squares += value * value;
      }
      one.mean[i] = sum / members;
      one.variance[i] = kLeastBinSigma * kLeastBinSigma + std::max(0.0, squares / members - one.mean[i] * one.mean[i]);
    }
    one.log_prior = std::log(members / static_cast<double>(count));
  }
}

const HistogramRecognizer::PatchClass* HistogramRecognizer::classify(const OrientationHistogram& histogram) const {
  const PatchClass* best = nullptr;
  double best_log = -INFINITY;
  for (const PatchClass& one : classes_) {
    double distance = 0.0, log_volume = 0.0;
    for (std::size_t i = 0; i < kOrientationBins; ++i) {
      const double difference = static_cast<double>(histogram.bins[i]) - one.mean[i];
      distance += difference * difference / one.variance[i];
      log_volume += 0.5 * std::log(one.variance[i]);
    }
    if (distance > kGreatestDistance * static_cast<double>(kOrientationBins)) continue;
    const double log_posterior = one.log_prior - 0.5 * distance - log_volume;
    if (log_posterior <= best_log) continue;
    best_log = log_posterior;
    best = &one;
  }
  return best;
}

std::vector<HistogramRecognizer::Candidate> HistogramRecognizer::candidates(const GrayImage& gray) const {
  const std::vector<GrayImage> levels = pyramidOf(gray, kSmallestLevel_px);
  std::vector<Candidate> found;
  for (std::size_t level = 0; level < std::min(kHistogramLevels, levels.size()); ++level) {
    const GrayImage& image = levels[level];
    for (const vision::Corner& corner : vision::findCorners(image, kPictureCorners)) {
      const auto histogram = orientationHistogram(image, static_cast<int>(corner.pixel.x() + 0.5),
                                                  static_cast<int>(corner.pixel.y() + 0.5));
      const PatchClass* const one = histogram ? classify(*histogram) : nullptr;
      if (one == nullptr) continue;
      for (const Member& member : one->members)
        found.push_back({{member.point_m, atFullSize(corner.pixel, level)},
                         turnOf(histogram->turn_bins - member.histogram.turn_bins),
                         static_cast<double>(1 << level) / member.pixel_m});
    }
  }
  return found;
}

std::vector<std::vector<HistogramRecognizer::Candidate>> HistogramRecognizer::fullestBins(
    const std::vector<Candidate>& candidates) const {
  using Bin = std::array<int, 4>;  // Octave of the size, turn, column and row of the middle.
  std::map<Bin, std::vector<std::size_t>> votes;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& [match, turn_rad, px_per_m] = candidates[i];
    const int octave = static_cast<int>(std::floor(std::log2(px_per_m * pattern_.width_m()) + 0.5));
    const double cell_px = kCellShare * std::ldexp(1.0, octave);
    const Complex middle = inPicture(match) - std::polar(px_per_m, turn_rad) * onPaper(match);
    const double turn = (turn_rad / (2.0 * std::numbers::pi) + 2.0) * kTurnBins;
    const double column = middle.real() / cell_px, row = middle.imag() / cell_px;
    // Bins overlap by half, so that no border divides what belongs together.
    for (const int k : {0, 1, 2, 3, 4, 5, 6, 7})
      votes[{octave, static_cast<int>(std::floor(turn + 0.5 * (k & 1))) % kTurnBins * 2 + (k & 1),
             2 * static_cast<int>(std::floor(column + 0.25 * (k & 2))) + (k >> 1 & 1),
             2 * static_cast<int>(std::floor(row + 0.125 * (k & 4))) + (k >> 2)}]
          .push_back(i);
  }
  std::vector<std::vector<std::size_t>> bins;
  for (auto& [bin, members] : votes)
    if (members.size() >= kLeastAgreeing) bins.push_back(std::move(members));
  std::stable_sort(bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  if (bins.size() > kBins) bins.resize(kBins);
  std::vector<std::vector<Candidate>> fullest;
  for (const std::vector<std::size_t>& members : bins) {
    fullest.emplace_back();
    for (const std::size_t i : members) fullest.back().push_back(candidates[i]);
  }
  return fullest;
}

std::vector<PlanarMatch> HistogramRecognizer::agreeing(const std::vector<Candidate>& candidates, Complex factor,
                                                       Complex offset_px) const {
  const double px_per_m = std::abs(factor), turn_rad = std::arg(factor);
  const double tolerance_px =
      std::clamp(kAgreementShare * px_per_m * pattern_.width_m(), kLeastAgreement_px, kMostAgreement_px);
  std::vector<PlanarMatch> found;
  for (const auto& [match, candidate_turn_rad, candidate_px_per_m] : candidates) {
    if (std::abs(factor * onPaper(match) + offset_px - inPicture(match)) > tolerance_px) continue;
    if (candidate_px_per_m > kSizeTolerance * px_per_m || px_per_m > kSizeTolerance * candidate_px_per_m) continue;
    if (std::abs(std::remainder(candidate_turn_rad - turn_rad, 2.0 * std::numbers::pi)) > kTurnTolerance_rad) continue;
    const bool is_new = std::none_of(found.begin(), found.end(), [&](const PlanarMatch& other) {
      return (other.pixel - match.pixel).norm() < tolerance_px ||
             (other.point_m - match.point_m).norm() * px_per_m < tolerance_px;
    });
    if (is_new) found.push_back(match);
  }
  return found;
}

std::vector<Recognized> HistogramRecognizer::recognize(const Observation& observation) {
  if (!hasWholePicture(observation)) return {};
  const std::vector<Candidate> all = candidates(observation.picture->gray);
  if (all.size() < kLeastAgreeing) return {};
  common::RandomStream random(0, "histogram_recognizer");
  std::vector<PlanarMatch> best;
  for (const std::vector<Candidate>& bin : fullestBins(all)) {
    for (int trial = 0; trial < kPairTrials; ++trial) {
      const auto draw = [&] { return static_cast<std::size_t>(random.uniform() * static_cast<double>(bin.size())); };
      const Candidate &one = bin[draw()], &other = bin[draw()];
      const Complex on_paper = onPaper(other.match) - onPaper(one.match);
      if (std::abs(on_paper) < 0.1 * pattern_.width_m()) continue;
      const Complex factor = (inPicture(other.match) - inPicture(one.match)) / on_paper;
      const double width_px = std::abs(factor) * pattern_.width_m();
      if (width_px < kLeastWidth_px || width_px > kGreatestWidth_px) continue;
      std::vector<PlanarMatch> found = agreeing(bin, factor, inPicture(one.match) - factor * onPaper(one.match));
      if (found.size() > best.size()) best = std::move(found);
    }
  }
  if (best.size() < kLeastAgreeing) return {};
  const auto fitted = fitPose(observation.picture->camera, best);
  if (!fitted || !fitted->pose.showsFace()) return {};
  const Eigen::Matrix<double, 6, 6> covariance =
      std::max(1.0, fitted->rms_px * fitted->rms_px) * fitted->information.inverse();
  return {{pattern_.name(), T_camera_plane(fitted->pose), inCameraAxes(covariance),
           std::min(1.0, static_cast<double>(best.size()) / kSureCorners)}};
}

}  // namespace swiftlet::perception
