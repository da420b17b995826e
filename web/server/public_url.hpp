// The addresses by which others open the page: that of a proxy in front of it, or a name of this machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::web {

/// Where a page comes from, as browsers compare it (RFC 6454): "https://field.example" is {"https", "field.example",
/// 443}.
struct Origin {
  std::string scheme;  ///< "http" or "https".
  std::string host;    ///< As in Authority.
  int port = 0;
  bool operator==(const Origin&) const = default;
};
/// nullopt for "null" and for any text that is not a host of http or https.
std::optional<Origin> parseOrigin(std::string_view text);
/// As browsers write it: without the port that its scheme implies.
std::string toString(const Origin& origin);
/// The port that "http" or "https" implies.
int portOf(std::string_view scheme);

struct PublicUrl {
  Origin origin;
  std::string path;  ///< Decoded; begins and ends with '/'. A proxy may leave it in front of the page's own paths.
  std::string text;  ///< The whole address, to be printed: "https://field.example/swiftlet/".
};
/// Throws common::InputError with a hint: where it is not an address of http or https, or has more than host, port and
/// path.
PublicUrl parsePublicUrl(const std::string& text);

}  // namespace swiftlet::web
