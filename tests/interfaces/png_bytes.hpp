// PNG files of any colour type and depth, made here so that their reader is not tested by its own writer.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace swiftlet::interfaces {

inline std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + body + bigEndian(static_cast<std::uint32_t>(crc));
}

struct PngKind {
  int depth = 8;
  int color_type = 0;             ///< 0 grey, 2 colours, 3 palette, 4 grey and opacity, 6 colours and opacity.
  std::string palette = {};       ///< Red, green, blue of each colour.
  std::string transparency = {};  ///< The chunk tRNS.
};

/// `row` is that of each of `height` rows.
inline std::string pngOf(int width, int height, const std::string& row, const PngKind& kind) {
  std::string raw;
  for (int i = 0; i < height; ++i) raw += '\0' + row;
  std::string packed(compressBound(static_cast<uLong>(raw.size())), '\0');
  uLongf size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
           static_cast<uLong>(raw.size()));
  packed.resize(size);
  std::string bytes = "\x89PNG\r\n\x1a\n";
  bytes +=
      pngChunk("IHDR", bigEndian(static_cast<std::uint32_t>(width)) + bigEndian(static_cast<std::uint32_t>(height)) +
                           static_cast<char>(kind.depth) + static_cast<char>(kind.color_type) + std::string(3, '\0'));
  if (!kind.palette.empty()) bytes += pngChunk("PLTE", kind.palette);
  if (!kind.transparency.empty()) bytes += pngChunk("tRNS", kind.transparency);
  return bytes + pngChunk("IDAT", packed) + pngChunk("IEND", "");
}

}  // namespace swiftlet::interfaces
