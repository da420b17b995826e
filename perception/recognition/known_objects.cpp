#include "perception/recognition/known_objects.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/validation.hpp"
#include "perception/recognition/house_recognizer.hpp"
#include "perception/recognition/object_tracker.hpp"
#include "perception/recognition/pattern_recognizer.hpp"
#include "perception/recognition/tag_recognizer.hpp"

namespace swiftlet::perception {

using common::Message;
using common::Problem;

namespace {

/// A scan plane that is more tilted meets the floor within the reach of a door that is told from a wall.
constexpr double kLevel_rad = 6.0 * common::kRadPerDeg;

/// Without depths openings are known as far as the level laser shows them, in the axes of the camera.
std::vector<Recognized> openingsInScan(const Observation& observation) {
  const Eigen::Quaterniond R_level_laser = observation.R_level_camera * observation.T_camera_laser.rotation;
  if ((R_level_laser * Eigen::Vector3d::UnitZ()).z() < std::cos(kLevel_rad)) return {};
  std::vector<Recognized> openings = ScanOpeningRecognizer(OpeningConfig{}).recognize(observation);
  const Eigen::Matrix3d R = observation.T_camera_laser.rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
  for (Recognized& opening : openings) {
    opening.T_sensor_object = observation.T_camera_laser * opening.T_sensor_object;
    opening.covariance = turn * opening.covariance * turn.transpose();
  }
  return openings;
}

}  // namespace

void KnownObjectConfig::describe(common::config::Fields& fields) {
  fields("name", name,
         "`openings` for windows and doors, or the name of a pattern or a house, by which missions ask for it.");
  fields("picture", picture,
         "Picture of the pattern (PNG or JPEG), or the model of the house (YAML: docs/recognition.md), a path; empty "
         "for openings and tags.");
  fields("tag", tag, {-1, 586}, "Id of the pattern as an AprilTag of the family 36h11; -1 if it is none.");
  fields("width_m", width_m, {0, 10}, "Width of the printed picture, or of the black square of a tag.");
}

std::vector<Problem> KnownObjectConfig::validate() const {
  common::Validation validation;
  validation.given(!name.empty(), "name");
  if (!isPattern())
    return validation
        .require(picture.empty() && tag < 0, "name",
                 Message("recognition.openings-shape", "`{}` have no picture and no tag", kOpenings),
                 "give the pattern another name")
        .problems();
  validation.require(!isOpeningName(name), "name",
                     Message("recognition.name-taken", "`{}` is what an opening is called", name),
                     "name the pattern otherwise, or `openings` to look for windows and doors");
  validation.require(picture.empty() != (tag < 0), "picture",
                     Message("recognition.no-look", "`{}` needs either a picture or a tag", name));
  if (namesHouseModel(picture)) return validation.problems();
  return validation.given(width_m > 0.0, "width_m").problems();
}

tl::expected<KnownObjects, Problem> KnownObjects::create(const std::vector<KnownObjectConfig>& configs,
                                                         const OpeningConfig& openings) {
  KnownObjects known;
  std::vector<KnownTag> tags;
  for (const KnownObjectConfig& config : configs) {
    if (!config.isPattern()) {
      known.openings_ = std::make_unique<OpeningRecognizer>(openings);
    } else if (namesHouseModel(config.picture)) {
      const auto house = HouseModel::read(config.picture_bytes, config.picture);
      if (!house)
        return tl::unexpected(Problem{{}, config.name, house.error().behind("`" + config.picture + "` "), {}});
      known.patterns_.push_back({config.name, {house->length_m, house->width_m}});
      known.recognizers_.push_back(std::make_unique<HouseRecognizer>(
          HouseConfig{config.name, *house, openings.inverse_depth_sigma_1_m, openings.range_max_m}));
    } else if (config.picture.empty()) {
      tags.push_back({config.name, config.tag, config.width_m});
      known.patterns_.push_back({config.name, {config.width_m, config.width_m}});
    } else {
      const auto pattern = PatternTemplate::read(config.name, config.picture_bytes, config.width_m);
      if (!pattern)
        return tl::unexpected(Problem{{}, config.name, pattern.error().behind("`" + config.picture + "` "), {}});
      known.patterns_.push_back({config.name, {pattern->width_m(), pattern->height_m()}});
      known.recognizers_.push_back(std::make_unique<PatternRecognizer>(*pattern));
    }
  }
  if (tags.empty()) return known;
  auto recognizer = TagRecognizer::create(std::move(tags));
  if (!recognizer) return tl::unexpected(Problem{{}, "tag", recognizer.error(), {}});
  known.recognizers_.push_back(std::make_unique<TagRecognizer>(*std::move(recognizer)));
  return known;
}

std::vector<Recognized> KnownObjects::recognize(const Observation& observation) {
  std::vector<Recognized> all;
  if (openings_) all = hasWholeDepths(observation) ? openings_->recognize(observation) : openingsInScan(observation);
  for (const auto& recognizer : recognizers_)
    for (Recognized& one : recognizer->recognize(observation)) {
      const auto known =
          std::find_if(patterns_.begin(), patterns_.end(), [&](const Known& each) { return each.name == one.what; });
      if (known != patterns_.end()) one.size_m = known->size_m;
      all.push_back(std::move(one));
    }
  return all;
}

}  // namespace swiftlet::perception
