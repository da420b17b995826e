#include "apps/map3d_notes.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "apps/recorded_log.hpp"
#include "common/geometry.hpp"
#include "common/median_step.hpp"
#include "interfaces/files/stamp_units.hpp"

namespace swiftlet::apps {
namespace {

using interfaces::FrameFault;
using interfaces::RgbdFolder;

/// With poses for a smaller part of the frames, their times are probably from another clock.
constexpr double kFewPoses = 0.5;
/// No camera pauses longer within one recording.
constexpr double kLongGap_s = 10.0;

/// The typical depth of the frames, from which a user sees whether the unit of the depths is right.
std::string depthQuestion(const RgbdFolder& folder, const Map3dRun& run) {
  return fmt::format("the depths are {:.2f} m in the median at {:g} units a metre: is depth_units_per_m right?",
                     run.medianDepth_m(), folder.calibration().depth_units_per_m);
}

void noteOnTrack(const RgbdFolder& folder, const Map3dRun& run, const std::vector<MapPiece>& pieces,
                 const Map3dTrust& trust, std::vector<std::string>& notes) {
  if (!trust.reason.empty()) notes.push_back("the map is probably wrong: " + trust.reason);
  if (trust.is_much_missing) notes.push_back(depthQuestion(folder, run));
  if (pieces.size() > 1)
    notes.push_back(fmt::format("{} in {} that nothing connects to the map: pieces.txt has their poses",
                                plural(run.tracked.size() - pieces.front().frames.size(), "frame is", "frames are"),
                                plural(pieces.size() - 1, "piece", "pieces")));
  if (run.lost > 0)
    notes.push_back(fmt::format("the track was lost for {} and found again {}", plural(run.lost, "frame", "frames"),
                                plural(run.found_again, "time", "times")));
}

void noteOnFocalLength(const Map3dRun& run, std::vector<std::string>& notes) {
  if (run.frames > 0 && !run.mapper.isFocalLengthChecked())
    notes.emplace_back("the focal length could not be checked: too few views of the same place could be compared");
}

void noteOnPoses(const RgbdFolder& folder, const Map3dRun& run, std::vector<std::string>& notes) {
  if (run.given.empty()) return;
  const auto& pairs = folder.listing().pairs;
  if (static_cast<double>(run.with_pose) < kFewPoses * static_cast<double>(run.frames))
    notes.push_back(fmt::format("{}: the poses are from {:.3f} s to {:.3f} s, the frames from {:.3f} s to {:.3f} s",
                                run.with_pose == 0 ? std::string("no frame has a pose of its time")
                                                   : fmt::format("only {} of {} have a pose of their time",
                                                                 run.with_pose, plural(run.frames, "frame", "frames")),
                                run.given.front().stamp.seconds(), run.given.back().stamp.seconds(),
                                pairs.front().stamp.seconds(), pairs.back().stamp.seconds()));
  if (const auto& apart = run.disagreement_of_given; apart && apart->isContradiction())
    notes.push_back(fmt::format(
        "the given poses contradict the pictures: within {:.1f} s the camera moves by {:.2f} m and {:.1f} deg in the "
        "median, and the poses differ from that by {:.3g} m and {:.1f} deg; are they in metres, their rotations in the "
        "order qx qy qz qw, and of this camera (x right, y down, z along the view) and its clock?",
        apart->stretch_s, apart->motion_m, apart->motion_rad / common::kRadPerDeg, apart->error_m,
        apart->error_rad / common::kRadPerDeg));
}

void noteOnStamps(const RgbdFolder& folder, std::vector<std::string>& notes) {
  const auto& pairs = folder.listing().pairs;
  if (folder.listing().stamps_per_s != 1.0)
    notes.push_back(fmt::format("the stamps are whole numbers: they are taken for frames, {:g} of which are a second",
                                folder.listing().stamps_per_s));
  const std::string steps = interfaces::stampStepNote(
      common::medianStep_s(pairs, [](const interfaces::RgbdListing::Pair& pair) { return pair.stamp; }));
  if (!steps.empty()) notes.push_back(steps);
  double longest_s = 0.0, from_s = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double gap_s = (pairs[i].stamp - pairs[i - 1].stamp).seconds();
    if (gap_s <= longest_s) continue;
    longest_s = gap_s;
    from_s = pairs[i - 1].stamp.seconds();
  }
  if (longest_s > kLongGap_s)
    notes.push_back(
        fmt::format("the longest gap between two frames is {:.1f} s, after the one of {:.3f} s", longest_s, from_s));
}

void noteOnFrames(const RgbdFolder& folder, std::vector<std::string>& notes) {
  notes.insert(notes.end(), folder.listing().notes.begin(), folder.listing().notes.end());
  if (folder.listing().unpaired > 0)
    notes.push_back(plural(folder.listing().unpaired, "image has", "images have") + " no partner of the same time");
  for (std::size_t i = 0; i < interfaces::kFrameFaults; ++i) {
    const auto fault = static_cast<FrameFault>(i);
    if (folder.skipped(fault) > 0)
      notes.push_back(fmt::format("{} skipped: {}; the first: {}",
                                  plural(folder.skipped(fault), "frame was", "frames were"),
                                  interfaces::toString(fault), folder.firstDetail(fault)));
  }
}

std::string remedyOf(FrameFault fault, const RgbdFolder& folder) {
  switch (fault) {
    case FrameFault::kMissing:
      return "are the images of the list in the folder?";
    case FrameFault::kOtherSize:
      return "give the calibration of this camera (--intrinsics), with its width_px and height_px";
    case FrameFault::kNoDepth:
      return "a frame needs depths in most of it";
    case FrameFault::kOtherScale:
      return fmt::format("are {:g} units a metre right? Give depth_units_per_m (--intrinsics)",
                         folder.calibration().depth_units_per_m);
    case FrameFault::kUnreadable:
    case FrameFault::kBlack:
    case FrameFault::kWhite:
    case FrameFault::kRepeated:
    case FrameFault::kStampRepeated:
      break;
  }
  return "the notes above say why";
}

}  // namespace

std::vector<std::string> map3dNotes(const RgbdFolder& folder, const Map3dRun& run, const std::vector<MapPiece>& pieces,
                                    const Map3dTrust& trust) {
  std::vector<std::string> notes;
  noteOnTrack(folder, run, pieces, trust, notes);
  noteOnFocalLength(run, notes);
  noteOnPoses(folder, run, notes);
  noteOnStamps(folder, notes);
  noteOnFrames(folder, notes);
  return notes;
}

std::string map3dRemedy(const RgbdFolder& folder, const Map3dRun& run) {
  if (run.frames > 0) return "they could be read, but show too little texture and too few surfaces to begin with";
  auto most = FrameFault::kMissing;
  for (std::size_t i = 0; i < interfaces::kFrameFaults; ++i)
    if (const auto fault = static_cast<FrameFault>(i); folder.skipped(fault) > folder.skipped(most)) most = fault;
  return remedyOf(most, folder);
}

}  // namespace swiftlet::apps
