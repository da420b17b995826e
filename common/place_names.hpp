// How texts for people name places: in the frame that the reader sees on the page, which is the given map's while
// the vehicle is localized in it, and `map` otherwise (docs/decisions/localization.md#060).
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/pose2.hpp"

namespace swiftlet::common {

/// A value. Made from the pose that the page uses too (MapLayer::T_map_given), so that both name the same place alike.
struct PlaceNames {
  std::optional<Pose2> T_given_map;  ///< nullopt: places are named in `map`.

  static PlaceNames in(const std::optional<Pose2>& T_map_given) {
    return {T_map_given ? std::optional(T_map_given->inverse()) : std::nullopt};
  }

  /// "(1.00, 2.00)", or "(1.00, 2.00) in the given map".
  std::string of(const Eigen::Vector2d& place_map_m) const;
  /// With the height over the take-off floor, which both frames share.
  std::string of(const Eigen::Vector3d& place_map_m) const;
  /// Without the frame, for a second place in a text that has named it.
  std::string coordinatesOf(const Eigen::Vector2d& place_map_m) const;
  /// The place in the frame of the texts.
  Eigen::Vector2d inFrame_m(const Eigen::Vector2d& place_map_m) const;
};

/// A place that is known in the given map.
std::string nameOfGivenPlace(const Eigen::Vector2d& place_given_m);

}  // namespace swiftlet::common
