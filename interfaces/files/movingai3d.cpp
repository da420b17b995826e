#include "interfaces/files/movingai3d.hpp"

#include <cmath>

#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;
using common::VoxelIndex;

const LineFormat& listedFormat() {
  static const LineFormat kFormat{"voxel", {"x", "y", "z"}};
  return kFormat;
}

const LineFormat& voxelProblemFormat() {
  static const LineFormat kFormat{
      "problem", {"start x", "start y", "start z", "goal x", "goal y", "goal z", "optimal length", "ratio"}};
  return kFormat;
}

/// Three fields from `field` on, of a box.
VoxelIndex voxelOf(const LineFields& fields, std::size_t field, const VoxelIndex& size) {
  const auto whole = [&](std::size_t at, int end) {
    const double value = fields.numberWithin(at, 0.0, end - 1);
    if (value != std::floor(value))
      throw fields.problemAt(at, "voxel", Message("movingai.no-voxel", "{} is no number of a voxel", value));
    return static_cast<int>(value);
  };
  return {whole(field, size.x), whole(field + 1, size.y), whole(field + 2, size.z)};
}

VoxelIndex voxelMapSize(const LineReader& reader, const std::vector<Word>& words) {
  constexpr const char* kHeader = "a voxel map begins with `voxel 100 100 50`, its sides";
  if (words.size() != 4 || words[0].text != "voxel")
    throw reader.problemAt(1, "", Message("movingai.no-voxels", "is no header of a voxel map"), kHeader);
  double sides[3] = {};
  double voxels = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!parseNumber(words[i + 1].text, sides[i]) || sides[i] != std::floor(sides[i]) || sides[i] < 1.0)
      throw reader.problemAt(words[i + 1].column, "voxel",
                             Message("movingai.voxel-side", "`{}` is no number of voxels", words[i + 1].text), kHeader);
    voxels *= sides[i];
  }
  if (!(voxels <= kMostListedVoxels))
    throw reader.problemAt(
        words[1].column, "voxel",
        Message("movingai.voxels", "has {:.1e} voxels, more than {:.0e}", voxels, kMostListedVoxels));
  return {static_cast<int>(sides[0]), static_cast<int>(sides[1]), static_cast<int>(sides[2])};
}

VoxelListing readListingFrom(LineReader reader) {
  std::vector<Word> words;
  if (!nextWords(reader, words))
    throw reader.problemAt(0, "", Message("movingai.no-voxels", "is no header of a voxel map"));
  VoxelListing map{voxelMapSize(reader, words), {}};
  while (nextWords(reader, words))
    map.blocked.push_back(voxelOf(LineFields(reader, words, listedFormat()), 0, map.size));
  return map;
}

std::vector<VoxelProblem> readVoxelProblemsFrom(LineReader reader, const VoxelIndex& size) {
  std::vector<VoxelProblem> problems;
  std::vector<Word> words;
  while (nextWords(reader, words)) {
    // "version 1" and the name of the map.
    if (words[0].text == "version" || words.size() == 1) continue;
    const LineFields fields(reader, words, voxelProblemFormat());
    problems.push_back(
        {voxelOf(fields, 0, size), voxelOf(fields, 3, size), fields.number(6), static_cast<int>(reader.lineNumber())});
  }
  return problems;
}

}  // namespace

VoxelListing readVoxelListing(const std::filesystem::path& file) { return readListingFrom(LineReader(file)); }

VoxelListing parseVoxelListing(std::string_view bytes, const std::string& name) {
  return readListingFrom(LineReader::fromBytes(bytes, name));
}

std::vector<VoxelProblem> readVoxelProblems(const std::filesystem::path& file, VoxelIndex size) {
  return readVoxelProblemsFrom(LineReader(file), size);
}

std::vector<VoxelProblem> parseVoxelProblems(std::string_view bytes, const std::string& name, VoxelIndex size) {
  return readVoxelProblemsFrom(LineReader::fromBytes(bytes, name), size);
}

}  // namespace swiftlet::interfaces
