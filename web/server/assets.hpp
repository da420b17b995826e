// The page's files, embedded at build time from web/console.
#pragma once

#include <span>
#include <string_view>

namespace swiftlet::web {

struct Asset {
  std::string_view name;  ///< "index.html"
  std::string_view content;
  std::string_view media_type;
  std::string_view tag;  ///< Changes with the content; for ETag, with its quotes.
};

std::span<const Asset> assets();

}  // namespace swiftlet::web
