#include "common/jpeg_encoder.hpp"

#include <turbojpeg.h>

#include "common/check.hpp"

namespace swiftlet::common {

struct JpegEncoder::Impl {
  explicit Impl(ImageContent shown) : content(shown) {}

  ImageContent content;
  tjhandle handle = tjInitCompress();
  unsigned char* buffer = nullptr;
  unsigned long capacity = 0;

  ~Impl() {
    tjFree(buffer);
    tjDestroy(handle);
  }
};

JpegEncoder::JpegEncoder(ImageContent content) : impl_(std::make_unique<Impl>(content)) {
  SWIFTLET_CHECK(impl_->handle != nullptr);
}
JpegEncoder::~JpegEncoder() = default;
JpegEncoder::JpegEncoder(JpegEncoder&&) noexcept = default;
JpegEncoder& JpegEncoder::operator=(JpegEncoder&&) noexcept = default;

std::vector<std::uint8_t> JpegEncoder::encode(const Image& image, int quality) {
  SWIFTLET_CHECK(image.width_px > 0 && image.height_px > 0 && quality >= 1 && quality <= 100, image.width_px,
                 image.height_px, quality);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  const bool drawing = impl_->content == ImageContent::kDrawing;
  const int sampling = drawing ? TJSAMP_444 : TJSAMP_420;
  const unsigned long needed = tjBufSize(image.width_px, image.height_px, sampling);
  if (needed > impl_->capacity) {
    tjFree(impl_->buffer);
    impl_->buffer = tjAlloc(static_cast<int>(needed));
    impl_->capacity = needed;
    SWIFTLET_CHECK(impl_->buffer != nullptr, needed);
  }
  unsigned long size = impl_->capacity;
  const int failed =
      tjCompress2(impl_->handle, image.rgb.data(), image.width_px, 0, image.height_px, TJPF_RGB, &impl_->buffer, &size,
                  sampling, quality, TJFLAG_NOREALLOC | (drawing ? TJFLAG_FASTDCT : 0));
  SWIFTLET_CHECK(failed == 0, tjGetErrorStr2(impl_->handle));
  return {impl_->buffer, impl_->buffer + size};
}

}  // namespace swiftlet::common
