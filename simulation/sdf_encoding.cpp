#include "simulation/sdf_encoding.hpp"

#include <iconv.h>

#include <array>
#include <cerrno>
#include <utility>

#include <tl/expected.hpp>

#include "common/error.hpp"
#include "common/lower_case.hpp"

namespace swiftlet::simulation {
namespace {

enum class Failure { kUnknownEncoding, kOtherBytes };

tl::expected<std::string, Failure> converted(std::string_view bytes, const std::string& encoding) {
  const iconv_t converter = ::iconv_open("UTF-8", encoding.c_str());
  // The value that iconv_open() documents for an encoding that is not known.
  if (converter == reinterpret_cast<iconv_t>(-1))  // NOLINT(performance-no-int-to-ptr)
    return tl::unexpected(Failure::kUnknownEncoding);
  std::string from(bytes), text;
  char* in = from.data();
  std::size_t left = from.size();
  bool good = true;
  while (good && left > 0) {
    std::array<char, 4096> part{};
    char* out = part.data();
    std::size_t room = part.size();
    good = ::iconv(converter, &in, &left, &out, &room) != static_cast<std::size_t>(-1) || errno == E2BIG;
    text.append(part.data(), part.size() - room);
  }
  ::iconv_close(converter);
  if (!good) return tl::unexpected(Failure::kOtherBytes);
  return text;
}

/// By the first bytes: a byte order mark, or the zero bytes about a `<`. Empty for all else.
std::string wideEncoding(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, const char*>, 8> kBegins{{{"\xFF\xFE\0\0"sv, "UTF-32LE"},
                                                                             {"<\0\0\0"sv, "UTF-32LE"},
                                                                             {"\0\0\xFE\xFF"sv, "UTF-32BE"},
                                                                             {"\0\0\0<"sv, "UTF-32BE"},
                                                                             {"\xFF\xFE"sv, "UTF-16LE"},
                                                                             {"<\0"sv, "UTF-16LE"},
                                                                             {"\xFE\xFF"sv, "UTF-16BE"},
                                                                             {"\0<"sv, "UTF-16BE"}}};
  for (const auto& [begin, encoding] : kBegins)
    if (bytes.starts_with(begin)) return encoding;
  return {};
}

/// The encoding in the XML declaration; empty without a declaration, or if it names no encoding.
std::string declaredEncoding(std::string_view bytes) {
  const std::size_t begin = bytes.find('<');
  if (begin == std::string_view::npos || !bytes.substr(begin).starts_with("<?xml")) return {};
  const std::string_view declaration = bytes.substr(begin, bytes.find("?>", begin) - begin);
  const std::size_t word = declaration.find("encoding");
  if (word == std::string_view::npos) return {};
  const std::size_t open = declaration.find_first_of("\"'", word);
  if (open == std::string_view::npos) return {};
  return std::string(declaration.substr(open + 1, declaration.find(declaration[open], open + 1) - open - 1));
}

}  // namespace

std::string utf8Text(const std::string& file, std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::string encoding = wideEncoding(bytes);
  const bool is_wide = !encoding.empty();
  if (!is_wide) {
    if (bytes.starts_with(kMark)) bytes.remove_prefix(kMark.size());
    if (converted(bytes, "UTF-8")) return std::string(bytes);
    encoding = declaredEncoding(bytes);
    if (encoding.empty() || common::lowerCase(encoding) == "utf-8") encoding = "ISO-8859-1";
  }
  auto text = converted(bytes, encoding);
  if (text) return text->starts_with(kMark) ? text->substr(kMark.size()) : *std::move(text);
  using common::Message;
  throw common::InputError(
      {file, 1}, "",
      text.error() == Failure::kUnknownEncoding
          ? Message("encoding.unknown", "the encoding `{}`, which the file declares, is not known", encoding)
          : Message("encoding.other-bytes", "the file is not in `{}`, the encoding that {}", encoding,
                    is_wide ? "its first bytes say" : "it declares"),
      "save it as UTF-8 in an editor");
}

}  // namespace swiftlet::simulation
