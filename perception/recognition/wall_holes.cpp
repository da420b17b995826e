#include "perception/recognition/wall_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/quantile.hpp"

namespace swiftlet::perception {
namespace {

enum class Against : std::uint8_t { kOn, kBehind, kInFront, kUnknown, kOutside };

/// Behind the plane by more than this, and by 3.5 sigmas: of a million pixels of a wall 200 are, which do not connect.
constexpr double kBehind_m = 0.03, kSigmas = 3.5;
/// Frames, handles and skirtings stand out by less.
constexpr double kRelief_m = 0.12;
/// Fewer pixels behind the wall are no opening of 40 px at 60 degrees.
constexpr int kPixels = 150;
/// The shadow of a projector at 0.1 m, from the edge at 0.8 m to what is far behind: 36 px of 290 px focal length. As
/// an angle; wider gaps are no shadow.
constexpr double kShadow_rad = 0.13;
/// The wall beside a hole goes on for so much; below a sill for more than the floor before a door appears to.
constexpr double kFrame_m = 0.06, kSill_m = 0.25;
/// Near its corners a hole's sides are rounded by noise and roll.
constexpr double kCorner = 0.1;
/// Lines of pixels shorter than this share of the usual ones are not of the hole.
constexpr double kUsual = 0.4;
/// Share of a side's samples that decide what it is.
constexpr double kMostly = 0.6;
/// Floor that leads through is as high as the lower end of the hole, to the noise at 5 m.
constexpr double kSameHeight_m = 0.12;
/// Of an edge between two pixels, with what its mixing leaves (measured, docs/recognition.md).
constexpr double kEdgeSigma_px = 1.5;

/// Every pixel against a plane, whose inverse depth is linear in the pixel.
class AgainstWall {
 public:
  AgainstWall(const DepthView& view, const WallPlane& wall) : view_(view), wall_(wall) {
    at_zero_ = wall.inverse_1_m.dot(view.ray(0, 0));
    by_u_ = wall.inverse_1_m.dot(view.ray(1, 0)) - at_zero_;
    by_v_ = wall.inverse_1_m.dot(view.ray(0, 1)) - at_zero_;
    classes_.reserve(static_cast<std::size_t>(view.camera.pixels()));
    for (int v = 0; v < view.camera.height_px; ++v)
      for (int u = 0; u < view.camera.width_px; ++u) classes_.push_back(compare(u, v));
  }

  /// 1 over the depth of the wall there; not above 0 where the ray does not meet it.
  double wall_1_m(double u_px, double v_px) const { return at_zero_ + by_u_ * u_px + by_v_ * v_px; }
  Against at(int u, int v) const {
    if (u < 0 || v < 0 || u >= view_.camera.width_px || v >= view_.camera.height_px) return Against::kOutside;
    return classes_[static_cast<std::size_t>(v * view_.camera.width_px + u)];
  }
  Eigen::Vector3d onWall(double u_px, double v_px) const { return view_.ray(u_px, v_px) / wall_1_m(u_px, v_px); }
  /// Distance behind the wall that is sure; below 0 without a measurement.
  double behind_m(int u, int v) const {
    const float depth_m = view_.depth.at(u, v);
    const double sure_m = depth_m == common::DepthImage::kTooFar ? view_.range_max_m : static_cast<double>(depth_m);
    return wall_.distance_m() * (sure_m * wall_1_m(u, v) - 1.0);
  }
  const DepthView& view() const { return view_; }
  const WallPlane& wall() const { return wall_; }

 private:
  Against compare(int u, int v) const {
    const double expected_1_m = wall_1_m(u, v), noise_1_m = kSigmas * view_.inverse_depth_sigma_1_m;
    const float depth_m = view_.depth.at(u, v);
    if (depth_m == common::DepthImage::kTooFar)
      return expected_1_m > 1.0 / view_.range_max_m + noise_1_m ? Against::kBehind : Against::kUnknown;
    if (!common::isMeasured(depth_m)) return Against::kUnknown;
    const double farther_1_m = expected_1_m - 1.0 / static_cast<double>(depth_m);
    const double squared_1_m2 = expected_1_m * expected_1_m;
    if (expected_1_m <= 0.0 || farther_1_m < -std::max(noise_1_m, kRelief_m * squared_1_m2)) return Against::kInFront;
    return farther_1_m > std::max(noise_1_m, kBehind_m * squared_1_m2) ? Against::kBehind : Against::kOn;
  }

  DepthView view_;
  WallPlane wall_;
  double at_zero_, by_u_, by_v_;
  std::vector<Against> classes_;
};

bool isBehindOrUnknown(Against at) { return at == Against::kBehind || at == Against::kUnknown; }

/// What is dark or far behind an opening returns nothing, so pixels without depth belong to a hole that they touch; but
/// not lines of them, which the edges of everything have.
bool mayBelong(const AgainstWall& against, int u, int v) {
  const Against at = against.at(u, v);
  if (at != Against::kUnknown) return at == Against::kBehind;
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (const Against beside = against.at(u + du, v + dv); beside != Against::kOutside && !isBehindOrUnknown(beside))
        return false;
  return true;
}

/// Connected pixels that are behind the wall or without depth; enough of them are behind it.
std::vector<std::vector<int>> piecesBehind(const AgainstWall& against) {
  const int width = against.view().camera.width_px, height = against.view().camera.height_px;
  std::vector<bool> taken(static_cast<std::size_t>(width * height), false);
  std::vector<std::vector<int>> pieces;
  const auto take = [&](int u, int v, std::vector<int>& piece) {
    if (u < 0 || v < 0 || u >= width || v >= height || taken[static_cast<std::size_t>(v * width + u)]) return;
    if (!mayBelong(against, u, v)) return;
    taken[static_cast<std::size_t>(v * width + u)] = true;
    piece.push_back(v * width + u);
  };
  for (int pixel = 0; pixel < width * height; ++pixel) {
    std::vector<int> piece;
    if (against.at(pixel % width, pixel / width) == Against::kBehind) take(pixel % width, pixel / width, piece);
    for (std::size_t next = 0; next < piece.size(); ++next) {
      const int u = piece[next] % width, v = piece[next] / width;
      take(u - 1, v, piece);
      take(u + 1, v, piece);
      take(u, v - 1, piece);
      take(u, v + 1, piece);
    }
    const auto behind = std::count_if(
        piece.begin(), piece.end(), [&](int one) { return against.at(one % width, one / width) == Against::kBehind; });
    if (behind < kPixels) continue;
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// One look from a hole outwards.
struct SideSample {
  HoleEnd end = HoleEnd::kHidden;
  double place_m = 0.0;
  double sigma_m = 0.0;
};

/// Looks from the last pixel of a hole in one direction.
class LookOut {
 public:
  LookOut(const AgainstWall& against, int du, int dv) : against_(against), du_(du), dv_(dv) {
    shadow_px_ = static_cast<int>(kShadow_rad * against.view().camera.fx_px);
  }

  SideSample from(int u, int v) const {
    int gap = 0;
    Against next = Against::kUnknown;
    for (; gap <= shadow_px_; ++gap) {
      u += du_;
      v += dv_;
      next = against_.at(u, v);
      if (next != Against::kUnknown) break;
    }
    const double edge_u = u - 0.5 * du_, edge_v = v - 0.5 * dv_;
    SideSample sample;
    const Eigen::Vector3d edge = against_.onWall(edge_u, edge_v);
    sample.place_m = place(edge);
    // One pixel is so long on the wall, in this direction.
    sample.sigma_m = kEdgeSigma_px * std::abs(place(against_.onWall(edge_u + du_, edge_v + dv_)) - sample.place_m);
    if (next == Against::kOutside) sample.end = HoleEnd::kPicture;
    if (next == Against::kOn) sample.end = beyondEdge(u, v, sample.sigma_m / kEdgeSigma_px);
    if (next == Against::kInFront && isFloor(u, v, edge)) sample.end = HoleEnd::kFloor;
    return sample;
  }

 private:
  double place(const Eigen::Vector3d& point) const { return du_ != 0 ? against_.wall().right().dot(point) : point.z(); }

  HoleEnd beyondEdge(int u, int v, double pixel_m) const {
    const int steps = std::max(2, static_cast<int>((dv_ > 0 ? kSill_m : kFrame_m) / std::max(pixel_m, 1e-3)));
    int on = 0, seen = 0;
    Against last = Against::kOn;
    for (int step = 1; step <= steps; ++step) {
      const Against at = against_.at(u + step * du_, v + step * dv_);
      if (at == Against::kOutside) break;
      last = at;
      if (at == Against::kUnknown) continue;
      ++seen;
      if (at == Against::kOn) ++on;
    }
    // A sill is told from the floor before a door by what is a little lower.
    if (dv_ > 0 && last == Against::kInFront) {
      const Eigen::Vector3d edge = against_.onWall(u, v);
      if (isFloor(u + steps * du_, v + steps * dv_, edge)) return HoleEnd::kFloor;
    }
    return on >= kMostly * seen ? HoleEnd::kWall : HoleEnd::kHidden;
  }

  bool isFloor(int u, int v, const Eigen::Vector3d& edge) const {
    const common::PinholeCamera& camera = against_.view().camera;
    if (dv_ <= 0 || u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) return false;
    const float depth_m = against_.view().depth.at(u, v);
    if (!common::isMeasured(depth_m)) return false;
    const double height_m = static_cast<double>(depth_m) * against_.view().ray(u, v).z();
    return std::abs(height_m - edge.z()) < kSameHeight_m;
  }

  const AgainstWall& against_;
  int du_, dv_;
  int shadow_px_ = 0;
};

struct Extent {
  int first = std::numeric_limits<int>::max();
  int last = std::numeric_limits<int>::min();

  bool empty() const { return first > last; }
  void add(int value) {
    first = std::min(first, value);
    last = std::max(last, value);
  }
};

/// Of a side: what most of its samples say. `outermost` is 1 where greater places are farther out, else -1.
HoleSide summed(const std::vector<SideSample>& samples, double outermost, double& walled) {
  std::array<int, 4> counts{};
  std::vector<double> wall, floor, all;
  double sigma_m = 0.0;
  for (const SideSample& sample : samples) {
    ++counts[static_cast<std::size_t>(sample.end)];
    all.push_back(outermost * sample.place_m);
    sigma_m += sample.sigma_m / static_cast<double>(samples.size());
    if (sample.end == HoleEnd::kWall) wall.push_back(sample.place_m);
    if (sample.end == HoleEnd::kFloor) floor.push_back(sample.place_m);
  }
  walled = samples.empty() ? 0.0 : static_cast<double>(wall.size()) / static_cast<double>(samples.size());
  if (samples.empty()) return {HoleEnd::kHidden, 0.0, std::numeric_limits<double>::infinity()};
  const auto mostly = [&](HoleEnd end) {
    return counts[static_cast<std::size_t>(end)] >= kMostly * static_cast<double>(samples.size());
  };
  if (mostly(HoleEnd::kWall)) return {HoleEnd::kWall, common::quantile(wall, 0.5), sigma_m};
  if (mostly(HoleEnd::kFloor)) return {HoleEnd::kFloor, common::quantile(floor, 0.5), sigma_m};
  // As far as most of it reaches.
  const double seen_m = outermost * common::quantile(all, 0.8);
  return {mostly(HoleEnd::kPicture) ? HoleEnd::kPicture : HoleEnd::kHidden, seen_m,
          std::numeric_limits<double>::infinity()};
}

/// Leaves out lines that are much shorter than those of the hole itself: of floor at its foot that returns nothing, and
/// of shadows at its corners. A line is as long as those of the hole if half of the pixels are in lines no longer.
void dropShort(std::vector<Extent>& lines) {
  std::vector<int> lengths;
  int pixels = 0;
  for (const Extent& line : lines) {
    if (line.empty()) continue;
    lengths.push_back(line.last - line.first + 1);
    pixels += lengths.back();
  }
  std::sort(lengths.begin(), lengths.end());
  int shorter = 0, usual = 0;
  for (std::size_t i = 0; i < lengths.size() && 2 * shorter < pixels; ++i) {
    usual = lengths[i];
    shorter += usual;
  }
  for (Extent& line : lines)
    if (!line.empty() && line.last - line.first + 1 < kUsual * usual) line = {};
}

/// The samples of the middle of a side.
template <typename Sample>
std::vector<SideSample> samplesOf(const std::vector<Extent>& lines, Sample&& sample) {
  Extent used;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!lines[i].empty()) used.add(static_cast<int>(i));
  std::vector<SideSample> samples;
  if (used.empty()) return samples;
  const int margin = static_cast<int>(kCorner * (used.last - used.first));
  for (int i = used.first + margin; i <= used.last - margin; ++i)
    if (const Extent& line = lines[static_cast<std::size_t>(i)]; !line.empty()) samples.push_back(sample(i, line));
  return samples;
}

/// Area on the wall, between the sides, of pixels behind it and without depth: a pixel's solid angle, over the cosine,
/// is depth^3 / (distance fx fy).
double area_m2(const AgainstWall& against, const WallHole& hole) {
  const common::PinholeCamera& camera = against.view().camera;
  const Eigen::Vector3d right = hole.wall.right();
  double sum = 0.0;
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      if (!isBehindOrUnknown(against.at(u, v)) || against.wall_1_m(u, v) <= 0.0) continue;
      const Eigen::Vector3d at = against.onWall(u, v);
      const double along_m = right.dot(at);
      if (along_m > hole.sides[WallHole::kLeft].place_m && along_m < hole.sides[WallHole::kRight].place_m &&
          at.z() > hole.sides[WallHole::kBottom].place_m && at.z() < hole.sides[WallHole::kTop].place_m)
        sum += std::pow(against.wall_1_m(u, v), -3.0);
    }
  return sum / (against.wall().distance_m() * camera.fx_px * camera.fy_px);
}

void measureDepth(const AgainstWall& against, WallHole& hole) {
  const int width = against.view().camera.width_px;
  std::vector<double> measured_m;
  int deep = 0, all = 0;
  for (const int pixel : hole.pixels) {
    const int u = pixel % width, v = pixel / width;
    if (against.at(u, v) != Against::kBehind) continue;
    ++all;
    const double behind_m = against.behind_m(u, v);
    if (behind_m > kRoomBehind_m) ++deep;
    if (common::isMeasured(against.view().depth.at(u, v))) measured_m.push_back(behind_m);
  }
  hole.deep = static_cast<double>(deep) / all;
  hole.measured = static_cast<double>(measured_m.size()) / all;
  if (!measured_m.empty()) hole.recess_m = common::quantile(measured_m, 0.5);
}

WallHole holeOf(const AgainstWall& against, std::vector<int> pixels) {
  const common::PinholeCamera& camera = against.view().camera;
  std::vector<Extent> rows(static_cast<std::size_t>(camera.height_px)),
      columns(static_cast<std::size_t>(camera.width_px));
  for (const int pixel : pixels) {
    rows[static_cast<std::size_t>(pixel / camera.width_px)].add(pixel % camera.width_px);
    columns[static_cast<std::size_t>(pixel % camera.width_px)].add(pixel / camera.width_px);
  }
  dropShort(rows);
  dropShort(columns);
  const LookOut left(against, -1, 0), right(against, 1, 0), up(against, 0, -1), down(against, 0, 1);
  WallHole hole;
  hole.wall = against.wall();
  hole.pixels = std::move(pixels);
  std::array<double, 4> walled{};
  const auto side = [&](WallHole::Side which, const std::vector<Extent>& lines, double outermost, const auto& look) {
    hole.sides[which] = summed(samplesOf(lines, look), outermost, walled[which]);
  };
  side(WallHole::kLeft, rows, -1.0, [&](int v, const Extent& row) { return left.from(row.first, v); });
  side(WallHole::kRight, rows, 1.0, [&](int v, const Extent& row) { return right.from(row.last, v); });
  side(WallHole::kTop, columns, 1.0, [&](int u, const Extent& column) { return up.from(u, column.first); });
  side(WallHole::kBottom, columns, -1.0, [&](int u, const Extent& column) { return down.from(u, column.last); });
  hole.framed = (walled[WallHole::kLeft] + walled[WallHole::kRight] +
                 std::max(walled[WallHole::kTop], walled[WallHole::kBottom])) /
                3.0;
  hole.filled = area_m2(against, hole) / std::max(1e-3, hole.width_m() * hole.height_m());
  measureDepth(against, hole);
  return hole;
}

}  // namespace

Eigen::Vector3d WallHole::centre() const {
  const double along_m = 0.5 * (sides[kLeft].place_m + sides[kRight].place_m);
  const double height_m = 0.5 * (sides[kTop].place_m + sides[kBottom].place_m);
  // The point of the plane with that place and height; the plane may be a little off upright.
  const Eigen::Vector3d right = wall.right(), up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead = up.cross(right);
  const Eigen::Vector3d aside = along_m * right + height_m * up;
  return aside + (1.0 - wall.inverse_1_m.dot(aside)) / wall.inverse_1_m.dot(ahead) * ahead;
}

std::vector<WallHole> findHoles(const DepthView& view, const WallPlane& wall) {
  const AgainstWall against(view, wall);
  std::vector<WallHole> holes;
  for (std::vector<int>& pixels : piecesBehind(against)) {
    WallHole hole = holeOf(against, std::move(pixels));
    if (hole.sides[WallHole::kLeft].end == HoleEnd::kWall && hole.sides[WallHole::kRight].end == HoleEnd::kWall)
      holes.push_back(std::move(hole));
  }
  return holes;
}

}  // namespace swiftlet::perception
