#include "interfaces/files/map_picture.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <utility>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/files/bmp.hpp"

namespace swiftlet::interfaces {
namespace {

using common::InputError;
using common::Message;

constexpr const char* kConvert = "convert it, for instance by ImageMagick's `convert FILE map.png`";

constexpr const char* kGetAgain = "copy or download it again: it is not whole";
constexpr const char* kGetFile = "download the file itself, where a site shows it there is a link `raw` or `download`";

/// What a browser or a script saves when it is given the page that shows a picture, or that asks to log in.
bool isWebPage(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  const std::string start = common::lowerCase(bytes.substr(std::min(begin, bytes.size()), 16));
  return start.starts_with("<!doctype") || start.starts_with("<html") || start.starts_with("<head");
}

bool isNetpbm(std::string_view bytes) {
  constexpr std::array<std::string_view, 4> kMagics = {"P2", "P3", "P5", "P6"};
  return std::find(kMagics.begin(), kMagics.end(), bytes.substr(0, 2)) != kMagics.end();
}
bool isBmp(std::string_view bytes) { return bytes.starts_with("BM"); }
constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";
bool isPngOrJpeg(std::string_view bytes) { return bytes.starts_with(kPngMagic) || bytes.starts_with("\xff\xd8\xff"); }

/// The bytes behind the last chunk of a PNG, each of which is a length, four letters, so many bytes and a checksum.
std::size_t bytesBehindPng(std::string_view bytes) {
  constexpr std::size_t kFrame = 12;
  bytes.remove_prefix(kPngMagic.size());
  while (bytes.size() >= kFrame) {
    std::size_t length = 0;
    for (const char c : bytes.substr(0, 4)) length = 256 * length + static_cast<std::uint8_t>(c);
    const bool last = bytes.substr(4, 4) == "IEND";
    bytes.remove_prefix(std::min(kFrame + length, bytes.size()));
    if (last) return bytes.size();
  }
  return 0;
}

/// The words of a PGM or PPM: they stand between blanks, `#` to the end of the line is a comment.
class NetpbmWords {
 public:
  NetpbmWords(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::string_view word() {
    skipBlank();
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !isBlank(bytes_[at_]) && bytes_[at_] != '#') ++at_;
    return bytes_.substr(begin, at_ - begin);
  }

  int number(const char* element, int low, int high) {
    const std::string_view text = word();
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < low || value > high)
      throw fail(element,
                 Message("netpbm.number", "`{}` is not a whole number from {} to {}", text.substr(0, 20), low, high));
    return value;
  }

  InputError fail(const char* element, Message message) const {
    return InputError({name_, line_}, element, std::move(message));
  }

  /// Whether no word follows.
  bool atEnd() {
    skipBlank();
    return at_ >= bytes_.size();
  }

  /// The bytes after the one blank that ends the header. Where more follow than `count`, a line feed that ends the same
  /// line and comments below it, which other programs write there, are left out.
  std::string_view raster(std::size_t count) const {
    std::string_view data = bytes_.substr(std::min(at_, bytes_.size()));
    const bool line_goes_on = !data.starts_with('\n');
    if (!data.starts_with('#')) data.remove_prefix(std::min<std::size_t>(1, data.size()));
    if (line_goes_on && data.starts_with('\n') && data.size() > count) data.remove_prefix(1);
    while (data.starts_with('#')) {
      const std::size_t end = data.find('\n');
      if (end == std::string_view::npos || data.size() - (end + 1) < count) break;
      data.remove_prefix(end + 1);
    }
    return data;
  }

  std::size_t bytesLeft() const { return bytes_.size() - at_; }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skipBlank() {
    for (bool comment = false; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') comment = true;
      if (c == '\n') {
        comment = false;
        ++line_;
      }
      if (!comment && !isBlank(c)) return;
    }
  }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// A value from 0 to `greatest` as one from 0 to 255, rounded.
std::uint32_t scaled(std::uint32_t value, std::uint32_t greatest) {
  return (2 * 255 * std::min(value, greatest) + greatest) / (2 * greatest);
}

struct NetpbmHeader {
  bool is_text = false;
  std::size_t colors = 1;
  std::uint32_t greatest = 255;
  std::size_t count = 0;  ///< How many numbers the pixels are.

  std::size_t bytesEach() const { return greatest > 255 ? 2 : 1; }
};

NetpbmHeader readHeader(NetpbmWords& words, common::GreyImage& image) {
  const std::string_view magic = words.word();
  if (!isNetpbm(magic) || magic.size() != 2)
    throw words.fail("PGM",
                     Message("netpbm.other-begin", "begins with `{}`, P5 or P2 was expected", magic.substr(0, 8)));
  NetpbmHeader header{magic == "P2" || magic == "P3", magic == "P3" || magic == "P6" ? std::size_t{3} : 1};
  image.width_px = words.number("width", 1, common::kMostGreySide_px);
  image.height_px = words.number("height", 1, common::kMostGreySide_px);
  header.greatest = static_cast<std::uint32_t>(words.number("greatest value", 1, 65'535));
  header.count = static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px) * header.colors;
  return header;
}

InputError cutOff(const NetpbmWords& words, const NetpbmHeader& header, std::size_t numbers) {
  return words.fail("pixels", Message("netpbm.cut", "the file ends after {} of {} pixels", numbers / header.colors,
                                      header.count / header.colors));
}

MapPicture parseNetpbm(std::string_view bytes, const std::string& name) {
  MapPicture picture;
  NetpbmWords words(bytes, name);
  const NetpbmHeader header = readHeader(words, picture.image);
  const std::size_t each = header.is_text ? 1 : header.bytesEach(), needed = header.count * each;
  const std::string_view data = words.raster(needed);
  // Each number takes at least one byte. A header that promises more than there are must not allocate them.
  if (data.size() < (header.is_text ? needed - 1 : needed)) throw cutOff(words, header, data.size() / each);
  if (!header.is_text) picture.left_over_bytes = data.size() - needed;
  picture.image.brightness.reserve(header.count / header.colors);
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < header.count; ++i) {
    if (header.is_text && words.atEnd()) throw cutOff(words, header, i);
    const auto byte = [&](std::size_t at) { return std::uint32_t{static_cast<std::uint8_t>(data[at])}; };
    const std::uint32_t value =
        header.is_text ? static_cast<std::uint32_t>(words.number("pixel", 0, static_cast<int>(header.greatest)))
        : each == 2    ? 256 * byte(2 * i) + byte(2 * i + 1)
                       : byte(i);
    sum += scaled(value, header.greatest);
    if ((i + 1) % header.colors != 0) continue;
    picture.image.brightness.push_back(
        static_cast<std::uint8_t>((std::exchange(sum, 0) + header.colors / 2) / header.colors));
  }
  if (header.is_text && !words.atEnd()) picture.left_over_bytes = words.bytesLeft();
  return picture;
}

}  // namespace

MapPicture parsePicture(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const Message& message, const char* hint) { throw InputError({name}, "", message, hint); };
  if (bytes.empty()) refuse(Message("picture.empty", "is empty, a picture was expected"), kGetAgain);
  if (isWebPage(bytes)) refuse(Message("picture.web-page", "is a page of the web, a picture was expected"), kGetFile);
  if (isNetpbm(bytes)) return parseNetpbm(bytes, name);
  if (!isBmp(bytes) && !isPngOrJpeg(bytes))
    refuse(Message("picture.other-kind", "is no picture of a kind that can be read: PNG, BMP, PGM, PPM, JPEG"),
           kConvert);
  auto image = isBmp(bytes) ? decodeBmp(bytes) : common::decodeGrey(bytes);
  if (!image && image.error().is_damaged) refuse(image.error().reason.behind("is damaged: "), kGetAgain);
  if (!image) refuse(image.error().reason, kConvert);
  return {std::move(*image), bytes.starts_with(kPngMagic) ? bytesBehindPng(bytes) : 0};
}

bool isPicture(const std::filesystem::path& file) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) return false;
  std::array<char, 8> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  const std::string_view bytes(first.data(), static_cast<std::size_t>(stream.gcount()));
  return isNetpbm(bytes) || isBmp(bytes) || isPngOrJpeg(bytes);
}

}  // namespace swiftlet::interfaces
