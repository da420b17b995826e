#include "common/image_decoder.hpp"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace swiftlet::common {
namespace {

using tl::unexpected;

bool isPng(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }
bool isJpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }

std::size_t samples(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

/// None if it is at most that large.
std::optional<ImageFault> tooLarge(int width_px, int height_px, int most_px) {
  if (std::max(width_px, height_px) <= most_px) return std::nullopt;
  return ImageFault{
      Message("image.too-large", "is {}x{} pixels large, 1 to {} can be read", width_px, height_px, most_px)};
}

ImageFault neitherPngNorJpeg() { return {Message("image.no-png-or-jpeg", "is neither PNG nor JPEG")}; }

constexpr const char* kCutOff = "is cut off";

/// What libpng and libjpeg say of bytes that are missing or changed, and of images that are whole: of 12 bits, or with
/// the colours of printers.
ImageFault faultOf(const std::string& said) {
  if (said == kCutOff) return {Message("image.cut-off", "is cut off"), true};
  constexpr std::array<std::string_view, 6> kWholes{"upported", "implemented", "determine",
                                                    "limit",    "memory",      "is not a"};
  const bool is_whole = std::any_of(kWholes.begin(), kWholes.end(),
                                    [&](std::string_view text) { return said.find(text) != std::string::npos; });
  return {Message("image.not-decoded", "{}", said), !is_whole};
}

/// Deflate packs at most so many bytes into one, and JPEG fewer. A header that promises more pixels must not allocate
/// them.
constexpr std::size_t kMostUnpacked = 1032;

// --- PNG ------------------------------------------------------------------------------------------------------------

enum class Wanted { kRgb, kGray16, kGrey };

/// A PNG while it is read. libpng leaves by longjmp to `readPixels`, which has no objects with destructors.
struct PngRead {
  std::string_view bytes;
  std::size_t at = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  int width_px = 0, height_px = 0, channels = 0;
  std::vector<std::uint8_t> pixels;
  std::vector<png_bytep> rows;
  ImageFault fault;

  explicit PngRead(std::string_view all) : bytes(all) {}
  PngRead(const PngRead&) = delete;
  PngRead& operator=(const PngRead&) = delete;
  ~PngRead() { png_destroy_read_struct(&png, &info, nullptr); }
};

void onError(png_structp png, png_const_charp message) {
  static_cast<PngRead*>(png_get_error_ptr(png))->fault = faultOf(message);
  png_longjmp(png, 1);
}
void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep out, std::size_t count) {
  PngRead& read = *static_cast<PngRead*>(png_get_io_ptr(png));
  if (read.bytes.size() - read.at < count) png_error(png, kCutOff);
  std::memcpy(out, read.bytes.data() + read.at, count);
  read.at += count;
}

void convertTo(PngRead& read, Wanted wanted) {
  const int depth = png_get_bit_depth(read.png, read.info), type = png_get_color_type(read.png, read.info);
  if (wanted == Wanted::kGray16) {
    if (depth != 16 || type != PNG_COLOR_TYPE_GRAY) png_error(read.png, "is not a 16-bit grey image");
    png_set_swap(read.png);
    return;
  }
  png_set_expand(read.png);
  if (wanted == Wanted::kGrey) return png_set_scale_16(read.png);
  png_set_strip_16(read.png);
  png_set_strip_alpha(read.png);
  if (!(type & PNG_COLOR_MASK_COLOR)) png_set_gray_to_rgb(read.png);
}

void placeRows(PngRead& read) {
  const std::size_t row_bytes = png_get_rowbytes(read.png, read.info);
  read.pixels.resize(row_bytes * static_cast<std::size_t>(read.height_px));
  for (std::size_t i = 0; i < static_cast<std::size_t>(read.height_px); ++i)
    read.rows.push_back(read.pixels.data() + i * row_bytes);
}

/// Not inlined into `readPixels`, whose objects longjmp would leave behind.
[[gnu::noinline]] bool isTooLarge(PngRead& read, int most_px) {
  auto fault = tooLarge(read.width_px, read.height_px, most_px);
  if (fault) read.fault = *std::move(fault);
  return fault.has_value();
}

/// False with `read.fault`. Not inlined into its caller, whose objects longjmp would leave behind.
[[gnu::noinline]] bool readPixels(PngRead& read, Wanted wanted) {
  if (setjmp(png_jmpbuf(read.png)) != 0) return false;
  read.info = png_create_info_struct(read.png);
  png_set_user_limits(read.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_read_fn(read.png, &read, onRead);
  png_read_info(read.png, read.info);
  read.width_px = static_cast<int>(png_get_image_width(read.png, read.info));
  read.height_px = static_cast<int>(png_get_image_height(read.png, read.info));
  if (isTooLarge(read, wanted == Wanted::kGrey ? kMostGreySide_px : kMostImageSide_px)) return false;
  if (png_get_rowbytes(read.png, read.info) * static_cast<std::size_t>(read.height_px) / kMostUnpacked >
      read.bytes.size())
    png_error(read.png, kCutOff);
  convertTo(read, wanted);
  png_set_interlace_handling(read.png);
  png_read_update_info(read.png, read.info);
  read.channels = png_get_channels(read.png, read.info);
  placeRows(read);
  png_read_image(read.png, read.rows.data());
  png_read_end(read.png, nullptr);
  return true;
}

/// False with `read.fault`.
bool readPng(PngRead& read, Wanted wanted) {
  read.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &read, onError, onWarning);
  if (read.png != nullptr) return readPixels(read, wanted);
  read.fault = {Message("image.no-memory", "cannot be read for lack of memory")};
  return false;
}

tl::expected<Image, ImageFault> colorFromPng(std::string_view bytes) {
  PngRead read(bytes);
  if (!readPng(read, Wanted::kRgb)) return unexpected(std::move(read.fault));
  if (read.pixels.size() != 3 * samples(read.width_px, read.height_px))
    return unexpected(ImageFault{Message("image.not-8-bit", "is not an 8-bit RGB image")});
  return Image{read.width_px, read.height_px, std::move(read.pixels)};
}

/// From pixels of one or three colours, with or without a last channel for opacity.
GreyImage greyOf(int width_px, int height_px, const std::vector<std::uint8_t>& pixels, int channels) {
  const auto step = static_cast<std::size_t>(channels);
  const std::size_t colors = channels < 3 ? 1 : 3, count = samples(width_px, height_px);
  GreyImage image{width_px, height_px, {}, {}};
  image.brightness.reserve(count);
  if (step > colors) image.opacity.reserve(count);
  for (std::size_t at = 0; at < count * step; at += step) {
    const int sum = colors == 1 ? 3 * pixels[at] : pixels[at] + pixels[at + 1] + pixels[at + 2];
    image.brightness.push_back(static_cast<std::uint8_t>((2 * sum + 3) / 6));
    if (step > colors) image.opacity.push_back(pixels[at + colors]);
  }
  return image;
}

// --- JPEG -----------------------------------------------------------------------------------------------------------

struct DestroyJpeg {
  void operator()(void* handle) const { tjDestroy(handle); }
};

tl::expected<Image, ImageFault> colorFromJpeg(std::string_view bytes, int most_px) {
  const std::unique_ptr<void, DestroyJpeg> handle(tjInitDecompress());
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width_px = 0, height_px = 0, subsampling = 0, color_space = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width_px, &height_px, &subsampling, &color_space) != 0)
    return unexpected(faultOf(tjGetErrorStr2(handle.get())));
  if (auto fault = tooLarge(width_px, height_px, most_px)) return unexpected(*std::move(fault));
  if (width_px <= 0 || height_px <= 0 || samples(width_px, height_px) / kMostUnpacked > bytes.size())
    return unexpected(faultOf(kCutOff));
  Image image{width_px, height_px, std::vector<std::uint8_t>(3 * samples(width_px, height_px))};
  // The accurate transform gives the same bytes with and without the CPU's vector instructions. A warning, such as a
  // premature end, counts as an error: what is missing would be grey.
  if (tjDecompress2(handle.get(), data, bytes.size(), image.rgb.data(), width_px, 0, height_px, TJPF_RGB,
                    TJFLAG_ACCURATEDCT) != 0)
    return unexpected(faultOf(tjGetErrorStr2(handle.get())));
  return image;
}

}  // namespace

tl::expected<Image, ImageFault> decodeColor(std::string_view bytes) {
  if (isPng(bytes)) return colorFromPng(bytes);
  if (isJpeg(bytes)) return colorFromJpeg(bytes, kMostImageSide_px);
  return unexpected(neitherPngNorJpeg());
}

tl::expected<DepthCodes, ImageFault> decodeDepth(std::string_view bytes) {
  if (!isPng(bytes)) return unexpected(ImageFault{Message("image.no-png", "is not a PNG")});
  PngRead read(bytes);
  if (!readPng(read, Wanted::kGray16)) return unexpected(std::move(read.fault));
  DepthCodes depth{read.width_px, read.height_px, {}};
  depth.codes.resize(samples(read.width_px, read.height_px));
  std::memcpy(depth.codes.data(), read.pixels.data(), read.pixels.size());
  return depth;
}

tl::expected<GreyImage, ImageFault> decodeGrey(std::string_view bytes) {
  if (isJpeg(bytes))
    return colorFromJpeg(bytes, kMostGreySide_px).map([](const Image& image) {
      return greyOf(image.width_px, image.height_px, image.rgb, 3);
    });
  if (!isPng(bytes)) return unexpected(neitherPngNorJpeg());
  PngRead read(bytes);
  if (!readPng(read, Wanted::kGrey)) return unexpected(std::move(read.fault));
  return greyOf(read.width_px, read.height_px, read.pixels, read.channels);
}

}  // namespace swiftlet::common
