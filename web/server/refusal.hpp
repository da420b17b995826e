// How a check of a request refuses it: by throwing the action that answers the client.
#pragma once

#include <string>
#include <string_view>

#include "common/message.hpp"

namespace swiftlet::web {

struct Refuse {
  int status = 400;  ///< 400, 401, 403, 404, 405, 426
  common::Message reason;
  std::string allow;  ///< For status 405: the allowed methods.
};

/// Throws a Refuse, which route() returns.
[[noreturn]] void refuse(int status, common::Message reason, std::string allow = {});

/// Text of an unknown client, made safe for a message.
std::string shown(std::string_view text);

}  // namespace swiftlet::web
