// Encodes pictures: JPEG for streams (libjpeg-turbo), PNG for files (libpng). The same picture gives the same bytes: no
// time stamps, fixed compression.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/sensor_event.hpp"

namespace swiftlet::rendering {

using Bytes = std::vector<std::uint8_t>;

/// Reuses its buffers; one thread at a time.
class JpegEncoder {
 public:
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(JpegEncoder&&) noexcept;
  JpegEncoder& operator=(JpegEncoder&&) noexcept;

  /// Quality in [1, 100]. The image must have at least one pixel and as many bytes as its size says.
  Bytes encode(const common::Image& image, int quality);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

Bytes encodePng(const common::Image& image);

/// Base64, for pictures inside HTML and SVG.
std::string base64(const Bytes& bytes);

}  // namespace swiftlet::rendering
