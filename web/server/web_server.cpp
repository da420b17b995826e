#include "web/server/web_server.hpp"

#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>

#include "common/check.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "web/server/assets.hpp"
#include "web/server/core.hpp"
#include "web/server/http_session.hpp"
#include "web/server/reachable_address.hpp"

namespace swiftlet::web {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
using common::Message;

/// The shortest password that NIST SP 800-63B allows.
constexpr std::size_t kLeastTokenLength = 8;

[[noreturn]] void fail(const char* element, Message message, const char* hint) {
  throw common::InputError({}, element, std::move(message), hint);
}

void checkOptions(const WebServer::Options& options) {
  SWIFTLET_CHECK(options.unix_time != nullptr);
  const auto sound = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (options.token.size() < kLeastTokenLength || !std::all_of(options.token.begin(), options.token.end(), sound))
    fail("token",
         Message("server.token", "`{}` is not at least {} letters, digits, `-` or `_`", options.token,
                 kLeastTokenLength),
         "");
  if (options.port < 0 || options.port > 65535)
    fail("port", Message("server.no-port", "{} is not in 0 to 65535", options.port), "0 picks a free one");
}

boost::asio::ip::address addressOf(const std::string& text) {
  error_code error;
  auto address = boost::asio::ip::make_address(text == "localhost" ? "127.0.0.1" : text, error);
  if (error)
    fail("address", Message("server.no-address", "`{}` is not an IPv4 or IPv6 address", text),
         "127.0.0.1 serves this machine, 0.0.0.0 every network");
  return address;
}

Policy policyOf(const WebServer::Options& options, const std::vector<WebServer::Sources>& sources) {
  Policy policy;
  policy.token = options.token;
  for (const std::string& url : options.public_urls) policy.public_urls.push_back(parsePublicUrl(url));
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0') {
    policy.hosts.push_back(common::lowerCase(name.data()));
    policy.hosts.push_back(common::lowerCase(name.data()) + ".local");
  }
  for (const Asset& asset : assets()) policy.files.emplace_back(asset.name);
  for (const WebServer::Sources& vehicle : sources)
    if (!vehicle.name.empty()) policy.vehicles.push_back(vehicle.name);
  return policy;
}

}  // namespace

struct WebServer::Impl : std::enable_shared_from_this<WebServer::Impl> {
  Impl(boost::asio::io_context& context, const Options& options, const std::vector<Sources>& sources)
      : io(context),
        acceptor(context),
        retry(context),
        core(std::make_shared<Core>(context, options, sources, policyOf(options, sources))) {}

  void listen(const tcp::endpoint& endpoint) {
    error_code error;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(boost::asio::socket_base::max_listen_connections, error);
    if (!error) return;
    const std::string where = fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
    if (error == boost::asio::error::address_in_use)
      fail("port", Message("server.port-in-use", "{} is in use", where),
           "stop what listens there, or choose another port; 0 picks a free one");
    if (error == boost::asio::error::access_denied)
      fail("port", Message("server.port-not-allowed", "{} may not be opened by this user", where),
           "choose a port above 1023");
    fail("address", Message("server.cannot-listen", "cannot listen on {}: {}", where, error.message()),
         "127.0.0.1 serves this machine, 0.0.0.0 every network");
  }

  void accept() {
    acceptor.async_accept([self = shared_from_this()](const error_code& error, tcp::socket socket) {
      if (self->core->closed()) return;
      if (!error) {
        startHttp(self->core, std::move(socket));
        return self->accept();
      }
      // Out of descriptors, or the client was gone. Both are temporary.
      self->retry.expires_after(std::chrono::milliseconds(100));
      self->retry.async_wait([self](const error_code& cancelled) {
        if (!cancelled && !self->core->closed()) self->accept();
      });
    });
  }

  void close() {
    error_code ignored;
    acceptor.close(ignored);
    retry.cancel();
    core->close();
  }

  boost::asio::io_context& io;
  tcp::acceptor acceptor;
  boost::asio::steady_timer retry;
  std::shared_ptr<Core> core;
  std::atomic<bool> stopped = false;
  int port = 0;
};

WebServer::WebServer(IoContext& io, const Options& options, const Sources& sources)
    : WebServer(io, options, std::vector<Sources>{sources}) {}

WebServer::WebServer(IoContext& io, const Options& options, const std::vector<Sources>& sources) {
  SWIFTLET_CHECK(!sources.empty());
  checkOptions(options);
  const tcp::endpoint endpoint(addressOf(options.address), static_cast<unsigned short>(options.port));
  impl_ = std::make_shared<Impl>(io.get(), options, sources);
  impl_->listen(endpoint);
  impl_->port = impl_->acceptor.local_endpoint().port();
  impl_->accept();
  impl_->core->wake();
}

WebServer::~WebServer() { stop(); }

int WebServer::port() const { return impl_->port; }

std::vector<std::string> WebServer::operatorUrls() const {
  const Options& options = impl_->core->options;
  const std::string host = reachableAddress(addressOf(options.address)).to_string();
  std::vector<std::string> urls{toString(Origin{"http", host, impl_->port}) + "/"};
  for (const PublicUrl& url : impl_->core->policy.public_urls) urls.push_back(url.text);
  for (std::string& url : urls) url += "?token=" + options.token;
  return urls;
}

bool WebServer::cameraWanted(std::size_t vehicle) const {
  return impl_->core->vehicle(vehicle).camera_watchers.load() > 0;
}

void WebServer::postEvent(const common::Event& event, std::size_t vehicle) {
  impl_->core->vehicle(vehicle).telemetry.events().post(event);
}

void WebServer::stop() {
  if (impl_->stopped.exchange(true)) return;
  boost::asio::post(impl_->io, [impl = impl_] { impl->close(); });
}

std::string makeToken() {
  std::array<unsigned char, 16> random{};
  SWIFTLET_CHECK(getrandom(random.data(), random.size(), 0) == static_cast<ssize_t>(random.size()));
  std::string token;
  for (const unsigned char byte : random) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace swiftlet::web
