#include "common/blank_picture.hpp"

#include <cstdint>
#include <numeric>

namespace swiftlet::common {
namespace {

/// Mean values of a black and of a white picture, of 255.
constexpr double kBlackMean = 6.0;
constexpr double kWhiteMean = 249.0;

/// Grey without pixels.
double meanOf(const Image& picture) {
  if (picture.rgb.empty()) return 128.0;
  const auto sum = std::accumulate(picture.rgb.begin(), picture.rgb.end(), std::uint64_t{0});
  return static_cast<double>(sum) / static_cast<double>(picture.rgb.size());
}

}  // namespace

Blank blankOf(const Image& picture) {
  const double mean = meanOf(picture);
  if (mean < kBlackMean) return Blank::kBlack;
  return mean > kWhiteMean ? Blank::kWhite : Blank::kNo;
}

}  // namespace swiftlet::common
