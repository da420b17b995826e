// What proxies do to requests, over real sockets: HTTP/1.0, no Upgrade, connections shared by many. Whole proxies are
// those of tests/console/proxies.mjs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/console/fake_backend.hpp"
#include "tests/web/http_client.hpp"

namespace swiftlet::testing {
namespace {

using ::testing::HasSubstr;

TEST(ProxyTest, SpeaksHttp10) {
  FakeBackend backend({});
  for (const char* headers : {"", "Host: 127.0.0.1:8080\r\n", "Host: localhost\r\nConnection: keep-alive\r\n"}) {
    RawClient client(backend.port());
    client.send(std::string("POST /api/hold HTTP/1.0\r\nContent-Length: 0\r\n") + headers + bearer() + "\r\n");
    const Reply reply = client.readReply();
    EXPECT_EQ(reply.status, 200) << headers;
    EXPECT_EQ(reply.headers.at("connection"), "close") << headers;
    EXPECT_TRUE(client.closed()) << headers;
    RawClient stream(backend.port());
    stream.send(std::string("GET /stream/map.mjpg?width=160 HTTP/1.0\r\n") + headers + "\r\n");
    const std::string head = stream.readUntil("\r\n\r\n");
    EXPECT_THAT(head, HasSubstr("200 OK")) << headers;
    EXPECT_THAT(head, HasSubstr("Connection: close")) << "the end of the connection ends it";
    EXPECT_THAT(head, HasSubstr("X-Accel-Buffering: no")) << "nginx collects no pictures";
    EXPECT_THAT(stream.readUntil("\xff\xd8"), HasSubstr("image/jpeg")) << headers;
  }
  RawClient stranger(backend.port());
  stranger.send("GET /api/state HTTP/1.0\r\nHost: evil.example\r\n\r\n");
  EXPECT_EQ(stranger.readReply().status, 403);
}

TEST(ProxyTest, OpensASocketThroughAProxyThatDropsTheUpgrade) {
  FakeBackend::Setup setup;
  setup.public_urls = {"https://field.example/swiftlet/"};
  FakeBackend backend(setup);
  const auto answer = [&](const std::string& version, const std::string& origin, const std::string& more) {
    RawClient client(backend.port());
    client.send("GET /swiftlet/api/ws HTTP/" + version +
                "\r\nHost: 127.0.0.1:8080\r\nConnection: close\r\nOrigin: " + origin + "\r\n" + more + "\r\n");
    const std::string head = client.readUntil("\r\n\r\n");
    return head.find(" 101 ") == std::string::npos ? head : head + client.readUntil("}");
  };
  const std::string handshake = "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  for (const char* version : {"1.0", "1.1"}) {
    const std::string head = answer(version, "https://field.example", handshake);
    EXPECT_THAT(head, HasSubstr("HTTP/1.1 101")) << version;
    EXPECT_THAT(head, HasSubstr("Upgrade: websocket")) << version;
    EXPECT_THAT(head, HasSubstr("\"hello\"")) << version;
    EXPECT_THAT(answer(version, "https://evil.example", handshake), HasSubstr(" 403 ")) << version;
    EXPECT_THAT(answer(version, "https://field.example", ""), HasSubstr(" 426 ")) << version;
  }
}

TEST(ProxyTest, ARequestIsTheOperatorsByItsOwnToken) {
  FakeBackend::Setup setup;
  setup.max_connections = 0;
  FakeBackend backend(setup);
  RawClient proxy(backend.port());
  proxy.send("GET /api/token HTTP/1.1\r\nHost: localhost\r\n" + bearer() + "\r\n");
  EXPECT_EQ(proxy.readReply().status, 200);
  proxy.send("GET /stream/map.mjpg HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(proxy.readReply().status, 503) << "of a viewer, by the connection that a proxy also used for an operator";
}

TEST(ProxyTest, TheLinksOfPublicAddressesFollow) {
  FakeBackend backend({.public_urls = {"https://field.example/swiftlet", "http://drone.local:8080/"}});
  const std::string own = "http://127.0.0.1:" + std::to_string(backend.port());
  EXPECT_EQ(
      backend.server().operatorUrls(),
      (std::vector<std::string>{own + "/?token=operator-token", "https://field.example/swiftlet/?token=operator-token",
                                "http://drone.local:8080/?token=operator-token"}));
  const Reply reply = request(backend.port(), "GET", "/swiftlet?token=x");
  EXPECT_EQ(reply.status, 307);
  EXPECT_EQ(reply.headers.at("location"), "./swiftlet/?token=x");
  EXPECT_THROW(FakeBackend({.public_urls = {"field.example"}}), common::InputError);
}

}  // namespace
}  // namespace swiftlet::testing
