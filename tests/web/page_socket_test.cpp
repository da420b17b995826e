// The WebSocket as a page uses it.
#include <array>
#include <map>

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include "tests/console/fake_backend.hpp"

namespace swiftlet::testing {
namespace {

namespace beast = boost::beast;

class PageClient {
 public:
  PageClient(int port, const std::string& origin, const std::string& path = "/api/ws") : socket_(io_) {
    socket_.next_layer().connect({boost::asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)});
    socket_.set_option(beast::websocket::stream_base::decorator([origin](beast::websocket::request_type& request) {
      if (!origin.empty()) request.set(beast::http::field::origin, origin);
    }));
    socket_.handshake("127.0.0.1:" + std::to_string(port), path, error_);
  }
  bool open() const { return !error_; }

  /// "state", "tiles" ...; the bytes it had are counted.
  std::string next() {
    beast::flat_buffer buffer;
    socket_.read(buffer);
    const std::string text = beast::buffers_to_string(buffer.data());
    bytes_ += text.size();
    if (socket_.got_binary())
      return std::array{"", "tiles", "laser", "points", "poses", "camera"}.at(static_cast<std::size_t>(text.at(0)));
    json_ = nlohmann::json::parse(text);
    return json_["type"].get<std::string>();
  }
  const nlohmann::json& json() const { return json_; }
  std::size_t bytes() const { return bytes_; }

 private:
  boost::asio::io_context io_;
  beast::websocket::stream<boost::asio::ip::tcp::socket> socket_;
  boost::system::error_code error_;
  nlohmann::json json_;
  std::size_t bytes_ = 0;
};

TEST(PageSocketTest, SendsEverythingOnceAndThenWhatChanges) {
  FakeBackend backend({});
  PageClient page(backend.port(), "");
  ASSERT_TRUE(page.open());
  EXPECT_EQ(page.next(), "hello");
  std::map<std::string, int> counts;
  std::size_t trail = 0;
  while (counts["state"] < 15) {
    const std::string type = page.next();
    ++counts[type];
    if (type == "trail") {
      EXPECT_EQ(page.json()["from"], trail);
      trail += page.json()["points"].size();
    }
    if (type == "tree") {
      EXPECT_EQ(page.json()["whole"], true);
      EXPECT_EQ(page.json()["nodes"].size(), 9u);
    }
  }
  EXPECT_EQ(counts["levels"], 1);
  EXPECT_GE(counts["tiles"], 2);
  EXPECT_LT(counts["tiles"], counts["state"]);
  EXPECT_GE(counts["trail"], 2);
  EXPECT_EQ(counts["tree"], 1) << "nothing of it changes";
  EXPECT_FALSE(page.json()["mission"].contains("tree"));
}

TEST(PageSocketTest, ALatePageGetsTheWholeMapWithinItsBudget) {
  FakeBackend backend({});
  PageClient page(backend.port(), "");
  int states = 0;
  while (states < 5) states += page.next() == "state";
  const std::size_t first = page.bytes();
  EXPECT_LT(first, 120'000u);
  while (states < 35) states += page.next() == "state";
  // Three seconds of flight through new rooms: at most 100 kB each.
  EXPECT_LT(page.bytes() - first, 300'000u);
  RecordProperty("bytes_per_second", static_cast<int>((page.bytes() - first) / 3));
  std::printf("page socket: %zu bytes to begin, %zu bytes/s flying\n", first, (page.bytes() - first) / 3);
}

TEST(PageSocketTest, ThePointsOfThe3dMapComeByASocketOfTheirOwn) {
  FakeBackend::Setup setup;
  setup.maps3d = true;
  FakeBackend backend(setup);
  PageClient page(backend.port(), "", "/api/map3d");
  ASSERT_TRUE(page.open());
  EXPECT_EQ(page.next(), "poses");
  std::map<std::string, int> counts;
  while (counts["camera"] < 5) ++counts[page.next()];
  EXPECT_GE(counts["points"], 5);
  EXPECT_GT(page.bytes(), 20'000U * 12);
  EXPECT_LE(counts["poses"], 3);
  EXPECT_FALSE(PageClient(backend.port(), "http://evil.example", "/api/map3d").open());
}

TEST(PageSocketTest, RefusesForeignPages) {
  FakeBackend backend({});
  EXPECT_FALSE(PageClient(backend.port(), "http://evil.example").open());
  EXPECT_TRUE(PageClient(backend.port(), "http://127.0.0.1:" + std::to_string(backend.port())).open());
}

}  // namespace
}  // namespace swiftlet::testing
