#include "interfaces/files/numbered_frames.hpp"

#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/error.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;

/// The number in "frame-000123.pose.txt", "000123.pose.txt" or "123.txt"; nullopt for other names.
std::optional<std::int64_t> poseFrame(std::string_view name) {
  for (const std::string_view prefix : {"frame-", "frame_", "frame"})
    if (name.starts_with(prefix)) {
      name.remove_prefix(prefix.size());
      break;
    }
  std::int64_t number = 0;
  const char* end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, number);
  const std::string_view ending(rest, static_cast<std::size_t>(end - rest));
  const bool is_pose = ending == ".pose.txt" || ending == ".txt" || ending == ".pose";
  if (error != std::errc() || !is_pose || number < 0 || number > 1'000'000'000) return std::nullopt;
  return number;
}

}  // namespace

RecordedPoses readNumberedFrames(const fs::path& folder) {
  std::error_code failure;
  const fs::directory_iterator entries(folder, failure);
  if (failure) throw InputError({folder.string()}, "", Message("file.not-reached", "{}", failure.message()));
  std::map<std::int64_t, fs::path> files;
  for (const auto& entry : entries) {
    const auto number = poseFrame(entry.path().filename().string());
    if (!number) continue;
    if (const auto [other, is_new] = files.emplace(*number, entry.path()); !is_new)
      throw InputError({entry.path().string()}, "",
                       Message("frames.number-twice", "has the frame number {}, and so has `{}`", *number,
                               other->second.filename().string()),
                       "keep one of them");
  }
  if (files.empty())
    throw InputError({folder.string()}, "", Message("frames.unknown-format", "holds no poses of a known format"),
                     "expected trajectory.tum, groundtruth.txt, trajectory.log (Open3D), frame-000000.pose.txt "
                     "(7-Scenes) or 0.txt (ScanNet); of KITTI, give the file");
  RecordedPoses found{PoseOrder::kNumbers, {}, 0};
  for (const auto& [number, file] : files) {
    const RecordedPoses one = readPoseMatrices(file);
    if (one.poses.size() + one.without_pose != 1)
      throw InputError({file.string()}, "",
                       Message("frames.several-poses", "holds {} poses, where one of frame {} belongs",
                               one.poses.size() + one.without_pose, number),
                       "give the file alone if it is a trajectory");
    found.without_pose += one.without_pose;
    for (const common::StampedPose& at : one.poses)
      found.poses.push_back({common::Time::fromSeconds(static_cast<double>(number)), at.pose});
  }
  requireFinitePoses(found, folder);
  return found;
}

}  // namespace swiftlet::interfaces
