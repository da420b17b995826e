// Decides what to do with a request. A pure function, so that every refusal can be tested and fuzzed without a socket.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "common/command.hpp"
#include "web/server/picture_view.hpp"
#include "web/server/public_url.hpp"
#include "web/server/refusal.hpp"
#include "web/server/request.hpp"

namespace swiftlet::web {

struct ServeFile {
  std::string name;  ///< Name of the embedded file: "index.html".
};
struct Redirect {
  std::string location;  ///< Relative to the address that was asked for.
};
// In the actions below, `vehicle` is the number of the vehicle that the request names.
struct StreamPictures {
  PictureView view;
  double fps = 10.0;
  std::size_t vehicle = 0;
};
struct SendPicture {
  PictureView view;
  std::size_t vehicle = 0;
};
struct SendState {
  std::size_t vehicle = 0;
};
struct OpenSocket {
  enum class Feed { kPage, kMap3d };
  Feed feed = Feed::kPage;
  std::size_t vehicle = 0;
};
struct GiveCommand {
  decltype(common::OperatorCommand::kind) kind;
  std::size_t vehicle = 0;
};
struct ListMissions {};
struct StartMission {
  std::string file;
  std::map<std::string, std::string> parameters;
  std::size_t vehicle = 0;
};
struct ConfirmToken {};

using Action = std::variant<ServeFile, Redirect, StreamPictures, SendPicture, SendState, OpenSocket, GiveCommand,
                            ListMissions, StartMission, ConfirmToken, Refuse>;

struct Policy {
  std::string token;
  std::vector<std::string> hosts;  ///< Names, lower case, that may stand in Host besides addresses and localhost.
  std::vector<std::string> files;  ///< The embedded ones.
  std::vector<std::string> vehicles = {};   ///< Names of several, by their numbers; empty: there is one.
  std::vector<PublicUrl> public_urls = {};  ///< Where else the page is opened: their hosts and origins are its own.
};

/// Checked in this order: host (403), target (400), path (404), vehicle (404), method (405), origin (403), token (401),
/// parameters and body (400). Widths, heights and rates that are too large are reduced to what is offered. A viewpoint
/// outside its bounds is refused. A path that a proxy passes on as it is loses the path of a public address; that path
/// without its last slash is redirected, since the page's own addresses are relative.
Action route(const Request& request, const Policy& policy);

/// Whether the request carries the operator's token, in a header or its address.
bool hasToken(const Request& request, const Policy& policy);

}  // namespace swiftlet::web
