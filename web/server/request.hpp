// The parts of an HTTP request that routing needs, without an HTTP library.
#pragma once

#include <string>

namespace swiftlet::web {

struct Request {
  std::string method;  ///< "GET", "POST" ...
  std::string target;  ///< Path and query as sent: "/api/goal?token=x".
  std::string host;    ///< The Host header.
  std::string origin;  ///< The Origin header; empty without one, as from a program that is not a browser.
  std::string authorization;
  std::string body;
  bool wants_websocket = false;
  std::string token = {};  ///< The header X-Swiftlet-Token: a proxy may want Authorization for itself.
};

}  // namespace swiftlet::web
