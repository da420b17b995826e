#include "vision/epipolar_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "vision/binary_descriptor.hpp"
#include "vision/corners.hpp"

namespace swiftlet::vision {
namespace {

/// Fewer corners are compared than features are tracked: a median needs no more.
constexpr CornerConfig kCorners{.greatest_number = 150, .cell_px = 24};
/// Rows between two corners that are compared, as a share of the height. A camera that is turned against the other by 3
/// degrees shifts rows by about a twentieth of it.
constexpr double kSearchedRows = 0.08;
constexpr int kMostBits = 50;
constexpr double kMostOfSecond = 0.8;  ///< To the second most similar corner (Lowe, IJCV 2004, section 7.1).
constexpr int kLeastAlike = 15;
/// Blocks of nine rows still match with a row between them; with two, most of them do not.
constexpr double kGreatestRows_px = 1.5;
constexpr double kMostReversed = 0.5;

struct DescribedCorner {
  Eigen::Vector2d pixel;
  BinaryDescriptor descriptor;
};

std::vector<DescribedCorner> describedCorners(const GrayImage& image) {
  const auto corners = findCorners(image, kCorners);
  std::vector<DescribedCorner> described;
  for (const DescribedPatch& patch : describedPatches(image, corners))
    described.push_back({corners[patch.index].pixel, patch.descriptor});
  return described;
}

/// The corner of `others` that is alike, within the rows that are searched; null without one that is clearly it.
const DescribedCorner* partnerOf(const DescribedCorner& corner, const std::vector<DescribedCorner>& others,
                                 double rows_px) {
  NearestDescriptor nearest;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (std::abs(others[i].pixel.y() - corner.pixel.y()) <= rows_px)
      nearest.consider(corner.descriptor.distance(others[i].descriptor), i);
  const bool alike = nearest.distance <= kMostBits && nearest.distance <= kMostOfSecond * nearest.second;
  return alike ? &others[nearest.index] : nullptr;
}

}  // namespace

std::optional<EpipolarResidual> epipolarResidual(const GrayImage& left, const GrayImage& right) {
  const std::vector<DescribedCorner> of_left = describedCorners(left), of_right = describedCorners(right);
  const double rows_px = kSearchedRows * left.height_px;
  std::vector<double> apart_px;
  EpipolarResidual residual;
  int reversed = 0;
  for (const DescribedCorner& corner : of_left) {
    const DescribedCorner* partner = partnerOf(corner, of_right, rows_px);
    if (partner == nullptr || partnerOf(*partner, of_left, rows_px) != &corner) continue;
    apart_px.push_back(std::abs(partner->pixel.y() - corner.pixel.y()));
    if (partner->pixel.x() > corner.pixel.x() + 1.0) ++reversed;
  }
  residual.pairs = static_cast<int>(apart_px.size());
  if (residual.pairs < kLeastAlike) return std::nullopt;
  const auto middle = apart_px.begin() + residual.pairs / 2;
  std::nth_element(apart_px.begin(), middle, apart_px.end());
  residual.rows_px = *middle;
  residual.share_reversed = static_cast<double>(reversed) / residual.pairs;
  return residual;
}

std::optional<common::Message> contradictionOf(const EpipolarResidual& residual) {
  if (residual.share_reversed > kMostReversed)
    return common::Message("stereo.exchanged",
                           "left and right seem exchanged: {:.0f} % of {} corners lie farther to the right in the "
                           "picture of the right camera",
                           100.0 * residual.share_reversed, residual.pairs);
  if (residual.rows_px > kGreatestRows_px)
    return common::Message("stereo.rows-apart",
                           "the calibration does not fit: corners lie {:.1f} rows apart in the two pictures (median of "
                           "{})",
                           residual.rows_px, residual.pairs);
  return std::nullopt;
}

}  // namespace swiftlet::vision
