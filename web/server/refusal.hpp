// How a check of a request refuses it: by throwing the message to the client.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::web {

/// Thrown within route() only.
struct Refused {
  int status = 400;
  std::string reason;
  std::string allow;  ///< For status 405: the allowed methods.
};

[[noreturn]] void refuse(int status, std::string reason, std::string allow = {});

/// Text of an unknown client, made safe for a message.
std::string shown(std::string_view text);

}  // namespace swiftlet::web
