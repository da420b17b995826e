#include "web/server/picture_query.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "web/server/refusal.hpp"

namespace swiftlet::web {
namespace {

using common::Message;

/// Larger numbers are mistakes: no map is 100 km wide.
constexpr double kFarthestTarget_m = 1e5;

class Parameters {
 public:
  Parameters(const Target& target, std::vector<std::string> known) : query_(target.query) {
    for (const auto& [key, value] : query_) {
      // Pages add `t` or `_` to get past a cache.
      if (key == "token" || key == "vehicle" || key == "t" || key == "_") continue;
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        const std::string hint = common::didYouMean(key, known);
        refuse(400, Message("query.unknown-parameter", "unknown parameter {}{}{}", shown(key), hint.empty() ? "" : ", ",
                            hint));
      }
    }
  }

  double number(const std::string& key, double otherwise, double least, double greatest, const char* unit) const {
    const auto it = query_.find(key);
    if (it == query_.end()) return otherwise;
    double value = 0.0;
    const char* end = it->second.data() + it->second.size();
    const auto [stop, error] = std::from_chars(it->second.data(), end, value);
    if (error != std::errc() || stop != end || !(value >= least))
      refuse(400, Message("query.too-low", "{}: {} is not a number of at least {:g}{}", key, shown(it->second), least,
                          unit));
    return std::min(value, greatest);
  }

  bool has(const std::string& key) const { return query_.contains(key); }

  /// Refuses what is outside of the bounds.
  double within(const std::string& key, double otherwise, double bound_low, double bound_high, const char* unit) const {
    const double value = number(key, otherwise, bound_low, std::numeric_limits<double>::infinity(), unit);
    if (!(value <= bound_high))
      refuse(400, Message("query.too-high", "{}: {:g} is not at most {:g}{}", key, value, bound_high, unit));
    return value;
  }

  /// The place of the word among `words`; 0 when it is not given.
  std::size_t word(const std::string& key, const std::vector<std::string>& words) const {
    const auto it = query_.find(key);
    if (it == query_.end()) return 0;
    const auto found = std::find(words.begin(), words.end(), it->second);
    if (found == words.end())
      refuse(400,
             Message("query.unknown-word", "{}: {} is none of {}", key, shown(it->second), fmt::join(words, ", ")));
    return static_cast<std::size_t>(found - words.begin());
  }

  rendering::Scheme scheme() const {
    const auto it = query_.find("scheme");
    if (it == query_.end()) return rendering::Scheme::kLight;
    const auto scheme = rendering::schemeFrom(it->second);
    if (!scheme)
      refuse(400, Message("query.unknown-scheme", "scheme: {} is neither `light` nor `dark`", shown(it->second)));
    return *scheme;
  }

 private:
  const std::map<std::string, std::string>& query_;
};

PictureView mapView(const Parameters& parameters) {
  PictureView view;
  view.width_px = static_cast<int>(parameters.number("width", 640, 64, 1920, " pixels"));
  view.height_px =
      static_cast<int>(parameters.number("height", std::max(64, view.width_px * 3 / 4), 64, 1920, " pixels"));
  view.scheme = parameters.scheme();
  return view;
}

double framesPerSecond(const Parameters& parameters) {
  return parameters.number("fps", 10.0, 0.1, 30.0, " per second");
}

/// Of a camera, whose pictures keep their aspect ratio.
PictureQuery cameraQuery(const Target& target, PictureView::Source source) {
  const Parameters parameters(target, {"width", "fps"});
  PictureView view;
  view.source = source;
  view.width_px = static_cast<int>(parameters.number("width", 640, 32, 1920, " pixels"));
  view.height_px = 0;
  return {view, framesPerSecond(parameters)};
}

/// Parameters that a kind of viewpoint does not use are refused, so that their lack of effect is no surprise.
void refuseUnused(const Parameters& parameters, std::initializer_list<const char*> keys, const char* needs) {
  for (const char* key : keys)
    if (parameters.has(key)) refuse(400, Message("query.without-effect", "{}: only for {}", key, needs));
}

rendering::Viewpoint3d viewpoint(const Parameters& parameters) {
  using Kind = rendering::Viewpoint3d::Kind;
  rendering::Viewpoint3d view;
  view.kind = static_cast<Kind>(parameters.word("view", {"whole", "orbit", "follow", "camera"}));
  if (view.kind != Kind::kOrbit) refuseUnused(parameters, {"x", "y", "z"}, "view=orbit");
  if (view.kind == Kind::kWhole || view.kind == Kind::kCamera)
    refuseUnused(parameters, {"distance"}, "view=orbit and view=follow");
  if (view.kind == Kind::kCamera) refuseUnused(parameters, {"azimuth", "elevation"}, "other views than view=camera");
  const auto coordinate = [&](const char* key) {
    return parameters.within(key, 0.0, -kFarthestTarget_m, kFarthestTarget_m, " m");
  };
  view.target_x_map_m = coordinate("x");
  view.target_y_map_m = coordinate("y");
  view.target_z_map_m = coordinate("z");
  view.distance_m = parameters.within("distance", view.distance_m, 0.2, 1000.0, " m");
  const auto angle_rad = [&](const char* key, double otherwise_rad, double bound_deg) {
    return parameters.within(key, otherwise_rad / common::kRadPerDeg, -bound_deg, bound_deg, " degrees") *
           common::kRadPerDeg;
  };
  view.azimuth_rad = angle_rad("azimuth", view.azimuth_rad, 360.0);
  view.elevation_rad = angle_rad("elevation", view.elevation_rad, 89.0);
  return view;
}

}  // namespace

PictureQuery mapStream(const Target& target) {
  const Parameters parameters(target, {"width", "height", "fps", "scheme"});
  return {mapView(parameters), framesPerSecond(parameters)};
}

PictureQuery map3dStream(const Target& target) {
  const Parameters parameters(
      target, {"width", "height", "fps", "scheme", "color", "view", "x", "y", "z", "distance", "azimuth", "elevation"});
  PictureView view = mapView(parameters);
  view.source = PictureView::Source::kMap3d;
  view.coloring = static_cast<rendering::PointColor>(parameters.word("color", {"measured", "normal"}));
  view.viewpoint = viewpoint(parameters);
  return {view, framesPerSecond(parameters)};
}

PictureQuery cameraStream(const Target& target) { return cameraQuery(target, PictureView::Source::kCamera); }

PictureQuery depthStream(const Target& target) { return cameraQuery(target, PictureView::Source::kDepth); }

PictureView mapPicture(const Target& target) { return mapView(Parameters(target, {"width", "height", "scheme"})); }

}  // namespace swiftlet::web
