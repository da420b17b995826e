#include "perception/recognition/house_model.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "common/config.hpp"
#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

using common::Message;

void HouseModel::describe(common::config::Fields& fields) {
  fields("length_m", length_m, {1, 50}, "Outer length, along the ridge.");
  fields("width_m", width_m, {1, 50}, "Outer width.");
  fields("eaves_m", eaves_m, {1, 20}, "Height of the eaves above the floor.");
  fields("ridge_m", ridge_m, {1, 30}, "Height of the ridge above the floor; that of the eaves for a flat roof.");
  fields("chimney_x_m", chimney_x_m, {0, 25}, "Middle of the chimney along the ridge, from the middle of the house.");
  fields("chimney_y_m", chimney_y_m, {-25, 25}, "Middle of the chimney across the ridge, to the left of x.");
  fields("chimney_side_m", chimney_side_m, {0.1, 5}, "Side of the chimney, a square.");
  fields("chimney_top_m", chimney_top_m, {1, 40}, "Height of the top of the chimney above the floor.");
}

std::vector<common::Problem> HouseModel::validate() const {
  common::Validation validation;
  validation.require(ridge_m >= eaves_m, "ridge_m",
                     Message("house.ridge-below-eaves", "the ridge, {} m, is below the eaves, {} m", ridge_m, eaves_m));
  const bool on_roof = std::abs(chimney_x_m) + 0.5 * chimney_side_m <= 0.5 * length_m &&
                       std::abs(chimney_y_m) + 0.5 * chimney_side_m <= 0.5 * width_m;
  validation.require(on_roof, "chimney_x_m", Message("house.chimney-beside", "the chimney is not on the roof"));
  validation.require(chimney_top_m > roofAt_m(chimney_y_m), "chimney_top_m",
                     Message("house.chimney-below-roof", "the chimney ends below the roof, at {} m", chimney_top_m));
  // In the middle it looks the same from both sides, and does not tell which end of the house is which.
  const bool tells = std::hypot(chimney_x_m, chimney_y_m) >= 0.5 * chimney_side_m;
  return validation
      .require(tells, "chimney_x_m",
               Message("house.chimney-in-the-middle", "a chimney in the middle does not tell one end from the other"))
      .problems();
}

tl::expected<HouseModel, Message> HouseModel::read(const std::string& text, const std::string& name) {
  HouseModel model;
  try {
    common::config::YamlReader::fromText(text, name).read(model);
  } catch (const common::InputError& error) {
    return tl::unexpected(error.problems().front().message);
  }
  return model;
}

double HouseModel::roofAt_m(double y_m) const {
  return ridge_m - (ridge_m - eaves_m) * std::abs(y_m) / (0.5 * width_m);
}

HouseBody::HouseBody(const HouseModel& model) {
  const double rise_m = model.ridge_m - model.eaves_m, half_m = 0.5 * model.width_m;
  const Eigen::Vector3d left = Eigen::Vector3d(0.0, rise_m, half_m).normalized();
  const Eigen::Vector3d right(0.0, -left.y(), left.z());
  faces_ = {{{Eigen::Vector3d::UnitX(), 0.5 * model.length_m},
             {-Eigen::Vector3d::UnitX(), 0.5 * model.length_m},
             {Eigen::Vector3d::UnitY(), half_m},
             {-Eigen::Vector3d::UnitY(), half_m},
             {left, left.z() * model.ridge_m},
             {right, right.z() * model.ridge_m}}};
}

int HouseBody::faceOf(const Eigen::Vector3d& point_m) const {
  int best = 0;
  double most_m = -std::numeric_limits<double>::infinity();
  for (int face = 0; face < kHouseFaces; ++face) {
    const double off = off_m(point_m, face);
    if (off <= most_m) continue;
    most_m = off;
    best = face;
  }
  return best;
}

std::optional<HouseBody::Entry> HouseBody::enteredBy(const Eigen::Vector3d& from_m, const Eigen::Vector3d& ray) const {
  double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
  int face = -1;
  for (int i = 0; i < kHouseFaces; ++i) {
    const double outside_m = off_m(from_m, i), towards = faces_[static_cast<std::size_t>(i)].normal.dot(ray);
    if (std::abs(towards) < 1e-9) {
      if (outside_m > 0.0) return std::nullopt;
      continue;
    }
    const double at = -outside_m / towards;
    if (towards > 0.0) {
      leaves = std::min(leaves, at);
    } else if (at > enters) {
      enters = at;
      face = i;
    }
  }
  // The floor: what the ray meets below it is the ground.
  if (face < 0 || enters >= leaves || from_m.z() + enters * ray.z() < 0.0) return std::nullopt;
  return Entry{enters, face};
}

}  // namespace swiftlet::perception
