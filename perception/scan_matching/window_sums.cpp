#include "perception/scan_matching/window_sums.hpp"

#include <algorithm>
#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

void sumScalar(const std::uint8_t* cells, int stride, std::span<const std::int32_t> offsets, int rows,
               std::uint16_t* sums) {
  std::fill_n(sums, static_cast<std::size_t>(rows) * kWindowColumns, std::uint16_t{0});
  for (const std::int32_t offset : offsets) {
    for (int row = 0; row < rows; ++row) {
      const std::uint8_t* in = cells + offset + static_cast<std::ptrdiff_t>(row) * stride;
      std::uint16_t* out = sums + static_cast<std::ptrdiff_t>(row) * kWindowColumns;
      for (int c = 0; c < kWindowColumns; ++c) out[c] = static_cast<std::uint16_t>(out[c] + in[c]);
    }
  }
}

#if defined(__x86_64__)

__attribute__((target("sse4.1"))) void sumSse41(const std::uint8_t* cells, int stride,
                                                std::span<const std::int32_t> offsets, int rows, std::uint16_t* sums) {
  for (int row = 0; row < rows; ++row) {
    const std::uint8_t* base = cells + static_cast<std::ptrdiff_t>(row) * stride;
    __m128i low = _mm_setzero_si128(), high = _mm_setzero_si128();
    for (const std::int32_t offset : offsets) {
      const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(base + offset));
      low = _mm_add_epi16(low, _mm_cvtepu8_epi16(bytes));
      high = _mm_add_epi16(high, _mm_unpackhi_epi8(bytes, _mm_setzero_si128()));
    }
    auto* out = reinterpret_cast<__m128i*>(sums + static_cast<std::ptrdiff_t>(row) * kWindowColumns);
    _mm_storeu_si128(out, low);
    _mm_storeu_si128(out + 1, high);
  }
}

__attribute__((target("avx2"))) __m256i widened(const std::uint8_t* bytes) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)));
}

/// Four rows at once share one pass over the offsets.
__attribute__((target("avx2"))) void sumAvx2(const std::uint8_t* cells, int stride,
                                             std::span<const std::int32_t> offsets, int rows, std::uint16_t* sums) {
  auto* out = reinterpret_cast<__m256i*>(sums);
  int row = 0;
  for (; row + 4 <= rows; row += 4) {
    const std::uint8_t* base = cells + static_cast<std::ptrdiff_t>(row) * stride;
    __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
    for (const std::int32_t offset : offsets) {
      const std::uint8_t* at = base + offset;
      a = _mm256_add_epi16(a, widened(at));
      b = _mm256_add_epi16(b, widened(at + stride));
      c = _mm256_add_epi16(c, widened(at + 2 * static_cast<std::ptrdiff_t>(stride)));
      d = _mm256_add_epi16(d, widened(at + 3 * static_cast<std::ptrdiff_t>(stride)));
    }
    _mm256_storeu_si256(out + row, a);
    _mm256_storeu_si256(out + row + 1, b);
    _mm256_storeu_si256(out + row + 2, c);
    _mm256_storeu_si256(out + row + 3, d);
  }
  for (; row + 2 <= rows; row += 2) {
    const std::uint8_t* base = cells + static_cast<std::ptrdiff_t>(row) * stride;
    __m256i a = _mm256_setzero_si256(), b = a;
    for (const std::int32_t offset : offsets) {
      a = _mm256_add_epi16(a, widened(base + offset));
      b = _mm256_add_epi16(b, widened(base + offset + stride));
    }
    _mm256_storeu_si256(out + row, a);
    _mm256_storeu_si256(out + row + 1, b);
  }
  for (; row < rows; ++row) {
    const std::uint8_t* base = cells + static_cast<std::ptrdiff_t>(row) * stride;
    __m256i a = _mm256_setzero_si256();
    for (const std::int32_t offset : offsets) a = _mm256_add_epi16(a, widened(base + offset));
    _mm256_storeu_si256(out + row, a);
  }
}

#endif

std::int32_t floorToCell(float value) {
  const auto cell = static_cast<std::int32_t>(value);
  return static_cast<float>(cell) > value ? cell - 1 : cell;
}

#if defined(__x86_64__)
__m128i floorToCell(__m128 value) {
  const __m128i cell = _mm_cvttps_epi32(value);
  return _mm_add_epi32(cell, _mm_castps_si128(_mm_cmpgt_ps(_mm_cvtepi32_ps(cell), value)));
}
#endif

}  // namespace

bool isAvailable(Instructions instructions) {
#if defined(__x86_64__)
  if (instructions == Instructions::kAvx2) return __builtin_cpu_supports("avx2") != 0;
  if (instructions == Instructions::kSse41) return __builtin_cpu_supports("sse4.1") != 0;
#endif
  return instructions == Instructions::kScalar;
}

Instructions bestInstructions() {
  for (const Instructions instructions : {Instructions::kAvx2, Instructions::kSse41})
    if (isAvailable(instructions)) return instructions;
  return Instructions::kScalar;
}

const char* toString(Instructions instructions) {
  switch (instructions) {
    case Instructions::kScalar:
      return "scalar";
    case Instructions::kSse41:
      return "sse4.1";
    case Instructions::kAvx2:
      return "avx2";
  }
  return "?";
}

void sumWindows(Instructions instructions, const std::uint8_t* cells, int stride, std::span<const std::int32_t> offsets,
                int rows, std::uint16_t* sums) {
  SWIFTLET_CHECK(offsets.size() <= kMaxWindowPoints, offsets.size());
  switch (instructions) {
#if defined(__x86_64__)
    case Instructions::kSse41:
      return sumSse41(cells, stride, offsets, rows, sums);
    case Instructions::kAvx2:
      return sumAvx2(cells, stride, offsets, rows, sums);
#endif
    default:
      return sumScalar(cells, stride, offsets, rows, sums);
  }
}

void transformToCells(std::span<const float> points_x, std::span<const float> points_y, float cosine, float sine,
                      float shift_x, float shift_y, std::span<std::int32_t> cells_x, std::span<std::int32_t> cells_y) {
  const std::size_t size = points_x.size();
  SWIFTLET_CHECK(points_y.size() == size && cells_x.size() == size && cells_y.size() == size, size);
  std::size_t i = 0;
#if defined(__x86_64__)
  const __m128 c = _mm_set1_ps(cosine), s = _mm_set1_ps(sine);
  const __m128 tx = _mm_set1_ps(shift_x), ty = _mm_set1_ps(shift_y);
  for (; i + 4 <= size; i += 4) {
    const __m128 x = _mm_loadu_ps(&points_x[i]), y = _mm_loadu_ps(&points_y[i]);
    const __m128 moved_x = _mm_add_ps(_mm_sub_ps(_mm_mul_ps(c, x), _mm_mul_ps(s, y)), tx);
    const __m128 moved_y = _mm_add_ps(_mm_add_ps(_mm_mul_ps(s, x), _mm_mul_ps(c, y)), ty);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&cells_x[i]), floorToCell(moved_x));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&cells_y[i]), floorToCell(moved_y));
  }
#endif
  for (; i < size; ++i) {
    cells_x[i] = floorToCell(cosine * points_x[i] - sine * points_y[i] + shift_x);
    cells_y[i] = floorToCell(sine * points_x[i] + cosine * points_y[i] + shift_y);
  }
}

}  // namespace swiftlet::perception
