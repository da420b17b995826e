#include <turbojpeg.h>

#include "common/check.hpp"
#include "rendering/encode.hpp"

namespace swiftlet::rendering {

struct JpegEncoder::Impl {
  tjhandle handle = tjInitCompress();
  unsigned char* buffer = nullptr;
  unsigned long capacity = 0;

  ~Impl() {
    tjFree(buffer);
    tjDestroy(handle);
  }
};

JpegEncoder::JpegEncoder() : impl_(std::make_unique<Impl>()) { SWIFTLET_CHECK(impl_->handle != nullptr); }
JpegEncoder::~JpegEncoder() = default;
JpegEncoder::JpegEncoder(JpegEncoder&&) noexcept = default;
JpegEncoder& JpegEncoder::operator=(JpegEncoder&&) noexcept = default;

Bytes JpegEncoder::encode(const common::Image& image, int quality) {
  SWIFTLET_CHECK(image.width_px > 0 && image.height_px > 0 && quality >= 1 && quality <= 100, image.width_px,
                 image.height_px, quality);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  // Full colour resolution: otherwise the map's thin coloured lines would bleed.
  const int sampling = TJSAMP_444;
  const unsigned long needed = tjBufSize(image.width_px, image.height_px, sampling);
  if (needed > impl_->capacity) {
    tjFree(impl_->buffer);
    impl_->buffer = tjAlloc(static_cast<int>(needed));
    impl_->capacity = needed;
    SWIFTLET_CHECK(impl_->buffer != nullptr, needed);
  }
  unsigned long size = impl_->capacity;
  const int failed = tjCompress2(impl_->handle, image.rgb.data(), image.width_px, 0, image.height_px, TJPF_RGB,
                                 &impl_->buffer, &size, sampling, quality, TJFLAG_NOREALLOC | TJFLAG_FASTDCT);
  SWIFTLET_CHECK(failed == 0, tjGetErrorStr2(impl_->handle));
  return Bytes(impl_->buffer, impl_->buffer + size);
}

}  // namespace swiftlet::rendering
