// The server over real sockets: the page, commands, streams, bad requests and slow clients.
#include "web/server/web_server.hpp"

#include <sys/socket.h>

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "tests/console/fake_backend.hpp"
#include "tests/support/patience.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/web/http_client.hpp"
#include "web/server/assets.hpp"
#include "web/server/reachable_address.hpp"

namespace swiftlet::testing {
namespace {

using test_support::patience;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;

nlohmann::json jsonOf(const Reply& reply) { return nlohmann::json::parse(reply.body, nullptr, false); }

TEST(ServerTest, ServesThePageWithEverythingItNeeds) {
  FakeBackend backend({});
  const Reply page = request(backend.port(), "GET", "/?token=operator-token");
  EXPECT_EQ(page.status, 200);
  EXPECT_THAT(page.headers.at("content-security-policy"), HasSubstr("frame-ancestors 'none'"));
  EXPECT_EQ(page.headers.at("referrer-policy"), "no-referrer");
  for (const char* file : {"/main.js", "/style.css", "/link.js", "/map_view.js", "/map_store.js", "/panels.js",
                           "/commands.js", "/icon.svg"})
    EXPECT_EQ(request(backend.port(), "GET", file).status, 200) << file;
  for (const web::Asset& asset : web::assets()) {
    const std::string content(asset.content);
    EXPECT_THAT(content, Not(HasSubstr("https://"))) << asset.name << ": the page works offline, without another host";
    for (const char* address :
         {"'/api", "`/api", "\"/api", "'/stream", "`/stream", "href=\"/", "src=\"/", "url(/", "location.host"})
      EXPECT_THAT(content, Not(HasSubstr(address))) << asset.name << ": the page may lie below a path";
  }
  const Reply again = request(backend.port(), "GET", "/", "If-None-Match: " + page.headers.at("etag") + "\r\n");
  EXPECT_EQ(again.status, 304);
}

TEST(ServerTest, AnswersStateAndMap) {
  FakeBackend backend({});
  const Reply state = request(backend.port(), "GET", "/api/state");
  EXPECT_EQ(state.status, 200);
  EXPECT_EQ(jsonOf(state)["flight_state"], "flying");
  const Reply map = request(backend.port(), "GET", "/api/map.png?width=320");
  EXPECT_EQ(map.headers.at("content-type"), "image/png");
  EXPECT_EQ(map.body.substr(1, 3), "PNG");
}

TEST(ServerTest, HeadAnswersAsGetWithoutTheBody) {
  FakeBackend backend({});
  const std::string size = request(backend.port(), "GET", "/icon.svg").headers.at("content-length");
  RawClient client(backend.port());
  client.send("HEAD /icon.svg HTTP/1.1\r\nHost: localhost\r\n\r\nHEAD /api/state HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(client.readUntil("\r\n\r\n"), HasSubstr("Content-Length: " + size + "\r\n"));
  EXPECT_THAT(client.readUntil("\r\n"), HasSubstr("HTTP/1.1 200")) << "the next answer follows at once";
}

TEST(ServerTest, TheFirstRequestGetsTheRealtimeFactor) {
  FakeBackend backend({});
  std::this_thread::sleep_for(1500ms);
  EXPECT_TRUE(jsonOf(request(backend.port(), "GET", "/api/state"))["realtime_factor"].is_number());
}

TEST(ServerTest, AnswersUnavailableBeforeTheFirstWorld) {
  FakeBackend::Setup setup;
  setup.flies = false;
  FakeBackend backend(setup);
  EXPECT_EQ(request(backend.port(), "GET", "/api/state").status, 503);
  EXPECT_EQ(request(backend.port(), "GET", "/api/map.png").status, 503);
  RawClient stream(backend.port());
  stream.send("GET /stream/map.mjpg HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(stream.readUntil("Content-Length: "), HasSubstr("image/jpeg"));
}

TEST(ServerTest, AnswersACommandWithItsResult) {
  FakeBackend backend({});
  const Reply good = request(backend.port(), "POST", "/api/goal", bearer(), R"({"x_m": 1.0, "y_m": 0.5})");
  EXPECT_EQ(good.status, 200);
  EXPECT_EQ(jsonOf(good)["accepted"], true);
  const Reply bad = request(backend.port(), "POST", "/api/goal", bearer(), R"({"x_m": 40, "y_m": 0.5})");
  EXPECT_EQ(bad.status, 409);
  EXPECT_THAT(jsonOf(bad)["reason"].get<std::string>(), HasSubstr("not known to be free"));
  for (const char* name : {"hold", "resume", "home", "land"})
    EXPECT_EQ(request(backend.port(), "POST", std::string("/api/") + name + "?token=operator-token").status, 200)
        << name;
  EXPECT_EQ(backend.commandsSeen().size(), 6u);
  EXPECT_EQ(jsonOf(request(backend.port(), "GET", "/api/state"))["events"].size(), 6u);
}

/// The data that one of several vehicles gives to the server. The test executes its commands.
struct Flown {
  explicit Flown(std::string name_in) : name(std::move(name_in)) {
    flight.layers().vehicle.name = name;
    world.post(flight.advance(1.0));
  }
  web::WebServer::Sources sources() { return {world, camera, commands, results, name}; }

  std::string name;
  ExampleFlight flight;
  common::LatestValue<common::World> world;
  common::LatestValue<common::CameraFrame> camera;
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
};

TEST(ServerTest, EachVehicleHasItsOwnStateEventsAndCommands) {
  Flown alpha("alpha"), beta("beta");
  web::WebServer::Options options;
  options.port = 0;
  options.token = "operator-token";
  options.unix_time = unixTime;
  web::IoContext io;
  web::WebServer server(io, options, {alpha.sources(), beta.sources()});
  server.postEvent({common::Time(), common::Severity::kInfo, "flight", "motors on", "", "beta"}, 1);
  std::jthread thread([&] { io.run(); });
  const auto stateOf = [&](const std::string& query) {
    return jsonOf(request(server.port(), "GET", "/api/state" + query));
  };
  EXPECT_EQ(stateOf("")["vehicle"], "alpha") << "the first, where none is named";
  EXPECT_EQ(stateOf("?vehicle=beta")["vehicle"], "beta");
  EXPECT_EQ(stateOf("?vehicle=beta")["events"].size(), 1u);
  EXPECT_EQ(stateOf("?vehicle=alpha")["events"].size(), 0u);
  EXPECT_EQ(request(server.port(), "GET", "/api/state?vehicle=gamma").status, 404);

  std::jthread pilot([&] {
    std::vector<common::OperatorCommand> asked;
    eventually([&] { return !(asked = beta.commands.takeAll()).empty(); });
    for (const common::OperatorCommand& command : asked) beta.results.push({command.id, true, "by beta"});
  });
  const Reply landed = request(server.port(), "POST", "/api/land?vehicle=beta", bearer());
  EXPECT_EQ(jsonOf(landed)["reason"], "by beta");
  EXPECT_TRUE(alpha.commands.takeAll().empty());
  EXPECT_FALSE(server.cameraWanted(1));
  RawClient stream(server.port());
  stream.send("GET /stream/camera.mjpg?vehicle=beta HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(eventually([&] { return server.cameraWanted(1); }));
  EXPECT_FALSE(server.cameraWanted(0));
  server.stop();
}

TEST(ServerTest, WithoutTheTokenNothingReachesTheVehicle) {
  FakeBackend backend({});
  EXPECT_EQ(request(backend.port(), "POST", "/api/land").status, 401);
  EXPECT_EQ(request(backend.port(), "POST", "/api/land?token=wrong").status, 401);
  EXPECT_EQ(request(backend.port(), "POST", "/api/land", bearer() + "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(request(backend.port(), "GET", "/api/land?token=operator-token").status, 405);
  std::this_thread::sleep_for(150ms);
  EXPECT_TRUE(backend.commandsSeen().empty());
}

TEST(ServerTest, AnUnansweredCommandTimesOut) {
  FakeBackend::Setup setup;
  setup.answers = false;
  FakeBackend backend(setup);
  const Reply reply = request(backend.port(), "POST", "/api/hold", bearer());
  EXPECT_EQ(reply.status, 504);
  EXPECT_EQ(jsonOf(reply)["accepted"], false);
}

TEST(ServerTest, KeepsAConnectionForManyRequests) {
  FakeBackend backend({});
  RawClient client(backend.port());
  for (int i = 0; i < 3; ++i) {
    client.send("POST /api/hold HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n" + bearer() + "\r\n");
    EXPECT_EQ(client.readReply().status, 200);
  }
}

TEST(ServerTest, BadRequestsGetAnAnswerAndTheServerContinues) {
  FakeBackend backend({});
  const std::pair<std::string, int> cases[] = {
      {"GARBAGE\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20000, 'a') + "\r\n\r\n", 431},
      {"POST /api/goal HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999\r\n\r\n{", 413},
      {"GET /" + std::string(7000, '%') + " HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n\r\n", 403},
      {"GET /\x01 HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"DELETE / HTTP/1.1\r\nHost: localhost\r\n\r\n", 405},
      {"POST /api/goal HTTP/1.1\r\nHost: localhost\r\nContent-Length: abc\r\n\r\n", 400},
  };
  for (const auto& [bytes, status] : cases) {
    RawClient client(backend.port());
    client.send(bytes);
    EXPECT_EQ(client.readReply().status, status) << bytes.substr(0, 60);
  }
  EXPECT_EQ(request(backend.port(), "GET", "/").status, 200);
}

TEST(ServerTest, SaysWhetherATokenIsTheOperators) {
  FakeBackend backend({});
  EXPECT_EQ(request(backend.port(), "GET", "/api/token", bearer()).status, 200);
  EXPECT_EQ(request(backend.port(), "GET", "/api/token").status, 401);
  EXPECT_EQ(request(backend.port(), "GET", "/api/token", "Authorization: Bearer of-yesterday\r\n").status, 401);
  EXPECT_TRUE(backend.commandsSeen().empty());
}

TEST(ServerTest, TheCameraIsRequestedOnlyWhileAClientWatches) {
  FakeBackend backend({});
  EXPECT_FALSE(backend.server().cameraWanted());
  {
    RawClient client(backend.port());
    client.send("GET /stream/camera.mjpg?width=160 HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(client.readUntil("Content-Length: "), HasSubstr("multipart/x-mixed-replace"));
    EXPECT_TRUE(backend.server().cameraWanted());
    EXPECT_THAT(client.readUntil("X-Timestamp: "), HasSubstr("X-Timestamp: "));
  }
  EXPECT_TRUE(eventually([&] { return !backend.server().cameraWanted(); }));
}

/// Reads parts of a stream and returns the age of each frame at its arrival, in seconds.
std::vector<double> frameAges(int port, const std::string& target, double duration_s) {
  RawClient client(port);
  client.send("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  client.readUntil("--swiftlet-frame\r\n");
  std::vector<double> ages;
  const common::Time begin = unixTime();
  while ((unixTime() - begin).seconds() < duration_s) {
    const std::string head = client.readUntil("\r\n\r\n");
    const std::size_t length = head.find("Content-Length: "), stamp = head.find("X-Timestamp: ");
    if (length == std::string::npos || stamp == std::string::npos) break;
    const std::string jpeg = client.readBytes(std::stoul(head.substr(length + 16)));
    ages.push_back(unixTime().seconds() - std::stod(head.substr(stamp + 13)));
    EXPECT_EQ(jpeg.substr(0, 2), "\xff\xd8");
    EXPECT_EQ(client.readUntil("--swiftlet-frame\r\n").substr(0, 4), "\r\n--");
  }
  return ages;
}

TEST(StreamTest, SendsWholePicturesAtTheRequestedRate) {
  FakeBackend backend({});
  const int many = patience();
  const std::vector<double> ages = frameAges(backend.port(), "/stream/map.mjpg?width=320&fps=10", 1.5 * many);
  EXPECT_GE(ages.size(), 8u);
  EXPECT_LE(ages.size(), 18u * static_cast<unsigned>(many));
}

TEST(StreamTest, AClientThatReadsNothingDelaysNoOtherAndIsDropped) {
  FakeBackend::Setup setup;
  setup.stall_timeout_s = 0.5 * patience();
  FakeBackend backend(setup);
  RawClient stuck(backend.port());
  const int small = 4096;
  setsockopt(stuck.nativeSocket(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  stuck.send("GET /stream/camera.mjpg?width=640&fps=30 HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(eventually([&] { return backend.server().cameraWanted(); }));
  std::vector<double> ages = frameAges(backend.port(), "/stream/map.mjpg?width=320&fps=10", 1.5 * patience());
  ASSERT_GE(ages.size(), 5u);
  std::sort(ages.begin(), ages.end());
  // Generous, for a loaded machine; benchmark_stream prints the real figures.
  EXPECT_LT(ages[ages.size() / 2], 0.5 * patience());
  EXPECT_TRUE(eventually([&] { return !backend.server().cameraWanted(); }));
}

TEST(WebServerTest, APortInUseIsAClearError) {
  FakeBackend backend({});
  FakeBackend::Setup second;
  second.port = backend.port();
  EXPECT_THAT(test_support::problemsOf([&] { FakeBackend other(second); }),
              test_support::HasProblem("server.port-in-use", "port"));
}

TEST(WebServerTest, BadOptionsAreClearErrors) {
  common::LatestValue<common::World> world;
  common::LatestValue<common::CameraFrame> camera;
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
  web::IoContext io;
  const auto make = [&](const std::string& address, int port, const std::string& token) {
    web::WebServer::Options options;
    options.address = address;
    options.port = port;
    options.token = token;
    options.unix_time = unixTime;
    web::WebServer server(io, options, {world, camera, commands, results});
  };
  EXPECT_THROW(make("elsewhere", 0, "operator-token"), common::InputError);
  EXPECT_THROW(make("192.0.2.1", 0, "operator-token"), common::InputError);
  EXPECT_THROW(make("127.0.0.1", 70000, "operator-token"), common::InputError);
  EXPECT_THROW(make("127.0.0.1", 0, "short"), common::InputError);
  EXPECT_THROW(make("127.0.0.1", 0, "with blanks in it"), common::InputError);
  EXPECT_NO_THROW(make("::1", 0, web::makeToken()));
  EXPECT_NE(web::makeToken(), web::makeToken());
}

TEST(WebServerTest, TheLinkOfAServerOnAllInterfacesNamesAnAddressOfTheMachine) {
  using boost::asio::ip::make_address;
  EXPECT_EQ(web::reachableAddress(make_address("192.0.2.7")), make_address("192.0.2.7"));
  EXPECT_FALSE(web::reachableAddress(make_address("::")).is_unspecified());
  const auto address = web::reachableAddress(make_address("0.0.0.0"));
  EXPECT_FALSE(address.is_unspecified());
  boost::asio::io_context io;
  EXPECT_NO_THROW(boost::asio::ip::tcp::acceptor(io, {address, 0})) << address << " is not ours";

  FakeBackend backend({.address = "0.0.0.0"});
  EXPECT_EQ(backend.server().operatorUrls().front(),
            "http://" + address.to_string() + ":" + std::to_string(backend.port()) + "/?token=operator-token");
}

TEST(WebServerTest, StopsWithClientsConnected) {
  auto backend = std::make_unique<FakeBackend>(FakeBackend::Setup{});
  RawClient stream(backend->port()), idle(backend->port());
  stream.send("GET /stream/map.mjpg HTTP/1.1\r\nHost: localhost\r\n\r\n");
  stream.readUntil("--swiftlet-frame");
  const common::Time begin = unixTime();
  backend.reset();
  EXPECT_LT((unixTime() - begin).seconds(), 2.0 * patience());
  EXPECT_TRUE(idle.closed());
}

TEST(WebServerTest, StopsWhileACommandWaitsAndReleasesEverything) {
  common::LatestValue<common::World> world;
  common::LatestValue<common::CameraFrame> camera;
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
  auto held = std::make_shared<int>();  // Held by the server's clock.
  const std::weak_ptr<int> still_held = held;
  {
    web::WebServer::Options options;
    options.port = 0;
    options.token = "operator-token";
    options.command_timeout_s = 60.0;
    options.unix_time = [held = std::move(held)] { return unixTime(); };
    web::IoContext io;
    web::WebServer server(io, options, {world, camera, commands, results});
    options = {};
    std::jthread thread([&] { io.run(); });
    RawClient client(server.port());
    client.send("POST /api/hold HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n" + bearer() + "\r\n");
    EXPECT_TRUE(eventually([&] { return !commands.takeAll().empty(); }));
    server.stop();
    EXPECT_TRUE(client.closed());
  }
  EXPECT_TRUE(still_held.expired());
}

}  // namespace
}  // namespace swiftlet::testing
