#include "rendering/stroke_font.hpp"

#include <array>
#include <cmath>

namespace swiftlet::rendering {
namespace {

constexpr double kUnitsPerCapital = 6.0;
constexpr double kGap = 1.7;  // Gap between two characters, in units.

/// Strokes are pairs: a column '0'..'4' and a row 'a' (-2, the descender) .. 'c' (0, the baseline) .. 'g' (4, a small
/// letter) .. 'i' (6, a capital). A blank ends a stroke; a stroke of one repeated point is a dot.
struct Glyph {
  int width;
  const char* strokes;
};

constexpr Glyph kBox{4, "0c0i4i4c0c"};

// From ' ' (32) to '~' (126).
constexpr std::array<Glyph, 95> kGlyphs{{
    {2, ""},
    {0, "0i0e 0c0c"},
    {2, "0i0g 2i2g"},
    {4, "1i1c 3i3c 0e4e 0g4g"},
    {4, "4h3i1i0h0g1f3f4e4d3c1c0d 2i2c"},
    {4, "4i0c 0i1i1h0h0i 3d4d4c3c3d"},
    {4, "4c1g1h2i3h3g0e0d1c2c4e"},
    {0, "0i0g"},
    {1, "1i0h0d1c"},
    {1, "0i1h1d0c"},
    {4, "2h2d 0g4e 0e4g"},
    {4, "2h2d 0f4f"},
    {1, "1d1c0b"},
    {3, "0f3f"},
    {0, "0c0c"},
    {3, "0c3i"},
    {4, "1i3i4h4d3c1c0d0h1i"},
    {4, "0h2i2c 0c4c"},
    {4, "0h1i3i4h4g0c4c"},
    {4, "0h1i3i4h4g3f2f 2f3f4e4d3c1c0d"},
    {4, "3c3i0e4e"},
    {4, "4i0i0f3f4e4d3c1c0d"},
    {4, "4h3i1i0h0d1c3c4d4e3f1f0e"},
    {4, "0i4i1c"},
    {4, "1f0g0h1i3i4h4g3f1f0e0d1c3c4d4e3f"},
    {4, "4g3f1f0g0h1i3i4h4d3c1c0d"},
    {0, "0f0f 0c0c"},
    {1, "1f1f 1c0b"},
    {3, "3h0f3d"},
    {4, "0g4g 0e4e"},
    {3, "0h3f0d"},
    {4, "0h1i3i4h4g2f2e 2c2c"},
    {4, "4c1c0d0h1i3i4h4e2e2g4g"},
    {4, "0c2i4c 1f3f"},
    {4, "0c0i3i4h4g3f0f 3f4e4d3c0c"},
    {4, "4h3i1i0h0d1c3c4d"},
    {4, "0c0i2i4g4e2c0c"},
    {4, "4i0i0c4c 0f3f"},
    {4, "4i0i0c 0f3f"},
    {4, "4h3i1i0h0d1c3c4d4f2f"},
    {4, "0i0c 4i4c 0f4f"},
    {0, "0i0c"},
    {3, "3i3d2c1c0d"},
    {4, "0i0c 4i0e 1f4c"},
    {3, "0i0c3c"},
    {4, "0c0i2f4i4c"},
    {4, "0c0i4c4i"},
    {4, "1i3i4g4e3c1c0e0g1i"},
    {4, "0c0i3i4h4g3f0f"},
    {4, "1i3i4g4e3c1c0e0g1i 2e4c"},
    {4, "0c0i3i4h4g3f0f 2f4c"},
    {4, "4h3i1i0h0g1f3f4e4d3c1c0d"},
    {4, "0i4i 2i2c"},
    {4, "0i0d1c3c4d4i"},
    {4, "0i2c4i"},
    {4, "0i1c2f3c4i"},
    {4, "0i4c 0c4i"},
    {4, "0i2f4i 2f2c"},
    {4, "0i4i0c4c"},
    {1, "1i0i0c1c"},
    {3, "0i3c"},
    {1, "0i1i1c0c"},
    {2, "0g1i2g"},
    {4, "0b4b"},
    {1, "0i1h"},
    {3, "3g3c 3f2g1g0f0d1c2c3d"},
    {3, "0i0c 0f1g2g3f3d2c1c0d"},
    {3, "3f2g1g0f0d1c2c3d"},
    {3, "3i3c 3f2g1g0f0d1c2c3d"},
    {3, "0e3e3f2g1g0f0d1c3c"},
    {2, "2i1h1c 0g2g"},
    {3, "3g3b2a1a0b 3f2g1g0f0d1c2c3d"},
    {3, "0i0c 0f1g2g3f3c"},
    {0, "0g0c 0i0i"},
    {1, "1g1b0a 1i1i"},
    {3, "0i0c 3g0d 1e3c"},
    {1, "0i0d1c"},
    {4, "0g0c 0f1g2f2c 2f3g4f4c"},
    {3, "0g0c 0f1g2g3f3c"},
    {3, "1g2g3f3d2c1c0d0f1g"},
    {3, "0g0a 0f1g2g3f3d2c1c0d"},
    {3, "3g3a 3f2g1g0f0d1c2c3d"},
    {2, "0g0c 0f1g2g"},
    {3, "3f2g1g0f1e2e3d2c1c0d"},
    {2, "1i1d2c 0g2g"},
    {3, "0g0d1c2c3d 3g3c"},
    {2, "0g1c2g"},
    {4, "0g1c2f3c4g"},
    {3, "0g3c 0c3g"},
    {2, "0g1c 2g1c0a"},
    {3, "0g3g0c3c"},
    {2, "2i1h1g0f1e1d2c"},
    {0, "0i0a"},
    {2, "0i1h1g2f1e1d0c"},
    {3, "0f1g2f3g"},
}};

const Glyph& glyphOf(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 32 && code < 127 ? kGlyphs[code - 32u] : kBox;
}

using Stroke = std::vector<Eigen::Vector2d>;

/// Cuts blunt corners once more, so that the chamfers of the grid look like curves; sharp corners stay.
Stroke rounded(const Stroke& stroke) {
  Stroke result;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (i == 0 || i + 1 == stroke.size()) {
      result.push_back(stroke[i]);
      continue;
    }
    const Eigen::Vector2d in = stroke[i] - stroke[i - 1], out = stroke[i + 1] - stroke[i];
    const bool blunt = in.dot(out) > 0.5 * in.norm() * out.norm();
    if (!blunt) {
      result.push_back(stroke[i]);
    } else {
      result.push_back(stroke[i] - in * (0.4 / std::max(1.0, in.norm())));
      result.push_back(stroke[i] + out * (0.4 / std::max(1.0, out.norm())));
    }
  }
  return result;
}

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> textStrokes(std::string_view text) {
  std::vector<Stroke> strokes;
  double left = 0.0;
  for (const char c : text) {
    const Glyph& glyph = glyphOf(c);
    Stroke stroke;
    const auto finish = [&] {
      if (!stroke.empty()) strokes.push_back(rounded(stroke));
      stroke.clear();
    };
    for (const char* p = glyph.strokes; *p != '\0';) {
      if (*p == ' ') {
        finish();
        ++p;
        continue;
      }
      stroke.emplace_back((left + (p[0] - '0')) / kUnitsPerCapital, (p[1] - 'c') / kUnitsPerCapital);
      p += 2;
    }
    finish();
    left += glyph.width + kGap;
  }
  return strokes;
}

double textWidth(std::string_view text) {
  double units = text.empty() ? 0.0 : -kGap;
  for (const char c : text) units += glyphOf(c).width + kGap;
  return units / kUnitsPerCapital;
}

}  // namespace swiftlet::rendering
