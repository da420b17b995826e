// Encodes images as JPEG (libjpeg-turbo). The same image gives the same bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/image.hpp"

namespace swiftlet::common {

/// A drawing keeps its full colour resolution, so that thin coloured lines do not bleed; a photo has half of it, as
/// cameras give it too. Reuses its buffers; one thread at a time.
class JpegEncoder {
 public:
  explicit JpegEncoder(ImageContent content = ImageContent::kDrawing);
  ~JpegEncoder();
  JpegEncoder(JpegEncoder&&) noexcept;
  JpegEncoder& operator=(JpegEncoder&&) noexcept;

  /// Quality in [1, 100]. The image must have at least one pixel and as many bytes as its size says.
  std::vector<std::uint8_t> encode(const Image& image, int quality);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::common
