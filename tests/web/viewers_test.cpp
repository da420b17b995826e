// Many viewers and one operator: slots and bandwidth are kept for the operator.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/console/fake_backend.hpp"
#include "tests/web/http_client.hpp"

namespace swiftlet::testing {
namespace {

using test_support::patience;
using ::testing::HasSubstr;

/// A viewer of the map, or an operator; the beginning of the answer.
std::string watch(RawClient& client, const std::string& parameters = "width=64") {
  client.send("GET /stream/map.mjpg?" + parameters + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  return client.readUntil("\r\n");
}

TEST(ViewersTest, TooManyViewersAreRefusedWithAnAnswerAndTheOperatorIsNot) {
  FakeBackend::Setup setup;
  setup.max_connections = 8;
  FakeBackend backend(setup);
  std::vector<std::unique_ptr<RawClient>> viewers;
  for (int i = 0; i < 8; ++i) {
    viewers.push_back(std::make_unique<RawClient>(backend.port()));
    EXPECT_THAT(watch(*viewers.back()), HasSubstr("200 OK"));
  }
  RawClient refused(backend.port()), by_operator(backend.port());
  EXPECT_THAT(watch(refused), HasSubstr("503"));
  EXPECT_THAT(watch(by_operator, "width=64&token=operator-token"), HasSubstr("200 OK"));
  EXPECT_EQ(request(backend.port(), "GET", "/").status, 200) << "the page still opens";
  EXPECT_EQ(request(backend.port(), "POST", "/api/hold", bearer()).status, 200);
  viewers.clear();
  EXPECT_TRUE(eventually([&] {
    RawClient next(backend.port());
    return watch(next).find("200 OK") != std::string::npos;
  }));
}

TEST(ViewersTest, SilentConnectionsLockNobodyOut) {
  FakeBackend backend({});
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 300; ++i) silent.push_back(std::make_unique<RawClient>(backend.port()));
  EXPECT_EQ(request(backend.port(), "POST", "/api/land", bearer()).status, 200);
  EXPECT_EQ(request(backend.port(), "GET", "/").status, 200);
}

/// One picture is drawn for viewers in a tick, and their time for drawing is bounded; the rest is refused at once.
TEST(ViewersTest, LargePicturesForViewersKeepNoOperatorWaiting) {
  FakeBackend backend({});
  const std::string picture = "/api/map.png?width=1920&height=1920";
  std::vector<std::unique_ptr<RawClient>> viewers;
  for (int i = 0; i < 24; ++i) {
    viewers.push_back(std::make_unique<RawClient>(backend.port()));
    viewers.back()->send("GET " + picture + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  EXPECT_EQ(request(backend.port(), "POST", "/api/hold", bearer()).status, 200);
  std::map<int, int> answers;
  for (const auto& viewer : viewers) ++answers[viewer->readReply().status];
  EXPECT_GE(answers[200], 1);
  EXPECT_GE(answers[503], 12);
  EXPECT_EQ(answers[200] + answers[503], 24);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(request(backend.port(), "GET", picture, bearer()).status, 200);
  EXPECT_TRUE(eventually([&] { return request(backend.port(), "GET", "/api/map.png").status == 200; }));
}

TEST(ViewersTest, FreshViewsOfViewersTakeABoundedShareOfTheThread) {
  FakeBackend backend({});
  std::vector<std::unique_ptr<RawClient>> viewers;
  for (int i = 0; i < 64; ++i) {
    viewers.push_back(std::make_unique<RawClient>(backend.port()));
    viewers.back()->send("GET /stream/map.mjpg?height=1920&width=" + std::to_string(1900 - i) +
                         " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  const double before_s = backend.serverCpu_s();
  const common::Time begin = unixTime();
  while ((unixTime() - begin).seconds() < 1.0)
    EXPECT_EQ(request(backend.port(), "POST", "/api/hold", bearer()).status, 200);
  EXPECT_LT(backend.serverCpu_s() - before_s, 0.75 * (unixTime() - begin).seconds());
}

TEST(ViewersTest, ViewersShareTheirBandwidthAndTheOperatorHasItsOwn) {
  FakeBackend::Setup setup;
  setup.viewers_bytes_per_s = 20e3;  // About three pictures a second.
  FakeBackend backend(setup);
  const auto frames = [&](const std::string& token) {
    RawClient client(backend.port());
    client.send("GET /stream/map.mjpg?width=320&fps=10" + token + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    int count = 0;
    const common::Time begin = unixTime();
    while ((unixTime() - begin).seconds() < 2.0 * patience() &&
           client.readUntil("--swiftlet-frame\r\n").ends_with("frame\r\n"))
      ++count;
    return count;
  };
  const int viewed = frames(""), operated = frames("&token=operator-token");
  EXPECT_GT(viewed, 1);
  EXPECT_GT(operated, 2 * viewed);
}

}  // namespace
}  // namespace swiftlet::testing
