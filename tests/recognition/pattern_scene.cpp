#include "tests/recognition/pattern_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/random.hpp"
#include "perception/recognition/picture_pyramid.hpp"
#include "perception/recognition/planar_pose.hpp"

namespace swiftlet::perception {
namespace {

using common::RandomStream;
using vision::GrayImage;

constexpr double kPi = std::numbers::pi;

/// Radical inverse (Halton): low discrepancy in every dimension with its own prime.
double halton(std::uint64_t index, std::uint64_t base) {
  double value = 0.0, digit = 1.0 / static_cast<double>(base);
  for (std::uint64_t rest = index; rest > 0; rest /= base, digit /= static_cast<double>(base))
    value += digit * static_cast<double>(rest % base);
  return value;
}

/// Six numbers in [0, 1), those of the sequence shifted by the seed (Cranley and Patterson).
std::array<double, 6> sixNumbers(std::uint64_t index, RandomStream& shift) {
  constexpr std::array<std::uint64_t, 6> kPrimes = {2, 3, 5, 7, 11, 13};
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < 6; ++i) numbers[i] = std::fmod(halton(index + 1, kPrimes[i]) + shift.uniform(), 1.0);
  return numbers;
}

std::array<Eigen::Vector2d, 4> cornersOf(const PlanarPose& pose, double width_m) {
  const double half = 0.5 * width_m;
  const common::PinholeCamera camera = sceneCamera();
  return {pixelOf(camera, pose * Eigen::Vector2d(-half, -half)), pixelOf(camera, pose * Eigen::Vector2d(half, -half)),
          pixelOf(camera, pose * Eigen::Vector2d(half, half)), pixelOf(camera, pose * Eigen::Vector2d(-half, half))};
}

/// A sheet of which all corners are in the picture, from numbers in [0, 1): size, tilt and its direction, turn, place.
PlacedSheet place(const std::array<double, 6>& numbers, double width_m) {
  constexpr double kSmallest_px = 20.0, kLargest_px = 280.0, kGreatestTilt_rad = 65.0 * kPi / 180.0;
  const common::PinholeCamera camera = sceneCamera();
  const double wanted_px = kSmallest_px * std::pow(kLargest_px / kSmallest_px, numbers[0]);
  // Uniform over the directions of the normal within the cone.
  const double cosine = 1.0 - numbers[1] * (1.0 - std::cos(kGreatestTilt_rad));
  PlacedSheet sheet;
  sheet.tilt_rad = std::acos(cosine);
  const double towards = 2.0 * kPi * numbers[2], turn = 2.0 * kPi * numbers[3];
  const double margin_px = 0.75 * wanted_px / std::sqrt(cosine) + 3.0;
  const double free_u = std::max(0.0, camera.width_px - 2.0 * margin_px);
  const double free_v = std::max(0.0, camera.height_px - 2.0 * margin_px);
  const double u = 0.5 * camera.width_px + (numbers[4] - 0.5) * free_u;
  const double v = 0.5 * camera.height_px + (numbers[5] - 0.5) * free_v;
  const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0);
  // Facing the camera: x right, y up, z back along the ray.
  Eigen::Matrix3d facing;
  facing << 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0;
  const Eigen::Matrix3d to_ray = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray).toRotationMatrix();
  const Eigen::Vector3d axis(std::cos(towards), std::sin(towards), 0.0);
  PlanarPose pose;
  pose.rotation = to_ray * Eigen::AngleAxisd(sheet.tilt_rad, axis).toRotationMatrix() * facing *
                  Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  double distance_m = camera.fx_px * width_m * std::sqrt(cosine) / wanted_px;
  for (int i = 0; i < 4; ++i) {
    pose.position_m = distance_m * ray;
    const auto corners = cornersOf(pose, width_m);
    double area = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
      area += 0.5 * std::abs((corners[k] - corners[0]).x() * (corners[(k + 1) % 4] - corners[0]).y() -
                             (corners[k] - corners[0]).y() * (corners[(k + 1) % 4] - corners[0]).x());
    sheet.size_px = std::sqrt(area);
    distance_m *= sheet.size_px / wanted_px;
  }
  sheet.T_camera_sheet = T_camera_plane(pose);
  return sheet;
}

using Canvas = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

float readClamped(const GrayImage& image, double u, double v) {
  return interpolated(image, std::clamp(static_cast<float>(u), 0.0F, static_cast<float>(image.width_px) - 1.01F),
                      std::clamp(static_cast<float>(v), 0.0F, static_cast<float>(image.height_px) - 1.01F));
}

void drawBackground(Canvas& canvas, const std::vector<GrayImage>& backgrounds, RandomStream& random) {
  if (backgrounds.empty()) {
    canvas.setConstant(static_cast<float>(random.uniform(60.0, 160.0)));
    for (int i = 0; i < 60; ++i) {
      const auto width = static_cast<Eigen::Index>(random.uniform(5.0, 160.0));
      const auto height = static_cast<Eigen::Index>(random.uniform(5.0, 160.0));
      const auto u = static_cast<Eigen::Index>(random.uniform(0.0, static_cast<double>(canvas.cols() - width)));
      const auto v = static_cast<Eigen::Index>(random.uniform(0.0, static_cast<double>(canvas.rows() - height)));
      canvas.block(v, u, height, width) = static_cast<float>(random.uniform(10.0, 245.0));
    }
    return;
  }
  const GrayImage& source =
      backgrounds[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(backgrounds.size())))];
  const double scale = random.uniform(0.6, 1.0) * std::min(source.width_px / static_cast<double>(canvas.cols()),
                                                           source.height_px / static_cast<double>(canvas.rows()));
  const double u0 = random.uniform(0.0, source.width_px - scale * static_cast<double>(canvas.cols()));
  const double v0 = random.uniform(0.0, source.height_px - scale * static_cast<double>(canvas.rows()));
  const bool is_flipped = random.chance(0.5);
  for (Eigen::Index v = 0; v < canvas.rows(); ++v)
    for (Eigen::Index u = 0; u < canvas.cols(); ++u) {
      const auto from = static_cast<double>(is_flipped ? canvas.cols() - 1 - u : u);
      canvas(v, u) = readClamped(source, u0 + scale * from, v0 + scale * static_cast<double>(v));
    }
}

void drawSheet(Canvas& canvas, const PlacedSheet& sheet, const GrayImage& print, double width_m) {
  const PlanarPose pose = planarPose(sheet.T_camera_sheet);
  const common::PinholeCamera camera = sceneCamera();
  const std::vector<GrayImage> levels = pyramidOf(print, 4);
  Eigen::Matrix3d to_optical;
  to_optical << pose.rotation.leftCols<2>(), pose.position_m;
  Eigen::Matrix3d K;
  K << camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d to_sheet = (K * to_optical).inverse();
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Eigen::Vector2d& corner : cornersOf(pose, width_m)) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double per_m = print.width_px / width_m;
  // 3 x 3 rays a pixel; each reads the print at their spacing.
  const double spacing_px = width_m / sheet.size_px * per_m / 3.0;
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(std::max(1.0, spacing_px)) + 0.5)), 0,
                               static_cast<int>(levels.size()) - 1);
  const GrayImage& read = levels[static_cast<std::size_t>(level)];
  for (int v = std::max(0, static_cast<int>(low.y()) - 1);
       v < std::min<int>(static_cast<int>(canvas.rows()), static_cast<int>(high.y()) + 3); ++v)
    for (int u = std::max(0, static_cast<int>(low.x()) - 1);
         u < std::min<int>(static_cast<int>(canvas.cols()), static_cast<int>(high.x()) + 3); ++u) {
      float sum = 0.0F, count = 0.0F;
      for (int k = 0; k < 9; ++k) {
        const Eigen::Vector3d on_sheet = to_sheet * Eigen::Vector3d(u + (k % 3 - 1) / 3.0, v + (k / 3 - 1) / 3.0, 1.0);
        const Eigen::Vector2d at = on_sheet.hnormalized();
        if (std::abs(at.x()) > 0.5 * width_m || std::abs(at.y()) > 0.5 * width_m) continue;
        const Eigen::Vector2d pixel((at.x() + 0.5 * width_m) * per_m - 0.5, (0.5 * width_m - at.y()) * per_m - 0.5);
        const Eigen::Vector2d there = atLevel(pixel, level);
        // Ink reflects 5 %, paper 85 %.
        sum += 13.0F + 0.8F * readClamped(read, there.x(), there.y());
        count += 1.0F;
      }
      canvas(v, u) = (sum + (9.0F - count) * canvas(v, u)) / 9.0F;
    }
}

/// Hides a share of the pattern behind a strip that comes from one side, or a disc.
void drawOccluder(Canvas& canvas, const PatternScene& scene, RandomStream& random) {
  const auto corners = cornersOf(planarPose(scene.pattern.T_camera_sheet), scene.width_m);
  const Eigen::Vector2d middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const double size = scene.pattern.size_px, grey = random.uniform(10.0, 240.0);
  const double towards = random.uniform(0.0, 2.0 * kPi);
  const Eigen::Vector2d direction(std::cos(towards), std::sin(towards));
  const bool is_disc = random.chance(0.5);
  const double radius = size * std::sqrt(scene.occluded_share / kPi);
  const Eigen::Vector2d disc = middle + random.uniform(0.0, 0.45) * size * direction;
  const double edge = size * (0.5 - scene.occluded_share);
  for (Eigen::Index v = 0; v < canvas.rows(); ++v)
    for (Eigen::Index u = 0; u < canvas.cols(); ++u) {
      const Eigen::Vector2d at(static_cast<double>(u), static_cast<double>(v));
      const double along = direction.dot(at - middle);
      const bool hides = is_disc ? (at - disc).squaredNorm() < radius * radius : along > edge && along < size;
      if (hides) canvas(v, u) = static_cast<float>(grey + 12.0 * std::sin(0.7 * at.x() + 0.4 * at.y()));
    }
}

/// The mean over a straight motion during the exposure, and the blur of the lens.
Canvas blurred(const Canvas& canvas, double motion_px, double towards) {
  const Eigen::Index rows = canvas.rows(), columns = canvas.cols();
  Canvas moved = canvas;
  const int taps = static_cast<int>(std::ceil(motion_px)) + 1;
  if (motion_px > 0.3) {
    moved.setZero();
    for (int tap = 0; tap < taps; ++tap) {
      const double shift = motion_px * ((tap + 0.5) / taps - 0.5);
      const double du = shift * std::cos(towards), dv = shift * std::sin(towards);
      const auto whole_u = static_cast<Eigen::Index>(std::floor(du)),
                 whole_v = static_cast<Eigen::Index>(std::floor(dv));
      const auto a = static_cast<float>(du - std::floor(du)), b = static_cast<float>(dv - std::floor(dv));
      for (Eigen::Index v = 0; v < rows; ++v) {
        const Eigen::Index v0 = std::clamp<Eigen::Index>(v + whole_v, 0, rows - 1);
        const Eigen::Index v1 = std::clamp<Eigen::Index>(v + whole_v + 1, 0, rows - 1);
        for (Eigen::Index u = 0; u < columns; ++u) {
          const Eigen::Index u0 = std::clamp<Eigen::Index>(u + whole_u, 0, columns - 1);
          const Eigen::Index u1 = std::clamp<Eigen::Index>(u + whole_u + 1, 0, columns - 1);
          moved(v, u) += (1.0F - b) * ((1.0F - a) * canvas(v0, u0) + a * canvas(v0, u1)) +
                         b * ((1.0F - a) * canvas(v1, u0) + a * canvas(v1, u1));
        }
      }
    }
    moved /= static_cast<float>(taps);
  }
  // A binomial of sigma 0.7 px.
  Canvas across = moved, down;
  across.middleCols(1, columns - 2) =
      0.5F * moved.middleCols(1, columns - 2) + 0.25F * (moved.leftCols(columns - 2) + moved.rightCols(columns - 2));
  down = across;
  down.middleRows(1, rows - 2) =
      0.5F * across.middleRows(1, rows - 2) + 0.25F * (across.topRows(rows - 2) + across.bottomRows(rows - 2));
  return down;
}

/// Draws a function of the place, x right and y up in [-1, 1], with 3 x 3 samples a pixel.
GrayImage drawn(int side_px, const std::function<double(double, double)>& grey) {
  GrayImage picture{side_px, side_px, {}};
  for (int v = 0; v < side_px; ++v)
    for (int u = 0; u < side_px; ++u) {
      double sum = 0.0;
      for (int k = 0; k < 9; ++k)
        sum += grey(2.0 * (u + (k % 3 + 0.5) / 3.0) / side_px - 1.0, 1.0 - 2.0 * (v + (k / 3 + 0.5) / 3.0) / side_px);
      picture.values.push_back(static_cast<std::uint8_t>(sum / 9.0 + 0.5));
    }
  return picture;
}

bool isInBox(double x, double y, double left, double right, double bottom, double top) {
  return x >= left && x <= right && y >= bottom && y <= top;
}

/// A black disc with a white figure.
GrayImage disc(int side_px, const std::function<bool(double, double)>& figure) {
  return drawn(side_px, [&](double x, double y) {
    if (std::hypot(x, y) > 0.9) return 255.0;
    return figure(x, y) ? 255.0 : 0.0;
  });
}

}  // namespace

common::PinholeCamera sceneCamera() { return {752, 480, 460.0, 460.0, 375.5, 239.5}; }

PatternScene drawScene(std::uint64_t seed, std::uint64_t index, double width_m) {
  RandomStream shift(seed, "pattern_scene_shift"), random(seed, "pattern_scene", index);
  PatternScene scene;
  scene.seed = seed;
  scene.index = index;
  scene.width_m = width_m;
  scene.has_pattern = index % 2 == 0;
  scene.pattern = place(sixNumbers(index / 2, shift), width_m);
  const int decoys = static_cast<int>(random.uniform(0.0, 4.0));
  for (int i = 0; i < decoys; ++i) {
    std::array<double, 6> numbers{};
    for (double& number : numbers) number = random.uniform();
    const PlacedSheet decoy = place(numbers, width_m);
    const auto middle = [](const PlacedSheet& sheet) { return sceneCamera().pixel(sheet.T_camera_sheet.position_m); };
    const double apart = (middle(decoy) - middle(scene.pattern)).norm();
    if (!scene.has_pattern || apart > 1.2 * (decoy.size_px + scene.pattern.size_px)) scene.decoys.push_back(decoy);
  }
  if (random.chance(0.3)) scene.occluded_share = random.uniform(0.03, 0.25);
  scene.brightness = random.uniform(0.25, 1.1);
  scene.shading = random.uniform(-0.5, 0.5);
  // Most pictures are sharp; some are taken in a turn.
  scene.motion_px = random.chance(0.5) ? 0.0 : 8.0 * random.uniform() * random.uniform();
  scene.noise = random.uniform(1.0, 6.0);
  return scene;
}

CameraPicture render(const PatternScene& scene, const Prints& prints, const std::vector<GrayImage>& backgrounds) {
  const common::PinholeCamera camera = sceneCamera();
  RandomStream random(scene.seed, "pattern_picture", scene.index);
  Canvas canvas(camera.height_px, camera.width_px);
  drawBackground(canvas, backgrounds, random);
  for (const PlacedSheet& decoy : scene.decoys)
    drawSheet(canvas, decoy,
              prints.decoys[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(prints.decoys.size())))],
              scene.width_m);
  if (scene.has_pattern) drawSheet(canvas, scene.pattern, prints.pattern, scene.width_m);
  if (scene.has_pattern && scene.occluded_share > 0.0) drawOccluder(canvas, scene, random);
  canvas = blurred(canvas, scene.motion_px, random.uniform(0.0, 2.0 * kPi));
  const double towards = random.uniform(0.0, 2.0 * kPi);
  CameraPicture picture{camera, {camera.width_px, camera.height_px, {}}};
  picture.gray.values.reserve(static_cast<std::size_t>(camera.pixels()));
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const double along = ((u - camera.cx_px) * std::cos(towards) + (v - camera.cy_px) * std::sin(towards)) / 446.0;
      const double light = scene.brightness * (1.0 + scene.shading * along);
      // The sum of four uniform numbers is nearly normal; each has a variance of 1 / 12.
      const std::uint64_t bits = random.bits();
      double sum = -2.0;
      for (int k = 0; k < 4; ++k) sum += static_cast<double>((bits >> (16 * k)) & 0xffffU) / 65536.0;
      const double value = light * static_cast<double>(canvas(v, u)) + scene.noise * sum * std::sqrt(3.0);
      picture.gray.values.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)));
    }
  return picture;
}

GrayImage landingMark(int side_px) {
  return disc(side_px, [](double x, double y) {
    return isInBox(x, y, -0.55, -0.25, -0.6, 0.6) || isInBox(x, y, -0.05, 0.6, 0.1, 0.55) ||
           isInBox(x, y, -0.3, 0.3, -0.4, -0.15);
  });
}

GrayImage shapesDrawing(int side_px) {
  return drawn(side_px, [](double x, double y) {
    if (std::hypot(x + 0.45, y - 0.45) < 0.38) return 30.0;
    if (isInBox(x, y, 0.1, 0.85, 0.2, 0.85)) return isInBox(x, y, 0.3, 0.65, 0.4, 0.65) ? 220.0 : 90.0;
    if (y < -0.1 && y > -0.85 && std::abs(x + 0.45) < 0.5 * (-0.1 - y)) return 130.0;
    if (isInBox(x, y, 0.2, 0.4, -0.85, -0.1) || isInBox(x, y, 0.2, 0.85, -0.85, -0.65)) return 10.0;
    return 240.0;
  });
}

GrayImage mirrored(const GrayImage& picture) {
  GrayImage mirror = picture;
  for (int v = 0; v < picture.height_px; ++v) {
    const auto row = mirror.values.begin() + static_cast<std::ptrdiff_t>(v) * picture.width_px;
    std::reverse(row, row + picture.width_px);
  }
  return mirror;
}

std::vector<GrayImage> landingDecoys(int side_px) {
  return {mirrored(landingMark(side_px)),
          mirrored(shapesDrawing(side_px)),
          disc(side_px, [](double x, double y) { return std::abs(std::abs(x) - std::abs(y)) < 0.18; }),
          disc(side_px, [](double x, double y) { return std::hypot(x, y) < 0.6 && std::hypot(x, y) > 0.3; }),
          disc(side_px, [](double x, double y) { return y > -0.5 && y < 0.6 && std::abs(x) < 0.45 * (0.6 - y); }),
          disc(side_px,
               [](double x, double y) {
                 return isInBox(x, y, -0.4, -0.15, -0.6, 0.6) || isInBox(x, y, -0.4, 0.4, 0.35, 0.6) ||
                        isInBox(x, y, -0.4, 0.25, -0.1, 0.15);
               }),
          disc(side_px, [](double x, double y) {
            return std::hypot(x + 0.35, y) < 0.2 || std::hypot(x - 0.3, y - 0.35) < 0.2 ||
                   std::hypot(x - 0.3, y + 0.35) < 0.2;
          })};
}

}  // namespace swiftlet::perception
