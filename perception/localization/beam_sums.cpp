#include "perception/localization/beam_sums.hpp"

#include <algorithm>
#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

/// Operands are ordered as in _mm_min_ps and _mm_max_ps, so that NaN becomes the upper bound.
float clamped(float value, float high) {
  value = value < high ? value : high;
  return value > 0.0F ? value : 0.0F;
}

void sumScalar(const FieldView& field, const CellPoses& poses, const CellBeams& beams, std::size_t begin,
               std::span<std::int32_t> sums) {
  const auto high_x = static_cast<float>(field.width - 1), high_y = static_cast<float>(field.height - 1);
  for (std::size_t i = begin; i < sums.size(); ++i) {
    const float c = poses.cosine[i], s = poses.sine[i], x0 = poses.x[i], y0 = poses.y[i];
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < beams.x.size(); ++k) {
      const float x = (c * beams.x[k] - s * beams.y[k]) + x0;
      const float y = (s * beams.x[k] + c * beams.y[k]) + y0;
      const auto column = static_cast<std::int32_t>(clamped(x, high_x));
      const auto row = static_cast<std::int32_t>(clamped(y, high_y));
      sum += field.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.width) +
                         static_cast<std::size_t>(column)];
    }
    sums[i] = sum;
  }
}

#if defined(__x86_64__)

__attribute__((target("sse4.1"))) std::size_t sumSse41(const FieldView& field, const CellPoses& poses,
                                                       const CellBeams& beams, std::span<std::int32_t> sums) {
  const __m128 high_x = _mm_set1_ps(static_cast<float>(field.width - 1));
  const __m128 high_y = _mm_set1_ps(static_cast<float>(field.height - 1));
  const __m128 zero = _mm_setzero_ps();
  const __m128i width = _mm_set1_epi32(field.width);
  std::size_t i = 0;
  for (; i + 4 <= sums.size(); i += 4) {
    const __m128 c = _mm_loadu_ps(&poses.cosine[i]), s = _mm_loadu_ps(&poses.sine[i]);
    const __m128 x0 = _mm_loadu_ps(&poses.x[i]), y0 = _mm_loadu_ps(&poses.y[i]);
    __m128i sum = _mm_setzero_si128();
    for (std::size_t k = 0; k < beams.x.size(); ++k) {
      const __m128 bx = _mm_set1_ps(beams.x[k]), by = _mm_set1_ps(beams.y[k]);
      const __m128 x = _mm_add_ps(_mm_sub_ps(_mm_mul_ps(c, bx), _mm_mul_ps(s, by)), x0);
      const __m128 y = _mm_add_ps(_mm_add_ps(_mm_mul_ps(s, bx), _mm_mul_ps(c, by)), y0);
      const __m128i column = _mm_cvttps_epi32(_mm_max_ps(_mm_min_ps(x, high_x), zero));
      const __m128i row = _mm_cvttps_epi32(_mm_max_ps(_mm_min_ps(y, high_y), zero));
      const __m128i index = _mm_add_epi32(_mm_mullo_epi32(row, width), column);
      const __m128i bytes =
          _mm_setr_epi32(field.cells[_mm_extract_epi32(index, 0)], field.cells[_mm_extract_epi32(index, 1)],
                         field.cells[_mm_extract_epi32(index, 2)], field.cells[_mm_extract_epi32(index, 3)]);
      sum = _mm_add_epi32(sum, bytes);
    }
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&sums[i]), sum);
  }
  return i;
}

struct Lanes {
  __m256 cosine, sine, x, y;
};

__attribute__((target("avx2"))) inline Lanes lanesAt(const CellPoses& poses, std::size_t i) {
  return {_mm256_loadu_ps(&poses.cosine[i]), _mm256_loadu_ps(&poses.sine[i]), _mm256_loadu_ps(&poses.x[i]),
          _mm256_loadu_ps(&poses.y[i])};
}

/// The byte under one beam for eight poses. The gather reads four bytes per lane; the field has room for that past its
/// end.
__attribute__((target("avx2"))) inline __m256i bytesUnder(const FieldView& field, const Lanes& pose, __m256 bx,
                                                          __m256 by, __m256 high_x, __m256 high_y, __m256i width) {
  const __m256 zero = _mm256_setzero_ps();
  const __m256 x = _mm256_add_ps(_mm256_sub_ps(_mm256_mul_ps(pose.cosine, bx), _mm256_mul_ps(pose.sine, by)), pose.x);
  const __m256 y = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(pose.sine, bx), _mm256_mul_ps(pose.cosine, by)), pose.y);
  const __m256i column = _mm256_cvttps_epi32(_mm256_max_ps(_mm256_min_ps(x, high_x), zero));
  const __m256i row = _mm256_cvttps_epi32(_mm256_max_ps(_mm256_min_ps(y, high_y), zero));
  const __m256i index = _mm256_add_epi32(_mm256_mullo_epi32(row, width), column);
  const __m256i words = _mm256_i32gather_epi32(reinterpret_cast<const int*>(field.cells), index, 1);
  return _mm256_and_si256(words, _mm256_set1_epi32(0xff));
}

__attribute__((target("avx2"))) std::size_t sumAvx2(const FieldView& field, const CellPoses& poses,
                                                    const CellBeams& beams, std::span<std::int32_t> sums) {
  const __m256 high_x = _mm256_set1_ps(static_cast<float>(field.width - 1));
  const __m256 high_y = _mm256_set1_ps(static_cast<float>(field.height - 1));
  const __m256i width = _mm256_set1_epi32(field.width);
  std::size_t i = 0;
  for (; i + 16 <= sums.size(); i += 16) {
    const Lanes a = lanesAt(poses, i), b = lanesAt(poses, i + 8);
    __m256i sum_a = _mm256_setzero_si256(), sum_b = _mm256_setzero_si256();
    for (std::size_t k = 0; k < beams.x.size(); ++k) {
      const __m256 bx = _mm256_set1_ps(beams.x[k]), by = _mm256_set1_ps(beams.y[k]);
      sum_a = _mm256_add_epi32(sum_a, bytesUnder(field, a, bx, by, high_x, high_y, width));
      sum_b = _mm256_add_epi32(sum_b, bytesUnder(field, b, bx, by, high_x, high_y, width));
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(&sums[i]), sum_a);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(&sums[i + 8]), sum_b);
  }
  return i;
}

#endif

}  // namespace

void sumBeams(Instructions instructions, const FieldView& field, const CellPoses& poses, const CellBeams& beams,
              std::span<std::int32_t> sums) {
  SWIFTLET_CHECK(poses.x.size() == sums.size() && poses.y.size() == sums.size() && poses.cosine.size() == sums.size() &&
                     poses.sine.size() == sums.size() && beams.x.size() == beams.y.size(),
                 sums.size(), beams.x.size());
  std::size_t done = 0;
#if defined(__x86_64__)
  if (instructions == Instructions::kSse41) done = sumSse41(field, poses, beams, sums);
  if (instructions == Instructions::kAvx2) done = sumAvx2(field, poses, beams, sums);
#else
  (void)instructions;
#endif
  sumScalar(field, poses, beams, done, sums);
}

}  // namespace swiftlet::perception
