// What the routing needs of an HTTP request, free of any HTTP library.
#pragma once

#include <string>

namespace swiftlet::web {

struct Request {
  std::string method;  ///< "GET", "POST" ...
  std::string target;  ///< Path and query as sent: "/api/goal?token=x".
  std::string host;    ///< The Host header.
  std::string origin;  ///< The Origin header; empty when there is none, as from a program that is no browser.
  std::string authorization;
  std::string body;
  bool wants_websocket = false;
};

}  // namespace swiftlet::web
