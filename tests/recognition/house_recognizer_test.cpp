// A house of known shape: its model, the fit, what tells it from one of another size, and all of it on scenes of the
// generator that it was not written with.
#include "perception/recognition/house_recognizer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "perception/recognition/house_check.hpp"
#include "perception/recognition/house_fit.hpp"
#include "perception/recognition/known_objects.hpp"
#include "tests/recognition/known_house_scene.hpp"

namespace swiftlet::perception {
namespace {

const std::string kSizes =
    "length_m: 4.4\nwidth_m: 3.6\neaves_m: 2.2\nridge_m: 3.0\nchimney_x_m: 1.3\nchimney_y_m: 0.7\nchimney_side_m: "
    "0.5\n";

HouseModel knownHouse() { return *HouseModel::read(kSizes + "chimney_top_m: 3.5\n", "house.yaml"); }

std::string problemOf(const std::string& text) {
  const auto model = HouseModel::read(text, "house.yaml");
  return model ? "" : std::string(model.error().name());
}

TEST(HouseModel, ItsFileSaysSizesThatMakeAHouse) {
  const HouseModel model = knownHouse();
  EXPECT_DOUBLE_EQ(model.roofAt_m(0.0), 3.0);
  EXPECT_DOUBLE_EQ(model.roofAt_m(-1.8), 2.2);
  EXPECT_EQ(problemOf(kSizes + "chimney_top_m: 2.4\n"), "house.chimney-below-roof");
  EXPECT_EQ(problemOf(kSizes + "chimney_top_m: 3.5\nridge_m: 2.0\n").empty(), false) << "a key twice";
  std::string other = kSizes + "chimney_top_m: 3.5\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = other;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(problemOf(with("ridge_m: 3.0", "ridge_m: 2.0")), "house.ridge-below-eaves");
  EXPECT_EQ(problemOf(with("chimney_x_m: 1.3", "chimney_x_m: 2.1")), "house.chimney-beside");
  const std::string middle = with("chimney_x_m: 1.3", "chimney_x_m: 0.0");
  EXPECT_EQ(problemOf(std::string(middle).replace(middle.find("y_m: 0.7"), 8, "y_m: 0.0")),
            "house.chimney-in-the-middle");
}

/// Against a walk along the ray in small steps.
TEST(HouseBody, ARayEntersWhereItsFirstPointInsideIs) {
  const HouseModel model = knownHouse();
  const HouseBody body(model);
  const auto isInside = [&](const Eigen::Vector3d& at) {
    return std::abs(at.x()) <= 2.2 && std::abs(at.y()) <= 1.8 && at.z() >= 0.0 && at.z() <= model.roofAt_m(at.y());
  };
  common::RandomStream random(4, "rays");
  int entered = 0;
  for (int i = 0; i < 300; ++i) {
    const double bearing_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Eigen::Vector3d from(5.0 * std::cos(bearing_rad), 5.0 * std::sin(bearing_rad), random.uniform(0.5, 6.0));
    const Eigen::Vector3d to(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(0.0, 3.5));
    const Eigen::Vector3d ray = (to - from).normalized();
    constexpr double kStep_m = 0.002;
    double walked_m = 0.0;
    while (walked_m < 12.0 && !isInside(from + walked_m * ray)) walked_m += kStep_m;
    const auto entry = body.enteredBy(from, ray);
    // What only grazes an edge may be stepped over.
    if (walked_m >= 12.0 && entry && !isInside(from + (entry->depth_m + 0.01) * ray)) continue;
    ASSERT_EQ(entry.has_value(), walked_m < 12.0) << i;
    if (!entry) continue;
    ++entered;
    EXPECT_NEAR(entry->depth_m, walked_m, 2.0 * kStep_m);
    EXPECT_NEAR(body.off_m(from + entry->depth_m * ray, entry->face), 0.0, 1e-9);
  }
  EXPECT_GT(entered, 80);
}

/// Points of the roof and of two walls, as from a camera in the direction of the corner between these.
std::vector<HousePoint> pointsOf(const HouseModel& model, const HousePose& pose, double sigma_m) {
  common::RandomStream random(7, "house points");
  std::vector<HousePoint> points;
  const auto add = [&](const Eigen::Vector3d& at_house_m) {
    points.push_back({pose.inLevel_m(at_house_m) +
                          Eigen::Vector3d(random.gaussian(sigma_m), random.gaussian(sigma_m), random.gaussian(sigma_m)),
                      sigma_m});
  };
  for (double x = -2.15; x < 2.2; x += 0.1) {
    for (double y = 0.05; y < 1.8; y += 0.1) add({x, y, model.roofAt_m(y)});
    for (double z = 0.4; z < 2.2; z += 0.1) add({x, 1.8, z});
  }
  for (double y = -1.75; y < 1.8; y += 0.1)
    for (double z = 0.4; z < model.roofAt_m(y); z += 0.1) add({2.2, y, z});
  return points;
}

TEST(FitHouse, FindsTheShapeAtEveryHeadingUpToHalfATurn) {
  const HouseModel model = knownHouse();
  for (int i = 0; i < 24; ++i) {
    HousePose truth;
    truth.position_m = {5.0, 0.4, -4.0};
    truth.yaw_rad = common::wrapAngle(2.0 * std::numbers::pi * i / 24.0 + 0.03);
    const auto poses = fitHouse(model, pointsOf(model, truth, 0.03), -4.02);
    ASSERT_FALSE(poses.empty());
    EXPECT_LT((poses.front().position_m - truth.position_m).norm(), 0.03) << i;
    EXPECT_LT(std::abs(std::remainder(poses.front().yaw_rad - truth.yaw_rad, std::numbers::pi)), 0.01) << i;
    EXPECT_GT(poses.front().fit, 0.97);
  }
  EXPECT_TRUE(fitHouse(model, {}, 0.0).empty());
}

struct Recognition {
  int looks = 0, found = 0, off = 0;
};

/// A pose is right within 15 cm and 3 degrees.
Recognition recognitionOf(HouseLook look, bool other, int looks) {
  Recognition result;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(looks); ++i) {
    const KnownHouseScene scene = drawKnownHouse(KnownHouses::kHeldBack, look, other, 31, i);
    const std::vector<Recognized> houses = housesIn(scene, houseCamera());
    ++result.looks;
    if (houses.empty()) continue;
    ++result.found;
    EXPECT_EQ(houses.front().what, "house");
    const HouseError error = errorOf(houses.front(), scene);
    if (error.position_m > 0.15 || error.heading_rad > 3.0 * common::kRadPerDeg) ++result.off;
  }
  return result;
}

TEST(HouseRecognizer, PlacesTheKnownHouseFromFourMetresAbove) {
  const Recognition down = recognitionOf(HouseLook::kDown, false, 12);
  EXPECT_GE(down.found, 6);
  // From straight above only the ends of the roof say where the house is along its ridge: one is 18 cm off.
  EXPECT_LE(down.off, 1);
  const Recognition ahead = recognitionOf(HouseLook::kAhead, false, 12);
  EXPECT_GE(ahead.found, 3);
  EXPECT_EQ(ahead.off, 0);
}

TEST(HouseRecognizer, RefusesAHouseOfAnotherSize) {
  EXPECT_EQ(recognitionOf(HouseLook::kDown, true, 12).found, 0);
  EXPECT_EQ(recognitionOf(HouseLook::kAhead, true, 12).found, 0);
}

TEST(HouseRecognizer, NeedsDepthsAPictureAndTheGround) {
  const KnownHouseScene scene = drawKnownHouse(KnownHouses::kWritten, HouseLook::kDown, false, 2, 1);
  const common::RgbdFrame frame = frameOf(scene, houseCamera());
  const CameraPicture picture{frame.camera, vision::grayOf(frame.color)};
  HouseRecognizer recognizer({"house", scene.model, 0.0019, 8.0});
  Observation observation{.picture = &picture, .frame = &frame, .R_level_camera = scene.R_level_camera};
  EXPECT_EQ(recognizer.recognize(observation).size(), 1U);
  observation.picture = nullptr;
  EXPECT_TRUE(recognizer.recognize(observation).empty());
  observation.picture = &picture;
  observation.frame = nullptr;
  EXPECT_TRUE(recognizer.recognize(observation).empty());
  // A picture without contrast, and depths without the chimney, do not tell one end from the other.
  CameraPicture blank = picture;
  std::fill(blank.gray.values.begin(), blank.gray.values.end(), std::uint8_t{120});
  common::RgbdFrame no_chimney = frame;
  const HouseBody body(scene.model);
  const common::Pose3 T_house_camera = scene.T_camera_house().inverse();
  for (int v = 0; v < frame.camera.height_px; ++v)
    for (int u = 0; u < frame.camera.width_px; ++u) {
      const auto entry =
          body.enteredBy(T_house_camera.position_m, T_house_camera.rotation * frame.camera.point_camera_m(u, v, 1.0));
      if (!entry) continue;
      no_chimney.depth.depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.camera.width_px) +
                               static_cast<std::size_t>(u)] = static_cast<float>(entry->depth_m);
    }
  observation.picture = &blank;
  observation.frame = &no_chimney;
  EXPECT_TRUE(recognizer.recognize(observation).empty());
}

TEST(KnownObjects, AHouseIsNamedByTheFileOfItsModel) {
  KnownObjectConfig config;
  config.name = "home";
  config.picture = "home.yaml";
  config.picture_bytes = kSizes + "chimney_top_m: 3.5\n";
  EXPECT_TRUE(config.validate().empty()) << "it has no width of a print";
  const auto known = KnownObjects::create({config}, {});
  ASSERT_TRUE(known);
  EXPECT_TRUE(known->needsPicture());
  config.picture_bytes = kSizes + "chimney_top_m: 2.4\n";
  const auto refused = KnownObjects::create({config}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().element, "home");
  EXPECT_THAT(refused.error().message.text(), testing::HasSubstr("`home.yaml`"));
}

}  // namespace
}  // namespace swiftlet::perception
