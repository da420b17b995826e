#include "web/server/route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "web/server/picture_query.hpp"
#include "web/server/refusal.hpp"
#include "web/server/target.hpp"

namespace swiftlet::web {
namespace {

using common::Message;

/// Larger numbers are mistakes: no map is 100 km wide.
constexpr double kGreatestCoordinate_m = 1e5;

/// Takes the same time for a wrong token as for the right one.
bool sameSecret(std::string_view given, std::string_view secret) {
  unsigned char difference = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < secret.size(); ++i)
    difference = static_cast<unsigned char>(difference | (secret[i] ^ (i < given.size() ? given[i] : '\0')));
  return difference == 0;
}

template <typename List>
bool in(const List& list, std::string_view item) {
  return std::find(std::begin(list), std::end(list), item) != std::end(list);
}

/// What to add to the refusal of an address that may be one of the page.
std::string howToAllow(const std::optional<Origin>& origin) {
  return origin ? fmt::format("; if it is this page, start with `--public-url {}/`", toString(*origin)) : "";
}

/// Where a page that was opened by the Host comes from, if no proxy has changed anything.
std::optional<Origin> originOfHost(const Request& request) { return parseOrigin("http://" + request.host); }

/// Refuses a name that others could let stand for this machine's address (DNS rebinding).
void checkHost(const Request& request, const Policy& policy) {
  const auto origin = originOfHost(request);
  const auto isHost = [&](const PublicUrl& url) { return url.origin.host == origin->host; };
  if (origin && (origin->host == "localhost" || isAddressLiteral(origin->host) || in(policy.hosts, origin->host) ||
                 std::any_of(policy.public_urls.begin(), policy.public_urls.end(), isHost)))
    return;
  refuse(403, Message("request.other-host", "the host {} is not this server: open the page by its address{}",
                      shown(request.host), origin ? howToAllow(origin) + ", or with https" : ""));
}

void checkMethod(const Request& request, const std::string& wanted, const std::string& allow) {
  if (request.method != wanted)
    refuse(405, Message("request.other-method", "use {} here, not {}", wanted, shown(request.method)), allow);
}
void checkMethod(const Request& request, const std::string& wanted) { checkMethod(request, wanted, wanted); }

/// HEAD is GET without the body (RFC 9110, 9.1).
void checkGetOrHead(const Request& request) {
  if (request.method != "HEAD") checkMethod(request, "GET", "GET, HEAD");
}

/// By its public addresses, or by the Host; not by a Host that is a public address of https, whose name others may use
/// for a page of http.
bool isOwn(const Origin& origin, const Request& request, const Policy& policy) {
  bool behind_tls = false;
  for (const PublicUrl& url : policy.public_urls) {
    if (url.origin == origin) return true;
    behind_tls |= parseOrigin(url.origin.scheme + "://" + request.host) == url.origin && url.origin.scheme == "https";
  }
  return !behind_tls && origin == originOfHost(request);
}

/// Browsers send the origin of a page that posts or opens a socket; only Swiftlet's own page may.
void checkOrigin(const Request& request, const Policy& policy) {
  if (request.origin.empty()) return;
  const auto origin = parseOrigin(request.origin);
  if (origin && isOwn(*origin, request, policy)) return;
  refuse(403,
         Message("request.other-page", "a page of {} may not do this{}", shown(request.origin), howToAllow(origin)));
}

/// The texts that may be the operator's token. A proxy may put a token of its own into Authorization, and a page that
/// was opened by an old link shows that in its address.
std::array<std::string_view, 3> shownTokens(const Request& request, const Target& target) {
  constexpr std::string_view kBearer = "Bearer ";
  std::array<std::string_view, 3> shown{request.token};
  const std::string_view authorization = request.authorization;
  if (authorization.starts_with(kBearer)) shown[1] = authorization.substr(kBearer.size());
  if (const auto it = target.query.find("token"); it != target.query.end()) shown[2] = it->second;
  return shown;
}

bool showsToken(const Request& request, const Target& target, const Policy& policy) {
  const auto shown = shownTokens(request, target);
  return !policy.token.empty() && std::any_of(shown.begin(), shown.end(),
                                              [&](std::string_view given) { return sameSecret(given, policy.token); });
}

void checkToken(const Request& request, const Target& target, const Policy& policy) {
  if (showsToken(request, target, policy)) return;
  const auto shown = shownTokens(request, target);
  if (std::all_of(shown.begin(), shown.end(), [](std::string_view given) { return given.empty(); }))
    refuse(401, Message("request.no-token",
                        "this needs the operator's token: open the link printed at start, or send `Authorization: "
                        "Bearer TOKEN`"));
  refuse(401, Message("request.wrong-token",
                      "the operator's token is wrong: open the link printed at this program's start"));
}

/// The number of the vehicle that is meant; the first where none is named.
std::size_t vehicleOf(const Target& target, const Policy& policy) {
  const auto named = target.query.find("vehicle");
  if (named == target.query.end()) return 0;
  const auto it = std::find(policy.vehicles.begin(), policy.vehicles.end(), named->second);
  if (it != policy.vehicles.end()) return static_cast<std::size_t>(it - policy.vehicles.begin());
  const std::string hint = common::didYouMean(named->second, policy.vehicles);
  refuse(404, Message("request.no-vehicle", "there is no vehicle {}{}{}", shown(named->second),
                      hint.empty() ? "" : ", ", hint));
}

double coordinate(const nlohmann::json& body, const char* key) {
  const auto it = body.find(key);
  if (it == body.end() || !it->is_number())
    refuse(400, Message("goal.no-coordinate",
                        "{}: a number of metres in the map is missing; send {{\"x_m\": 1.0, \"y_m\": 2.0}}", key));
  const double value = it->get<double>();
  if (!std::isfinite(value) || std::abs(value) > kGreatestCoordinate_m)
    refuse(400,
           Message("goal.too-far", "{}: {} is not within {:g} m of the origin", key, value, kGreatestCoordinate_m));
  return value;
}

/// Whether the body's places lie in the given map: "frame": "given". Otherwise, and without a frame, they lie in `map`.
bool inGivenMap(const nlohmann::json& body) {
  const auto it = body.find("frame");
  if (it == body.end() || *it == "map") return false;
  if (*it == "given") return true;
  refuse(400, Message("request.no-frame",
                      "frame: expected \"map\", the frame of the flight, or \"given\", that of the given map"));
}

/// The object in the body of a request; `example` is what it may send.
nlohmann::json objectIn(const Request& request, const std::string& example) {
  nlohmann::json body = nlohmann::json::parse(request.body, nullptr, false);
  if (body.is_object()) return body;
  const std::size_t begin = request.body.find_first_not_of(" \t\r\n");
  const bool broken = body.is_discarded() && begin != std::string::npos && request.body[begin] == '{';
  refuse(400, broken ? Message("request.no-json",
                               "the body is not JSON: its numbers must be finite, its names and texts in quotation "
                               "marks; send {}",
                               example)
                     : Message("request.no-object", "the body is not a JSON object; send {}", example));
}

[[noreturn]] void refuseKey(const std::string& key, const char* known) {
  refuse(400, Message("request.unknown-key", "unknown key {}; send {}", shown(key), known));
}

[[noreturn]] void refuseBody(const char* example) { refuse(400, Message("request.other-body", "send {}", example)); }

Action goal(const Request& request, std::size_t vehicle) {
  const nlohmann::json body = objectIn(request, R"({"x_m": 1.0, "y_m": 2.0})");
  for (const auto& [key, value] : body.items())
    if (key != "x_m" && key != "y_m" && key != "frame") refuseKey(key, "x_m, y_m and perhaps frame");
  const Eigen::Vector2d place(coordinate(body, "x_m"), coordinate(body, "y_m"));
  if (inGivenMap(body)) return GiveCommand{common::GoalCommand{{}, place}, vehicle};
  return GiveCommand{common::GoalCommand{place}, vehicle};
}

std::map<std::string, std::string> parametersIn(const nlohmann::json& given) {
  if (given.is_null()) return {};
  if (!given.is_object())
    refuse(400, Message("mission.parameters", "parameters: expected an object of texts, {{\"KEY\": \"VALUE\"}}"));
  std::map<std::string, std::string> parameters;
  for (const auto& [name, text] : given.items()) {
    if (!text.is_string()) refuse(400, Message("mission.parameter-value", "{}: the value is not a text", shown(name)));
    parameters[name] = text;
  }
  return parameters;
}

/// {"file": "missions/patrol.xml", "parameters": {"Main/Sequence/TakeOff.height_m": "1.2"}}.
Action mission(const Request& request, std::size_t vehicle) {
  constexpr const char* kExample = R"({"file": "a file of /api/missions", "parameters": {}})";
  const nlohmann::json body = objectIn(request, kExample);
  if (!body.contains("file") || !body["file"].is_string()) refuseBody(kExample);
  StartMission start{body["file"], {}, vehicle};
  for (const auto& [key, value] : body.items()) {
    if (key == "file") continue;
    if (key != "parameters") refuseKey(key, "file and parameters");
    start.parameters = parametersIn(value);
  }
  return start;
}

Eigen::Vector2d corner(const nlohmann::json& pair) {
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number())
    refuse(400, Message("keep-out.no-corners",
                        "corners_m: expected pairs of metres in the map, [[0.0, 1.0], [2.0, 1.0], ...]"));
  return {pair[0].get<double>(), pair[1].get<double>()};
}

Action keepOut(const Request& request, std::size_t vehicle) {
  constexpr const char* kExample = R"({"corners_m": [[0.0, 1.0], [2.0, 1.0], [2.0, 3.0]]})";
  const nlohmann::json body = objectIn(request, kExample);
  const std::size_t keys = body.contains("frame") ? 2 : 1;
  if (body.size() != keys || !body.contains("corners_m") || !body["corners_m"].is_array()) refuseBody(kExample);
  if (body["corners_m"].size() > common::kMostCorners)
    refuse(400, Message("keep-out.too-many-corners", "corners_m: more than {} corners", common::kMostCorners));
  common::KeepOutCommand zone;
  for (const nlohmann::json& pair : body["corners_m"]) zone.area.corners_map_m.push_back(corner(pair));
  if (const auto problem = problemOf(zone.area)) refuse(400, problem->behind("corners_m: "));
  if (inGivenMap(body)) zone.corners_given_m = std::exchange(zone.area.corners_map_m, {});
  return GiveCommand{std::move(zone), vehicle};
}

Action command(const Request& request, const std::string& name, std::size_t vehicle) {
  if (name == "mission") return mission(request, vehicle);
  if (name == "stop") return GiveCommand{common::StopMissionCommand{}, vehicle};
  if (name == "goal") return goal(request, vehicle);
  if (name == "keep_out") return keepOut(request, vehicle);
  if (name == "clear_keep_out") return GiveCommand{common::ClearKeepOutCommand{}, vehicle};
  if (name == "go_on") return GiveCommand{common::GoOnCommand{}, vehicle};
  if (name == "hold") return GiveCommand{common::HoldCommand{}, vehicle};
  if (name == "resume") return GiveCommand{common::ResumeCommand{}, vehicle};
  if (name == "home") return GiveCommand{common::HomeCommand{}, vehicle};
  return GiveCommand{common::LandCommand{}, vehicle};
}

Action read(const Request& request, const Target& target, std::size_t vehicle, const Policy& policy) {
  if (target.path == "/api/map.png" || target.path == "/api/state")
    checkGetOrHead(request);
  else
    checkMethod(request, "GET");  // An endless stream has no length for HEAD.
  const auto stream = [&](const PictureQuery& asked) { return StreamPictures{asked.view, asked.fps, vehicle}; };
  if (target.path == "/stream/map.mjpg") return stream(mapStream(target));
  if (target.path == "/stream/camera.mjpg") return stream(cameraStream(target));
  if (target.path == "/stream/map3d.mjpg") return stream(map3dStream(target));
  if (target.path == "/stream/depth.mjpg") return stream(depthStream(target));
  if (target.path == "/api/map.png") return SendPicture{mapPicture(target), vehicle};
  if (target.path == "/api/state") return SendState{vehicle};
  checkOrigin(request, policy);
  if (!request.wants_websocket)
    refuse(426, Message("request.no-websocket", "this is a WebSocket: connect with `Upgrade: websocket`"));
  return OpenSocket{target.path == "/api/map3d" ? OpenSocket::Feed::kMap3d : OpenSocket::Feed::kPage, vehicle};
}

constexpr std::array<std::string_view, 8> kReads{
    "/stream/map.mjpg", "/stream/camera.mjpg", "/stream/map3d.mjpg", "/stream/depth.mjpg", "/api/map.png", "/api/state",
    "/api/ws",          "/api/map3d"};
constexpr std::array<std::string_view, 10> kCommands{
    "/api/goal",    "/api/hold", "/api/resume",   "/api/home",           "/api/land",
    "/api/mission", "/api/stop", "/api/keep_out", "/api/clear_keep_out", "/api/go_on"};
constexpr std::array<std::string_view, 2> kForTheOperator{"/api/token", "/api/missions"};

std::string fileOf(std::string_view path) { return path == "/" ? "index.html" : std::string(path.substr(1)); }

bool isServed(std::string_view path, const Policy& policy) {
  return in(kReads, path) || in(kCommands, path) || in(kForTheOperator, path) || in(policy.files, fileOf(path));
}

/// The path as it is served: proxies may leave in front of it the path of the public address, and a slash too many.
std::string servedPath(const std::string& asked, const Policy& policy) {
  std::string path = asked.substr(std::min(asked.find_first_not_of('/'), asked.size()) - 1);
  if (isServed(path, policy)) return path;
  for (const PublicUrl& url : policy.public_urls)
    if (path.starts_with(url.path) && isServed(path.substr(url.path.size() - 1), policy))
      return path.substr(url.path.size() - 1);
  return path;
}

/// From the path of a public address without its last slash to the one with it.
std::optional<Redirect> toFolder(const Request& request, const std::string& path, const Policy& policy) {
  const auto lacksSlash = [&](const PublicUrl& url) { return url.path == path + "/"; };
  if (std::none_of(policy.public_urls.begin(), policy.public_urls.end(), lacksSlash)) return std::nullopt;
  checkGetOrHead(request);
  const std::string_view target = request.target, as_sent = target.substr(0, target.find('?'));
  return Redirect{fmt::format("./{}/{}", as_sent.substr(as_sent.rfind('/') + 1), target.substr(as_sent.size()))};
}

Action decide(const Request& request, const Policy& policy) {
  checkHost(request, policy);
  auto target = parseTarget(request.target);
  if (!target) refuse(400, target.error());
  target->path = servedPath(target->path, policy);
  if (in(kReads, target->path)) return read(request, *target, vehicleOf(*target, policy), policy);
  if (in(kCommands, target->path)) {
    const std::size_t vehicle = vehicleOf(*target, policy);
    checkMethod(request, "POST");
    checkOrigin(request, policy);
    checkToken(request, *target, policy);
    return command(request, target->path.substr(5), vehicle);
  }
  if (in(kForTheOperator, target->path)) {
    checkMethod(request, "GET");
    checkToken(request, *target, policy);
    if (target->path == "/api/missions") return ListMissions{};
    return ConfirmToken{};
  }
  if (const auto redirect = toFolder(request, target->path, policy)) return *redirect;
  if (!in(policy.files, fileOf(target->path)))
    refuse(404, Message("request.no-such-path", "there is no {} here", shown(target->path)));
  (void)vehicleOf(*target, policy);
  checkGetOrHead(request);
  return ServeFile{fileOf(target->path)};
}

}  // namespace

bool hasToken(const Request& request, const Policy& policy) {
  const Request asked = inOriginForm(request);
  const auto target = parseTarget(asked.target);
  return target && showsToken(asked, *target, policy);
}

Action route(const Request& request, const Policy& policy) {
  try {
    return decide(inOriginForm(request), policy);
  } catch (const Refuse& refusal) {
    return refusal;
  }
}

}  // namespace swiftlet::web
