#include "web/server/route.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "web/server/target.hpp"

namespace swiftlet::web {
namespace {

/// Larger numbers are mistakes: no map is 100 km wide.
constexpr double kGreatestCoordinate_m = 1e5;

/// Holds the refusal as soon as a check fails.
struct Refused {
  Refuse refuse;
};

[[noreturn]] void refuse(int status, std::string reason, std::string allow = {}) {
  throw Refused{{status, std::move(reason), std::move(allow)}};
}

/// Text of an unknown client, made safe for a message.
std::string shown(std::string_view text) {
  std::string result = "`";
  for (const char c : text.substr(0, 40))
    result += static_cast<unsigned char>(c) >= 32 && static_cast<unsigned char>(c) < 127 ? c : '?';
  return result + (text.size() > 40 ? "...`" : "`");
}

/// Takes the same time for a wrong token as for the right one.
bool sameSecret(std::string_view given, std::string_view secret) {
  unsigned char difference = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < secret.size(); ++i)
    difference = static_cast<unsigned char>(difference | (secret[i] ^ (i < given.size() ? given[i] : '\0')));
  return difference == 0;
}

void checkHost(const Request& request, const Policy& policy) {
  const auto name = hostName(request.host);
  if (name && (*name == "localhost" || isAddressLiteral(*name) ||
               std::find(policy.hosts.begin(), policy.hosts.end(), *name) != policy.hosts.end()))
    return;
  refuse(403, fmt::format("the host {} is not this server: open the page by its address", shown(request.host)));
}

void checkMethod(const Request& request, const std::string& wanted) {
  if (request.method != wanted) refuse(405, fmt::format("use {} here, not {}", wanted, shown(request.method)), wanted);
}

/// Browsers send the origin of a page that posts or opens a socket; only Swiftlet's own page may.
void checkOrigin(const Request& request) {
  if (request.origin.empty() || request.origin == "http://" + request.host) return;
  refuse(403, fmt::format("a page of {} may not do this", shown(request.origin)));
}

/// Empty if the request shows none.
std::string_view shownToken(const Request& request, const Target& target) {
  constexpr std::string_view kBearer = "Bearer ";
  if (request.authorization.compare(0, kBearer.size(), kBearer) == 0)
    return std::string_view(request.authorization).substr(kBearer.size());
  const auto it = target.query.find("token");
  return it == target.query.end() ? std::string_view() : std::string_view(it->second);
}

bool isToken(std::string_view given, const Policy& policy) {
  return !policy.token.empty() && sameSecret(given, policy.token);
}

void checkToken(const Request& request, const Target& target, const Policy& policy) {
  const std::string_view given = shownToken(request, target);
  if (given.empty())
    refuse(401,
           "this needs the operator's token: open the link printed at start, or send `Authorization: Bearer TOKEN`");
  if (!isToken(given, policy))
    refuse(401, "the operator's token is wrong: open the link printed at this program's start");
}

/// The number of the vehicle that is meant; the first where none is named.
std::size_t vehicleOf(const Target& target, const Policy& policy) {
  const auto named = target.query.find("vehicle");
  if (named == target.query.end()) return 0;
  const auto it = std::find(policy.vehicles.begin(), policy.vehicles.end(), named->second);
  if (it != policy.vehicles.end()) return static_cast<std::size_t>(it - policy.vehicles.begin());
  const std::string hint = common::didYouMean(named->second, policy.vehicles);
  refuse(404, fmt::format("there is no vehicle {}{}{}", shown(named->second), hint.empty() ? "" : ", ", hint));
}

class Parameters {
 public:
  Parameters(const Target& target, std::vector<std::string> known) : query_(target.query) {
    for (const auto& [key, value] : query_) {
      // Pages add `t` or `_` to get past a cache.
      if (key == "token" || key == "vehicle" || key == "t" || key == "_") continue;
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        const std::string hint = common::didYouMean(key, known);
        refuse(400, fmt::format("unknown parameter {}{}{}", shown(key), hint.empty() ? "" : ", ", hint));
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
      refuse(400, fmt::format("{}: {} is not a number of at least {:g}{}", key, shown(it->second), least, unit));
    return std::min(value, greatest);
  }

  bool has(const std::string& key) const { return query_.contains(key); }

  /// Refuses what is outside of the bounds.
  double within(const std::string& key, double otherwise, double bound_low, double bound_high, const char* unit) const {
    const double value = number(key, otherwise, bound_low, std::numeric_limits<double>::infinity(), unit);
    if (!(value <= bound_high))
      refuse(400, fmt::format("{}: {:g} is not at most {:g}{}", key, value, bound_high, unit));
    return value;
  }

  /// The place of the word among `words`; 0 when it is not given.
  std::size_t word(const std::string& key, const std::vector<std::string>& words) const {
    const auto it = query_.find(key);
    if (it == query_.end()) return 0;
    const auto found = std::find(words.begin(), words.end(), it->second);
    if (found == words.end())
      refuse(400, fmt::format("{}: {} is none of {}", key, shown(it->second), fmt::join(words, ", ")));
    return static_cast<std::size_t>(found - words.begin());
  }

  rendering::Scheme scheme() const {
    const auto it = query_.find("scheme");
    if (it == query_.end()) return rendering::Scheme::kLight;
    const auto scheme = rendering::schemeFrom(it->second);
    if (!scheme) refuse(400, fmt::format("scheme: {} is neither `light` nor `dark`", shown(it->second)));
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

Action mapStream(const Target& target, std::size_t vehicle) {
  const Parameters parameters(target, {"width", "height", "fps", "scheme"});
  return StreamPictures{mapView(parameters), framesPerSecond(parameters), vehicle};
}

Action mapPicture(const Target& target, std::size_t vehicle) {
  return SendPicture{mapView(Parameters(target, {"width", "height", "scheme"})), vehicle};
}

Action cameraStream(const Target& target, std::size_t vehicle) {
  const Parameters parameters(target, {"width", "fps"});
  PictureView view;
  view.source = PictureView::Source::kCamera;
  view.width_px = static_cast<int>(parameters.number("width", 640, 32, 1920, " pixels"));
  view.height_px = 0;
  return StreamPictures{view, framesPerSecond(parameters), vehicle};
}

Action depthStream(const Target& target, std::size_t vehicle) {
  const Parameters parameters(target, {"width", "fps"});
  PictureView view;
  view.source = PictureView::Source::kDepth;
  view.width_px = static_cast<int>(parameters.number("width", 640, 32, 1920, " pixels"));
  view.height_px = 0;
  return StreamPictures{view, framesPerSecond(parameters), vehicle};
}

/// What a kind of viewpoint has no use for is refused, so that nobody wonders why it changes nothing.
void refuseUnused(const Parameters& parameters, std::initializer_list<const char*> keys, const char* needs) {
  for (const char* key : keys)
    if (parameters.has(key)) refuse(400, fmt::format("{}: only for {}", key, needs));
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
    return parameters.within(key, 0.0, -kGreatestCoordinate_m, kGreatestCoordinate_m, " m");
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

Action map3dStream(const Target& target, std::size_t vehicle) {
  const Parameters parameters(
      target, {"width", "height", "fps", "scheme", "color", "view", "x", "y", "z", "distance", "azimuth", "elevation"});
  PictureView view = mapView(parameters);
  view.source = PictureView::Source::kMap3d;
  view.coloring = static_cast<rendering::PointColor>(parameters.word("color", {"measured", "normal"}));
  view.viewpoint = viewpoint(parameters);
  return StreamPictures{view, framesPerSecond(parameters), vehicle};
}

double coordinate(const nlohmann::json& body, const char* key) {
  const auto it = body.find(key);
  if (it == body.end() || !it->is_number())
    refuse(400, fmt::format("{}: a number of metres in the map is missing; send {{\"x_m\": 1.0, \"y_m\": 2.0}}", key));
  const double value = it->get<double>();
  if (!std::isfinite(value) || std::abs(value) > kGreatestCoordinate_m)
    refuse(400, fmt::format("{}: {} is not within {:g} m of the origin", key, value, kGreatestCoordinate_m));
  return value;
}

Action goal(const Request& request, std::size_t vehicle) {
  const nlohmann::json body = nlohmann::json::parse(request.body, nullptr, false);
  if (!body.is_object()) refuse(400, "the body is not a JSON object; send {\"x_m\": 1.0, \"y_m\": 2.0}");
  for (const auto& [key, value] : body.items())
    if (key != "x_m" && key != "y_m") refuse(400, fmt::format("unknown key {}; send x_m and y_m", shown(key)));
  return GiveCommand{common::GoalCommand{{coordinate(body, "x_m"), coordinate(body, "y_m")}}, vehicle};
}

Action command(const Request& request, const std::string& name, std::size_t vehicle) {
  if (name == "goal") return goal(request, vehicle);
  if (name == "hold") return GiveCommand{common::HoldCommand{}, vehicle};
  if (name == "resume") return GiveCommand{common::ResumeCommand{}, vehicle};
  if (name == "home") return GiveCommand{common::HomeCommand{}, vehicle};
  return GiveCommand{common::LandCommand{}, vehicle};
}

Action read(const Request& request, const Target& target, std::size_t vehicle) {
  checkMethod(request, "GET");
  if (target.path == "/stream/map.mjpg") return mapStream(target, vehicle);
  if (target.path == "/stream/camera.mjpg") return cameraStream(target, vehicle);
  if (target.path == "/stream/map3d.mjpg") return map3dStream(target, vehicle);
  if (target.path == "/stream/depth.mjpg") return depthStream(target, vehicle);
  if (target.path == "/api/map.png") return mapPicture(target, vehicle);
  if (target.path == "/api/state") return SendState{vehicle};
  checkOrigin(request);
  if (!request.wants_websocket) refuse(426, "this is a WebSocket: connect with `Upgrade: websocket`");
  return OpenSocket{target.path == "/api/map3d" ? OpenSocket::Feed::kMap3d : OpenSocket::Feed::kPage, vehicle};
}

Action decide(const Request& request, const Policy& policy) {
  static const std::vector<std::string> kReads{"/stream/map.mjpg",
                                               "/stream/camera.mjpg",
                                               "/stream/map3d.mjpg",
                                               "/stream/depth.mjpg",
                                               "/api/map.png",
                                               "/api/state",
                                               "/api/ws",
                                               "/api/map3d"};
  static const std::vector<std::string> kCommands{"/api/goal", "/api/hold", "/api/resume", "/api/home", "/api/land"};
  const auto in = [](const std::vector<std::string>& list, const std::string& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
  };
  checkHost(request, policy);
  const auto target = parseTarget(request.target);
  if (!target) refuse(400, fmt::format("the address {} is malformed", shown(request.target)));
  if (in(kReads, target->path)) return read(request, *target, vehicleOf(*target, policy));
  if (in(kCommands, target->path)) {
    const std::size_t vehicle = vehicleOf(*target, policy);
    checkMethod(request, "POST");
    checkOrigin(request);
    checkToken(request, *target, policy);
    return command(request, target->path.substr(5), vehicle);
  }
  if (target->path == "/api/token") {
    checkMethod(request, "GET");
    checkToken(request, *target, policy);
    return ConfirmToken{};
  }
  const std::string file = target->path == "/" ? "index.html" : target->path.substr(1);
  if (!in(policy.files, file)) refuse(404, fmt::format("there is no {} here", shown(target->path)));
  (void)vehicleOf(*target, policy);
  checkMethod(request, "GET");
  return ServeFile{file};
}

}  // namespace

bool hasToken(const Request& request, const Policy& policy) {
  const auto target = parseTarget(request.target);
  return target && isToken(shownToken(request, *target), policy);
}

Action route(const Request& request, const Policy& policy) {
  try {
    return decide(request, policy);
  } catch (const Refused& refused) {
    return refused.refuse;
  }
}

}  // namespace swiftlet::web
