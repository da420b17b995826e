// Every reason to refuse a request, without a socket.
#include "web/server/route.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/problem_matchers.hpp"
#include "web/server/target.hpp"

namespace swiftlet::web {
namespace {

using ::swiftlet::test_support::MessageIs;

const Policy kPolicy{"secret-token", {"cobra.local"}, {"index.html", "page.js"}};

Request get(std::string target) { return {"GET", std::move(target), "127.0.0.1:8080", "", "", "", false}; }

Request post(std::string target, std::string body = "") {
  return {"POST", std::move(target), "127.0.0.1:8080", "", "Bearer secret-token", std::move(body), false};
}

int statusOf(const Action& action) {
  const auto* refuse = std::get_if<Refuse>(&action);
  return refuse == nullptr ? 200 : refuse->status;
}

common::Message reasonOf(const Action& action) {
  const auto* refuse = std::get_if<Refuse>(&action);
  return refuse == nullptr ? common::Message() : refuse->reason;
}

Policy withPublicUrls(const std::vector<std::string>& urls) {
  Policy policy = kPolicy;
  for (const std::string& url : urls) policy.public_urls.push_back(parsePublicUrl(url));
  return policy;
}

/// Whether a page of that origin may land the vehicle, and connect.
bool mayCommand(const std::string& host, const std::string& origin, const Policy& policy) {
  Request land = post("/api/land"), socket = get("/api/ws");
  socket.wants_websocket = true;
  land.host = socket.host = host;
  land.origin = socket.origin = origin;
  const bool may = std::holds_alternative<GiveCommand>(route(land, policy));
  EXPECT_EQ(std::holds_alternative<OpenSocket>(route(socket, policy)), may);
  return may;
}

TEST(RouteTest, ServesThePageAtTheRoot) {
  const Action action = route(get("/?token=secret-token"), kPolicy);
  EXPECT_EQ(std::get<ServeFile>(action).name, "index.html");
  EXPECT_EQ(std::get<ServeFile>(route(get("/page.js"), kPolicy)).name, "page.js");
}

TEST(RouteTest, ReadsStreamParameters) {
  const auto stream = std::get<StreamPictures>(route(get("/stream/map.mjpg?width=320&fps=5&scheme=dark"), kPolicy));
  EXPECT_EQ(stream.view.width_px, 320);
  EXPECT_EQ(stream.view.height_px, 240);
  EXPECT_EQ(stream.view.scheme, rendering::Scheme::kDark);
  EXPECT_DOUBLE_EQ(stream.fps, 5.0);
}

TEST(RouteTest, ClampsLargeParametersAndRefusesInvalidOnes) {
  const auto stream = std::get<StreamPictures>(route(get("/stream/map.mjpg?width=99999&fps=1e9"), kPolicy));
  EXPECT_EQ(stream.view.width_px, 1920);
  EXPECT_DOUBLE_EQ(stream.fps, 30.0);
  for (const char* bad : {"width=", "width=abc", "width=-5", "width=12px", "width=nan", "width=inf&fps=-inf", "fps=0",
                          "scheme=pink", "width=1&width=2", "width=%zz"})
    EXPECT_EQ(statusOf(route(get(std::string("/stream/map.mjpg?") + bad), kPolicy)), 400) << bad;
  EXPECT_THAT(reasonOf(route(get("/stream/map.mjpg?widht=3"), kPolicy)),
              MessageIs("query.unknown-parameter", "`width`"));
  EXPECT_THAT(reasonOf(route(get("/stream/map.mjpg?width=1&width=2"), kPolicy)),
              MessageIs("query.parameter-twice", "`width`"));
}

TEST(RouteTest, SaysWhoIsAnOperator) {
  EXPECT_TRUE(std::holds_alternative<ConfirmToken>(route(get("/api/token?token=secret-token"), kPolicy)));
  EXPECT_EQ(statusOf(route(get("/api/token?token=of-yesterday"), kPolicy)), 401);
  EXPECT_EQ(statusOf(route(get("/api/token"), kPolicy)), 401);
  EXPECT_EQ(statusOf(route(post("/api/token"), kPolicy)), 405);
  EXPECT_TRUE(hasToken(get("/stream/map.mjpg?token=secret-token"), kPolicy));
  EXPECT_TRUE(hasToken(post("/api/hold"), kPolicy));
  EXPECT_FALSE(hasToken(get("/stream/map.mjpg?token=of-yesterday"), kPolicy)) << "it may still watch";
  EXPECT_FALSE(hasToken(get("/stream/map.mjpg"), kPolicy));
  EXPECT_FALSE(hasToken(get("/?token="), Policy{}));
}

TEST(RouteTest, SelectsTheNamedVehicle) {
  Policy several = kPolicy;
  several.vehicles = {"alpha", "beta"};
  EXPECT_EQ(std::get<SendState>(route(get("/api/state"), several)).vehicle, 0u);
  EXPECT_EQ(std::get<SendState>(route(get("/api/state?vehicle=beta"), several)).vehicle, 1u);
  EXPECT_EQ(std::get<SendPicture>(route(get("/api/map.png?vehicle=beta&width=99"), several)).vehicle, 1u);
  EXPECT_EQ(std::get<StreamPictures>(route(get("/stream/map.mjpg?vehicle=beta"), several)).vehicle, 1u);
  EXPECT_EQ(std::get<StreamPictures>(route(get("/stream/camera.mjpg?vehicle=beta"), several)).vehicle, 1u);
  for (const char* name : {"hold", "resume", "home", "land"})
    EXPECT_EQ(std::get<GiveCommand>(route(post(std::string("/api/") + name + "?vehicle=beta"), several)).vehicle, 1u);
  const auto goal = route(post("/api/goal?vehicle=beta", R"({"x_m": 1.0, "y_m": 2.0})"), several);
  EXPECT_EQ(std::get<GiveCommand>(goal).vehicle, 1u);
  Request socket = get("/api/ws?vehicle=beta");
  socket.wants_websocket = true;
  EXPECT_EQ(std::get<OpenSocket>(route(socket, several)).vehicle, 1u);
  EXPECT_EQ(std::get<ServeFile>(route(get("/?vehicle=beta"), several)).name, "index.html");
}

TEST(RouteTest, AnUnknownVehicleIsNotFound) {
  Policy several = kPolicy;
  several.vehicles = {"alpha", "beta"};
  for (const char* target : {"/api/state?vehicle=bet", "/?vehicle=bet", "/stream/map.mjpg?vehicle=bet"})
    EXPECT_EQ(statusOf(route(get(target), several)), 404) << target;
  EXPECT_THAT(reasonOf(route(get("/api/state?vehicle=bet"), several)), MessageIs("request.no-vehicle", "`beta`"));
  EXPECT_EQ(statusOf(route(post("/api/land?vehicle=gamma"), several)), 404) << "not the first one";
  EXPECT_EQ(statusOf(route(get("/api/state?vehicle=alpha"), kPolicy)), 404) << "one that flies alone has no name";
}

TEST(RouteTest, RefusesForeignHosts) {
  for (const char* host : {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example:8080", "cobra.local:x",
                           "1.2.3", "1.2.3.4.5", "[::1", "a b", "999.1.1.1.example"}) {
    Request request = get("/api/state");
    request.host = host;
    EXPECT_EQ(statusOf(route(request, kPolicy)), 403) << host;
  }
  for (const char* host :
       {"localhost", "LOCALHOST:80", "192.168.1.20:8080", "[::1]:8080", "[fe80::1]", "Cobra.local:8080"}) {
    Request request = get("/api/state");
    request.host = host;
    EXPECT_TRUE(std::holds_alternative<SendState>(route(request, kPolicy))) << host;
  }
}

TEST(RouteTest, CommandsNeedTheToken) {
  Request request = post("/api/hold");
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(request, kPolicy)));
  for (const char* wrong :
       {"", "Bearer ", "Bearer secret-toke", "Bearer secret-tokenx", "Basic secret-token", "secret-token"}) {
    request.authorization = wrong;
    EXPECT_EQ(statusOf(route(request, kPolicy)), 401) << wrong;
  }
  request = post("/api/hold?token=secret-token");
  request.authorization = "Basic cGlsb3Q6c2VjcmV0";  // Of a proxy.
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(request, kPolicy)));
  request = post("/api/hold");
  request.authorization = "Basic cGlsb3Q6c2VjcmV0";
  request.token = "secret-token";
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(request, kPolicy)));
  request.authorization = "Bearer of-the-proxy";
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(request, kPolicy)));
  EXPECT_TRUE(hasToken(request, kPolicy));
  request.token = "secret-tokem";
  EXPECT_EQ(statusOf(route(request, kPolicy)), 401);
  request.target = "/api/hold?token=secret-token";
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(request, kPolicy)));
  // A server without a token accepts no commands.
  Policy open = kPolicy;
  open.token.clear();
  EXPECT_EQ(statusOf(route(post("/api/hold?token="), open)), 401);
}

TEST(RouteTest, AKeepOutZoneIsAPolygon) {
  const auto zone = [](const std::string& body) { return route(post("/api/keep_out", body), kPolicy); };
  const Action good = zone(R"({"corners_m": [[0, 1], [2, 1], [2, 3.5]]})");
  const auto& area = std::get<common::KeepOutCommand>(std::get<GiveCommand>(good).kind).area;
  EXPECT_EQ(area, (common::Polygon{{{0, 1}, {2, 1}, {2, 3.5}}}));
  for (const char* bad :
       {"", "[]", "{}", R"({"corners_m": 3})", R"({"corners_m": [[0, 1], [2, 1]]})",
        R"({"corners_m": [[0, 1], [2, 1], [2]]})", R"({"corners_m": [[0, 1], [2, 1], [2, "x"]]})",
        R"({"corners_m": [[0, 0], [2, 2], [2, 0], [0, 2]]})", R"({"corners_m": [[0, 1], [2, 1], [2, 3]], "x": 1})"})
    EXPECT_EQ(statusOf(zone(bad)), 400) << bad;
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(post("/api/clear_keep_out"), kPolicy)));
  EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(post("/api/go_on"), kPolicy)));
}

TEST(RouteTest, ForeignPagesMayNeitherCommandNorConnect) {
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:8080", "http://127.0.0.1:8081"}) {
    Request request = post("/api/land");
    request.origin = origin;
    EXPECT_EQ(statusOf(route(request, kPolicy)), 403) << origin;
    request = get("/api/ws");
    request.wants_websocket = true;
    request.origin = origin;
    EXPECT_EQ(statusOf(route(request, kPolicy)), 403) << origin;
  }
  EXPECT_TRUE(mayCommand("127.0.0.1:8080", "http://127.0.0.1:8080", kPolicy));
  EXPECT_TRUE(mayCommand("Cobra.local:80", "http://cobra.local", kPolicy));
  EXPECT_TRUE(mayCommand("[::1]", "http://[::1]", kPolicy));
}

TEST(RouteTest, ARefusedOwnPageIsToldTheOption) {
  Request request = post("/api/hold");
  request.origin = "https://field.example";
  EXPECT_THAT(reasonOf(route(request, kPolicy)),
              MessageIs("request.other-page", "`--public-url https://field.example/`"));
  request.origin = "null";
  EXPECT_THAT(reasonOf(route(request, kPolicy)), ::testing::Not(MessageIs("request.other-page", "--public-url")));
  request = get("/api/state");
  request.host = "field.example:8080";
  EXPECT_THAT(reasonOf(route(request, kPolicy)),
              MessageIs("request.other-host", "`--public-url http://field.example:8080/`"));
}

TEST(RouteTest, PagesOfAPublicAddressAreOwnWhateverTheHost) {
  const Policy policy = withPublicUrls({"https://field.example/swiftlet/", "http://10.0.0.5:9000/"});
  for (const char* host : {"127.0.0.1:8080", "field.example", "FIELD.EXAMPLE:443", "field.example:8443", "localhost"})
    EXPECT_TRUE(mayCommand(host, "https://field.example", policy)) << host;
  EXPECT_TRUE(mayCommand("127.0.0.1:8080", "https://field.example:443", policy));
  EXPECT_TRUE(mayCommand("127.0.0.1:8080", "http://10.0.0.5:9000", policy));
  EXPECT_TRUE(mayCommand("field.example", "", policy)) << "a program that is not a browser";
  EXPECT_TRUE(mayCommand("127.0.0.1:8080", "http://127.0.0.1:8080", policy)) << "beside it, without the proxy";
  EXPECT_TRUE(mayCommand("field.example:8080", "http://field.example:8080", policy)) << "by name, without the proxy";
  for (const char* origin :
       {"http://field.example", "https://field.example:8443", "https://evil.example", "https://sub.field.example",
        "https://field.example.evil.example", "null", "https://field.example/", "http://10.0.0.5"}) {
    EXPECT_FALSE(mayCommand("127.0.0.1:8080", origin, policy)) << origin;
    EXPECT_FALSE(mayCommand("field.example", origin, policy)) << origin;
  }
  EXPECT_FALSE(mayCommand("sub.field.example", "https://field.example", policy)) << "names are whole";
}

TEST(RouteTest, NamesOfPublicAddressesMayStandInHost) {
  const Policy policy = withPublicUrls({"http://drone.local:8080/"});
  EXPECT_TRUE(mayCommand("Drone.LOCAL.:8080", "http://drone.local:8080", policy));
  EXPECT_TRUE(mayCommand("drone.local:9000", "http://drone.local:9000", policy)) << "a port that is passed on";
  EXPECT_FALSE(mayCommand("drone.local:9000", "http://drone.local:9001", policy));
  EXPECT_FALSE(mayCommand("evil.example", "http://evil.example", policy)) << "DNS rebinding";
}

TEST(RouteTest, AProxyTakesThePathOfThePublicAddressOffOrLeavesIt) {
  const Policy policy = withPublicUrls({"https://field.example/a/swiftlet", "https://field.example/api/"});
  for (const char* before : {"", "/a/swiftlet", "/api", "/", "//"}) {
    const auto at = [&](const std::string& path) { return before + path; };
    EXPECT_EQ(std::get<ServeFile>(route(get(at("/?token=x")), policy)).name, "index.html") << before;
    EXPECT_EQ(std::get<ServeFile>(route(get(at("/page.js")), policy)).name, "page.js") << before;
    EXPECT_TRUE(std::holds_alternative<SendState>(route(get(at("/api/state")), policy))) << before;
    EXPECT_TRUE(std::holds_alternative<StreamPictures>(route(get(at("/stream/map.mjpg?fps=5")), policy))) << before;
    EXPECT_TRUE(std::holds_alternative<GiveCommand>(route(post(at("/api/hold")), policy))) << before;
    EXPECT_TRUE(std::holds_alternative<ConfirmToken>(route(get(at("/api/token?token=secret-token")), policy)));
    Request stranger = post(at("/api/hold"));
    stranger.authorization.clear();
    EXPECT_EQ(statusOf(route(stranger, policy)), 401) << before;
  }
  for (const char* target :
       {"/a/page.js", "/b/swiftlet/page.js", "/a/swiftlet/none.js", "/a/swiftlet/a/swiftlet/", "/a/swiftletpage.js"})
    EXPECT_EQ(statusOf(route(get(target), policy)), 404) << target;
  EXPECT_EQ(statusOf(route(get("/a/swiftlet/../page.js"), policy)), 400);
}

TEST(RouteTest, APublicAddressWithoutItsSlashIsRedirected) {
  const Policy policy = withPublicUrls({"https://field.example/a/swiftlet/"});
  EXPECT_EQ(std::get<Redirect>(route(get("/a/swiftlet?token=x"), policy)).location, "./swiftlet/?token=x");
  EXPECT_EQ(std::get<Redirect>(route(get("/a/swift%6Cet"), policy)).location, "./swift%6Cet/");
  EXPECT_EQ(statusOf(route(post("/a/swiftlet"), policy)), 405);
  EXPECT_EQ(statusOf(route(get("/a"), policy)), 404);
  EXPECT_EQ(statusOf(route(get("/a/swiftlet"), kPolicy)), 404);
}

TEST(RouteTest, GoalsAreReadStrictly) {
  const auto command = std::get<GiveCommand>(route(post("/api/goal", R"({"x_m": 3, "y_m": -1.5})"), kPolicy));
  EXPECT_EQ(std::get<common::GoalCommand>(command.kind).goal_map_m, Eigen::Vector2d(3.0, -1.5));
  for (const char* bad : {"", "{", "[]", "null", "[1,2]", R"({"x_m":1})", R"({"x_m":"1","y_m":2})",
                          R"({"x_m":1e300,"y_m":2})", R"({"x_m":1e999,"y_m":2})", R"({"x_m":1,"y_m":2,"z_m":3})",
                          R"({"x_m":null,"y_m":2})", R"({"x_m":1,"y_m":2}x)", "\xff\xfe"})
    EXPECT_EQ(statusOf(route(post("/api/goal", bad), kPolicy)), 400) << bad;
  EXPECT_EQ(statusOf(route(post("/api/goal", std::string(4000, '[')), kPolicy)), 400);
  for (const char* endless : {R"({"x_m":NaN,"y_m":2})", R"({"x_m":1e400,"y_m":2})"})
    EXPECT_THAT(reasonOf(route(post("/api/goal", endless), kPolicy)), MessageIs("request.no-json"));
  EXPECT_THAT(reasonOf(route(post("/api/goal", "[]"), kPolicy)), MessageIs("request.no-object"));
}

TEST(RouteTest, PlacesMayLieInTheGivenMap) {
  const auto kindOf = [](const char* path, const char* body) {
    return std::get<GiveCommand>(route(post(path, body), kPolicy)).kind;
  };
  const auto goal = std::get<common::GoalCommand>(kindOf("/api/goal", R"({"x_m": 3, "y_m": -1.5, "frame": "given"})"));
  ASSERT_TRUE(goal.goal_given_m);
  EXPECT_EQ(*goal.goal_given_m, Eigen::Vector2d(3.0, -1.5));
  const auto own = std::get<common::GoalCommand>(kindOf("/api/goal", R"({"x_m": 3, "y_m": -1.5, "frame": "map"})"));
  EXPECT_FALSE(own.goal_given_m);
  EXPECT_EQ(own.goal_map_m, Eigen::Vector2d(3.0, -1.5));
  const auto zone = std::get<common::KeepOutCommand>(
      kindOf("/api/keep_out", R"({"corners_m": [[0, 1], [2, 1], [2, 3.5]], "frame": "given"})"));
  EXPECT_TRUE(zone.area.corners_map_m.empty()) << "the autonomy knows where they are in map";
  ASSERT_EQ(zone.corners_given_m.size(), 3u);
  EXPECT_EQ(zone.corners_given_m[2], Eigen::Vector2d(2.0, 3.5));
  for (const char* bad : {R"({"x_m":1,"y_m":2,"frame":"world"})", R"({"x_m":1,"y_m":2,"frame":3})"})
    EXPECT_EQ(statusOf(route(post("/api/goal", bad), kPolicy)), 400) << bad;
  EXPECT_EQ(
      statusOf(route(post("/api/keep_out", R"({"corners_m": [[0, 0], [2, 2], [2, 0], [0, 2]], "frame": "given"})"),
                     kPolicy)),
      400);
}

TEST(RouteTest, MissionsAreStartedByTheirFileAndParameters) {
  const auto start = std::get<StartMission>(
      route(post("/api/mission", R"({"file": "missions/a.xml", "parameters": {"M/Go.height_m": "1.2"}})"), kPolicy));
  EXPECT_EQ(start.file, "missions/a.xml");
  EXPECT_EQ(start.parameters, (std::map<std::string, std::string>{{"M/Go.height_m", "1.2"}}));
  EXPECT_TRUE(std::get<StartMission>(route(post("/api/mission", R"({"file": "a"})"), kPolicy)).parameters.empty());
  for (const char* bad : {"", "[]", "{}", R"({"file": 3})", R"({"file": "a", "more": {}})",
                          R"({"file": "a", "parameters": []})", R"({"file": "a", "parameters": {"x": 1.2}})"})
    EXPECT_EQ(statusOf(route(post("/api/mission", bad), kPolicy)), 400) << bad;
  EXPECT_THAT(reasonOf(route(post("/api/mission", R"({"file": "a", "parameters": []})"), kPolicy)),
              MessageIs("mission.parameters"));
  EXPECT_EQ(statusOf(route(post("/api/mission", R"({"file": "a", "parameters": null})"), kPolicy)), 200);
  const auto stop = std::get<GiveCommand>(route(post("/api/stop"), kPolicy));
  EXPECT_TRUE(std::holds_alternative<common::StopMissionCommand>(stop.kind));
  Request foreign = post("/api/mission", R"({"file": "a"})");
  foreign.authorization.clear();
  EXPECT_EQ(statusOf(route(foreign, kPolicy)), 401);
}

TEST(RouteTest, MissionsAreListedForTheOperatorOnly) {
  EXPECT_TRUE(std::holds_alternative<ListMissions>(route(get("/api/missions?token=secret-token"), kPolicy)));
  EXPECT_EQ(statusOf(route(get("/api/missions"), kPolicy)), 401);
  EXPECT_EQ(statusOf(route(post("/api/missions"), kPolicy)), 405);
}

TEST(RouteTest, NamesTheAllowedMethod) {
  const Action action = route(get("/api/goal"), kPolicy);
  EXPECT_EQ(std::get<Refuse>(action).status, 405);
  EXPECT_EQ(std::get<Refuse>(action).allow, "POST");
  EXPECT_EQ(statusOf(route(post("/api/state"), kPolicy)), 405);
  EXPECT_EQ(statusOf(route(get("/api/ws"), kPolicy)), 426);
}

TEST(RouteTest, HeadIsGetWhereTheAnswerHasAnEnd) {
  const auto head = [](Request request) {
    request.method = "HEAD";
    return route(request, kPolicy);
  };
  for (const char* target : {"/", "/page.js", "/api/state", "/api/map.png"})
    EXPECT_EQ(statusOf(head(get(target))), 200) << target;
  EXPECT_EQ(statusOf(head(get("/stream/map.mjpg"))), 405);
  EXPECT_EQ(std::get<Refuse>(route(post("/api/state"), kPolicy)).allow, "GET, HEAD");
}

TEST(RouteTest, AnAbsoluteTargetBringsItsOwnHost) {
  EXPECT_TRUE(std::holds_alternative<SendState>(route(get("http://127.0.0.1:8080/api/state"), kPolicy)));
  EXPECT_EQ(std::get<ServeFile>(route(get("HTTP://cobra.local"), kPolicy)).name, "index.html");
  EXPECT_TRUE(hasToken(get("http://localhost/?token=secret-token"), kPolicy));
  EXPECT_TRUE(hasToken(get("http://localhost?token=secret-token"), kPolicy));
  EXPECT_EQ(statusOf(route(get("http://evil.example/api/state"), kPolicy)), 403);
  EXPECT_EQ(statusOf(route(get("http:///api/state"), kPolicy)), 403);
}

TEST(RouteTest, ServesNothingElse) {
  for (const char* target : {"/etc/passwd", "/api", "/api/", "/index", "//api", "/api/state/"})
    EXPECT_EQ(statusOf(route(get(target), kPolicy)), 404) << target;
  for (const char* target : {"", "x", "https://127.0.0.1/", "*", "/../page.js", "/%2e%2e/page.js", "/page.js%00", "/%"})
    EXPECT_EQ(statusOf(route(get(target), kPolicy)), 400) << target;
}

}  // namespace
}  // namespace swiftlet::web
