#include "web/server/refusal.hpp"

#include <utility>

namespace swiftlet::web {

void refuse(int status, common::Message reason, std::string allow) {
  throw Refuse{status, std::move(reason), std::move(allow)};
}

std::string shown(std::string_view text) {
  std::string result = "`";
  for (const char c : text.substr(0, 40))
    result += static_cast<unsigned char>(c) >= 32 && static_cast<unsigned char>(c) < 127 ? c : '?';
  return result + (text.size() > 40 ? "...`" : "`");
}

}  // namespace swiftlet::web
