// The formats of pictures in files and streams: PNG, JPEG, base64.
#include <gtest/gtest.h>
#include <png.h>

#include "common/base64.hpp"
#include "common/jpeg_encoder.hpp"
#include "common/png_encoder.hpp"

namespace swiftlet::common {
namespace {

using Bytes = std::vector<std::uint8_t>;

Image pattern(int width_px, int height_px) {
  Image image{width_px, height_px, {}};
  for (int i = 0; i < 3 * width_px * height_px; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 7));
  return image;
}

TEST(EncodeTest, PngReadsBackAsTheSamePicture) {
  const Image image = pattern(31, 17);
  const Bytes png = encodePng(image);
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&reader, png.data(), png.size()), 0);
  reader.format = PNG_FORMAT_RGB;
  Bytes pixels(PNG_IMAGE_SIZE(reader));
  ASSERT_NE(png_image_finish_read(&reader, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels, image.rgb);
  EXPECT_EQ(encodePng(image), png);
}

TEST(EncodeTest, JpegHasItsMarkersAndIsRepeatable) {
  JpegEncoder encoder;
  const Bytes large = encoder.encode(pattern(200, 100), 80);
  EXPECT_EQ(large[0], 0xff);
  EXPECT_EQ(large[1], 0xd8);
  EXPECT_EQ(large[large.size() - 1], 0xd9);
  const Bytes small = encoder.encode(pattern(8, 8), 80);
  EXPECT_LT(small.size(), large.size());
  EXPECT_EQ(encoder.encode(pattern(200, 100), 80), large);
}

TEST(EncodeTest, Base64FollowsTheStandard) {
  const auto of = [](const std::string& text) { return base64(Bytes(text.begin(), text.end())); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

TEST(EncodeTest, APhotoAsPngReadsBackAsTheSamePicture) {
  const Image image = pattern(40, 30);
  const Bytes png = encodePng(image, ImageContent::kPhoto);
  const auto read = decodeColor({reinterpret_cast<const char*>(png.data()), png.size()});
  ASSERT_TRUE(read) << read.error().reason.text();
  EXPECT_EQ(read->rgb, image.rgb);
}

TEST(EncodeTest, DepthKeepsAllSixteenBits) {
  DepthCodes depth{7, 3, {}};
  for (int i = 0; i < 21; ++i) depth.codes.push_back(static_cast<std::uint16_t>(i * 3119));
  const Bytes png = encodePng(depth);
  const auto read = decodeDepth({reinterpret_cast<const char*>(png.data()), png.size()});
  ASSERT_TRUE(read) << read.error().reason.text();
  EXPECT_EQ(read->width_px, 7);
  EXPECT_EQ(read->codes, depth.codes);
}

}  // namespace
}  // namespace swiftlet::common
