// links: web
// A stranger's request: whatever its target, host, origin, authorization and body are, there is a decision; without the
// token it is never a command.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "web/server/route.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet::web;
  static const Policy kPolicy{"no-fuzzer-guesses-this-token-0123456789",
                              {"cobra.local"},
                              {"index.html"},
                              {},
                              {parsePublicUrl("https://field.example/swiftlet/")}};
  // Lines are: method, target, host, origin, authorization; the rest is the body.
  std::string rest(reinterpret_cast<const char*>(data), size);
  const auto line = [&rest] {
    const std::size_t end = rest.find('\n');
    std::string text = rest.substr(0, end);
    rest.erase(0, end == std::string::npos ? std::string::npos : end + 1);
    return text;
  };
  Request request;
  request.method = line();
  request.target = line();
  request.host = line();
  request.origin = line();
  request.authorization = line();
  request.body = rest;
  request.wants_websocket = size % 2 == 0;

  const Action action = route(request, kPolicy);
  if (std::holds_alternative<GiveCommand>(action)) std::abort();
  if (const auto* refuse = std::get_if<Refuse>(&action); refuse != nullptr && refuse->reason.empty()) std::abort();
  // With the token the body is read too.
  request.authorization = "Bearer " + kPolicy.token;
  if (const Action allowed = route(request, kPolicy); const auto* command = std::get_if<GiveCommand>(&allowed))
    if (const auto* goal = std::get_if<swiftlet::common::GoalCommand>(&command->kind))
      if (!goal->goal_map_m.allFinite()) std::abort();
  return 0;
}
