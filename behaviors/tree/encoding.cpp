#include "behaviors/tree/encoding.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

#include <iconv.h>

#include "behaviors/tree/characters.hpp"

namespace swiftlet::tree {
namespace {

/// Nothing if the C library does not know the encoding, or if the bytes are not of it.
std::optional<std::string> converted(std::string bytes, const std::string& encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  // The value that iconv_open() documents for an encoding that is not known.
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;  // NOLINT(performance-no-int-to-ptr)
  std::string text;
  std::array<char, 4096> buffer{};
  char* in = bytes.data();
  std::size_t left = bytes.size();
  bool going_on = true;
  while (going_on && left > 0) {
    char* out = buffer.data();
    std::size_t room = buffer.size();
    const bool failed = iconv(converter, &in, &left, &out, &room) == static_cast<std::size_t>(-1);
    going_on = !failed || errno == E2BIG;
    text.append(buffer.data(), buffer.size() - room);
  }
  iconv_close(converter);
  return going_on ? std::optional(std::move(text)) : std::nullopt;
}

bool isEncodingName(std::string_view name) {
  return !name.empty() && name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-") ==
                              std::string_view::npos;
}

/// Blanks fill the place of a longer name, so that columns stay.
void declareUtf8(std::string& text) {
  const std::string_view declared = declaredEncoding(text);
  if (declared.empty()) return;
  const auto begin = static_cast<std::size_t>(declared.data() - text.data());
  const std::size_t length = declared.size();
  std::string name = std::string("UTF-8") + text[begin + length];
  name.resize(std::max(name.size(), length + 1), ' ');
  text.replace(begin, length + 1, name);
}

}  // namespace

std::string_view wideEncoding(std::string_view bytes) {
  const auto begins = [&](std::string_view with) { return bytes.starts_with(with); };
  using namespace std::string_view_literals;
  if (begins("\xFF\xFE\0\0"sv) || begins("<\0\0\0"sv)) return "UTF-32LE";
  if (begins("\0\0\xFE\xFF"sv) || begins("\0\0\0<"sv)) return "UTF-32BE";
  if (begins("\xFF\xFE"sv) || begins("<\0"sv)) return "UTF-16LE";
  return begins("\xFE\xFF"sv) || begins("\0<"sv) ? "UTF-16BE" : "";
}

std::string_view declaredEncoding(std::string_view text) {
  if (const std::size_t begin = text.find('<'); begin < 8 && text.substr(begin).starts_with("<?xml")) {
    const std::string_view declaration = text.substr(0, text.find("?>"));
    constexpr std::string_view kName = "encoding";
    const std::size_t open = declaration.find_first_of("\"'", declaration.find(kName));
    if (open == std::string_view::npos) return {};
    const std::size_t close = declaration.find(declaration[open], open + 1);
    const std::string_view name = declaration.substr(open + 1, close - open - 1);
    return close != std::string_view::npos && isEncodingName(name) ? name : std::string_view();
  }
  return {};
}

std::string inUtf8(std::string bytes) {
  const std::string_view wide = wideEncoding(bytes);
  if (wide.empty() && isUtf8(bytes)) return bytes;
  const std::string encoding(wide.empty() ? declaredEncoding(bytes) : wide);
  if (encoding.empty()) return bytes;
  std::optional<std::string> text = converted(bytes, encoding);
  // A declaration that is read byte by byte cannot say that it is in UTF-16.
  if (!text || (wide.empty() && declaredEncoding(*text) != encoding)) return bytes;
  declareUtf8(*text);
  return std::move(*text);
}

}  // namespace swiftlet::tree
